#include "seautils/stream/nmea.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <algorithm>
#include <cstring>

namespace seautils::stream {

namespace {

constexpr char upper_digits[] = "0123456789ABCDEF";

/// Value of a hexadecimal digit; 16 or more for what is none.
constexpr unsigned digit_value(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10;
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10;
    return 16;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool is_printable(char c) { return c >= 0x20 && c < 0x7f; }

std::string_view trimmed(std::string_view line) {
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    return line;
}

std::size_t start_of_sentence(std::string_view line) {
    const void* last = ::memrchr(line.data(), '$', line.size());
    if (last == nullptr) return line.find('!');
    return static_cast<std::size_t>(static_cast<const char*>(last) - line.data());
}

std::string two_digits(std::uint8_t byte) {
    return {upper_digits[byte >> 4], upper_digits[byte & 15]};
}

}  // namespace

std::uint8_t nmea_checksum(std::string_view body) noexcept {
    std::uint8_t sum = 0;
    for (const char c : body) sum ^= static_cast<std::uint8_t>(c);
    return sum;
}

/// Finds the commas, without a branch that depends on where they are.
SentenceFault Sentence::split() noexcept {
    const std::size_t commas = static_cast<std::size_t>(
        std::count_if(body_.begin(), body_.end(), [](char c) { return c == ','; }));
    if (commas >= most_fields) return SentenceFault::too_many_fields;
    std::size_t at = 1;
    const std::size_t size = body_.size();
    for (std::size_t k = 0; k < size; ++k) {
        starts_[at] = static_cast<std::uint16_t>(k + 1);
        at += body_[k] == ',' ? 1U : 0U;
    }
    starts_[at] = static_cast<std::uint16_t>(size + 1);
    pieces_ = at;
    return starts_[1] == 1 ? SentenceFault::no_start : SentenceFault::none;
}

SentenceFault parse_sentence(std::string_view line, Sentence& sentence) noexcept {
    line = trimmed(line);
    const std::size_t start = line.empty() ? line.npos : start_of_sentence(line);
    if (start == line.npos) return SentenceFault::no_start;
    sentence.noise_ = line.substr(0, start);
    sentence.start_ = line[start];
    std::string_view body = line.substr(start + 1);
    if (body.size() >= longest_sentence) return SentenceFault::too_long;

    sentence.checksum_ = Checksum::absent;
    sentence.stated_ = 0;
    const std::size_t star = body.find('*');
    if (star != body.npos) {
        if (body.size() != star + 3) return SentenceFault::bad_ending;
        const unsigned value = digit_value(body[star + 1]) << 4 | digit_value(body[star + 2]);
        const bool digits = digit_value(body[star + 1]) < 16 && digit_value(body[star + 2]) < 16;
        if (!digits) return SentenceFault::bad_ending;
        sentence.stated_ = static_cast<std::uint8_t>(value);
        body = body.substr(0, star);
    }
    bool printable = true;
    for (const char c : body) printable &= is_printable(c);
    if (!printable) return SentenceFault::bad_byte;

    sentence.body_ = body;
    sentence.computed_ = nmea_checksum(body);
    if (star != line.npos) {
        sentence.checksum_ =
            sentence.computed_ == sentence.stated_ ? Checksum::good : Checksum::wrong;
    }
    return sentence.split();
}

std::string sentence_fault(SentenceFault fault, const Sentence& sentence) {
    switch (fault) {
        case SentenceFault::no_start:
            return "no sentence begins in it";
        case SentenceFault::too_long:
            return "longer than " + counted(longest_sentence, "byte");
        case SentenceFault::too_many_fields:
            return "more than " + counted(Sentence::most_fields, "field");
        case SentenceFault::bad_byte:
            return "bytes that are not printable";
        case SentenceFault::bad_ending:
            return "two hexadecimal digits should follow '*', and end it";
        case SentenceFault::none:
            break;
    }
    if (sentence.checksum() != Checksum::wrong) return {};
    return "checksum " + two_digits(sentence.stated()) + " is not the " +
           two_digits(sentence.computed()) + " of its bytes";
}

void append_sentence(std::string& out, std::string_view body) {
    if (body.empty()) throw DataError("a sentence of no bytes");
    if (body.size() + 4 > longest_sentence) {
        throw DataError("a sentence of " + counted(body.size() + 4, "byte") + " is longer than " +
                        counted(longest_sentence, "byte"));
    }
    for (const char c : body) {
        if (!is_printable(c) || c == '$' || c == '!' || c == '*')
            throw DataError("a sentence cannot say " + quote({&c, 1}));
    }
    const std::uint8_t sum = nmea_checksum(body);
    out += '$';
    out += body;
    out += {'*', upper_digits[sum >> 4], upper_digits[sum & 15], '\r', '\n'};
}

std::string sentence(std::string_view body) {
    std::string out;
    out.reserve(body.size() + 6);
    append_sentence(out, body);
    return out;
}

}  // namespace seautils::stream
