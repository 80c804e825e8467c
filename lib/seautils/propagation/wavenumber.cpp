#include "seautils/core/error.hpp"
#include "seautils/propagation/error_estimate.hpp"
#include "seautils/propagation/hankel.hpp"
#include "seautils/propagation/level_sea.hpp"
#include "seautils/propagation/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seautils::propagation {

namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};
constexpr double pi = std::numbers::pi;
constexpr double radians_per_step = 0.2;  ///< across, of what propagates
/// Samples lie so close that what wraps around comes from this much farther than the last range, and the contour so
/// low that it arrives with this much less.
constexpr double window = 3.5, wrapped_np = 11;

/// Samples along a contour that leaves 0 and runs below the real axis, k = s - iε s/√(s² + (5ε)²): odd in s, so that
/// sums of even steps converge fast.
struct Contour {
    double step = 0, below = 0;
    std::size_t samples = 0;

    double s(std::size_t n) const { return (static_cast<double>(n) + 0.5) * step; }
    double turn() const { return 5 * below; }
    Complex k(std::size_t n) const { return {s(n), -below * s(n) / std::hypot(s(n), turn())}; }
    /// dk/ds
    Complex slope(std::size_t n) const {
        return {1, -below * std::pow(turn(), 2) / std::pow(std::hypot(s(n), turn()), 3)};
    }
};

/// Far above the water's wavenumber what is sampled falls as exp(-s |z - zs|): to 1e-5 of the nearest receivers
/// that do not lie at the source's depth.
double most_wavenumber(const Environment& e, const LevelSea& sea) {
    // Waves in a layer that is slow against the water are heard near the bottom.
    const double k =
        std::sqrt(std::max(sea.most_k2, std::min(sea.bottom.most_k2(), 4 * sea.most_k2)));
    double apart = 1e300;
    for (const double z : sea.depth_m) {
        const double d = std::abs(z - e.source.depth_m);
        if (d > 0) apart = std::min(apart, d);
    }
    return k * 1.3 + std::min(11.5 / apart, k * 0.7);
}

Contour contour(const Environment& e, const LevelSea& sea) {
    const double range = std::max(e.receivers.range_m.back(), sea.column.height_m());
    Contour c;
    c.step = 2 * pi / (window * range);
    // Over the window the integrand repeats; what lies between comes in as exp(-ε window).
    c.below = wrapped_np / ((window - 1) * range);
    c.samples =
        static_cast<std::size_t>(std::min(1e12, std::ceil(most_wavenumber(e, sea) / c.step)));
    return c;
}

/// The first of six nodes about a depth, and how many steps the depth lies beyond it.
struct Place {
    std::size_t first = 0;
    double x = 0;
};

Place place(const Mesh& mesh, double depth_m) {
    const double at = (depth_m - mesh.guide.column.surface_m()) / mesh.step_m;
    const double start =
        std::clamp(std::floor(at) - 2, 0.0, static_cast<double>(mesh.k2.size() - 6));
    return {static_cast<std::size_t>(start), at - start};
}

Complex interpolated(const std::array<Complex, 6>& u, double x) {
    Complex sum = 0;
    for (int a = 0; a < 6; ++a) {
        double weight = 1;
        for (int b = 0; b < 6; ++b)
            if (a != b) weight *= (x - b) / (a - b);
        sum += weight * u[static_cast<std::size_t>(a)];
    }
    return sum;
}

/// mantissa 2^(512 exponent): products down a thousand wavelengths of decay stay numbers.
struct Scaled {
    Complex mantissa = 0;
    int exponent = 0;

    Scaled times(const Complex& factor) const {
        Scaled s{mantissa * factor, exponent};
        const double size = std::abs(s.mantissa.real()) + std::abs(s.mantissa.imag());
        if (size < 0x1p-256 && size > 0) s = {s.mantissa * 0x1p512, exponent - 1};
        if (size > 0x1p256) s = {s.mantissa * 0x1p-512, exponent + 1};
        return s;
    }
    /// As a number, where another exponent counts as 0.
    Complex beside(int other) const {
        const int turns = std::clamp(exponent - other, -4, 2);
        return turns == 0 ? mantissa
                          : Complex(std::ldexp(mantissa.real(), 512 * turns),
                                    std::ldexp(mantissa.imag(), 512 * turns));
    }
};

/// The depth-separated Green's function from the solution that holds at the surface and that which holds at
/// the bottom: u(shallower) v(deeper) / (u' v - u v').
class Green {
public:
    Green(const Mesh& mesh, double source_m, const std::vector<double>& depth_m)
        : mesh_(mesh), source_(source_m), depth_(depth_m), u_(mesh.k2.size()), v_(mesh.k2.size()) {}

    /// At all depths, for one k.
    void evaluate(const TwistedRows& rows, std::size_t lane, std::vector<Complex>& green) {
        follow(rows, lane);
        const Scaled u_source = at(rows, lane, u_, source_), v_source = at(rows, lane, v_, source_);
        const std::size_t j = nearest(source_);
        // Of Numerov's w it is the same between any two nodes, and h times that of u.
        const Complex determinant =
            -rows.meeting(lane, j) * u_[j].mantissa * v_[j].mantissa / mesh_.step_m;
        const int exponent = u_[j].exponent + v_[j].exponent;
        for (std::size_t k = 0; k < depth_.size(); ++k) {
            const bool shallower = depth_[k] < source_;
            const Scaled here = at(rows, lane, shallower ? u_ : v_, depth_[k]);
            const Scaled there = shallower ? v_source : u_source;
            const Scaled product{here.mantissa * (there.mantissa / determinant),
                                 here.exponent + there.exponent};
            green[k] = product.beside(exponent);
        }
    }

private:
    std::size_t nearest(double depth_m) const {
        const double at = (depth_m - mesh_.guide.column.surface_m()) / mesh_.step_m;
        return std::clamp(static_cast<std::size_t>(std::lround(at)), mesh_.first, mesh_.last);
    }
    /// w of both solutions: u 1 at the bottom, v 1 at the surface.
    void follow(const TwistedRows& rows, std::size_t lane) {
        u_[mesh_.last] = {1, 0};
        for (std::size_t j = mesh_.last; j-- > mesh_.first;)
            u_[j] = u_[j + 1].times(rows.from_surface(lane, j));
        v_[mesh_.first] = {1, 0};
        for (std::size_t j = mesh_.first; j < mesh_.last; ++j)
            v_[j + 1] = v_[j].times(rows.from_bottom(lane, j));
    }
    Scaled at(const TwistedRows& rows, std::size_t lane, const std::vector<Scaled>& w,
              double depth_m) const {
        const Place p = place(mesh_, depth_m);
        const int exponent = w[nearest(depth_m)].exponent;
        std::array<Complex, 6> u{};
        for (std::size_t a = 0; a < 6; ++a) {
            const std::size_t node = p.first + a;
            if (node >= mesh_.first && node <= mesh_.last)
                u[a] = w[node].beside(exponent) / rows.weight(lane, node);
        }
        return {interpolated(u, p.x), exponent};
    }

    const Mesh& mesh_;
    double source_;
    const std::vector<double>& depth_;
    std::vector<Scaled> u_, v_;
};

Complex bessel(const Complex& x) {
    const Complex turned = std::exp(i * x);
    return (hankel_over_exp(x) * turned + std::conj(hankel_over_exp(std::conj(x))) / turned) / 2.0;
}

/// What one sample adds at all ranges of p = 2 ∫ G J0(kr) k dk.
void add_sample(std::vector<Complex>& pressure, const std::vector<double>& range_m,
                const Complex& k, const Complex& weight, const std::vector<Complex>& green) {
    const std::size_t depths = green.size();
    for (std::size_t r = 0; r < range_m.size(); ++r) {
        if (range_m[r] <= 0) continue;
        const Complex factor = 2.0 * weight * k * bessel(k * range_m[r]);
        Complex* sum = &pressure[r * depths];
        for (std::size_t z = 0; z < depths; ++z) {
            const Complex& g = green[z];
            sum[z] += Complex(g.real() * factor.real() - g.imag() * factor.imag(),
                              g.real() * factor.imag() + g.imag() * factor.real());
        }
    }
}

/// The integrand ends softly: what is cut off sharply would ring.
double taper(std::size_t n, std::size_t samples) {
    const double part = static_cast<double>(n) / static_cast<double>(samples);
    return part < 0.8 ? 1 : 0.5 * (1 + std::cos(pi * (part - 0.8) / 0.2));
}

std::size_t steps_of(const Environment& e, const LevelSea& sea, const Contour& c) {
    const double steps = std::max(
        24.0, std::ceil(std::sqrt(sea.most_k2) * sea.column.height_m() / radians_per_step));
    const double receivers = static_cast<double>(e.receivers.range_m.size()) *
                             static_cast<double>(sea.depth_m.size() + 20);
    const double work = static_cast<double>(c.samples) *
                        (10 * steps + receivers + 120 * static_cast<double>(sea.bottom.slices()));
    if (!(work <= static_cast<double>(most_wavenumber_work)))
        throw DataError(
            fmt::format("wavenumber: {} samples on {:.0f} nodes for {:.0f} receivers are more work "
                        "than {} (a lower frequency, or modes, can)",
                        c.samples, steps, receivers, most_wavenumber_work));
    return static_cast<std::size_t>(steps);
}

/// What wraps around, and what the phase of Numerov's scheme is off by at the last range, where it
/// lags by (κh)⁴/480 of a vertical wavenumber κ: of the steepest wave that the bottom keeps, or of
/// one at 30°. That three times counts for 95 % of the cells, nulls among them.
double error_db(const Environment& e, const LevelSea& sea, std::size_t steps) {
    const double k = std::sqrt(sea.most_k2), slow = sea.guide.omega / k / e.bottom.sound_speed_mps;
    const bool keeps = e.bottom.kind == BoundaryKind::half_space && slow < 1;
    const double sine2 = keeps ? 1 - slow * slow : 0.25;
    const double h = sea.column.height_m() / static_cast<double>(steps);
    const double off_rad = k * e.receivers.range_m.back() / std::sqrt(1 - sine2 + 1e-3) *
                           std::pow(sine2, 3) * std::pow(k * h, 4) / 480;
    return std::min(20 / std::numbers::ln10 * (std::exp(-wrapped_np) + 3 * off_rad),
                    ErrorEstimate::most_db);
}

std::vector<Complex> integrated(const Environment& e, const LevelSea& sea, Basis& basis) {
    const Contour c = contour(e, sea);
    const std::size_t steps = steps_of(e, sea, c);
    basis.estimated_error_db = error_db(e, sea, steps);
    const Mesh mesh(sea.guide, steps);
    TwistedRows rows(mesh);
    Green green(mesh, e.source.depth_m, sea.depth_m);
    std::vector<Complex> at_depths(sea.depth_m.size());
    std::vector<Complex> pressure(sea.depth_m.size() * e.receivers.range_m.size());
    for (std::size_t n = 0; n < c.samples; n += polish_lanes) {
        TwistedRows::Xis xi;
        for (std::size_t l = 0; l < polish_lanes; ++l) xi[l] = c.k(n + l) * c.k(n + l);
        rows.factor(xi);
        for (std::size_t l = 0; l < polish_lanes && n + l < c.samples; ++l) {
            green.evaluate(rows, l, at_depths);
            add_sample(pressure, e.receivers.range_m, c.k(n + l), c.step * taper(n + l, c.samples),
                       at_depths);
        }
    }
    return pressure;
}

}  // namespace

Field wavenumber_field(const Environment& environment, const FieldOptions& options) {
    const LevelSea sea(environment, options, "wavenumber");
    if (options.sum != Sum::coherent)
        throw DataError("wavenumber: only a coherent sum (modes and rays can)");
    Field field = empty_field(environment, options, Engine::wavenumber);
    if (sea.depth_m.empty()) return field;
    const std::vector<Complex> pressure = integrated(environment, sea, field.basis);
    const std::size_t depths = sea.depth_m.size();
    for (std::size_t z = 0; z < depths; ++z)
        for (std::size_t r = 0; r < field.ranges; ++r)
            if (environment.receivers.range_m[r] > 0)
                put_pressure(field, sea.rows[z] * field.ranges + r, pressure[r * depths + z]);
    return field;
}

}  // namespace seautils::propagation
