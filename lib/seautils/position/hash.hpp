#ifndef SEAUTILS_POSITION_HASH_HPP
#define SEAUTILS_POSITION_HASH_HPP

#include <cstdint>
#include <string_view>

namespace seautils::position {

/// 64 bits that stand for bytes and a seed; the same on any machine.
/// Eight bytes at a time, the first the least significant, go through SplitMix64 (core/random.hpp).
/// Check value: no bytes and seed 1 give 910a2dec89025cc1.
std::uint64_t hash(std::string_view bytes, std::uint64_t seed);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_HASH_HPP
