#include "seautils/core/text.hpp"
#include "seautils/dccl/codec_impl.hpp"

#include <fmt/format.h>

#include <cmath>

namespace seautils::dccl {

namespace {

using schema::Kind;
using schema::Slot;

/// In Slot::aux of a oneof's member that is not set yet: the selector chose it.
constexpr std::uint32_t chosen = 0xffffffff;

std::int64_t floor_mod(std::int64_t a, std::int64_t b) {
    const std::int64_t r = a % b;
    return r < 0 ? r + b : r;
}

}  // namespace

void Decoder::part(const std::vector<Op>& ops, BitReader& reader) {
    ops_ = ops.data();
    reader_ = &reader;
    range(0, ops.size(), {0, &program_.layout(), 1});
}

void Decoder::range(std::size_t first, std::size_t last, const Frame& frame) {
    std::size_t at = first;
    const auto name = [&] {
        return ops_[at].field != nullptr ? ops_[at].field->name : std::string("oneof");
    };
    try {
        for (; at < last; at = ops_[at].end) {
            const Op& op = ops_[at];
            if (op.plain)
                single(op, at, frame.block + op.slot, frame);
            else
                step(op, at, frame);
        }
    } catch (FieldError& e) {
        e.enter(name());
        throw;
    } catch (const OutOfBits& e) {
        throw FieldError{name(), "takes " + where_left(e.wanted, "bit", e.left), true};
    } catch (const DataError& e) {
        throw FieldError{name(), e.what()};
    }
}

void Decoder::step(const Op& op, std::size_t at, const Frame& frame) {
    if (op.kind == OpKind::selectors) return selectors(op, frame);
    if (op.kind == OpKind::lost) return;
    const std::uint32_t slot = frame.block + op.slot;
    if (op.in_oneof) {
        if (values_[slot].aux != chosen) return;
        values_[slot].aux = 0;
    }
    if (op.condition >= 0) return conditional(op, at, frame);
    if (op.kind == OpKind::arithmetic) return arithmetic(op, frame);
    if (op.repeated) return repeated(op, at, frame);
    single(op, at, slot, frame);
}

void Decoder::conditional(const Op& op, std::size_t at, const Frame& frame) {
    if (op.repeated && op.kind != OpKind::arithmetic) return repeated(op, at, frame);
    if (dynamic().omitted(op, frame)) return;
    const Op effective = dynamic().effective(op, frame);
    if (op.kind == OpKind::arithmetic) return arithmetic(effective, frame);
    single(effective, at, frame.block + op.slot, frame);
}

void Decoder::single(const Op& op, std::size_t at, std::uint32_t slot, const Frame& frame) {
    if (op.presence_bit && reader_->get(1) == 0) return;
    value(op, at, slot, frame);
    settle(op, slot);
}

/// As in a protobuf message: of proto3's fields without presence, one that holds the default is
/// unset, though the wire has a code for each.
void Decoder::settle(const Op& op, std::uint32_t slot) {
    if (op.repeated || op.field->has_presence) return;
    if (is_default(*op.field, values_[slot])) values_[slot].present = false;
}

void Decoder::repeated(const Op& op, std::size_t at, const Frame& frame) {
    std::uint32_t count = op.max_repeat;
    if (op.counted) {
        count = op.min_repeat + static_cast<std::uint32_t>(reader_->get(op.count_width));
    }
    const bool is_message = op.kind == OpKind::message;
    if (is_message && count > op.max_repeat) {
        throw FieldError{
            "", fmt::format("counts {} elements, more than max_repeat {}", count, op.max_repeat)};
    }
    const std::uint32_t list = frame.block + op.slot;
    // A version 2 message is entered once for the header and once for the body.
    const bool again = values_[list].present;
    if (again && values_[list].aux != count) {
        throw FieldError{"", fmt::format("counts {} elements in the body, but {} in the header",
                                         count, values_[list].aux)};
    }
    const std::uint32_t first =
        again ? static_cast<std::uint32_t>(values_[list].u) : values_.add_elements(list, count);
    for (std::uint32_t k = 0; k < count; ++k) {
        const Frame inside{frame.block, frame.layout, k + 1};
        try {
            if (op.condition >= 0) {
                Frame self = inside;
                if (is_message) self = {block_of(op, first + k), op.field->message, k + 1};
                if (dynamic().omitted(op, self)) {
                    values_[first + k].present = false;
                    continue;
                }
                single(dynamic().effective(op, inside), at, first + k, inside);
            } else {
                single(op, at, first + k, inside);
            }
        } catch (FieldError& e) {
            e.enter(fmt::format("[{}]", k));
            throw;
        } catch (const OutOfBits& e) {
            throw FieldError{fmt::format("[{}]", k), "takes " + where_left(e.wanted, "bit", e.left),
                             true};
        }
    }
    if (is_message && op.condition < 0) return;  // all are there
    if (op.drop_empty) return;                   // prune() closes the gaps, after the body
    std::uint32_t kept = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
        if (values_[first + k].present) values_[first + kept++] = values_[first + k];
    }
    values_[list].aux = kept;
    values_[list].present = kept > 0;
}

void Decoder::selectors(const Op& op, const Frame& frame) {
    for (const SelectorCode::Oneof& oneof : program_.selectors(op).oneofs) {
        const std::uint64_t choice = reader_->get(oneof.width);
        if (choice == 0 || choice > oneof.slots.size()) continue;
        values_[frame.block + oneof.slots[choice - 1]].aux = chosen;
    }
}

void Decoder::value(const Op& op, std::size_t at, std::uint32_t slot, const Frame& frame) {
    Slot& s = values_[slot];
    switch (op.kind) {
        case OpKind::integer:
        case OpKind::floating:
            return number(op, s);
        case OpKind::boolean: {
            std::uint64_t code = 0;
            if (!take_null(op, code)) return;
            s.i = code != 0 ? 1 : 0;
            s.present = true;
            return;
        }
        case OpKind::enumeration:
            return enumeration(op, s);
        case OpKind::text:
            return text(op, slot);
        case OpKind::message:
            return message(op, at, slot, frame);
        case OpKind::time:
            return time(op, s);
        case OpKind::fixed_value:
            return fixed_value(op, slot);
        case OpKind::hash:
            return hash(op, s);
        case OpKind::native:
            return native(op, s);
        case OpKind::ccl:
            return ccl(op, slot);
        case OpKind::custom:
            return program_.field_codec(op).decode(*op.field, *reader_, values_, slot);
        case OpKind::arithmetic:
        case OpKind::selectors:
        case OpKind::lost:
            return;
    }
}

/// The message at the slot, which the header's pass may have made.
std::uint32_t Decoder::block_of(const Op& op, std::uint32_t slot) {
    if (values_[slot].present) return static_cast<std::uint32_t>(values_[slot].u);
    return values_.add_block(slot, *op.field->message);
}

void Decoder::message(const Op& op, std::size_t at, std::uint32_t slot, const Frame& frame) {
    const std::uint32_t block = block_of(op, slot);
    range(at + 1, ops_[at].end, {block, op.field->message, frame.index});
}

/// Reads a code; false: it says "not set". The shift is undone.
bool Decoder::take_null(const Op& op, std::uint64_t& code) {
    code = reader_->get(op.number.width);
    if (!op.number.null_code) return true;
    return code-- != 0;
}

void Decoder::number(const Op& op, Slot& slot) {
    std::uint64_t code = 0;
    if (!take_null(op, code)) return;
    if (op.kind == OpKind::integer)
        slot.i = decode_integer(op.number, code);
    else
        slot.d = decode_float(op.number, code);
    slot.present = true;
}

void Decoder::enumeration(const Op& op, Slot& slot) {
    std::uint64_t raw = 0;
    if (!take_null(op, raw)) return;
    const EnumCode& code = program_.enum_code(op);
    const std::int64_t value = decode_integer(op.number, raw);
    if (code.packed) {
        if (value < 0 || value >= static_cast<std::int64_t>(code.numbers.size())) return;
        slot.i = code.numbers[static_cast<std::size_t>(value)];
    } else {
        if (op.field->enumeration->find(static_cast<std::int32_t>(value)) == nullptr) return;
        slot.i = value;
    }
    slot.present = true;
}

void Decoder::text(const Op& op, std::uint32_t slot) {
    std::uint64_t length = op.max_length;
    if (op.text_form == TextForm::counted) length = reader_->get(op.length_width);
    if (length == 0 && op.empty_is_unset) return;
    if (length * 8 > reader_->left()) throw OutOfBits{length * 8, reader_->left()};
    char* to = values_.add_text(slot, static_cast<std::uint32_t>(length));
    reader_->get_bytes(to, length);
}

/// The time nearest to the receiver's clock that has these seconds of the period.
void Decoder::time(const Op& op, Slot& slot) {
    std::uint64_t raw = 0;
    if (!take_null(op, raw)) return;
    const TimeCode& code = program_.time_code(op);
    const double seconds = decode_float(op.number, raw);
    const std::int64_t today = floor_mod(codec_.options.now_s, code.period_s);
    std::int64_t start = codec_.options.now_s - today;
    const double half = static_cast<double>(code.period_s) / 2;
    if (seconds - static_cast<double>(today) > half)
        start -= code.period_s;
    else if (static_cast<double>(today) - seconds > half)
        start += code.period_s;
    const double step = codec_.options.full_time_resolution ? code.fine_rounding : code.rounding;
    const double sum = static_cast<double>(start) + seconds;
    slot.present = true;
    if (op.field->kind == Kind::float64) {
        slot.d = quantize(sum, step, 1.0 / step);
        return;
    }
    NumberCode rounding;
    rounding.kind = op.field->kind;
    rounding.resolution = step;
    rounding.whole_step = step >= 1;
    rounding.step = step >= 1 ? static_cast<std::int64_t>(step) : 1;
    Slot whole;
    set_number(Kind::int64, code.conversion * sum, whole);
    slot.i = quantize_integer(whole.i, rounding);
}

void Decoder::fixed_value(const Op& op, std::uint32_t slot) {
    const FixedValue& fixed = program_.fixed_value(op);
    if (op.field->kind == Kind::string || op.field->kind == Kind::bytes) {
        return values_.set_text(slot, fixed.text);
    }
    values_[slot].u = fixed.value.u;
    values_[slot].present = true;
}

void Decoder::prune() { prune(program_.pruning(), 0); }

void Decoder::prune(const std::vector<Pruning>& below, std::uint32_t block) {
    for (const Pruning& p : below) {
        const std::uint32_t at = block + p.slot;
        if (!values_[at].present) continue;
        const std::uint32_t first = p.repeated ? static_cast<std::uint32_t>(values_[at].u) : at;
        const std::uint32_t count = p.repeated ? values_[at].aux : 1;
        std::uint32_t kept = 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            if (!values_[first + k].present) continue;
            const auto inner = static_cast<std::uint32_t>(values_[first + k].u);
            prune(p.below, inner);
            bool empty = p.drop_empty;
            for (std::uint32_t f = 0; empty && f < p.layout->fields.size(); ++f) {
                empty = !values_[inner + f].present;
            }
            if (empty)
                values_[first + k].present = false;
            else if (p.repeated)
                values_[first + kept++] = values_[first + k];
        }
        if (!p.repeated) continue;
        values_[at].aux = kept;
        values_[at].present = kept > 0;
    }
}

}  // namespace seautils::dccl
