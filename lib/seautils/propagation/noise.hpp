#ifndef SEAUTILS_PROPAGATION_NOISE_HPP
#define SEAUTILS_PROPAGATION_NOISE_HPP

#include "seautils/propagation/environment.hpp"

#include <optional>
#include <vector>

namespace seautils::propagation {

/// Ambient noise of turbulence, ships, wind and heat, dB re 1 µPa²/Hz: Coates' fit to the curves of Wenz.
/// Check values for shipping 0.5 and 5 m/s: 67.79 at 100 Hz, 60.95 at 1 kHz, 38.51 at 25.12 kHz (45.44 at 10 m/s), 28.94
/// at 100 kHz.
/// @param shipping  0 (none) to 1 (heavy)
/// @param wind_mps  0 or more
/// Source: G. M. Wenz, J. Acoust. Soc. Am. 34, 1936-1956 (1962); R. F. W. Coates, Underwater Acoustic Systems (1990).
double ambient_noise_db(double frequency_hz, double shipping, double wind_mps);

/// Wind of a Beaufort number. Check values: 2 gives 2.36, 3 gives 4.34.
double wind_of_beaufort_mps(double beaufort);

/// Where the speed of sound is again the largest of the upper water, above the axis: below, no sound that has touched
/// the surface comes by refraction. None: the bottom is above it.
/// @param profile  one point at least
std::optional<double> critical_depth_m(const std::vector<SpeedPoint>& profile);

/// What is sent, and what is heard beside it.
struct SonarLevels {
    double source_level_db = 0;  ///< re 1 µPa at 1 m
    double bandwidth_hz = 1;
    double noise_db = 0;  ///< re 1 µPa²/Hz, at the surface
    double array_gain_db = 0;
    std::optional<double> fades_below_m;    ///< below this depth noise falls by 3 dB a kilometre
    std::vector<double> noise_depth_m;      ///< grows; where not empty, noise is that of the table
    std::vector<double> noise_at_depth_db;  ///< as many; linear between, constant beyond
};

/// In the band, dB re 1 µPa².
double noise_in_band_db(const SonarLevels& levels, double depth_m);

/// Signal to noise ratio in the band: the sonar equation.
double signal_to_noise_db(const SonarLevels& levels, double loss_db, double depth_m);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_NOISE_HPP
