#ifndef SEAUTILS_PROPAGATION_EDGE_HPP
#define SEAUTILS_PROPAGATION_EDGE_HPP

#include "seautils/propagation/layer_stack.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace seautils::propagation {

/// A level boundary as modes and wavenumber integration meet it: -u'/u outward, of the pressure u, as a
/// function of the squared horizontal wavenumber; time goes as exp(-iωt).
class Edge {
public:
    using Complex = std::complex<double>;

    /// @throws DataError  the boundary is a table: it says nothing of complex angles
    Edge(const Boundary& boundary, const char* name, double frequency_hz,
         double water_density_gcm3);

    /// No pressure at the boundary at all.
    bool is_free() const noexcept {
        return kind_ == BoundaryKind::vacuum && roughness_m_ == 0 && slices_.empty();
    }
    /// Homogeneous ones that the layers are taken for.
    std::size_t slices() const noexcept { return slices_.size(); }
    /// One that loses less: from nothing, where what is real in it is all there is, to all of it.
    /// @param share  0 to 1
    Edge losing(double share) const;
    /// Squared wavenumber of the slowest layer, rad²/m²; 0 without layers.
    double most_k2() const noexcept;
    /// Below the squared wavenumber of the half-space waves leave through it: the root is that of outgoing
    /// waves (the cut of the Pekeris problem goes straight up).
    /// @param xi     squared horizontal wavenumber, rad²/m²
    /// @param water  squared wavenumber of the water at the boundary
    Complex admittance(const Complex& xi, const Complex& water) const;
    /// Of what is real in it: without losses, and rigid where waves leave. Grows with xi, from where it was infinite;
    /// without layers never below 0.
    double real_admittance(double xi) const { return real_stack(xi).admittance; }
    /// And how often the pressure is 0 in the layers: so often the admittance has been infinite at greater xi.
    struct RealStack {
        double admittance = 0;
        std::size_t zeros = 0;
    };
    RealStack real_stack(double xi) const;
    /// exp(iλ) is the part that the reflection has in excess of that of real_admittance().
    Complex excess_phase(double xi, double water) const;

private:
    Complex smooth_admittance(const Complex& xi) const;
    Complex half_space_admittance(const Complex& xi) const;
    Complex stack_admittance(const Complex& xi, const Complex& base) const;

    BoundaryKind kind_;
    double roughness_m_, density_ratio_;  ///< water over half-space
    double water_density_gcm3_, share_ = 1;
    std::vector<Slice> slices_;      ///< from the lowest up
    std::vector<Complex> slice_k2_;  ///< theirs
    Complex compressional_, shear_;  ///< squared wavenumbers; shear_ 0 in a fluid
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_EDGE_HPP
