#include "seautils/position/hash.hpp"

#include "seautils/core/random.hpp"

#include <cstddef>

namespace seautils::position {

namespace {

constexpr std::size_t word_bytes = 8;

std::uint64_t word(std::string_view bytes) {
    std::uint64_t value = 0;
    for (std::size_t k = bytes.size(); k > 0; --k)
        value = value << 8 | static_cast<unsigned char>(bytes[k - 1]);
    return value;
}

}  // namespace

std::uint64_t hash(std::string_view bytes, std::uint64_t seed) {
    std::uint64_t value = splitmix64(seed ^ bytes.size());
    for (std::size_t at = 0; at < bytes.size(); at += word_bytes)
        value = splitmix64(value ^ word(bytes.substr(at, word_bytes)));
    return value;
}

}  // namespace seautils::position
