#ifndef SEAUTILS_TOOLBOX_ATTENUATION_HPP
#define SEAUTILS_TOOLBOX_ATTENUATION_HPP

namespace seautils::toolbox {

/// An attenuation in a unit of the Acoustics Toolbox, in decibels a wavelength.
/// Check values at 1000 Hz and 1500 m/s (a wavelength of 1.5 m): N 0.1 gives 1.302883, F 0.2 0.3, M 0.2 0.3, W 0.8 0.8,
/// Q 50 0.545751, L 0.01 0.545751.
/// @param unit  N: nepers/m; F: dB/(m kHz); M: dB/m; W: dB a wavelength; Q: quality factor (0: none); L: loss tangent
/// @param speed_mps  of the wave; not 0
double attenuation_db_per_wavelength(char unit, double x, double speed_mps, double frequency_hz);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_ATTENUATION_HPP
