#ifndef SEAUTILS_DCCL_NATIVE_HPP
#define SEAUTILS_DCCL_NATIVE_HPP

#include "seautils/dccl/bits.hpp"
#include "seautils/schema/values.hpp"

namespace seautils::dccl {

/// dccl.native_protobuf: protobuf's own encoding of a value, without its tag, byte by byte at the
/// current bit. An enumeration's slot holds the *position* of the enumerator, not its number.
void put_native(const schema::Field& field, const schema::Slot& slot, BitWriter& writer);

/// @throws OutOfBits
/// @throws DataError  a varint of more than ten bytes
void get_native(const schema::Field& field, BitReader& reader, schema::Slot& slot);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_NATIVE_HPP
