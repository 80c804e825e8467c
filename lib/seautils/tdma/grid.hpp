#ifndef SEAUTILS_TDMA_GRID_HPP
#define SEAUTILS_TDMA_GRID_HPP

#include <cstdint>
#include <string_view>

namespace seautils::tdma {

// Instants are nanoseconds since 1970-01-01T00:00:00Z without leap seconds, 0 to last_ns. What
// cycle an instant lies in is divided anew from the origin each time and never added up, so that a
// program that ran for a year and one that was just started agree to the nanosecond.

inline constexpr std::int64_t second_ns = 1'000'000'000;
inline constexpr std::int64_t day_ns = 86'400 * second_ns;
inline constexpr std::int64_t last_ns = 9'200'000'000 * second_ns;  ///< in July 2261

/// Where cycles are counted from.
struct Origin {
    enum class Kind {
        instant,   ///< one instant for ever; 1970 by default
        midnight,  ///< each day's 00:00 UTC, which cuts the cycle that is under way
    };
    Kind kind = Kind::instant;
    std::int64_t instant_ns = 0;
};

/// @param text  `epoch`, `midnight`, or an instant as parse_utc_ns takes it
/// @throws DataError  anything else, or later than last_ns
Origin parse_origin(std::string_view text);

/// A stretch of time in which cycles are counted through: cycle n begins at begin_ns + n·T, and
/// nothing lasts beyond end_ns.
struct Era {
    std::int64_t begin_ns, end_ns;
};

/// The era that an instant lies in, its begin included; with an instant as origin the only one,
/// also for what is earlier.
Era era_of(const Origin& origin, std::int64_t time_ns);

/// The first boundary of a grid that is later than `time_ns`, also where that is a boundary itself.
/// The end of an era is a boundary of every grid.
/// @param step_ns  of the grid; at least 1
std::int64_t boundary_after(const Origin& origin, std::int64_t step_ns, std::int64_t time_ns);

/// The first boundary that is not earlier than `time_ns`.
std::int64_t boundary_from(const Origin& origin, std::int64_t step_ns, std::int64_t time_ns);

/// Nanoseconds of a decimal number of seconds, exactly: `0.1` is 100,000,000.
/// @throws DataError  not digits with at most nine behind a point, or more than 10^9 seconds
std::int64_t parse_seconds_ns(std::string_view text);

}  // namespace seautils::tdma

#endif  // SEAUTILS_TDMA_GRID_HPP
