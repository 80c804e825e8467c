#ifndef SEAUTILS_CORE_WARP_HPP
#define SEAUTILS_CORE_WARP_HPP

#include <cstdint>
#include <string>
#include <string_view>

namespace seautils {

/// A clock of simulated time, the same for all programs of one machine that are told the same text:
/// it runs `factor` times as fast as the time since the machine's start (CLOCK_BOOTTIME, which no
/// one steps, and which is the first word of /proc/uptime).
struct WarpedClock {
    double factor = 1;         ///< 0.001 to 1000
    std::int64_t boot_ns = 0;  ///< time since the machine's start at which simulated time is sim_us
    std::int64_t sim_us = 0;   ///< microseconds since 1970, UTC

    /// Simulated nanoseconds since 1970 at a time since the machine's start.
    std::int64_t sim_ns_at(std::int64_t boot) const;
    /// The time since the machine's start at which that will be: at or after the time asked for.
    std::int64_t boot_ns_at(std::int64_t sim_ns) const;
};

/// `warp:N,BOOT,SIM`: the factor, seconds since the machine's start (decimal, at most nanoseconds),
/// and the time then, as parse_utc takes it.
/// @throws DataError  quotes what is wrong, with the bound
WarpedClock parse_warp(std::string_view text);

/// The text that parse_warp makes the same clock of.
std::string format_warp(const WarpedClock& clock);

}  // namespace seautils

#endif  // SEAUTILS_CORE_WARP_HPP
