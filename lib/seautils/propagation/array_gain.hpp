#ifndef SEAUTILS_PROPAGATION_ARRAY_GAIN_HPP
#define SEAUTILS_PROPAGATION_ARRAY_GAIN_HPP

#include "seautils/propagation/field.hpp"

#include <span>
#include <vector>

namespace seautils::propagation {

/// Hydrophones above each other, summed with delays for plane waves of one elevation.
struct VerticalArray {
    std::vector<double> depth_m;  ///< of each, from anywhere
    double steered_deg = 0;       ///< elevation of travel, positive down, -90 to 90
};

/// Part of the power of a plane wave that the sum has, 0 to 1: 1 at the steered elevation.
double array_response(const VerticalArray& array, double frequency_hz, double sound_speed_mps,
                      double elevation_deg);

/// Noise by the elevation that it travels in: intensity a steradian, in any unit; linear between, constant beyond. Less than
/// a twentieth of a degree is not seen.
struct NoiseRow {
    double elevation_deg = 0;
    double intensity = 0;
};

/// What an array gains over one hydrophone, dB: how much of the arrivals it keeps over how much of the noise.
/// Check value: n hydrophones half a wavelength apart, of a wave that they are steered at, gain 10 lg n where
/// noise comes from everywhere alike.
/// @param arrivals  intensities with absorption; one at least, of some amplitude
/// @param noise     grows in elevation, of some intensity; empty: from everywhere alike
/// @throws DataError  no hydrophone; no arrival or no noise of some intensity; a frequency or a speed that is not positive
double array_gain_db(const VerticalArray& array, double frequency_hz, double sound_speed_mps,
                     std::span<const Arrival> arrivals, std::span<const NoiseRow> noise);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_ARRAY_GAIN_HPP
