#include "seautils/dccl/native.hpp"

#include "seautils/core/error.hpp"

#include <bit>

namespace seautils::dccl {

namespace {

using schema::Kind;
using schema::WireForm;

void put_varint(std::uint64_t x, BitWriter& writer) {
    while (x >= 0x80) {
        writer.put((x & 0x7f) | 0x80, 8);
        x >>= 7;
    }
    writer.put(x, 8);
}

std::uint64_t get_varint(BitReader& reader) {
    std::uint64_t x = 0;
    for (unsigned shift = 0; shift < 70; shift += 7) {
        const std::uint64_t byte = reader.get(8);
        if (shift < 64) x |= (byte & 0x7f) << shift;
        if (byte < 0x80) return x;
    }
    throw DataError("is a varint of more than ten bytes");
}

std::uint64_t zigzag(std::int64_t x) {
    return (static_cast<std::uint64_t>(x) << 1) ^ static_cast<std::uint64_t>(x >> 63);
}
std::int64_t unzigzag(std::uint64_t x) {
    return static_cast<std::int64_t>((x >> 1) ^ (~(x & 1) + 1));
}

/// The bits of a 32-bit field as a slot keeps them.
void set_32(const schema::Field& field, std::uint32_t bits, schema::Slot& slot) {
    if (field.kind == Kind::float32) {
        slot.d = static_cast<double>(std::bit_cast<float>(bits));
    } else if (field.kind == Kind::uint32) {
        slot.u = bits;
    } else {
        slot.i = static_cast<std::int32_t>(bits);
    }
}

}  // namespace

void put_native(const schema::Field& field, const schema::Slot& slot, BitWriter& writer) {
    switch (field.wire_form) {
        case WireForm::fixed32:
            writer.put(field.kind == Kind::float32
                           ? std::bit_cast<std::uint32_t>(static_cast<float>(slot.d))
                           : slot.u,
                       32);
            return;
        case WireForm::fixed64:
            writer.put(slot.u, 64);
            return;  // a double's bits are in place
        case WireForm::zigzag:
            put_varint(zigzag(slot.i), writer);
            return;
        default:
            put_varint(slot.u, writer);
            return;
    }
}

void get_native(const schema::Field& field, BitReader& reader, schema::Slot& slot) {
    switch (field.wire_form) {
        case WireForm::fixed32:
            set_32(field, static_cast<std::uint32_t>(reader.get(32)), slot);
            return;
        case WireForm::fixed64:
            slot.u = reader.get(64);
            return;
        case WireForm::zigzag: {
            std::uint64_t x = get_varint(reader);
            if (field.kind == Kind::int32) x &= 0xffffffff;  // as protobuf: cut, then undone
            slot.i = unzigzag(x);
            return;
        }
        default:
            break;
    }
    if (field.kind == Kind::boolean) {  // one byte, as the header's size is fixed
        slot.i = reader.get(8) != 0 ? 1 : 0;
        return;
    }
    const std::uint64_t x = get_varint(reader);
    if (field.kind == Kind::int32 || field.kind == Kind::enumeration)
        slot.i = static_cast<std::int32_t>(x);
    else if (field.kind == Kind::uint32)
        slot.u = static_cast<std::uint32_t>(x);
    else
        slot.u = x;
}

}  // namespace seautils::dccl
