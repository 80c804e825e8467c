#ifndef SEAUTILS_DCCL_HASH_HPP
#define SEAUTILS_DCCL_HASH_HPP

#include <cstdint>

namespace seautils::dccl {

class Program;

/// The 64-bit fingerprint of a message's definition that the hash codec puts on the wire, cut to
/// its width: over protobuf's text of the options, the fields, the enumerations and the oneofs in
/// the order of the wire. Units and descriptions count; names count only in oneofs and
/// enumerations; max_bytes does not.
std::uint64_t hash_definition(const Program& program);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_HASH_HPP
