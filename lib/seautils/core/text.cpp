#include "seautils/core/text.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <numeric>

namespace seautils {

namespace {

constexpr std::size_t longest_quote = 60;
constexpr std::size_t longest_name = 200;  ///< the comparison of names takes time by its square

constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Value of each base64 digit; 64 for what is none.
constexpr std::array<std::uint8_t, 256> digit_values = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(64);
    for (std::uint8_t k = 0; k < 64; ++k) values[static_cast<unsigned char>(alphabet[k])] = k;
    values['-'] = 62;
    values['_'] = 63;
    return values;
}();

/// Levenshtein's distance.
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] =
                std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

std::string lower_first(std::string sentence) {
    const auto letter = [&](std::size_t k) { return static_cast<unsigned char>(sentence[k]); };
    if (sentence.size() > 1 && std::islower(letter(1)) != 0)
        sentence[0] = static_cast<char>(std::tolower(letter(0)));
    return sentence;
}

std::string counted(std::uint64_t n, std::string_view thing) {
    return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

std::string where_left(std::uint64_t wanted, std::string_view thing, std::uint64_t left) {
    return fmt::format("{} where {} {} left", counted(wanted, thing), left,
                       left == 1 ? "is" : "are");
}

std::size_t utf8_length(std::string_view text) {
    if (text.empty()) return 0;
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(k) & 0xc0) != 0x80) return 0;
    }
    const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
    const bool surrogate = first == 0xed && byte(1) >= 0xa0;
    const bool beyond = first == 0xf4 && byte(1) >= 0x90;
    return overlong || surrogate || beyond ? 0 : length;
}

bool is_valid_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

namespace {

/// Appends the text as printable() says, up to the character that begins at or behind `most`; returns
/// how many bytes of it that was.
std::size_t append_printable(std::string& out, std::string_view text, std::size_t most) {
    std::size_t at = 0;
    while (at < text.size() && at < most) {
        const std::size_t length = utf8_length(text.substr(at));
        const auto byte = static_cast<unsigned char>(text[at]);
        if (length == 0 || byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\x{:02x}", byte);
            ++at;
        } else {
            out += text.substr(at, length);
            at += length;
        }
    }
    return at;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
    std::string out;
    if (append_printable(out, text, most) < text.size()) out += "…";
    return out;
}

std::string quote(std::string_view value) {
    std::string out = "'";
    if (append_printable(out, value, longest_quote) < value.size()) out += "…";
    return out + "'";
}

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
    if (name.size() > longest_name) return {};
    std::size_t best = std::max<std::size_t>(1, name.size() / 3) + 1;
    std::string found;
    for (const std::string& candidate : candidates) {
        if (candidate.size() > longest_name) continue;
        const std::size_t distance = edits(name, candidate);
        if (distance >= best) continue;
        best = distance;
        found = candidate;
    }
    return found;
}

void append_base64(std::string& out, std::string_view bytes) {
    std::size_t at = 0;
    for (; at < bytes.size(); at += 3) {
        std::uint32_t word = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        for (std::size_t k = 0; k < 3; ++k) {
            word = word << 8 | (k < count ? static_cast<unsigned char>(bytes[at + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            out += k <= count ? alphabet[word >> (18 - 6 * k) & 63] : '=';
        }
    }
}

std::string from_base64(std::string_view text) {
    const std::size_t given = text.size();
    std::string_view digits = text;
    while (!digits.empty() && digits.back() == '=' && given - digits.size() < 2)
        digits.remove_suffix(1);
    const bool padded = digits.size() != given;
    if ((padded && given % 4 != 0) || digits.size() % 4 == 1) {
        throw DataError("base64 of " + counted(given, "character") + " is cut short");
    }
    std::string bytes;
    bytes.reserve(digits.size() * 3 / 4);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < digits.size(); ++k) {
        const std::uint8_t value = digit_values[static_cast<unsigned char>(digits[k])];
        if (value == 64) {
            throw DataError(fmt::format("{} in column {} is no base64 digit",
                                        quote(digits.substr(k, 1)), k + 1));
        }
        word = word << 6 | value;
        if (k % 4 != 0) bytes += static_cast<char>(word >> (6 - 2 * (k % 4)) & 0xff);
    }
    const std::size_t rest = digits.size() % 4;
    if ((rest == 2 && (word & 15) != 0) || (rest == 3 && (word & 3) != 0))
        throw DataError("base64 that ends within a byte");
    return bytes;
}

}  // namespace seautils
