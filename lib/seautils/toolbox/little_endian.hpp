#ifndef SEAUTILS_TOOLBOX_LITTLE_ENDIAN_HPP
#define SEAUTILS_TOOLBOX_LITTLE_ENDIAN_HPP

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace seautils::toolbox {

/// The unsigned integer of a number's size.
template <class T>
using BitsOf = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;

/// Appends a number of 4 or 8 bytes, the lowest byte first.
template <class T>
void append_little_endian(std::string& out, T x) {
    auto bits = std::bit_cast<BitsOf<T>>(x);
    for (std::size_t k = 0; k < sizeof(T); ++k, bits = static_cast<BitsOf<T>>(bits >> 8U))
        out += static_cast<char>(bits & 0xFFU);
}

/// The number at an offset. @pre  it lies in the bytes
template <class T>
T little_endian(std::string_view bytes, std::size_t at) {
    BitsOf<T> bits = 0;
    for (std::size_t k = sizeof(T); k-- > 0;)
        bits = static_cast<BitsOf<T>>(bits << 8U) | static_cast<unsigned char>(bytes[at + k]);
    return std::bit_cast<T>(bits);
}

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_LITTLE_ENDIAN_HPP
