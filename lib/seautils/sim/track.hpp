#ifndef SEAUTILS_SIM_TRACK_HPP
#define SEAUTILS_SIM_TRACK_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::sim {

/// Nanoseconds of simulated time since 1970, UTC; the years 1970 to 2200.
using Time = std::int64_t;

constexpr Time second_ns = 1'000'000'000;
constexpr Time never = INT64_MAX;

/// Seconds as nanoseconds, to the nearest.
Time nanoseconds(double seconds);
/// Nanoseconds as seconds.
constexpr double seconds(Time time) { return static_cast<double>(time) / 1e9; }

/// Metres from the scenario's origin; depth positive down.
struct Position {
    double x_m = 0;  ///< east
    double y_m = 0;  ///< north
    double depth_m = 0;
};

double distance_m(const Position& a, const Position& b);

/// Where latitude and longitude are zero metres. The earth is flat around it: by the radii of
/// curvature of WGS84 there, within 0.1 % of a distance of 50 km at latitudes below 60 degrees.
struct Origin {
    double latitude_deg = 0;   ///< -89 to 89
    double longitude_deg = 0;  ///< -180 to 180

    Position position(double at_latitude_deg, double at_longitude_deg, double depth_m) const;
};

/// Where something is at each time: straight lines between fixes, the ends before and after.
class Track {
public:
    struct Fix {
        Time time = 0;
        Position at;
    };

    Track() : fixes_{{}} {}
    explicit Track(Position fixed) : fixes_{{0, fixed}} {}
    /// @param fixes  at least one, times increasing
    explicit Track(std::vector<Fix> fixes) : fixes_(std::move(fixes)) {}

    Position at(Time time) const;
    const std::vector<Fix>& fixes() const { return fixes_; }

private:
    std::vector<Fix> fixes_;
};

/// A track from CSV with the columns `time_s`, and `x_m` and `y_m` or `latitude_deg` and
/// `longitude_deg` (also `lat_deg`, `lon_deg`), and `depth_m` (0 where there is none). Rows in
/// which one of them is blank are passed over; other columns are not looked at.
///
/// @param start   the time of the first row; none: time_s are seconds since 1970
/// @param origin  set by the first latitude and longitude where it is not set
/// @throws ConfigError  `FILE:LINE: what`: a column is missing, a value is no number or out of its
///                      range, time does not increase, no row, more than 1,000,000 rows
Track read_track(const std::string& file, std::string_view text, std::optional<Time> start,
                 std::optional<Origin>& origin);

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_TRACK_HPP
