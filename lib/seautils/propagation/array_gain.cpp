#include "seautils/propagation/array_gain.hpp"

#include "seautils/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace seautils::propagation {

namespace {

constexpr double degree = std::numbers::pi / 180;

double noise_at(std::span<const NoiseRow> noise, double elevation_deg) {
    if (noise.empty()) return 1;
    const auto above = std::upper_bound(
        noise.begin(), noise.end(), elevation_deg,
        [](double angle, const NoiseRow& row) { return angle < row.elevation_deg; });
    if (above == noise.begin()) return noise.front().intensity;
    if (above == noise.end()) return noise.back().intensity;
    const NoiseRow &a = *(above - 1), &b = *above;
    return std::lerp(a.intensity, b.intensity,
                     (elevation_deg - a.elevation_deg) / (b.elevation_deg - a.elevation_deg));
}

/// The part of all that the array keeps.
struct Kept {
    double all = 0, kept = 0;
    void add(double intensity, double response) {
        all += intensity;
        kept += intensity * response;
    }
};

}  // namespace

double array_response(const VerticalArray& array, double frequency_hz, double sound_speed_mps,
                      double elevation_deg) {
    const double k = 2 * std::numbers::pi * frequency_hz / sound_speed_mps;
    const double turn =
        k * (std::sin(elevation_deg * degree) - std::sin(array.steered_deg * degree));
    std::complex<double> sum = 0;
    for (const double z : array.depth_m) sum += std::polar(1.0, turn * z);
    return std::norm(sum / static_cast<double>(array.depth_m.size()));
}

double array_gain_db(const VerticalArray& array, double frequency_hz, double sound_speed_mps,
                     std::span<const Arrival> arrivals, std::span<const NoiseRow> noise) {
    if (array.depth_m.empty()) throw DataError("an array has no hydrophone");
    if (!(frequency_hz > 0 && sound_speed_mps > 0))
        throw DataError("the gain of an array needs a frequency and a speed of sound above 0");
    const auto response = [&](double elevation_deg) {
        return array_response(array, frequency_hz, sound_speed_mps, elevation_deg);
    };
    Kept signal, sea;
    for (const Arrival& a : arrivals)
        signal.add(a.amplitude * a.amplitude * std::pow(10, -a.absorption_db / 10),
                   response(a.arrival_deg));
    // Even steps of the sine are even steps of solid angle; as many as the pattern of the array can turn.
    const auto [least, most] = std::minmax_element(array.depth_m.begin(), array.depth_m.end());
    const double wavelengths = (*most - *least) * frequency_hz / sound_speed_mps;
    const int steps = static_cast<int>(std::clamp(64 * (wavelengths + 8), 4096.0, 100000.0));
    for (int j = 0; j < steps; ++j) {
        const double sine = (2 * j + 1.0) / steps - 1, elevation_deg = std::asin(sine) / degree;
        sea.add(noise_at(noise, elevation_deg), response(elevation_deg));
    }
    if (!(signal.all > 0)) throw DataError("no arrival of some amplitude");
    if (!(sea.all > 0)) throw DataError("no noise of some intensity");
    return 10 * std::log10(signal.kept / signal.all) - 10 * std::log10(sea.kept / sea.all);
}

}  // namespace seautils::propagation
