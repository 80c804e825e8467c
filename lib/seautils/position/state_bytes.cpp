#include "seautils/position/state_bytes.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <limits>

namespace seautils::position {

namespace {

constexpr std::size_t sum_bytes = 4;

/// FNV-1a, 32 bits: its steps cannot undo a change of one byte.
std::uint32_t check_sum(std::string_view bytes) {
    std::uint32_t sum = 2166136261U;
    for (const char c : bytes) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619U;
    return sum;
}

std::string sum_of(std::string_view bytes) {
    std::string text;
    const std::uint32_t sum = check_sum(bytes);
    for (unsigned k = 0; k < sum_bytes; ++k) text += static_cast<char>(sum >> (8 * k) & 0xFF);
    return text;
}

[[noreturn]] void damaged() { throw DataError("state is cut or damaged"); }

}  // namespace

void StateWriter::number(std::int64_t value) {
    // The sign goes last, so that small numbers are short: 0, -1, 1, -2 are 0, 1, 2, 3.
    auto left = static_cast<std::uint64_t>(value) * 2;
    if (value < 0) left = ~left;
    for (; left >= 0x80; left /= 0x80) bytes_ += static_cast<char>(0x80 | (left & 0x7F));
    bytes_ += static_cast<char>(left);
}

void StateWriter::text(std::string_view bytes) {
    number(static_cast<std::int64_t>(bytes.size()));
    bytes_ += bytes;
}

std::string StateWriter::finish() const { return bytes_ + sum_of(bytes_); }

StateReader::StateReader(std::string_view bytes, std::uint8_t version) : rest_(bytes) {
    if (bytes.empty()) damaged();
    const auto found = static_cast<unsigned char>(bytes[0]);
    if (found != version) {
        throw DataError(fmt::format("state is of version {}, not {}", found, version));
    }
    if (bytes.size() < 1 + sum_bytes) damaged();
    const std::string_view body = bytes.substr(0, bytes.size() - sum_bytes);
    if (bytes.substr(body.size()) != sum_of(body)) damaged();
    rest_ = body.substr(1);
}

std::int64_t StateReader::any() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        if (rest_.empty()) damaged();
        const auto byte = static_cast<unsigned char>(rest_[0]);
        rest_.remove_prefix(1);
        value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
        if (byte < 0x80) {
            const auto half = static_cast<std::int64_t>(value / 2);
            return value % 2 == 0 ? half : -half - 1;
        }
    }
    damaged();
}

std::int64_t StateReader::number(std::int64_t least, std::int64_t most) {
    const std::int64_t value = any();
    if (value < least || value > most) damaged();
    return value;
}

std::string_view StateReader::text() {
    const auto size = static_cast<std::size_t>(number(0, static_cast<std::int64_t>(rest_.size())));
    const std::string_view bytes = rest_.substr(0, size);
    if (bytes.size() < size) damaged();
    rest_.remove_prefix(size);
    return bytes;
}

void StateReader::same(std::int64_t value) {
    if (any() != value) throw DataError("state is of a codec of other options");
}

void StateReader::finish() const {
    if (!rest_.empty()) damaged();
}

}  // namespace seautils::position
