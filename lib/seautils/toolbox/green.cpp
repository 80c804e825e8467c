#include "seautils/toolbox/green.hpp"

#include "seautils/core/error.hpp"

#include <cmath>
#include <numbers>

namespace seautils::toolbox {

namespace {

using Complex = std::complex<double>;

/// What the wavenumbers weigh at a range. They are evenly spaced.
std::vector<Complex> weights(const std::vector<double>& speed_mps, double frequency_hz,
                             double range_m) {
    const double omega = 2 * std::numbers::pi * frequency_hz;
    const double first = omega / speed_mps.front(), last = omega / speed_mps.back();
    const double step = std::fabs(last - first) / static_cast<double>(speed_mps.size() - 1);
    std::vector<Complex> all;
    all.reserve(speed_mps.size());
    for (const double c : speed_mps) {
        const Complex k(omega / c, step);
        const Complex exponent = Complex(0, -1) * (k * range_m - std::numbers::pi / 4);
        all.push_back(-std::sqrt(k) * std::exp(exponent) *
                      (step / std::sqrt(2 * std::numbers::pi * range_m)));
    }
    return all;
}

}  // namespace

std::vector<std::complex<float>> transform_green(const ShdFile& green,
                                                 const std::vector<double>& range_m) {
    const std::size_t n = green.range_m.size(), depths = green.receiver_depth_m.size();
    if (n < 2) throw DataError("a Green's function of one wavenumber is no function");
    std::vector<std::complex<float>> pressure(depths * range_m.size());
    for (std::size_t r = 0; r < range_m.size(); ++r) {
        if (range_m[r] == 0) continue;
        const std::vector<Complex> w = weights(green.range_m, green.frequency_hz, range_m[r]);
        for (std::size_t z = 0; z < depths; ++z) {
            Complex sum = 0;
            for (std::size_t k = 0; k < n; ++k) sum += Complex(green.pressure[z * n + k]) * w[k];
            pressure[z * range_m.size() + r] = std::complex<float>(sum);
        }
    }
    return pressure;
}

}  // namespace seautils::toolbox
