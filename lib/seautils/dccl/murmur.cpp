#include "seautils/dccl/murmur.hpp"

#include <cstddef>

namespace seautils::dccl {

namespace {

constexpr std::uint64_t multiplier = 0xc6a4a7935bd1e995;
constexpr std::uint64_t seed = 0xc70f6907;

std::uint64_t fold(std::uint64_t x) { return x ^ (x >> 47); }

/// Up to eight bytes as a number, the first one lowest.
std::uint64_t word(std::string_view bytes) {
    std::uint64_t w = 0;
    for (std::size_t k = bytes.size(); k > 0; --k) {
        w = w << 8 | static_cast<unsigned char>(bytes[k - 1]);
    }
    return w;
}

}  // namespace

std::uint64_t std_string_hash(std::string_view bytes) {
    std::uint64_t hash = seed ^ (bytes.size() * multiplier);
    for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
        hash = (hash ^ (fold(word(bytes.substr(0, 8)) * multiplier) * multiplier)) * multiplier;
    }
    if (!bytes.empty()) hash = (hash ^ word(bytes)) * multiplier;
    return fold(fold(hash) * multiplier);
}

}  // namespace seautils::dccl
