#include "seautils/sim/fields.hpp"

#include "seautils/core/error.hpp"
#include "seautils/stream/hex.hpp"

#include <fmt/format.h>

#include <charconv>

namespace seautils::sim {

unsigned Fields::number(std::size_t k, unsigned least, unsigned most) const {
    const std::string_view word = text(k);
    unsigned value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < least || value > most)
        throw Refusal{3, fmt::format("field {} is not {} to {}", k, least, most)};
    return value;
}

std::string Fields::bytes(std::size_t k, std::size_t most) const {
    std::string bytes;
    try {
        stream::from_hex(text(k), bytes);
    } catch (const DataError&) {
        throw Refusal{3, fmt::format("field {} is not hexadecimal", k)};
    }
    if (bytes.size() > most)
        throw Refusal{3, fmt::format("{} bytes where {} fit", bytes.size(), most)};
    return bytes;
}

void Fields::need(std::size_t count) const {
    if (sentence_.fields() < count)
        throw Refusal{3, fmt::format("{} fields where {} are needed", sentence_.fields(), count)};
}

}  // namespace seautils::sim
