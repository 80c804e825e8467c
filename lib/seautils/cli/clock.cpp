#include "seautils/cli/clock.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <time.h>

#include <algorithm>
#include <string>

namespace seautils::cli {

namespace {

std::int64_t read_ns(clockid_t clock) {
    timespec now{};
    ::clock_gettime(clock, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

Clock::Clock(std::string_view word) {
    if (word == "system") return;
    if (word == "input") {
        kind_ = Kind::input;
    } else if (word.starts_with("warp:")) {
        kind_ = Kind::warp;
        warp_ = parse_warp(word);
    } else {
        throw DataError("clock " + quote(word) + " is none of system, input, warp:N,BOOT,SIM");
    }
}

Clock Clock::fixed(std::int64_t utc_us) {
    Clock clock;
    clock.kind_ = Kind::fixed;
    clock.ns_ = utc_us > INT64_MAX / 1000 ? INT64_MAX : utc_us * 1000;
    return clock;
}

std::string Clock::word() const {
    switch (kind_) {
        case Kind::system:
            return "system";
        case Kind::input:
            return "input";
        case Kind::warp:
            return format_warp(warp_);
        default:
            return format_warp({0.001, 0, ns_ / 1000});
    }
}

std::int64_t Clock::now_ns() const {
    switch (kind_) {
        case Kind::system:
            return read_ns(CLOCK_REALTIME);
        case Kind::warp:
            return warp_.sim_ns_at(read_ns(CLOCK_BOOTTIME));
        default:
            return ns_;
    }
}

std::int64_t Clock::steady_ns() const {
    return kind_ == Kind::system ? read_ns(CLOCK_BOOTTIME) : now_ns();
}

void Clock::advance(std::int64_t utc_ns) {
    if (kind_ == Kind::input) ns_ = std::max(ns_, utc_ns);
}

std::int64_t Clock::boot_ns_at_steady(std::int64_t steady_ns) const {
    return kind_ == Kind::warp ? warp_.boot_ns_at(steady_ns) : steady_ns;
}

std::optional<std::int64_t> Clock::boot_ns_at(std::int64_t utc_ns) const {
    if (kind_ == Kind::system) return std::nullopt;
    return boot_ns_at_steady(utc_ns);
}

}  // namespace seautils::cli
