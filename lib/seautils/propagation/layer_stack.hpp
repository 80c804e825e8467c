#ifndef SEAUTILS_PROPAGATION_LAYER_STACK_HPP
#define SEAUTILS_PROPAGATION_LAYER_STACK_HPP

#include "seautils/propagation/environment.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace seautils::propagation {

/// A wave at a level, up to a factor: its pressure, and -(d pressure / d depth) / density. Their ratio is an admittance;
/// kept apart they have no poles.
struct StackWave {
    std::complex<double> flow, pressure;
};

/// A homogeneous part of a layer.
struct Slice {
    double thickness_m = 0, sound_speed_mps = 0, density_gcm3 = 1;
    double attenuation_db_per_wavelength = 0;
};

/// Layers as homogeneous slices, from the lowest up. A layer of one speed is one slice; one whose speed changes is so
/// many that their thickness h and the change Δ(k²) over the layer hold h² Δ(k²) / 12 < tolerance, which is about the
/// error of the phase, and the relative one of the amplitude; where all layers would have more than most_slices, all
/// have fewer in proportion.
std::vector<Slice> slices_of(const std::vector<SedimentLayer>& layers, double omega_rad_per_s,
                             double tolerance);
inline constexpr double most_slices = 4096;
/// For waves, and for rays, which reflect often and are less exact by themselves.
inline constexpr double fine_slices = 3e-4, slices_of_rays = 3e-3;

/// From the lower side of a slice to its upper one. Nothing in it grows, however thick the slice and steep the
/// decay: it is a reflection that comes back weaker.
/// @param xi  squared horizontal wavenumber, rad²/m²
/// @param k2  squared wavenumber of the slice, in either convention of time
StackWave through(const Slice& slice, const std::complex<double>& xi,
                  const std::complex<double>& k2, const StackWave& below);

/// The same without losses, and how many zeros of pressure lie in what was passed.
struct RealWave {
    double flow = 0, pressure = 0;
    std::size_t zeros = 0;
};
RealWave through(const Slice& slice, double xi, double k2, const RealWave& below);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_LAYER_STACK_HPP
