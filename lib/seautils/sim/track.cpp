#include "seautils/sim/track.hpp"

#include "seautils/core/error.hpp"
#include "seautils/sim/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::sim {

namespace {

constexpr std::size_t most_rows = 1'000'000;

/// Which columns of a file a track is made of.
struct Columns {
    int time = -1, first = -1, second = -1, depth = -1;
    bool geographic = false;
};

Columns columns_of(const Csv& csv, const std::string& file) {
    Columns c;
    c.time = csv.column({"time_s"});
    c.first = csv.column({"x_m"});
    c.second = csv.column({"y_m"});
    c.geographic = c.first < 0 || c.second < 0;
    if (c.geographic) {
        c.first = csv.column({"latitude_deg", "lat_deg"});
        c.second = csv.column({"longitude_deg", "lon_deg"});
    }
    c.depth = csv.column({"depth_m"});
    if (c.time < 0) throw ConfigError(file + ": no column 'time_s'");
    if (c.first < 0 || c.second < 0) {
        throw ConfigError(file +
                          ": neither columns 'x_m' and 'y_m' nor 'latitude_deg' and "
                          "'longitude_deg'");
    }
    return c;
}

/// One row as numbers.
struct Row {
    double time_s, first, second, depth_m;
};

/// False where one of the values is blank.
bool read_row(const Columns& c, const std::vector<std::string_view>& values, Row& row) {
    const auto value = [&](int column) { return values[static_cast<std::size_t>(column)]; };
    if (value(c.time).empty() || value(c.first).empty() || value(c.second).empty()) return false;
    if (c.depth >= 0 && value(c.depth).empty()) return false;
    row.time_s = number("time_s", value(c.time), -1e9, 7e9, "s");
    const double most = c.geographic ? 90 : 1e6;
    row.first = number(c.geographic ? "latitude_deg" : "x_m", value(c.first), -most, most);
    row.second =
        number(c.geographic ? "longitude_deg" : "y_m", value(c.second), -2 * most, 2 * most);
    row.depth_m = c.depth < 0 ? 0 : number("depth_m", value(c.depth), -1000, 12000, "m");
    return true;
}

/// @param start  the time of the first row, or none
Time time_of(const Row& row, double first_s, std::optional<Time> start) {
    if (!start) {
        if (row.time_s < 0) throw ConfigError(fmt::format("time_s {} is before 1970", row.time_s));
        return nanoseconds(row.time_s);
    }
    const double since_s = row.time_s - first_s;
    if (std::abs(since_s) > 1e9)
        throw ConfigError(fmt::format("time_s {} is years from the first", row.time_s));
    return *start + nanoseconds(since_s);
}

Position position_of(const Row& row, bool geographic, std::optional<Origin>& origin) {
    if (!geographic) return {row.first, row.second, row.depth_m};
    if (!origin) origin = Origin{row.first, row.second};
    return origin->position(row.first, row.second, row.depth_m);
}

/// A fix from a row, checked against the one before.
Track::Fix fix_of(const Row& row, bool geographic, double first_s, std::optional<Time> start,
                  std::optional<Origin>& origin, const std::vector<Track::Fix>& before) {
    const Time time = time_of(row, first_s, start);
    if (!before.empty() && time <= before.back().time)
        throw ConfigError(fmt::format("time_s {} does not come after the row before", row.time_s));
    if (before.size() == most_rows) throw ConfigError(fmt::format("more than {} rows", most_rows));
    return {time, position_of(row, geographic, origin)};
}

double cosine_deg(double angle_deg) { return std::cos(angle_deg * std::numbers::pi / 180); }

}  // namespace

Time nanoseconds(double seconds) { return static_cast<Time>(std::llround(seconds * 1e9)); }

double distance_m(const Position& a, const Position& b) {
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m, a.depth_m - b.depth_m);
}

Position Origin::position(double at_latitude_deg, double at_longitude_deg, double depth_m) const {
    constexpr double radius_m = 6378137, e2 = 6.69437999014e-3;  // WGS84
    const double cosine = cosine_deg(latitude_deg);
    const double w2 = 1 - e2 * (1 - cosine * cosine);
    const double across_m = radius_m / std::sqrt(w2);
    const double along_m = across_m * (1 - e2) / w2;
    const double radian = std::numbers::pi / 180;
    const double east_deg = std::remainder(at_longitude_deg - longitude_deg, 360.0);
    return {east_deg * radian * across_m * cosine,
            (at_latitude_deg - latitude_deg) * radian * along_m, depth_m};
}

Position Track::at(Time time) const {
    const auto after = std::upper_bound(fixes_.begin(), fixes_.end(), time,
                                        [](Time t, const Fix& f) { return t < f.time; });
    if (after == fixes_.begin()) return fixes_.front().at;
    if (after == fixes_.end()) return fixes_.back().at;
    const Fix& a = *(after - 1);
    const Fix& b = *after;
    const double part = static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time);
    const auto between = [part](double from, double to) { return from + (to - from) * part; };
    return {between(a.at.x_m, b.at.x_m), between(a.at.y_m, b.at.y_m),
            between(a.at.depth_m, b.at.depth_m)};
}

Track read_track(const std::string& file, std::string_view text, std::optional<Time> start,
                 std::optional<Origin>& origin) {
    Csv csv(file, text);
    const Columns columns = columns_of(csv, file);
    std::vector<Track::Fix> fixes;
    std::optional<double> first_s;
    std::vector<std::string_view> values;
    Row row{};
    while (csv.next(values)) {
        try {
            if (!read_row(columns, values, row)) continue;
            if (!first_s) first_s = row.time_s;
            fixes.push_back(fix_of(row, columns.geographic, *first_s, start, origin, fixes));
        } catch (const ConfigError& e) {
            csv.fault(e.what());
        }
    }
    if (fixes.empty()) throw ConfigError(file + ": no row with a time and a position");
    return Track(std::move(fixes));
}

}  // namespace seautils::sim
