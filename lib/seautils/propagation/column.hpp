#ifndef SEAUTILS_PROPAGATION_COLUMN_HPP
#define SEAUTILS_PROPAGATION_COLUMN_HPP

#include "seautils/propagation/environment.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace seautils::propagation {

/// The water at the source, as wave equations want it: from its surface to its bottom, the squared
/// slowness 1/c² as its interpolation has it; constant beyond the ends of the profile. A mesh counts
/// as its first column.
class Column {
public:
    /// @param environment  check()ed
    explicit Column(const Environment& environment);

    double surface_m() const noexcept { return surface_m_; }
    double height_m() const noexcept { return bottom_m_ - surface_m_; }
    /// 1/c², s²/m², at a depth.
    double squared_slowness(double depth_m) const;

    /// 1/c² at 0 … n of n equal steps down the column. Its combination (1, 10, 1)/12 of neighbours is the
    /// mean of 1/c² under the triangle over three nodes, however many points of the profile lie there: what a
    /// scheme of fourth order keeps of a smooth profile, it keeps of one with kinks.
    /// Cost: n and the points of the profile. n is 2 or more.
    std::vector<double> sampled(std::size_t n) const;

private:
    double in_piece(std::size_t piece, double depth_m) const;
    std::size_t piece_at(double depth_m) const;
    /// ∫ of 1/c² under a line that rises from 0 to 1 (or falls) over the span.
    double under_ramp(double from_m, double to_m, bool rises, std::size_t& piece) const;

    double surface_m_, bottom_m_;
    bool n2_linear_;
    std::vector<double> depth_m_;  ///< where pieces begin and end
    std::vector<std::array<double, 4>>
        pieces_;  ///< powers of depth below the begin: of c, or of 1/c²
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_COLUMN_HPP
