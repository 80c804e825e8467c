#ifndef SEAUTILS_PROPAGATION_MESH_ROWS_HPP
#define SEAUTILS_PROPAGATION_MESH_ROWS_HPP

#include "seautils/propagation/column.hpp"
#include "seautils/propagation/edge.hpp"

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace seautils::propagation {

/// The water between its two boundaries.
struct Waveguide {
    const Column& column;
    const Edge &surface, &bottom;
    double omega = 0;  ///< rad/s
    double absorption_np_per_m = 0;
};

/// Nodes of equal distance down a waveguide, for u'' + (k²(z) - ξ) u = 0 by Numerov's scheme: with
/// w = u t, t = 1 + h²(k² - ξ)/12, a symmetric tridiagonal system with 1 beside the diagonal. The rows of
/// boundaries are of the same order.
struct Mesh {
    Mesh(const Waveguide& waveguide, std::size_t steps);

    const Waveguide& guide;
    double step_m;
    std::vector<double> k2, k2_loss;     ///< real and imaginary part of k² at each node, rad²/m²
    double surface_slope, bottom_slope;  ///< of k², outward
    std::size_t first, last;             ///< nodes with a row: not those of a free boundary

    std::size_t rows() const noexcept { return last - first + 1; }
    std::complex<double> squared_wavenumber(std::size_t node) const {
        return {k2[node], k2_loss[node]};
    }
};

inline constexpr std::size_t count_lanes = 8, polish_lanes = 4;

/// Eigenvalues of the lossless problem above each ξ, by the signs of Sturm's sequence.
std::array<std::size_t, count_lanes> roots_above(const Mesh& mesh,
                                                 const std::array<double, count_lanes>& xi);

/// The rows factored from both ends at several ξ at once, and what follows of it: the twisted
/// factorization, which finds an eigenvector without growth of rounding however it decays.
class TwistedRows {
public:
    using Complex = std::complex<double>;
    using Xis = std::array<Complex, polish_lanes>;

    explicit TwistedRows(const Mesh& mesh);
    void factor(const Xis& xi);

    /// Solution of one lane: w is 1 at the row where it is largest, and all rows hold but that one, by `residual`.
    struct Shape {
        Complex residual;
        Complex slope;  ///< d residual / dξ: -h ∫u², with what lies beyond the boundaries
    };
    /// @param values  u at all nodes, scaled as w; not wanted where null
    Shape shape(std::size_t lane, std::vector<Complex>* values);

    /// w at row j over w at row j + 1 of the solution that holds from the surface down to row j, and
    /// w at row j + 1 over w at row j of that which holds from the bottom up to row j + 1.
    Complex from_surface(std::size_t lane, std::size_t row) const;
    Complex from_bottom(std::size_t lane, std::size_t row) const;
    /// What row j lacks where both meet there with w = 1.
    Complex meeting(std::size_t lane, std::size_t row) const;
    /// w/u at a row.
    Complex weight(std::size_t lane, std::size_t row) const;

private:
    using Lane = std::array<double, polish_lanes>;
    struct Row {
        Lane re, im;
    };
    static Complex get(const Row& row, std::size_t lane) { return {row.re[lane], row.im[lane]}; }
    void set_edges(const Xis& xi);

    const Mesh& mesh_;
    std::vector<Row> a_, down_,
        up_;  ///< diagonal; inverse pivots from the surface, from the bottom
    std::array<Xis, 2> edge_weight_, edge_slope_;  ///< [surface, bottom]: t and da/dξ of their rows
    std::array<std::size_t, polish_lanes> twist_{};
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_MESH_ROWS_HPP
