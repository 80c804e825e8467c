#include "seautils/stream/hex.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace seautils::stream {

namespace {

constexpr char digits[] = "0123456789abcdef";

/// Value of each hexadecimal digit; 0xff for what is none.
constexpr std::array<std::uint8_t, 256> digit_values = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(0xff);
    for (std::uint8_t k = 0; k < 16; ++k) values[static_cast<unsigned char>(digits[k])] = k;
    for (std::uint8_t k = 10; k < 16; ++k) values[static_cast<unsigned char>("ABCDEF"[k - 10])] = k;
    return values;
}();

std::uint8_t value_of(char c) { return digit_values[static_cast<unsigned char>(c)]; }

[[noreturn]] void refuse(std::string_view text, std::size_t skipped) {
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (value_of(text[k]) == 0xff) {
            throw DataError(quote(text.substr(k, 1)) + " in column " +
                            std::to_string(skipped + k + 1) + " is no hexadecimal digit");
        }
    }
    throw DataError("an odd number of hexadecimal digits, " + std::to_string(text.size()));
}

}  // namespace

void append_hex(std::string& out, std::string_view bytes) {
    const std::size_t start = out.size();
    out.resize(start + 2 * bytes.size());
    char* to = out.data() + start;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        *to++ = digits[byte >> 4];
        *to++ = digits[byte & 15];
    }
}

void from_hex(std::string_view text, std::string& bytes) {
    const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
    text.remove_prefix(first);
    text = text.substr(0, text.find_last_not_of(" \t") + 1);
    if (text.size() % 2 != 0) refuse(text, first);
    bytes.resize(text.size() / 2);
    std::uint8_t bad = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        const std::uint8_t high = value_of(text[2 * k]);
        const std::uint8_t low = value_of(text[2 * k + 1]);
        bad |= high | low;
        bytes[k] = static_cast<char>(high << 4 | (low & 15));
    }
    if ((bad & 0xf0) != 0) refuse(text, first);
}

void append_delimited(std::string& out, std::string_view bytes) {
    std::size_t length = bytes.size();
    for (; length >= 0x80; length >>= 7) out += static_cast<char>((length & 0x7f) | 0x80);
    out += static_cast<char>(length);
    out += bytes;
}

}  // namespace seautils::stream
