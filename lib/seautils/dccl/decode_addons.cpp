// What the codecs beside the bounded numbers take out of bits.
#include "seautils/dccl/codec_impl.hpp"
#include "seautils/dccl/native.hpp"

#include <fmt/format.h>

#include <cmath>

namespace seautils::dccl {

using schema::Kind;
using schema::Slot;

void set_number(Kind kind, double x, Slot& slot) {
    switch (kind) {
        case Kind::float64:
            slot.d = x;
            return;
        case Kind::float32:
            slot.d = static_cast<double>(static_cast<float>(x));
            return;
        case Kind::boolean:
            slot.i = x != 0 ? 1 : 0;
            return;
        case Kind::uint32:
            slot.u = !(x > 0) ? 0 : x < 4294967295.0 ? static_cast<std::uint32_t>(x) : 4294967295U;
            return;
        case Kind::uint64:
            slot.u = !(x > 0)                     ? 0
                     : x < 18446744073709549568.0 ? static_cast<std::uint64_t>(x)
                                                  : ~std::uint64_t{0};
            return;
        case Kind::int64:
            slot.i = static_cast<std::int64_t>(
                std::fmin(std::fmax(x, -9223372036854775808.0), 9223372036854774784.0));
            return;
        default:
            slot.i =
                static_cast<std::int64_t>(std::fmin(std::fmax(x, -2147483648.0), 2147483647.0));
            return;
    }
}

void Decoder::hash(const Op& op, Slot& slot) {
    const HashCode& h = program_.hash_code(op);
    const std::uint64_t given = reader_->get(h.width);
    if (given != h.value) {
        throw FieldError{
            "",
            fmt::format("is {:#x} where this schema's hash is {:#x}: the sender's schema differs",
                        given, h.value)};
    }
    slot.u = given;
    slot.present = true;
}

void Decoder::native(const Op& op, Slot& slot) {
    Slot coded;
    get_native(*op.field, *reader_, coded);
    if (op.field->kind == Kind::enumeration) {
        const EnumCode& code = program_.enum_code(op);
        if (coded.i < 0 || coded.i >= static_cast<std::int64_t>(code.numbers.size())) return;
        coded.i = code.numbers[static_cast<std::size_t>(coded.i)];
    }
    slot.u = coded.u;
    slot.present = true;
}

void Decoder::arithmetic(const Op& op, const Frame& frame) {
    const entropy::Model& model = program_.model(op);
    codec_.run.clear();
    entropy::decode_run(
        model, codec_.decoder_counts.at(model.name), op.max_repeat,
        [&] { return reader_->get(1) != 0; }, codec_.run);
    const std::uint32_t list = frame.block + op.slot;
    const auto keep = [&](std::uint32_t slot, double x) {
        const bool is_float = op.field->kind == Kind::float32 || op.field->kind == Kind::float64;
        if (std::isnan(x) && !is_float) return false;
        set_number(op.field->kind, x, values_[slot]);
        if (op.field->kind == Kind::enumeration &&
            op.field->enumeration->find(static_cast<std::int32_t>(values_[slot].i)) == nullptr) {
            return false;
        }
        values_[slot].present = true;
        return true;
    };
    if (!op.repeated) {
        if (!codec_.run.empty()) keep(list, codec_.run.front());
        return settle(op, list);
    }
    const std::uint32_t first =
        values_.add_elements(list, static_cast<std::uint32_t>(codec_.run.size()));
    std::uint32_t kept = 0;
    for (const double x : codec_.run) kept += keep(first + kept, x) ? 1U : 0U;
    values_[list].aux = kept;
    values_[list].present = kept > 0;
}

namespace {

/// Sets the message's number of that name, if it has one.
void set_field(const schema::Layout& layout, schema::Values& values, std::uint32_t block,
               const char* name, double x) {
    const std::int32_t index = layout.find(name);
    if (index < 0 || layout.fields[static_cast<std::size_t>(index)].repeated) return;
    Slot& slot = values[block + static_cast<std::uint32_t>(index)];
    set_number(layout.fields[static_cast<std::size_t>(index)].kind, x, slot);
    slot.present = true;
}

}  // namespace

void Decoder::ccl(const Op& op, std::uint32_t slot) {
    if (op.ccl == CclCodec::gfi_pitch_oil) {
        const auto code = static_cast<std::uint32_t>(reader_->get(16));
        const GfiPitchOil value = ccl_decode_gfi_pitch_oil(code);
        const schema::Layout& layout = *op.field->message;
        const std::uint32_t block = values_.add_block(slot, layout);
        set_field(layout, values_, block, "gfi", static_cast<double>(value.gfi_percent));
        set_field(layout, values_, block, "pitch", static_cast<double>(value.pitch_deg));
        set_field(layout, values_, block, "oil", static_cast<double>(value.oil_percent));
        return;
    }
    Slot& s = values_[slot];
    if (op.ccl == CclCodec::fix_age) {
        std::uint64_t code = 0;
        if (!take_null(op, code)) return;
        s.u = code * 4;
    } else if (op.ccl == CclCodec::time_date) {
        s.u = ccl_decode_time_date(static_cast<std::uint32_t>(reader_->get(24)),
                                   codec_.options.now_s);
    } else {
        bool metres_per_second = false;
        if (op.ccl == CclCodec::speed) metres_per_second = values_[op.extra].i == 1;
        const auto code = static_cast<std::uint32_t>(reader_->get(op.max_length));
        set_number(op.field->kind, ccl_decode(op.ccl, code, metres_per_second), s);
    }
    s.present = true;
}

}  // namespace seautils::dccl
