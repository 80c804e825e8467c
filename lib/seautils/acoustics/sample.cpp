#include "seautils/acoustics/sample.hpp"

#include "seautils/acoustics/seawater.hpp"

#include <fmt/format.h>

#include <cmath>

namespace seautils::acoustics {

namespace {

/// What no sea goes beyond.
struct Bound {
    double least, most;
    const char* unit;
};
constexpr Bound bounds[quantities]{
    {0, 0, ""},  // time
    {-10, 12000, " dbar"},
    {-10, 12000, " m"},
    {-4, 45, " °C"},
    {0, 50, ""},
    {0, 10, " S/m"},
    {1300, 1800, " m/s"},
    {-90, 90, " degrees"},
    {-180, 360, " degrees"},
};

bool known(double x) { return !std::isnan(x); }

Drop say(std::string* why, Drop drop, const char* what) {
    if (why != nullptr) *why = what;
    return drop;
}

/// Whether all that is known is within its bounds.
bool within_bounds(const Reading& reading, std::string* why) {
    for (std::size_t k = 1; k < quantities; ++k) {
        const double x = reading.value[k];
        if (!known(x) || (x >= bounds[k].least && x <= bounds[k].most)) continue;
        if (why != nullptr)
            *why = fmt::format("{} {} is outside {} to {}{}", name(static_cast<Quantity>(k)), x,
                               bounds[k].least, bounds[k].most, bounds[k].unit);
        return false;
    }
    return true;
}

/// Depth and pressure, the one of the other where need be. False: neither is known.
bool place(const Reading& reading, Water& water) {
    water.pressure_dbar = reading[Quantity::pressure_dbar];
    water.depth_m = reading[Quantity::depth_m];
    if (!known(water.depth_m))
        water.depth_m = depth_at_pressure_m(water.pressure_dbar, water.latitude_deg);
    if (!known(water.pressure_dbar))
        water.pressure_dbar = pressure_at_depth_dbar(water.depth_m, water.latitude_deg);
    return known(water.depth_m);
}

void find_salinity(const Reading& reading, const Reduction& how, Water& water, Sample& sample) {
    water.salinity = reading[Quantity::salinity];
    const double conductivity = reading[Quantity::conductivity_spm];
    if (!known(water.salinity) && known(conductivity) && known(water.temperature_c)) {
        water.salinity = practical_salinity(conductivity, water.temperature_c, water.pressure_dbar);
        sample.extrapolated = !practical_salinity_holds(water.salinity);
    }
    if (known(water.salinity) || !how.salinity) return;
    water.salinity = *how.salinity;
    sample.salinity_assumed = true;
}

/// The speed of sound; false: nothing is known that it follows from.
bool find_speed(const Reading& reading, const Reduction& how, const Water& water, Sample& sample) {
    const double measured = reading[Quantity::sound_speed_mps];
    const bool computable = known(water.temperature_c) && known(water.salinity);
    sample.measured = how.measured || !computable;
    if (sample.measured) {
        sample.sound_speed_mps = measured;
        sample.extrapolated = sample.salinity_assumed = false;
        return known(measured);
    }
    const SoundSpeed speed = sound_speed(how.formula, water);
    sample.sound_speed_mps = speed.mps;
    sample.extrapolated = sample.extrapolated || speed.extrapolated;
    return true;
}

}  // namespace

std::string_view name(Quantity quantity) {
    static constexpr std::string_view names[quantities]{
        "time",         "pressure_dbar",    "depth_m",         "temperature_c",
        "salinity",     "conductivity_spm", "sound_speed_mps", "latitude_deg",
        "longitude_deg"};
    return names[static_cast<std::size_t>(quantity)];
}

std::string_view name(Drop drop) {
    static constexpr std::string_view names[drops]{
        "used", "flagged", "incomplete", "out_of_bounds", "above_surface", "spike", "loop", "slow"};
    return names[static_cast<std::size_t>(drop)];
}

std::uint64_t DropCounts::dropped() const {
    std::uint64_t sum = 0;
    for (std::size_t k = 1; k < drops; ++k) sum += count[k];
    return sum;
}

DropCounts& DropCounts::operator+=(const DropCounts& other) {
    for (std::size_t k = 0; k < drops; ++k) count[k] += other.count[k];
    return *this;
}

Drop reduce(const Reading& reading, const Reduction& how, Sample& sample, std::string* why) {
    if (reading.flagged) return say(why, Drop::flagged, "its source says that it is bad");
    if (!within_bounds(reading, why)) return Drop::out_of_bounds;
    sample = {};
    sample.time_ns = reading.time_ns;
    sample.line = reading.line;
    Water water;
    const double latitude = reading[Quantity::latitude_deg];
    water.latitude_deg = known(latitude) ? latitude : how.latitude_deg.value_or(45);
    if (!place(reading, water))
        return say(why, Drop::incomplete, "neither depth_m nor pressure_dbar");
    if (water.depth_m < 0) return say(why, Drop::above_surface, "above the surface");
    water.temperature_c = reading[Quantity::temperature_c];
    find_salinity(reading, how, water, sample);
    if (!find_speed(reading, how, water, sample))
        return say(why, Drop::incomplete,
                   "no sound_speed_mps, and not both of temperature and salinity");
    if (!(sample.sound_speed_mps >= 1300 && sample.sound_speed_mps <= 1800)) {
        if (why != nullptr)
            *why = fmt::format("its speed of sound of {:.1f} m/s is outside 1300 to 1800 m/s",
                               sample.sound_speed_mps);
        return Drop::out_of_bounds;
    }
    sample.depth_m = water.depth_m;
    sample.temperature_c = water.temperature_c;
    sample.salinity = water.salinity;
    const bool depth_given = known(reading[Quantity::depth_m]);
    sample.latitude_assumed = !known(latitude) && !how.latitude_deg && !depth_given;
    return Drop::none;
}

}  // namespace seautils::acoustics
