#include "seautils/plan/noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::plan {

double NoiseProfile::at_db(double depth_m) const {
    return level_db + slope_db_per_km * std::max(depth_m - critical_depth_m, 0.0) / 1000;
}

double interpolated(std::span<const double> depth_m, std::span<const double> values, double at_m) {
    const auto above = std::upper_bound(depth_m.begin(), depth_m.end(), at_m);
    if (above == depth_m.begin()) return values.front();
    if (above == depth_m.end()) return values.back();
    const auto k = static_cast<std::size_t>(above - depth_m.begin());
    const double share = (at_m - depth_m[k - 1]) / (depth_m[k] - depth_m[k - 1]);
    return (1 - share) * values[k - 1] + share * values[k];
}

double array_gain_db(const ArrayInput& input) {
    double signal = 0, heard = 0, noise = 0, noise_heard = 0;
    for (std::size_t k = 0; k < input.intensity.size(); ++k) {
        signal += input.intensity[k];
        heard += input.intensity[k] * input.signal_pattern[k];
    }
    // trapezoids over the elevation
    const auto density = [&](std::size_t k) {
        return input.noise_intensity[k] * std::cos(input.noise_deg[k] * std::numbers::pi / 180);
    };
    for (std::size_t k = 1; k < input.noise_deg.size(); ++k) {
        const double step = (input.noise_deg[k] - input.noise_deg[k - 1]) / 2;
        noise += step * (density(k) + density(k - 1));
        noise_heard += step * (density(k) * input.noise_pattern[k] +
                               density(k - 1) * input.noise_pattern[k - 1]);
    }
    return 10 * std::log10(heard / signal) - 10 * std::log10(noise_heard / noise);
}

}  // namespace seautils::plan
