#ifndef SEAUTILS_PROPAGATION_REFLECTION_HPP
#define SEAUTILS_PROPAGATION_REFLECTION_HPP

#include "seautils/propagation/environment.hpp"
#include "seautils/propagation/layer_stack.hpp"

#include <complex>
#include <vector>

namespace seautils::propagation {

/// Complex plane-wave reflection coefficient of a boundary seen from the water, in the time convention of the Acoustics
/// Toolbox (the conjugate of exp(-iωt)).
/// Layers count as homogeneous slices, see slices_of(): fine ones, or those that were made before.
/// The speed of a lossy medium is complex, c (1 + i loss), as in the Acoustics Toolbox.
/// Check values (half-space 1700 / (1 + loss²) m/s, 1.8 g/cm³, 0.5 dB a wavelength under 1500 m/s, 1.0): 1° gives magnitude 0.995732 and
/// a phase of +172.369° here; 20° 0.945548, 55.573°; 30° 0.677049; 90° 0.342117.
/// @param grazing_rad  0 to π/2
/// @param sound_speed_mps, density_gcm3  of the water at the boundary
std::complex<double> reflection_coefficient(const Boundary& boundary, double frequency_hz,
                                            double grazing_rad, double sound_speed_mps,
                                            double density_gcm3);
std::complex<double> reflection_coefficient(const Boundary& boundary,
                                            const std::vector<Slice>& slices, double frequency_hz,
                                            double grazing_rad, double sound_speed_mps,
                                            double density_gcm3);

/// A sediment by its mean grain size: the regressions of APL-UW TR 9407.
/// @param grain_phi  -1 to 9, in φ units
/// @param sound_speed_mps, density_gcm3  of the water above
/// @throws DataError  outside that range
Boundary grain_half_space(double grain_phi, double sound_speed_mps, double density_gcm3);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_REFLECTION_HPP
