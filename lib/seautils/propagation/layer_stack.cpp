#include "seautils/propagation/layer_stack.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

double wanted_slices(const SedimentLayer& l, double omega, double tolerance) {
    const double top = omega / l.sound_speed_top_mps, bottom = omega / l.sound_speed_bottom_mps;
    const double change = std::abs(top * top - bottom * bottom);
    return std::max(1.0, std::ceil(l.thickness_m * std::sqrt(change / (12 * tolerance))));
}

/// (1 - exp(-2γd)) / γ
Complex span(const Complex& gamma, double thickness_m, const Complex& decayed) {
    const Complex x = gamma * thickness_m;
    if (std::abs(x) > 1e-3) return (1.0 - decayed) / gamma;
    return thickness_m * (2.0 - x * (2.0 - x * (4.0 / 3 - x * (2.0 / 3))));
}

double size(const Complex& z) { return std::abs(z.real()) + std::abs(z.imag()); }

}  // namespace

std::vector<Slice> slices_of(const std::vector<SedimentLayer>& layers, double omega,
                             double tolerance) {
    double wanted = 0;
    for (const SedimentLayer& l : layers) wanted += wanted_slices(l, omega, tolerance);
    const double share = wanted > most_slices ? most_slices / wanted : 1;
    std::vector<Slice> slices;
    for (auto l = layers.rbegin(); l != layers.rend(); ++l) {
        const double n = std::max(1.0, std::floor(wanted_slices(*l, omega, tolerance) * share));
        for (double k = n - 0.5; k > 0; --k)
            slices.push_back({l->thickness_m / n,
                              std::lerp(l->sound_speed_top_mps, l->sound_speed_bottom_mps, k / n),
                              l->density_gcm3, l->attenuation_db_per_wavelength});
    }
    return slices;
}

StackWave through(const Slice& slice, const Complex& xi, const Complex& k2,
                  const StackWave& below) {
    const Complex square = xi - k2,
                  gamma = std::sqrt(square);  // decays: its real part is not below 0
    const Complex decayed = std::exp(-2.0 * gamma * slice.thickness_m);
    const Complex across = span(gamma, slice.thickness_m, decayed);
    const StackWave above{
        below.flow * (1.0 + decayed) + below.pressure * square * across / slice.density_gcm3,
        below.pressure * (1.0 + decayed) + below.flow * across * slice.density_gcm3};
    const double scale = std::max(size(above.flow), size(above.pressure));
    if (!(scale > 0)) return {gamma / slice.density_gcm3, 1};
    return {above.flow / scale, above.pressure / scale};
}

RealWave through(const Slice& slice, double xi, double k2, const RealWave& below) {
    const double density = slice.density_gcm3, d = slice.thickness_m;
    const double q = k2 - xi, turns = std::sqrt(std::abs(q)), x = turns * d;
    RealWave above = below;
    if (q > 0) {
        // From below: pressure goes as cos(turns s - from).
        const double from = std::atan2(density * below.flow, turns * below.pressure);
        const auto passed = [](double angle) { return std::floor(angle / pi + 0.5); };
        above.zeros += static_cast<std::size_t>(passed(x - from) - passed(-from));
        const double across = std::sin(x) / turns;
        above.flow = below.flow * std::cos(x) - below.pressure * q * across / density;
        above.pressure = below.pressure * std::cos(x) + below.flow * across * density;
    } else {
        const double decayed = std::exp(-2 * x);
        const double across = span(turns, d, decayed).real();
        above.flow = below.flow * (1 + decayed) - below.pressure * q * across / density;
        above.pressure = below.pressure * (1 + decayed) + below.flow * across * density;
        if (above.pressure * below.pressure < 0) ++above.zeros;
    }
    const double scale = std::max(std::abs(above.flow), std::abs(above.pressure));
    if (!(scale > 0)) return {turns / density, 1, above.zeros};
    above.flow /= scale;
    above.pressure /= scale;
    return above;
}

}  // namespace seautils::propagation
