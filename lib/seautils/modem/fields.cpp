#include "seautils/modem/fields.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/stream/hex.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>

namespace seautils::modem {

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t day_ns = 86400 * second_ns;

/// A decimal number that is all of the text. Modems pad with zeros, and write signs.
template <class T>
bool read_number(std::string_view text, T& value) {
    if (text.size() > 1 && text.front() == '+') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

/// The digits of `text` from `at` on; absent where some is none.
std::optional<unsigned> digits(std::string_view text, std::size_t at, std::size_t count) {
    unsigned value = 0;
    for (const char c : text.substr(at, count)) {
        if (c < '0' || c > '9') return {};
        value = value * 10 + static_cast<unsigned>(c - '0');
    }
    return value;
}

std::optional<std::int64_t> fraction_ns(std::string_view text) {
    if (text.size() > 9) return {};
    const auto value = digits(text, 0, text.size());
    if (!value) return {};
    std::int64_t ns = *value;
    for (std::size_t k = text.size(); k < 9; ++k) ns *= 10;
    return ns;
}

}  // namespace

std::optional<std::int64_t> Fields::maybe_whole(std::size_t k, std::int64_t least,
                                                std::int64_t most) const {
    if (text(k).empty()) return {};
    std::int64_t value = 0;
    if (!read_number(text(k), value) || value < least || value > most)
        refuse(k, fmt::format("a whole number {} to {}", least, most));
    return value;
}

std::optional<double> Fields::maybe_real(std::size_t k) const {
    if (text(k).empty()) return {};
    double value = 0;
    // Neither infinity nor what is none can be told in a record's JSON.
    if (!read_number(text(k), value) || !(value >= -1e12 && value <= 1e12)) refuse(k, "a number");
    return value;
}

std::uint32_t Fields::whole(std::size_t k, std::uint32_t most) const {
    const auto value = maybe_whole(k, 0, most);
    if (!value) refuse(k, fmt::format("a whole number 0 to {}", most));
    return static_cast<std::uint32_t>(*value);
}

std::string Fields::bytes(std::size_t k) const {
    std::string out;
    try {
        stream::from_hex(text(k), out);
    } catch (const DataError& e) {
        throw DataError(fmt::format("{} field {}: {}", name(), k, e.what()));
    }
    return out;
}

std::string Fields::name() const {
    constexpr std::size_t longest = 12;
    const std::string_view address = sentence_->address();
    return address.size() > longest ? quote(address) : printable(address);
}

void Fields::need(std::size_t least) const {
    if (count() >= least) return;
    throw DataError(
        fmt::format("{} of {} where there should be {}", name(), counted(count(), "field"), least));
}

void Fields::refuse(std::size_t k, std::string_view wanted) const {
    throw DataError(fmt::format("{} field {} {} is not {}", name(), k, quote(text(k)), wanted));
}

std::optional<std::int64_t> time_of_day_ns(std::string_view text) {
    const std::size_t point = text.find('.');
    const std::string_view whole = text.substr(0, point);
    if (whole.size() != 6) return {};
    const auto hour = digits(whole, 0, 2);
    const auto minute = digits(whole, 2, 2);
    const auto second = digits(whole, 4, 2);
    const auto fraction =
        fraction_ns(point == text.npos ? std::string_view() : text.substr(point + 1));
    if (!hour || !minute || !second || !fraction) return {};
    if (*hour > 23 || *minute > 59 || *second > 60) return {};
    return (*hour * 3600 + *minute * 60 + *second) * second_ns + *fraction;
}

std::optional<std::int64_t> date_ns(std::string_view text) {
    namespace chr = std::chrono;
    if (text.size() != 8) return {};
    const auto year = digits(text, 0, 4);
    const auto month = digits(text, 4, 2);
    const auto day = digits(text, 6, 2);
    if (!year || !month || !day || *year < 1970 || *year > 2200) return {};
    const chr::year_month_day date{chr::year{static_cast<int>(*year)}, chr::month{*month},
                                   chr::day{*day}};
    if (!date.ok()) return {};
    return chr::sys_days{date}.time_since_epoch().count() * day_ns;
}

record::UtcTime nearest_day(std::int64_t time_of_day_ns, record::UtcTime near) {
    const std::int64_t midnight = near.ns - (near.ns % day_ns + day_ns) % day_ns;
    std::int64_t ns = midnight + time_of_day_ns;
    if (ns - near.ns > day_ns / 2) ns -= day_ns;
    if (near.ns - ns > day_ns / 2) ns += day_ns;
    return {ns};
}

}  // namespace seautils::modem
