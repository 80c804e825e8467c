#include "seautils/acoustics/extend.hpp"

#include "seautils/acoustics/seawater.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::acoustics {

namespace {

constexpr double step_m = 100;  ///< of the levels below: the curve lies within 1 mm/s of its chords
constexpr double nearest_m = 0.001;  ///< levels closer than this are one

Water water_at(double depth_m, double latitude_deg) {
    Water water;
    water.depth_m = depth_m;
    water.latitude_deg = latitude_deg;
    water.pressure_dbar = pressure_at_depth_dbar(depth_m, latitude_deg);
    return water;
}

/// The water of one level, taken to other depths.
class Isothermal {
public:
    Isothermal(const Profile& profile, const Level& from, const Extending& how)
        : how_(how),
          latitude_deg_(profile.latitude_deg.value_or(how.latitude_deg.value_or(45))),
          water_(water_at(from.depth_m, latitude_deg_)) {
        water_.salinity = std::isnan(from.salinity) ? how.salinity.value_or(35) : from.salinity;
        water_.temperature_c =
            std::isnan(from.temperature_c)
                ? temperature_at_speed_c(how.formula, from.sound_speed_mps, water_)
                : from.temperature_c;
        offset_mps_ = from.sound_speed_mps - sound_speed(how.formula, water_).mps;
    }

    Level at(double depth_m) const {
        Water water = water_at(depth_m, latitude_deg_);
        water.temperature_c = water_.temperature_c;
        water.salinity = water_.salinity;
        const SoundSpeed speed = sound_speed(how_.formula, water);
        Level level;
        level.depth_m = depth_m;
        level.sound_speed_mps = speed.mps + offset_mps_;
        level.extrapolated = speed.extrapolated;
        return level;
    }

private:
    const Extending& how_;
    double latitude_deg_;
    Water water_;
    double offset_mps_ = 0;
};

void put_on_top(Profile& profile, const Level& level) {
    profile.levels.insert(profile.levels.begin(), level);
}

/// The levels of the climatology that lie above the profile, or below it.
void append_above(Profile& profile, const Profile& climatology, double blend_m) {
    const double top_m = profile.levels.front().depth_m;
    const double off_mps =
        profile.levels.front().sound_speed_mps - speed_at_mps(climatology, top_m);
    std::vector<Level> above;
    for (Level level : climatology.levels) {
        if (level.depth_m > top_m - nearest_m) break;
        level.sound_speed_mps += off_mps * std::max(0.0, 1 - (top_m - level.depth_m) / blend_m);
        level.count = 0;
        above.push_back(level);
    }
    profile.levels.insert(profile.levels.begin(), above.begin(), above.end());
}

void append_below(Profile& profile, const Profile& climatology, const Extending& how) {
    const double end_m = profile.levels.back().depth_m;
    const double off_mps = profile.levels.back().sound_speed_mps - speed_at_mps(climatology, end_m);
    // The offset ends within a layer of the climatology: there is a level, too.
    const double faded_m = end_m + how.blend_m;
    const auto add = [&](Level level) {
        if (level.depth_m < profile.levels.back().depth_m + nearest_m) return;
        level.sound_speed_mps += off_mps * std::max(0.0, 1 - (level.depth_m - end_m) / how.blend_m);
        level.count = 0;
        profile.levels.push_back(level);
    };
    const auto between = [&](double depth_m) {
        Level level;
        level.depth_m = depth_m;
        level.sound_speed_mps = speed_at_mps(climatology, depth_m);
        return level;
    };
    const double last_m = std::min(how.to_m, climatology.levels.back().depth_m);
    for (const Level& level : climatology.levels) {
        if (level.depth_m > faded_m && faded_m < last_m) add(between(faded_m));
        if (level.depth_m <= last_m) add(level);
    }
    add(between(last_m));
}

}  // namespace

void extend_isothermal(Profile& profile, const Extending& how) {
    if (profile.levels.empty()) return;
    const std::size_t before = profile.levels.size();
    const Level top = profile.levels.front(), end = profile.levels.back();
    if (top.depth_m > nearest_m) put_on_top(profile, Isothermal(profile, top, how).at(0));
    const Isothermal water(profile, end, how);
    double next_m = (std::floor(end.depth_m / step_m) + 1) * step_m;
    for (; next_m < how.to_m - nearest_m; next_m += step_m)
        if (next_m > end.depth_m + nearest_m) profile.levels.push_back(water.at(next_m));
    if (how.to_m > end.depth_m + nearest_m) profile.levels.push_back(water.at(how.to_m));
    if (profile.levels.size() > before && profile.extension == Extension::none)
        profile.extension = Extension::isothermal;
}

void extend_by(Profile& profile, const Profile& climatology, const Extending& how) {
    if (profile.levels.empty()) return;
    const std::size_t before = profile.levels.size();
    append_above(profile, climatology, how.blend_m);
    if (climatology.levels.back().depth_m > profile.levels.back().depth_m)
        append_below(profile, climatology, how);
    if (profile.levels.size() > before) profile.extension = Extension::climatology;
    extend_isothermal(profile, how);
}

}  // namespace seautils::acoustics
