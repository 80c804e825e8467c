#ifndef SEAUTILS_PROPAGATION_MODE_SEARCH_HPP
#define SEAUTILS_PROPAGATION_MODE_SEARCH_HPP

#include "seautils/propagation/mesh_rows.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace seautils::propagation {

struct Mode {
    std::complex<double> xi;          ///< squared horizontal wavenumber, rad²/m²
    std::complex<double> correction;  ///< by the extrapolation over meshes, which is in it
    /// At the depths asked for, where ∫u² over the water, and what lies beyond it, is 1; 1/√m.
    std::vector<std::complex<double>> values;
};

/// Largest ξ first.
struct ModeSet {
    std::vector<Mode> modes;
    std::size_t lost = 0;  ///< starts that led to no mode, or to one already found
};

/// Eigenvalues of the lossless sea above ξ.
std::size_t count_modes(const Mesh& mesh, double least_xi);

/// The modes, trapped and leaky, whose ξ is above least_xi: bracketed in a lossless sea by Sturm's
/// sequence, shifted by what the boundaries' reflection has in excess of that, refined by inverse iteration in
/// the complex plane, and extrapolated over meshes of h and 2h/3 (h⁴).
/// @param depth_m  in the water
ModeSet find_modes(const Waveguide& guide, double least_xi, std::size_t steps,
                   const std::vector<double>& depth_m);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_MODE_SEARCH_HPP
