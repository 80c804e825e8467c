#include "seautils/propagation/column.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::propagation {

namespace {

struct Points {
    std::vector<double> z, c;
};

Points points_of(const WaterColumn& water) {
    Points p;
    if (water.mesh) {
        p.z = water.mesh->depth_m;
        for (std::size_t k = 0; k < p.z.size(); ++k)
            p.c.push_back(water.mesh->sound_speed_mps[k * water.mesh->range_m.size()]);
        return p;
    }
    for (const SpeedPoint& point : water.profile) {
        p.z.push_back(point.depth_m);
        p.c.push_back(point.sound_speed_mps);
    }
    return p;
}

std::vector<double> secants(const Points& p) {
    std::vector<double> s;
    for (std::size_t k = 1; k < p.z.size(); ++k)
        s.push_back((p.c[k] - p.c[k - 1]) / (p.z[k] - p.z[k - 1]));
    return s;
}

/// Slope at an end from the two spans next to it, kept from overshooting.
double end_slope(double h0, double h1, double s0, double s1) {
    const double slope = ((2 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
    if (slope * s0 <= 0) return 0;
    return s0 * s1 <= 0 && std::abs(slope) > std::abs(3 * s0) ? 3 * s0 : slope;
}

/// F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5, 300-304 (1984).
std::vector<double> monotone_slopes(const Points& p) {
    const std::vector<double> s = secants(p);
    const std::size_t n = p.z.size();
    if (n == 2) return {s[0], s[0]};
    std::vector<double> slopes(n);
    for (std::size_t k = 1; k + 1 < n; ++k) {
        if (s[k - 1] * s[k] <= 0) continue;
        const double h0 = p.z[k] - p.z[k - 1], h1 = p.z[k + 1] - p.z[k];
        const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
        slopes[k] = (w0 + w1) / (w0 / s[k - 1] + w1 / s[k]);
    }
    slopes[0] = end_slope(p.z[1] - p.z[0], p.z[2] - p.z[1], s[0], s[1]);
    slopes[n - 1] = end_slope(p.z[n - 1] - p.z[n - 2], p.z[n - 2] - p.z[n - 3], s[n - 2], s[n - 3]);
    return slopes;
}

/// Slopes of the cubic spline whose third derivative does not jump at the second and the last but
/// one point; of the parabola through three points.
std::vector<double> spline_slopes(const Points& p) {
    const std::vector<double> s = secants(p);
    const std::size_t n = p.z.size();
    if (n == 2) return {s[0], s[0]};
    const auto h = [&](std::size_t k) { return p.z[k + 1] - p.z[k]; };
    if (n == 3) {
        const double bend = (s[1] - s[0]) / (h(0) + h(1));
        return {s[0] - bend * h(0), s[0] + bend * h(0), s[1] + bend * h(1)};
    }
    std::vector<double> lower(n), middle(n), upper(n), right(n);
    middle[0] = h(1), upper[0] = h(0) + h(1);
    right[0] = ((h(0) + 2 * upper[0]) * h(1) * s[0] + h(0) * h(0) * s[1]) / upper[0];
    for (std::size_t k = 1; k + 1 < n; ++k) {
        lower[k] = h(k), middle[k] = 2 * (h(k - 1) + h(k)), upper[k] = h(k - 1);
        right[k] = 3 * (h(k) * s[k - 1] + h(k - 1) * s[k]);
    }
    const double last = h(n - 2), before = h(n - 3);
    lower[n - 1] = last + before, middle[n - 1] = before;
    right[n - 1] =
        (last * last * s[n - 3] + (2 * lower[n - 1] + last) * before * s[n - 2]) / lower[n - 1];
    for (std::size_t k = 1; k < n; ++k) {
        const double part = lower[k] / middle[k - 1];
        middle[k] -= part * upper[k - 1];
        right[k] -= part * right[k - 1];
    }
    right[n - 1] /= middle[n - 1];
    for (std::size_t k = n - 1; k-- > 0;)
        right[k] = (right[k] - upper[k] * right[k + 1]) / middle[k];
    return right;
}

std::vector<std::array<double, 4>> cubics(const Points& p, const std::vector<double>& slopes) {
    std::vector<std::array<double, 4>> pieces;
    for (std::size_t k = 0; k + 1 < p.z.size(); ++k) {
        const double h = p.z[k + 1] - p.z[k], s = (p.c[k + 1] - p.c[k]) / h;
        pieces.push_back({p.c[k], slopes[k], (3 * s - 2 * slopes[k] - slopes[k + 1]) / h,
                          (slopes[k] + slopes[k + 1] - 2 * s) / (h * h)});
    }
    return pieces;
}

std::vector<std::array<double, 4>> lines(const Points& p) {
    const std::vector<double> s = secants(p);
    std::vector<std::array<double, 4>> pieces;
    for (std::size_t k = 0; k < s.size(); ++k) pieces.push_back({p.c[k], s[k], 0, 0});
    return pieces;
}

/// One of n pieces, where all beyond the ends counts to the first and the last.
double clamped(const std::vector<double>& depths, double z) {
    return std::clamp(z, depths.front(), depths.back());
}

}  // namespace

Column::Column(const Environment& e)
    : surface_m_(surface_depth_m(e, 0)),
      bottom_m_(bottom_depth_m(e, 0)),
      n2_linear_(!e.water.mesh && e.water.interpolation == SpeedInterpolation::n2_linear) {
    Points p = points_of(e.water);
    if (n2_linear_)
        for (double& c : p.c) c = 1 / (c * c);
    depth_m_ = p.z;
    const auto kind = e.water.mesh ? SpeedInterpolation::c_linear : e.water.interpolation;
    if (p.z.size() == 1)
        pieces_ = {{p.c[0], 0, 0, 0}};
    else if (kind == SpeedInterpolation::pchip)
        pieces_ = cubics(p, monotone_slopes(p));
    else if (kind == SpeedInterpolation::spline)
        pieces_ = cubics(p, spline_slopes(p));
    else
        pieces_ = lines(p);
}

std::size_t Column::piece_at(double depth_m) const {
    const auto after = std::upper_bound(depth_m_.begin(), depth_m_.end(), depth_m);
    const auto k = static_cast<std::size_t>(after - depth_m_.begin());
    return std::min(k == 0 ? 0 : k - 1, pieces_.size() - 1);
}

double Column::in_piece(std::size_t piece, double depth_m) const {
    const double x = clamped(depth_m_, depth_m) - depth_m_[piece];
    const auto& p = pieces_[piece];
    const double value = p[0] + x * (p[1] + x * (p[2] + x * p[3]));
    if (n2_linear_) return value;
    // A spline may swing to where there is no speed; keep a finite one.
    const double c = std::max(value, 1.0);
    return 1 / (c * c);
}

double Column::squared_slowness(double depth_m) const {
    return in_piece(piece_at(depth_m), depth_m);
}

double Column::under_ramp(double from_m, double to_m, bool rises, std::size_t& piece) const {
    static constexpr double node[]{-0.7745966692414834, 0, 0.7745966692414834};
    static constexpr double weight[]{5.0 / 18, 8.0 / 18, 5.0 / 18};
    double sum = 0;
    for (double a = from_m; a < to_m;) {
        while (piece + 1 < pieces_.size() && depth_m_[piece + 1] <= a) ++piece;
        const bool ends = piece + 1 < depth_m_.size() && depth_m_[piece + 1] > a;
        const double b = ends ? std::min(to_m, depth_m_[piece + 1]) : to_m;
        for (int k = 0; k < 3; ++k) {
            const double z = (a + b + node[k] * (b - a)) / 2;
            const double part = (z - from_m) / (to_m - from_m);
            sum += weight[k] * (b - a) * (rises ? part : 1 - part) * in_piece(piece, z);
        }
        a = b;
    }
    return sum;
}

std::vector<double> Column::sampled(std::size_t n) const {
    const double h = height_m() / static_cast<double>(n);
    const auto depth = [&](std::size_t k) { return surface_m_ + h * static_cast<double>(k); };
    std::vector<double> q(n + 1), pivot(n + 1, 10);
    q[0] = squared_slowness(surface_m_);
    q[n] = squared_slowness(bottom_m_);
    std::size_t above = piece_at(surface_m_), below = above;
    for (std::size_t k = 1; k < n; ++k)
        q[k] = 12 / h *
               (under_ramp(depth(k - 1), depth(k), true, above) +
                under_ramp(depth(k), depth(k + 1), false, below));
    q[1] -= q[0];
    q[n - 1] -= q[n];
    for (std::size_t k = 2; k < n; ++k) {
        pivot[k] -= 1 / pivot[k - 1];
        q[k] -= q[k - 1] / pivot[k - 1];
    }
    for (std::size_t k = n - 1; k >= 1; --k) q[k] = (q[k] - (k + 1 < n ? q[k + 1] : 0)) / pivot[k];
    return q;
}

}  // namespace seautils::propagation
