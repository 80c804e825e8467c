#ifndef SEAUTILS_DCCL_MURMUR_HPP
#define SEAUTILS_DCCL_MURMUR_HPP

#include <cstdint>
#include <string_view>

namespace seautils::dccl {

/// 64-bit MurmurHash64A with seed 0xc70f6907, words little-endian: what GNU's C++ library gives for
/// std::hash<std::string> on 64-bit machines, here on any machine.
///
/// Source: A. Appleby's MurmurHash2, 64-bit variant.
/// Check value: the empty text gives 0x553e93901e462a6e.
std::uint64_t std_string_hash(std::string_view bytes);

/// Mixes `next` into `hash`: hash ^ (next + 0x9e3779b9 + 64 hash + floor(hash / 4)), modulo 2^64.
constexpr std::uint64_t comb(std::uint64_t hash, std::uint64_t next) {
    return hash ^ (next + 0x9e3779b9 + (hash << 6) + (hash >> 2));
}

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_MURMUR_HPP
