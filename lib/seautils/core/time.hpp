#ifndef SEAUTILS_CORE_TIME_HPP
#define SEAUTILS_CORE_TIME_HPP

#include <cstdint>
#include <string>
#include <string_view>

namespace seautils {

/// Microseconds since 1970-01-01T00:00:00Z, without leap seconds.
///
/// @param text  RFC 3339 with `Z` or an offset (`2024-05-01T12:00:25.5Z`, years 1970 to 9999, at
///              most 6 decimals), or `@SECONDS` (decimal, at most 6 decimals)
/// @throws DataError  anything else; a time without zone is refused
std::int64_t parse_utc(std::string_view text);

/// RFC 3339 with `Z`; 0, 3 or 6 decimals, as many as it takes.
std::string format_utc(std::int64_t time_us);

/// Whole seconds since 1970-01-01T00:00:00Z, 0 to the end of the year 9999, and nanoseconds, 0 to 999999999.
struct UtcInstant {
    std::int64_t seconds = 0;
    std::int32_t nanoseconds = 0;
};

/// As parse_utc, with at most 9 decimals. @throws DataError
UtcInstant parse_instant(std::string_view text);

/// Appends RFC 3339 with `Z`; 0, 3, 6 or 9 decimals, as many as it takes.
void append_instant(std::string& out, UtcInstant instant);

/// The same as nanoseconds since 1970, which end in the year 2262.
/// @throws DataError  also: later than 2262-04-11T23:47:16Z
std::int64_t parse_utc_ns(std::string_view text);
std::string format_utc_ns(std::int64_t time_ns);

}  // namespace seautils

#endif  // SEAUTILS_CORE_TIME_HPP
