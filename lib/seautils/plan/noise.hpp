#ifndef SEAUTILS_PLAN_NOISE_HPP
#define SEAUTILS_PLAN_NOISE_HPP

#include <limits>
#include <span>
#include <vector>

namespace seautils::plan {

/// What is heard beside the signal, over depth: constant down to the critical depth, and less below (thesis 4.4.2).
struct NoiseProfile {
    double level_db = 0;  ///< at the surface; dB re 1 µPa²/Hz, or of any reference
    double critical_depth_m = std::numeric_limits<double>::infinity();
    double slope_db_per_km = -3;  ///< below it

    double at_db(double depth_m) const;
};

/// A value over depth by its points: straight between, constant beyond. @param depth_m  grows; 1 at least
double interpolated(std::span<const double> depth_m, std::span<const double> values, double at_m);

/// How much a vertical array gains on noise: 10 lg(Σ A² b² / Σ A²) - 10 lg(∫ D b² cos θ dθ / ∫ D cos θ dθ), b its beam
/// pattern at the elevation of each. 0 dB where all is heard alike.
struct ArrayInput {
    std::vector<double> intensity;        ///< of each arrival; 0 or more
    std::vector<double> signal_pattern;   ///< b² at its elevation
    std::vector<double> noise_deg;        ///< elevations that the noise is known at; grows
    std::vector<double> noise_intensity;  ///< D there
    std::vector<double> noise_pattern;    ///< b² there
};
/// @return  NaN where there is no signal or no noise
double array_gain_db(const ArrayInput& input);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_NOISE_HPP
