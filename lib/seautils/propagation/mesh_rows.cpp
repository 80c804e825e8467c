#include "seautils/propagation/mesh_rows.hpp"

#include <cmath>
#include <limits>

namespace seautils::propagation {

namespace {

using Complex = std::complex<double>;

/// -(row of a boundary): w of the node before it over u at it, from u' = -g u and the differential
/// equation, to h⁶. `q` is k² - ξ there, `slope` its derivative outward.
template <typename Number>
Number edge_row(const Number& g, const Number& q, double slope, double h) {
    const double h2 = h * h;
    return 1.0 + h * g - (5.0 / 12) * h2 * q - (h2 * h / 12) * (q * g - slope) +
           (h2 * h2 * h / 180) * (4.0 * slope * q - q * q * g);
}

Complex diagonal(const Edge& edge, const Mesh& m, std::size_t node, double slope,
                 const Complex& xi) {
    const Complex water = m.squared_wavenumber(node), q = water - xi;
    const Complex t = 1.0 + m.step_m * m.step_m / 12 * q;
    return -edge_row(edge.admittance(xi, water), q, slope, m.step_m) / t;
}

double real_diagonal(double admittance, const Mesh& m, std::size_t node, double slope, double xi) {
    const double q = m.k2[node] - xi;
    return -edge_row(admittance, q, slope, m.step_m) / (1 + m.step_m * m.step_m / 12 * q);
}

/// Derivative outward at an end of the column, of what its interpolation has there.
double slope_at(const Waveguide& w, double depth_m, double inward_m) {
    const double at = w.column.squared_slowness(depth_m),
                 before = w.column.squared_slowness(depth_m + inward_m);
    return w.omega * w.omega * (at - before) / std::abs(inward_m);
}

}  // namespace

Mesh::Mesh(const Waveguide& w, std::size_t steps)
    : guide(w),
      step_m(w.column.height_m() / static_cast<double>(steps)),
      k2(w.column.sampled(steps)),
      k2_loss(steps + 1),
      first(w.surface.is_free() ? 1 : 0),
      last(w.bottom.is_free() ? steps - 1 : steps) {
    for (std::size_t k = 0; k <= steps; ++k) {
        k2[k] *= w.omega * w.omega;
        k2_loss[k] = 2 * w.absorption_np_per_m * std::sqrt(std::abs(k2[k]));
    }
    const double top = w.column.surface_m(), bottom = top + w.column.height_m();
    surface_slope = slope_at(w, top, step_m / 16);
    bottom_slope = slope_at(w, bottom, -step_m / 16);
}

std::array<std::size_t, count_lanes> roots_above(const Mesh& m,
                                                 const std::array<double, count_lanes>& xi) {
    constexpr std::size_t n = count_lanes;
    const double c = m.step_m * m.step_m / 12;
    std::array<double, n> inverse{}, count{}, edge{};
    const std::size_t nodes = m.k2.size();
    const auto take = [&](const std::array<double, n>& a) {
        for (std::size_t l = 0; l < n; ++l) {
            const double pivot = a[l] - inverse[l];
            count[l] += pivot > 0 ? 1.0 : 0.0;
            inverse[l] = 1 / pivot;
        }
    };
    if (m.first == 0) {
        for (std::size_t l = 0; l < n; ++l)
            edge[l] =
                real_diagonal(m.guide.surface.real_admittance(xi[l]), m, 0, m.surface_slope, xi[l]);
        take(edge);
    }
    for (std::size_t j = 1; j + 1 < nodes; ++j) {
        std::array<double, n> a;
        for (std::size_t l = 0; l < n; ++l) a[l] = 10 - 12 / (1 + c * (m.k2[j] - xi[l]));
        take(a);
    }
    if (m.last + 1 == nodes) {
        // Zeros in the layers are of roots above, too.
        for (std::size_t l = 0; l < n; ++l) {
            const Edge::RealStack bottom = m.guide.bottom.real_stack(xi[l]);
            edge[l] = real_diagonal(bottom.admittance, m, m.last, m.bottom_slope, xi[l]);
            count[l] += static_cast<double>(bottom.zeros);
        }
        take(edge);
    }
    std::array<std::size_t, n> result;
    for (std::size_t l = 0; l < n; ++l) result[l] = static_cast<std::size_t>(count[l]);
    return result;
}

TwistedRows::TwistedRows(const Mesh& mesh)
    : mesh_(mesh), a_(mesh.k2.size()), down_(mesh.k2.size()), up_(mesh.k2.size()) {}

void TwistedRows::set_edges(const Xis& xi) {
    const auto set = [&](std::size_t which, const Edge& edge, std::size_t node, double slope) {
        for (std::size_t l = 0; l < polish_lanes; ++l) {
            const double dx = 1e-7 * (std::abs(xi[l]) + 1e-12);
            const Complex a = diagonal(edge, mesh_, node, slope, xi[l]);
            a_[node].re[l] = a.real();
            a_[node].im[l] = a.imag();
            edge_slope_[which][l] = (diagonal(edge, mesh_, node, slope, xi[l] + dx) -
                                     diagonal(edge, mesh_, node, slope, xi[l] - dx)) /
                                    (2 * dx);
            edge_weight_[which][l] =
                1.0 + mesh_.step_m * mesh_.step_m / 12 * (mesh_.squared_wavenumber(node) - xi[l]);
        }
    };
    if (mesh_.first == 0) set(0, mesh_.guide.surface, 0, mesh_.surface_slope);
    if (mesh_.last + 1 == a_.size()) set(1, mesh_.guide.bottom, mesh_.last, mesh_.bottom_slope);
}

void TwistedRows::factor(const Xis& xi) {
    constexpr std::size_t n = polish_lanes;
    constexpr double tiny = 1e-100;  // no pivot is 0; a mode's zero may lie on a node
    const double c = mesh_.step_m * mesh_.step_m / 12;
    Lane x, y;
    for (std::size_t l = 0; l < n; ++l) x[l] = xi[l].real(), y[l] = xi[l].imag();
    for (std::size_t j = 1; j + 1 < a_.size(); ++j)
        for (std::size_t l = 0; l < n; ++l) {
            const double re = 1 + c * (mesh_.k2[j] - x[l]), im = c * (mesh_.k2_loss[j] - y[l]);
            const double scale = 12 / (re * re + im * im);
            a_[j].re[l] = 10 - re * scale;
            a_[j].im[l] = im * scale;
        }
    set_edges(xi);
    Row inverse{};
    for (std::size_t j = mesh_.first; j <= mesh_.last; ++j) {
        for (std::size_t l = 0; l < n; ++l) {
            const double re = a_[j].re[l] - inverse.re[l] + tiny, im = a_[j].im[l] - inverse.im[l];
            const double scale = 1 / (re * re + im * im);
            inverse.re[l] = re * scale;
            inverse.im[l] = -im * scale;
        }
        down_[j] = inverse;
    }
    inverse = {};
    Lane least;
    least.fill(std::numeric_limits<double>::infinity());
    for (std::size_t j = mesh_.last + 1; j-- > mesh_.first;) {
        const Row* above = j > mesh_.first ? &down_[j - 1] : nullptr;
        for (std::size_t l = 0; l < n; ++l) {
            const double re = a_[j].re[l] - inverse.re[l] + tiny, im = a_[j].im[l] - inverse.im[l];
            const double scale = 1 / (re * re + im * im);
            inverse.re[l] = re * scale;
            inverse.im[l] = -im * scale;
            const double gap_re = re - (above ? above->re[l] : 0),
                         gap_im = im - (above ? above->im[l] : 0);
            const double gap = gap_re * gap_re + gap_im * gap_im;
            if (gap < least[l]) least[l] = gap, twist_[l] = j;
        }
        up_[j] = inverse;
    }
}

TwistedRows::Complex TwistedRows::from_surface(std::size_t lane, std::size_t row) const {
    return -get(down_[row], lane);
}

TwistedRows::Complex TwistedRows::from_bottom(std::size_t lane, std::size_t row) const {
    return -get(up_[row + 1], lane);
}

TwistedRows::Complex TwistedRows::meeting(std::size_t lane, std::size_t row) const {
    Complex gap = get(a_[row], lane);
    if (row > mesh_.first) gap -= get(down_[row - 1], lane);
    if (row < mesh_.last) gap -= get(up_[row + 1], lane);
    return gap;
}

TwistedRows::Complex TwistedRows::weight(std::size_t lane, std::size_t row) const {
    if (row == 0) return edge_weight_[0][lane];
    if (row + 1 == a_.size()) return edge_weight_[1][lane];
    return 12.0 / (10.0 - get(a_[row], lane));
}

TwistedRows::Shape TwistedRows::shape(std::size_t lane, std::vector<Complex>* values) {
    const std::size_t middle = twist_[lane];
    const double h2 = mesh_.step_m * mesh_.step_m;
    Complex sum = 0;
    if (values) values->assign(a_.size(), 0.0);
    const auto take = [&](std::size_t j, const Complex& w) {
        if (j == 0 || j + 1 == a_.size()) {
            const std::size_t which = j == 0 ? 0 : 1;
            sum += edge_slope_[which][lane] * w * w;
            if (values) (*values)[j] = w / edge_weight_[which][lane];
            return;
        }
        const double re = (10 - a_[j].re[lane]) / 12, im = -a_[j].im[lane] / 12;
        const Complex u{w.real() * re - w.imag() * im, w.real() * im + w.imag() * re};
        sum -= h2 * Complex{u.real() * u.real() - u.imag() * u.imag(), 2 * u.real() * u.imag()};
        if (values) (*values)[j] = u;
    };
    const auto step = [](const Complex& w, const Complex& ratio) {
        return Complex{ratio.imag() * w.imag() - ratio.real() * w.real(),
                       -ratio.real() * w.imag() - ratio.imag() * w.real()};
    };
    take(middle, 1.0);
    // Where |w|² of two rows (one may be a zero of the mode) changes nothing of a sum, all beyond does not.
    constexpr double forgotten = 1e-24;
    Complex w = 1;
    double before = 1;
    for (std::size_t j = middle; j-- > mesh_.first && before + std::norm(w) > forgotten;) {
        before = std::norm(w);
        take(j, w = step(w, get(down_[j], lane)));
    }
    w = before = 1;
    for (std::size_t j = middle + 1; j <= mesh_.last && before + std::norm(w) > forgotten; ++j) {
        before = std::norm(w);
        take(j, w = step(w, get(up_[j], lane)));
    }
    return {meeting(lane, middle), sum};
}

}  // namespace seautils::propagation
