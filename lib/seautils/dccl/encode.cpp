#include "seautils/core/text.hpp"
#include "seautils/dccl/codec_impl.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::dccl {

namespace {

using schema::Kind;
using schema::Slot;

/// Seconds of the period, exactly as fmod computes them: both steps are exact in doubles where
/// the value is a multiple of a unit that the remainder can hold, and fmod does the rest.
double remainder(double value, double period) {
    if (!(value >= 0 && value < 9e15)) return std::fmod(value, period);
    const double whole = static_cast<double>(static_cast<std::int64_t>(value / period)) * period;
    const double rest = value - whole;
    if (rest < 0) return rest + period;
    return rest >= period ? rest - period : rest;
}

}  // namespace

void Encoder::part(const std::vector<Op>& ops) {
    ops_ = ops.data();
    range(0, ops.size(), {0, &program_.layout(), 1});
}

void Encoder::range(std::size_t first, std::size_t last, const Frame& frame) {
    std::size_t at = first;
    try {
        for (; at < last; at = ops_[at].end) {
            const Op& op = ops_[at];
            if (!op.plain) {
                step(op, at, frame);
                continue;
            }
            const Slot& slot = values_[frame.block + op.slot];
            if (!slot.present)
                unset(op);
            else if (op.kind == OpKind::floating)
                number(op, encode_float(op.number, slot.d), slot);
            else
                value(op, at, slot, frame);
        }
    } catch (FieldError& e) {
        if (ops_[at].field != nullptr) e.enter(ops_[at].field->name);
        throw;
    } catch (const DataError& e) {
        throw FieldError{ops_[at].field != nullptr ? ops_[at].field->name : "", e.what()};
    }
}

void Encoder::step(const Op& op, std::size_t at, const Frame& frame) {
    const std::uint32_t slot = frame.block + op.slot;
    switch (op.kind) {
        case OpKind::selectors:
            return selectors(op, frame);
        case OpKind::lost:
            if (values_[slot].present && !codec_.options.lenient) {
                throw FieldError{"", op.in_head
                                         ? "is marked in_head inside of a message that is not in "
                                           "the header: it is never sent (--lenient drops it)"
                                         : "is inside of a message whose in_head differs from what "
                                           "is around it: it is never sent (--lenient drops it)"};
            }
            return;
        default:
            break;
    }
    if (op.in_oneof && !values_[slot].present) return;
    if (op.condition >= 0) return conditional(op, at, frame);
    if (op.kind == OpKind::arithmetic) return arithmetic(op, frame);
    if (op.repeated) return repeated(op, at, frame);
    single(op, at, slot, frame);
}

void Encoder::conditional(const Op& op, std::size_t at, const Frame& frame) {
    if (op.repeated && op.kind != OpKind::arithmetic) return repeated(op, at, frame);
    const Slot& slot = values_[frame.block + op.slot];
    if (dynamic().omitted(op, frame)) {
        if (slot.present && !codec_.options.lenient) {
            throw FieldError{"", "is set although its condition omits it (--lenient drops it)"};
        }
        return;
    }
    const Op effective = dynamic().effective(op, frame);
    if (op.kind == OpKind::arithmetic) return arithmetic(effective, frame);
    single(effective, at, frame.block + op.slot, frame);
}

void Encoder::single(const Op& op, std::size_t at, std::uint32_t slot, const Frame& frame) {
    const Slot& s = values_[slot];
    if (!s.present && op.kind != OpKind::fixed_value && op.kind != OpKind::hash) return unset(op);
    value(op, at, s, frame);
}

void Encoder::repeated(const Op& op, std::size_t at, const Frame& frame) {
    const Slot& list = values_[frame.block + op.slot];
    const std::uint32_t given = list.present ? list.aux : 0;
    if (!codec_.options.lenient && given > op.max_repeat) {
        throw FieldError{"", fmt::format("has {}, more than max_repeat {}",
                                         counted(given, "element"), op.max_repeat)};
    }
    if (!codec_.options.lenient && given < op.min_repeat) {
        throw FieldError{"", fmt::format("has {}, fewer than min_repeat {}",
                                         counted(given, "element"), op.min_repeat)};
    }
    std::uint32_t count = op.max_repeat;
    if (op.counted) {
        count = std::clamp(given, op.min_repeat, op.max_repeat);
        writer_.put(count - op.min_repeat, op.count_width);
    }
    const auto first = static_cast<std::uint32_t>(list.u);
    for (std::uint32_t k = 0; k < count; ++k) {
        const bool present = k < given && values_[first + k].present;
        const Frame inside{frame.block, frame.layout, k + 1};
        try {
            if (op.condition >= 0) {
                if (omitted_element(op, first + k, present, inside)) continue;
                const Op effective = dynamic().effective(op, inside);
                present ? value(effective, at, values_[first + k], inside) : unset(effective);
            } else if (present) {
                value(op, at, values_[first + k], inside);
            } else {
                unset(op);
            }
        } catch (FieldError& e) {
            e.enter(fmt::format("[{}]", k));
            throw;
        }
    }
}

bool Encoder::omitted_element(const Op& op, std::uint32_t slot, bool present, const Frame& frame) {
    Frame self = frame;
    if (op.kind == OpKind::message && present) {
        self = {static_cast<std::uint32_t>(values_[slot].u), op.field->message, frame.index};
    }
    if (!dynamic().omitted(op, self)) return false;
    if (present && !codec_.options.lenient) {
        throw FieldError{"", "is set although its condition omits it (--lenient drops it)"};
    }
    return true;
}

void Encoder::unset(const Op& op) {
    if (op.kind == OpKind::ccl && op.ccl == CclCodec::fix_age && !op.number.null_code) {
        writer_.put(63, op.number.width);  // 252 s, the oldest that the original could say
    } else if (op.presence_bit) {
        writer_.put(0, 1);
    } else {
        writer_.put_zeros(op.element_min_bits);
    }
}

void Encoder::value(const Op& op, std::size_t at, const Slot& slot, const Frame& frame) {
    switch (op.kind) {
        case OpKind::integer:
            return number(op, encode_integer(op.number, slot.i), slot);
        case OpKind::floating:
            return number(op, encode_float(op.number, slot.d), slot);
        case OpKind::boolean:
            return boolean(op, slot.i != 0);
        case OpKind::enumeration:
            return enumeration(op, slot);
        case OpKind::text:
            return text(op, slot);
        case OpKind::message:
            if (op.presence_bit) writer_.put(1, 1);
            return range(at + 1, ops_[at].end,
                         {static_cast<std::uint32_t>(slot.u), op.field->message, frame.index});
        case OpKind::time:
            return time(op, slot);
        case OpKind::fixed_value:
            return fixed_value(op, slot);
        case OpKind::hash: {
            const HashCode& h = program_.hash_code(op);
            return writer_.put(h.value, h.width);
        }
        case OpKind::native:
            return native(op, slot);
        case OpKind::ccl:
            return ccl(op, slot);
        case OpKind::custom:
            return program_.field_codec(op).encode(*op.field, values_, slot, writer_);
        case OpKind::arithmetic:
        case OpKind::selectors:
        case OpKind::lost:
            return;
    }
}

void Encoder::selectors(const Op& op, const Frame& frame) {
    for (const SelectorCode::Oneof& oneof : program_.selectors(op).oneofs) {
        std::uint64_t choice = 0;
        for (std::size_t k = 0; k < oneof.slots.size(); ++k) {
            if (values_[frame.block + oneof.slots[k]].present) choice = k + 1;
        }
        writer_.put(choice, oneof.width);
    }
}

void Encoder::out_of_range(const Op& op, const Slot& slot) {
    if (op.kind == OpKind::floating && std::isnan(slot.d)) {
        throw FieldError{"", "is NaN, which has no code"};
    }
    if (!codec_.options.lenient) {
        throw FieldError{"", fmt::format("{} is outside {} to {}{}", shown(op, slot, values_),
                                         op.number.min, op.number.max, with_unit(op))};
    }
    if (op.presence_bit) writer_.put(1, 1);  // something is there, but it has no code
    writer_.put_zeros(op.element_min_bits);
}

void Encoder::number(const Op& op, std::optional<std::uint64_t> code, const Slot& slot) {
    if (!code) return out_of_range(op, slot);
    if (op.presence_bit) writer_.put(1, 1);
    writer_.put(*code, op.number.width);
}

void Encoder::boolean(const Op& op, bool on) {
    if (op.presence_bit) writer_.put(1, 1);
    writer_.put((on ? 1U : 0U) + (op.number.null_code ? 1U : 0U), op.number.width);
}

void Encoder::enumeration(const Op& op, const Slot& slot) {
    const EnumCode& code = program_.enum_code(op);
    const auto position = position_of(code, slot.i);
    if (!position) {
        if (!codec_.options.lenient) {
            throw FieldError{
                "", fmt::format("{} is no number of {}", slot.i, op.field->enumeration->full_name)};
        }
        return unset(op);
    }
    number(op, encode_integer(op.number, code.packed ? *position : slot.i), slot);
}

void Encoder::text(const Op& op, const Slot& slot) {
    std::string_view bytes = values_.text(slot);
    if (bytes.size() > op.max_length) {
        if (!codec_.options.lenient) {
            throw FieldError{"", fmt::format("{} has {} bytes, more than max_length {}",
                                             quote(bytes), bytes.size(), op.max_length)};
        }
        bytes = bytes.substr(0, op.max_length);
    }
    if (op.presence_bit) writer_.put(1, 1);
    if (op.text_form == TextForm::counted) writer_.put(bytes.size(), op.length_width);
    writer_.put_bytes(bytes);
    if (op.text_form == TextForm::fixed) writer_.put_zeros((op.max_length - bytes.size()) * 8);
}

void Encoder::time(const Op& op, const Slot& slot) {
    const TimeCode& code = program_.time_code(op);
    const double given = as_double(op, slot) / code.conversion;
    if (std::isnan(given)) throw FieldError{"", "is NaN, which has no code"};
    const auto coded =
        encode_float(op.number, remainder(given, static_cast<double>(code.period_s)));
    if (!coded && !codec_.options.lenient) {
        throw FieldError{"", fmt::format("{} is no time after 1970", shown(op, slot, values_))};
    }
    if (!coded) return unset(op);
    writer_.put(*coded, op.number.width);
}

void Encoder::fixed_value(const Op& op, const Slot& slot) {
    if (!slot.present || codec_.options.lenient) return;
    const FixedValue& fixed = program_.fixed_value(op);
    const bool is_text = op.field->kind == Kind::string || op.field->kind == Kind::bytes;
    if (is_text ? values_.text(slot) == fixed.text : slot.u == fixed.value.u) return;
    throw FieldError{"",
                     fmt::format("{} is not its static value {}, which the receiver will see",
                                 shown(op, slot, values_),
                                 is_text ? quote(fixed.text) : shown(op, fixed.value, values_))};
}

}  // namespace seautils::dccl
