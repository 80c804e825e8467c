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

}  // namespace seautils

#endif  // SEAUTILS_CORE_TIME_HPP
