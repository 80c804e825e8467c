#ifndef SEAUTILS_PROPAGATION_RAY_SEA_HPP
#define SEAUTILS_PROPAGATION_RAY_SEA_HPP

#include "seautils/propagation/environment.hpp"
#include "seautils/propagation/layer_stack.hpp"

#include <string>
#include <vector>

namespace seautils::propagation {

/// Farther than any ray: where the outermost strips, layers and walls end.
inline constexpr double far_m = 1e9;

/// A rectangle of water: c = speed + range_gradient·Δr + depth_gradient·Δz + twist·Δr·Δz about its
/// middle (about its inner edge, where it runs to far_m).
struct Cell {
    double range_m = 0, depth_m = 0, speed_mps = 0;
    double range_gradient = 0, depth_gradient = 0, twist = 0;

    double speed_at(double r, double z) const {
        const double dr = r - range_m, dz = z - depth_m;
        return speed_mps + range_gradient * dr + (depth_gradient + twist * dr) * dz;
    }
};

/// A straight part of a wall, from a range to the next.
struct Facet {
    double range_m = 0, end_m = 0, depth_m = 0, end_depth_m = 0;
    double cosine = 1, sine = 0;  ///< of its slope; down is positive
    /// Of the wall that it stands for, at both ends: direction, and curvature in 1/m.
    double cosine_from = 1, sine_from = 0, cosine_to = 1, sine_to = 0;
    double curvature_from = 0, curvature_to = 0;
};

/// Surface or bottom.
struct Wall {
    Boundary boundary;
    bool level = true;
    double depth_m = 0;           ///< where level
    std::vector<Facet> facet;     ///< else; from -far_m to far_m
    std::vector<Slice> slices{};  ///< of the boundary's layers

    double depth_at(double range_m) const;
    /// The facet over a range.
    std::size_t facet_at(double range_m) const;
};

/// The environment as rays see it: strips of range by layers of depth, between two walls.
struct RaySea {
    std::vector<double> strip_edge_m, layer_edge_m;  ///< from -far_m to far_m
    std::vector<Cell> cell;                          ///< [strip][layer]
    Wall surface, bottom;
    bool periodic = false;  ///< nothing depends on range: rays repeat themselves
    double frequency_hz = 0, density_gcm3 = 1;
    double source_depth_m = 0, source_speed_mps = 0;
    double absorption_np_per_m = 0;

    std::size_t layers() const { return layer_edge_m.size() - 1; }
    std::size_t strip_at(double range_m) const;
    const Cell& at(std::size_t strip, std::size_t layer) const {
        return cell[strip * layers() + layer];
    }
};

/// The last range, rounded up to 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 of its decade, 1 mm at least:
/// what rays are chosen for, so that receivers may move a little under the same rays.
double reach_m(const Environment& environment);

/// @param environment  as check() lets it pass; of its receivers, reach_m() counts
/// @param remarks      takes what was assumed
RaySea make_ray_sea(const Environment& environment, std::vector<std::string>& remarks);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_SEA_HPP
