#ifndef SEAUTILS_ACOUSTICS_SAMPLE_HPP
#define SEAUTILS_ACOUSTICS_SAMPLE_HPP

#include "seautils/acoustics/sound_speed.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::acoustics {

inline constexpr double not_available = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::int64_t no_time = std::numeric_limits<std::int64_t>::min();

/// What a sensor says, each in the unit of its name.
enum class Quantity : std::uint8_t {
    time,  ///< Reading::time_ns
    pressure_dbar,
    depth_m,
    temperature_c,  ///< ITS-90
    salinity,
    conductivity_spm,  ///< S/m
    sound_speed_mps,
    latitude_deg,
    longitude_deg,
};
inline constexpr std::size_t quantities = 9;
std::string_view name(Quantity quantity);

/// One scan of a CTD or a sound-velocity probe as it was read; NaN is not available.
struct Reading {
    Reading() { value.fill(not_available); }
    double& operator[](Quantity q) { return value[static_cast<std::size_t>(q)]; }
    double operator[](Quantity q) const { return value[static_cast<std::size_t>(q)]; }

    std::int64_t time_ns = no_time;  ///< since 1970, UTC
    bool flagged = false;            ///< its source says that it is bad
    std::uint64_t line = 0;          ///< where it stands, for messages
    std::array<double, quantities> value;
};

/// Why a scan is left out.
enum class Drop : std::uint8_t {
    none,
    flagged,        ///< its source says that it is bad
    incomplete,     ///< no depth, or nothing that a speed of sound follows from
    out_of_bounds,  ///< a value that no sea has
    above_surface,  ///< the sensor was in air
    spike,          ///< far from the scans before and behind it
    loop,           ///< the sensor went back and came again: it measures its own wake
    slow,           ///< it moved more slowly than asked for
};
inline constexpr std::size_t drops = 8;
std::string_view name(Drop drop);

/// How many were left out, and why; [none]: how many were used.
struct DropCounts {
    std::array<std::uint64_t, drops> count{};
    std::uint64_t& operator[](Drop d) { return count[static_cast<std::size_t>(d)]; }
    std::uint64_t operator[](Drop d) const { return count[static_cast<std::size_t>(d)]; }
    std::uint64_t dropped() const;
    DropCounts& operator+=(const DropCounts& other);
};

/// A scan that a profile is made of.
struct Sample {
    std::int64_t time_ns = no_time;
    std::uint64_t line = 0;
    double depth_m = 0;  ///< positive down, from 0
    double sound_speed_mps = 0;
    double temperature_c = not_available;
    double salinity = not_available;
    bool extrapolated = false;      ///< a formula was used outside its range
    bool measured = false;          ///< the speed of sound is the sensor's own
    bool latitude_assumed = false;  ///< the depth is of a pressure, at 45 degrees
    bool salinity_assumed = false;  ///< it is Reduction::salinity
};

/// How readings become samples.
struct Reduction {
    SpeedFormula formula = SpeedFormula::chen_millero;
    bool measured = false;                    ///< use the speed that the sensor says, and only that
    std::optional<double> salinity = {};      ///< stands in where there is none
    std::optional<double> latitude_deg = {};  ///< stands in where there is none
};

/// Makes a sample of a reading: depth of the pressure where there is none, and the other way round
/// (depth_at_pressure_m()); salinity of the conductivity; the speed of sound by the formula where
/// temperature and salinity are known, else the sensor's own. Where no latitude is known it is 45.
/// @param why  if not null, what is wrong, with the value and the bound, where it is dropped
Drop reduce(const Reading& reading, const Reduction& how, Sample& sample,
            std::string* why = nullptr);

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_SAMPLE_HPP
