#ifndef SEAUTILS_ACOUSTICS_PROFILE_HPP
#define SEAUTILS_ACOUSTICS_PROFILE_HPP

#include "seautils/acoustics/clean.hpp"
#include "seautils/acoustics/legs.hpp"
#include "seautils/acoustics/sample.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seautils::acoustics {

/// One depth of a profile.
struct Level {
    double depth_m = 0;                    ///< positive down
    double sound_speed_mps = 0;            ///< mean of the samples
    double standard_deviation_mps = 0;     ///< of the samples; 0 where there are less than 2
    double temperature_c = not_available;  ///< means, where known
    double salinity = not_available;
    std::uint64_t count = 0;    ///< samples; 0: not measured but extended
    bool extrapolated = false;  ///< in one of the samples a formula was used outside its range
};

/// What a profile was continued by where nothing was measured.
enum class Extension : std::uint8_t { none, isothermal, climatology };

/// The speed of sound over depth, and what it rests on.
struct Profile {
    std::vector<Level> levels;                          ///< depth_m grows strictly
    std::int64_t start_ns = no_time, end_ns = no_time;  ///< of the samples; UTC, since 1970
    std::optional<double> latitude_deg, longitude_deg;
    std::optional<SpeedFormula>
        formula;                    ///< nothing: the sensor's own speed of sound, in all samples
    bool mixed = false;             ///< the sensor's own speed in some samples only
    bool latitude_assumed = false;  ///< depths are of pressures, at 45 degrees
    bool salinity_assumed = false;
    Direction direction = Direction::none;
    std::optional<double> measured_from_m, measured_to_m;  ///< what lies outside is extended
    Extension extension = Extension::none;
    DropCounts dropped;
};

struct Binning {
    double bin_m = 1;  ///< bin k holds depths from (k - 1/2) to below (k + 1/2) bin_m; 0.01 to 1000
    Cleaning cleaning;
    SpeedFormula formula = SpeedFormula::chen_millero;  ///< what the samples were reduced with

    static constexpr std::size_t most_levels = 20000;
};

/// Cleans the samples and bins what is left. A level lies at the mean depth of its samples, so that a
/// gradient within a bin shifts nothing; its deviation holds that gradient.
/// @param why  if not null, why each sample was left out
/// @throws DataError  more than Binning::most_levels bins hold something
Profile bin_samples(std::span<const Sample> samples, const Binning& how,
                    std::vector<Drop>* why = nullptr);

/// The speed of sound at a depth, linear between levels; beyond the ends that of the end.
/// @param profile  at least one level
double speed_at_mps(const Profile& profile, double depth_m);

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_PROFILE_HPP
