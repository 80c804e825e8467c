#include "seautils/core/text.hpp"
#include "seautils/dccl/codec_impl.hpp"
#include "seautils/dccl/native.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::dccl {

namespace {

using schema::Kind;
using schema::Slot;

std::string with_unit(const Op& op) {
    const std::string unit = field_options(*op.field->descriptor).unit;
    return unit.empty() ? unit : " " + unit;
}

/// A value as a person wrote it.
std::string shown(const Op& op, const Slot& slot, const schema::Values& values) {
    switch (op.field->kind) {
        case Kind::boolean:
            return slot.i != 0 ? "true" : "false";
        case Kind::uint32:
        case Kind::uint64:
            return fmt::format("{}", slot.u);
        case Kind::float32:
            return fmt::format("{}", static_cast<float>(slot.d));
        case Kind::float64:
            return fmt::format("{}", slot.d);
        case Kind::string:
        case Kind::bytes:
            return quote(values.text(slot));
        default:
            return fmt::format("{}", slot.i);
    }
}

/// Seconds of the period, exactly as fmod computes them: both steps are exact in doubles where
/// the value is a multiple of a unit that the remainder can hold, and fmod does the rest.
double remainder(double value, double period) {
    if (!(value >= 0 && value < 9e15)) return std::fmod(value, period);
    const double whole = static_cast<double>(static_cast<std::int64_t>(value / period)) * period;
    const double rest = value - whole;
    if (rest < 0) return rest + period;
    return rest >= period ? rest - period : rest;
}

double as_double(const Op& op, const Slot& slot) {
    switch (op.field->kind) {
        case Kind::float32:
        case Kind::float64:
            return slot.d;
        case Kind::uint32:
        case Kind::uint64:
            return static_cast<double>(slot.u);
        default:
            return static_cast<double>(slot.i);
    }
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
                throw FieldError{"",
                                 "is marked in_head inside of a message that is not in the "
                                 "header: it is never sent (--lenient drops it)"};
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

namespace {

/// Position of an enumerator's number in its declaration (the first name's, for aliases).
std::optional<std::int64_t> position_of(const EnumCode& code, std::int64_t number) {
    if (number >= 0 && number < static_cast<std::int64_t>(code.numbers.size()) &&
        code.numbers[static_cast<std::size_t>(number)] == number &&
        code.positions.front().first >= 0) {
        // numbered from 0 upwards, as most are: still the first of equal numbers?
        const auto at = static_cast<std::size_t>(number);
        if (at == 0 || code.numbers[at - 1] < number) return number;
    }
    const auto found = std::lower_bound(
        code.positions.begin(), code.positions.end(),
        std::pair<std::int32_t, std::uint32_t>(static_cast<std::int32_t>(number), 0));
    if (found == code.positions.end() || found->first != number) return std::nullopt;
    return found->second;
}

}  // namespace

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

void Encoder::native(const Op& op, const Slot& slot) {
    Slot coded = slot;
    if (op.field->kind == Kind::enumeration) {
        const auto position = position_of(program_.enum_code(op), slot.i);
        if (!position) {
            if (!codec_.options.lenient) {
                throw FieldError{"", fmt::format("{} is no number of {}", slot.i,
                                                 op.field->enumeration->full_name)};
            }
            return unset(op);
        }
        coded.i = *position;
    }
    if (op.presence_bit) writer_.put(1, 1);
    put_native(*op.field, coded, writer_);
}

void Encoder::arithmetic(const Op& op, const Frame& frame) {
    const entropy::Model& model = program_.model(op);
    const Slot& slot = values_[frame.block + op.slot];
    std::uint32_t count = op.repeated ? slot.aux : 1;
    if (!slot.present) count = 0;
    if (op.repeated && !codec_.options.lenient &&
        (count > op.max_repeat || count < op.min_repeat)) {
        throw FieldError{"", fmt::format("has {}, not {} to {}", counted(count, "element"),
                                         op.min_repeat, op.max_repeat)};
    }
    count = std::min(count, op.max_repeat);
    const std::uint32_t first =
        op.repeated ? static_cast<std::uint32_t>(slot.u) : frame.block + op.slot;
    codec_.run.clear();
    for (std::uint32_t k = 0; k < count; ++k) {
        const double x = as_double(op, values_[first + k]);
        if (std::isnan(x)) throw FieldError{"", "is NaN, which has no code"};
        if (!codec_.options.lenient &&
            (x < model.value_bound.front() || x > model.value_bound.back())) {
            throw FieldError{
                "", fmt::format("{} is outside {} to {} (model {})", x, model.value_bound.front(),
                                model.value_bound.back(), quote(model.name))};
        }
        codec_.run.push_back(x);
    }
    entropy::encode_run(
        model, codec_.encoder_counts.at(model.name), codec_.run, op.max_repeat,
        [&](bool bit) { writer_.put(bit ? 1 : 0, 1); }, codec_.options.lenient);
}

namespace {

/// The value of the message's field of that name, or 0.
float number_of(const schema::Layout& layout, const schema::Values& values, std::uint32_t block,
                const char* name) {
    const std::int32_t index = layout.find(name);
    if (index < 0) return 0;
    const schema::Field& f = layout.fields[static_cast<std::size_t>(index)];
    const Slot& s = values[block + static_cast<std::uint32_t>(index)];
    if (!s.present || f.repeated) return 0;
    const bool floating = f.kind == Kind::float32 || f.kind == Kind::float64;
    return static_cast<float>(floating ? s.d : static_cast<double>(s.i));
}

}  // namespace

void Encoder::ccl(const Op& op, const Slot& slot) {
    const bool by_message = op.ccl == CclCodec::gfi_pitch_oil;
    if (by_message) {
        const auto block = static_cast<std::uint32_t>(slot.u);
        const schema::Layout& layout = *op.field->message;
        const GfiPitchOil value{number_of(layout, values_, block, "gfi"),
                                number_of(layout, values_, block, "pitch"),
                                number_of(layout, values_, block, "oil")};
        return writer_.put(ccl_encode_gfi_pitch_oil(value), 16);
    }
    const double x = as_double(op, slot);
    if (std::isnan(x) || std::isinf(x))
        throw FieldError{"", fmt::format("is {}, which has no code", x)};
    if (op.ccl == CclCodec::time_date) {
        return writer_.put(ccl_encode_time_date(slot.u), 24);
    }
    bool metres_per_second = false;
    if (op.ccl == CclCodec::speed) metres_per_second = values_[op.extra].i == 1;
    const auto outside = codec_.options.lenient
                             ? std::nullopt
                             : ccl_out_of_range(op.ccl, x, op.max_length, metres_per_second);
    if (outside) {
        throw FieldError{"", fmt::format("{} is outside {} to {}{}", shown(op, slot, values_),
                                         outside->min, outside->max, with_unit(op))};
    }
    const std::uint32_t code = ccl_encode(op.ccl, x, op.max_length, metres_per_second);
    if (op.ccl == CclCodec::fix_age) {
        return writer_.put(code + (op.number.null_code ? 1U : 0U), op.number.width);
    }
    writer_.put(code, op.max_length);
}

}  // namespace seautils::dccl
