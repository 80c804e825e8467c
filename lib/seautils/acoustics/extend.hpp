#ifndef SEAUTILS_ACOUSTICS_EXTEND_HPP
#define SEAUTILS_ACOUSTICS_EXTEND_HPP

#include "seautils/acoustics/profile.hpp"

#include <optional>

namespace seautils::acoustics {

/// How a profile is continued to depths where nothing was measured.
struct Extending {
    double to_m = 0;       ///< down to there, 0 to 12000; and up to the surface
    double blend_m = 100;  ///< over what distance a climatology takes over
    SpeedFormula formula = SpeedFormula::chen_millero;
    std::optional<double> salinity = {};      ///< of water whose salinity is not known; else 35
    std::optional<double> latitude_deg = {};  ///< where the profile has none; else 45
};

/// Continues a profile at constant temperature and salinity, so that only the pressure changes the
/// speed of sound (0.016 to 0.018 m/s a metre): up to the surface, and down from its last level to
/// to_m, with levels at the multiples of 100 m. Where the last level's temperature is not known it is
/// the one at which water of that salinity has its speed of sound. The offset between the level and the
/// formula is kept. Such levels have no samples (count 0).
/// @param profile  no level: it stays as it is
void extend_isothermal(Profile& profile, const Extending& how);

/// Continues it by another profile, above and below what was measured: by its speed of sound, plus the
/// difference at the end of what was measured, which fades linearly to nothing over blend_m. Where the
/// other ends before to_m, or begins below the surface, extend_isothermal() goes on from there.
/// @param climatology  at least one level
void extend_by(Profile& profile, const Profile& climatology, const Extending& how);

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_EXTEND_HPP
