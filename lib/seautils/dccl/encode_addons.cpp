// What the codecs beside the bounded numbers put into bits.
#include "seautils/core/text.hpp"
#include "seautils/dccl/codec_impl.hpp"
#include "seautils/dccl/native.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::dccl {

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
