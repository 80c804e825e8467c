#include "seautils/propagation/noise.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::propagation {

namespace {

double power(double db) { return std::pow(10, 0.1 * db); }

/// Of a table that grows: linear between, constant beyond.
double at(const std::vector<double>& x, const std::vector<double>& y, double where) {
    const auto above = std::upper_bound(x.begin(), x.end(), where);
    if (above == x.begin()) return y.front();
    if (above == x.end()) return y.back();
    const auto k = static_cast<std::size_t>(above - x.begin());
    return std::lerp(y[k - 1], y[k], (where - x[k - 1]) / (x[k] - x[k - 1]));
}

}  // namespace

double ambient_noise_db(double frequency_hz, double shipping, double wind_mps) {
    const double khz = frequency_hz / 1000, lg = std::log10(khz);
    const double turbulence = 17 - 30 * lg;
    const double ships = 40 + 20 * (shipping - 0.5) + 26 * lg - 60 * std::log10(khz + 0.03);
    const double wind = 50 + 7.5 * std::sqrt(wind_mps) + 20 * lg - 40 * std::log10(khz + 0.4);
    const double heat = -15 + 20 * lg;
    return 10 * std::log10(power(turbulence) + power(ships) + power(wind) + power(heat));
}

double wind_of_beaufort_mps(double beaufort) { return 0.836 * std::pow(beaufort, 1.5); }

std::optional<double> critical_depth_m(const std::vector<SpeedPoint>& profile) {
    const auto slower = [](const SpeedPoint& a, const SpeedPoint& b) {
        return a.sound_speed_mps < b.sound_speed_mps;
    };
    const auto axis = std::min_element(profile.begin(), profile.end(), slower);
    const double most_mps = std::max_element(profile.begin(), axis + 1, slower)->sound_speed_mps;
    for (std::size_t k = profile.size() - 1; k > static_cast<std::size_t>(axis - profile.begin());
         --k) {
        const SpeedPoint &a = profile[k - 1], &b = profile[k];
        if (a.sound_speed_mps > most_mps || b.sound_speed_mps < most_mps) continue;
        const double rise = b.sound_speed_mps - a.sound_speed_mps;
        const double share = rise > 0 ? (most_mps - a.sound_speed_mps) / rise : 1;
        return std::lerp(a.depth_m, b.depth_m, share);
    }
    return std::nullopt;
}

double noise_in_band_db(const SonarLevels& levels, double depth_m) {
    double noise_db = levels.noise_depth_m.empty()
                          ? levels.noise_db
                          : at(levels.noise_depth_m, levels.noise_at_depth_db, depth_m);
    if (levels.fades_below_m) noise_db -= 0.003 * std::max(0.0, depth_m - *levels.fades_below_m);
    return noise_db + 10 * std::log10(levels.bandwidth_hz);
}

double signal_to_noise_db(const SonarLevels& levels, double loss_db, double depth_m) {
    return levels.source_level_db - loss_db - noise_in_band_db(levels, depth_m) +
           levels.array_gain_db;
}

}  // namespace seautils::propagation
