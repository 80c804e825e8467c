#include "seautils/core/warp.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace seautils {

namespace {

constexpr std::string_view form = "warp:N,BOOT,SIM";
constexpr std::int64_t last_us = 7'258'118'400'000'000;  ///< the year 2200: nanoseconds still fit

/// A decimal number without exponent, all of `text`.
bool is_decimal(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789.") == text.npos;
}

double decimal(std::string_view what, std::string_view text, double least, double most) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (!is_decimal(text) || error != std::errc() || end != text.data() + text.size())
        throw DataError(fmt::format("{} {} of a clock is not a number", what, quote(text)));
    if (value < least || value > most)
        throw DataError(
            fmt::format("{} {} of a clock is outside {} to {}", what, quote(text), least, most));
    return value;
}

/// Takes what stands before the next comma off `rest`.
std::string_view word(std::string_view& rest) {
    const std::string_view first = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), first.size() + 1));
    return first;
}

}  // namespace

std::int64_t WarpedClock::sim_ns_at(std::int64_t boot) const {
    const double passed = factor * static_cast<double>(boot - boot_ns);
    return sim_us * 1000 + static_cast<std::int64_t>(std::floor(passed));
}

std::int64_t WarpedClock::boot_ns_at(std::int64_t sim_ns) const {
    const double passed = static_cast<double>(sim_ns - sim_us * 1000) / factor;
    return boot_ns + static_cast<std::int64_t>(std::ceil(passed));
}

WarpedClock parse_warp(std::string_view text) {
    std::string_view rest = text;
    if (!rest.starts_with("warp:") || std::count(rest.begin(), rest.end(), ',') != 2)
        throw DataError(fmt::format("clock {} is not of the form {}", quote(text), form));
    rest.remove_prefix(5);
    WarpedClock clock;
    clock.factor = decimal("factor", word(rest), 0.001, 1000);
    clock.boot_ns = std::llround(decimal("start", word(rest), 0, 1e9) * 1e9);
    clock.sim_us = parse_utc(rest);
    if (clock.sim_us > last_us)
        throw DataError("time " + quote(rest) + " of a clock is after the year 2200");
    return clock;
}

std::string format_warp(const WarpedClock& clock) {
    const std::int64_t second_ns = 1'000'000'000;
    return fmt::format("warp:{},{}.{:09},{}", clock.factor, clock.boot_ns / second_ns,
                       clock.boot_ns % second_ns, format_utc(clock.sim_us));
}

}  // namespace seautils
