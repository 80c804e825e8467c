#include "seautils/propagation/reflection.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/absorption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

/// Wavenumber of a lossy medium where time goes as exp(+iωt): its imaginary part is below 0. It is the speed that is
/// complex, as in the Acoustics Toolbox: ω/k is linear in the loss.
Complex wavenumber(double omega, double speed_mps, double db_per_wavelength) {
    const double loss = db_per_wavelength / (2 * pi * db_per_neper);
    return omega / (speed_mps * Complex(1, loss));
}

/// Decays away from the boundary; without loss the limit of little.
Complex decay(double horizontal, const Complex& k) {
    const Complex gamma = std::sqrt(horizontal * horizontal - k * k);
    return gamma.real() < 0 || (gamma.real() == 0 && gamma.imag() < 0) ? -gamma : gamma;
}

/// What waves in a half-space are at its edge.
StackWave half_space(const Boundary& b, double omega, double kx) {
    const Complex gamma_p =
        decay(kx, wavenumber(omega, b.sound_speed_mps, b.attenuation_db_per_wavelength));
    if (b.shear_speed_mps <= 0) return {gamma_p, b.density_gcm3};
    const Complex ks = wavenumber(omega, b.shear_speed_mps, b.shear_attenuation_db_per_wavelength);
    const Complex gamma_s = decay(kx, ks);
    const Complex sum = gamma_s * gamma_s + kx * kx;
    // ω² (kx² - γs²) / μ = ks⁴ ω² / (μ ks²), and ρ ω² = μ ks²
    return {gamma_p * ks * ks * ks * ks,
            b.density_gcm3 * (sum * sum - 4.0 * gamma_s * gamma_p * (kx * kx))};
}

/// Of layers, if any, above a half-space or a perfect boundary.
Complex stack(const Boundary& b, const std::vector<Slice>& slices, double omega, double grazing_rad,
              double speed_mps, double density_gcm3) {
    const double k = omega / speed_mps, kx = k * std::cos(grazing_rad),
                 kz = k * std::sin(grazing_rad);
    StackWave wave{1, 0};
    if (b.kind == BoundaryKind::rigid) wave = {0, 1};
    if (b.kind == BoundaryKind::half_space) wave = half_space(b, omega, kx);
    for (const Slice& slice : slices) {
        const Complex ks =
            wavenumber(omega, slice.sound_speed_mps, slice.attenuation_db_per_wavelength);
        wave = through(slice, kx * kx, ks * ks, wave);
    }
    const Complex above = density_gcm3 * wave.flow, below = Complex(0, kz) * wave.pressure;
    return -(above - below) / (above + below);
}

Complex table(const std::vector<ReflectionRow>& rows, double grazing_deg) {
    if (rows.empty() || grazing_deg < rows.front().grazing_deg ||
        grazing_deg > rows.back().grazing_deg)
        return 0;
    const auto above = std::upper_bound(
        rows.begin(), rows.end() - 1, grazing_deg,
        [](double angle, const ReflectionRow& row) { return angle < row.grazing_deg; });
    if (above == rows.begin()) return std::polar(above->magnitude, above->phase_deg * pi / 180);
    const ReflectionRow &a = *(above - 1), &b = *above;
    const double share = (grazing_deg - a.grazing_deg) / (b.grazing_deg - a.grazing_deg);
    return std::polar(std::lerp(a.magnitude, b.magnitude, share),
                      std::lerp(a.phase_deg, b.phase_deg, share) * pi / 180);
}

double speed_ratio(double mz) {
    if (mz < 1) return 0.002709 * mz * mz - 0.056452 * mz + 1.2778;
    if (mz < 5.3) return -0.0014881 * mz * mz * mz + 0.0213937 * mz * mz - 0.1382798 * mz + 1.3425;
    return -0.0024324 * mz + 1.0019;
}

double density_ratio(double mz) {
    if (mz < 1) return 0.007797 * mz * mz - 0.17057 * mz + 2.3139;
    if (mz < 5.3) return -0.0165406 * mz * mz * mz + 0.2290201 * mz * mz - 1.1069031 * mz + 3.0455;
    return -0.0012973 * mz + 1.1565;
}

double attenuation_db_per_m_khz(double mz) {
    if (mz < 0) return 0.4556;
    if (mz < 2.6) return 0.4556 + 0.0245 * mz;
    if (mz < 4.5) return 0.1978 + 0.1245 * mz;
    if (mz < 6) return 8.0399 - 2.5228 * mz + 0.20098 * mz * mz;
    if (mz < 9.5) return 0.9431 - 0.2041 * mz + 0.0117 * mz * mz;
    return 0.0601;
}

}  // namespace

Complex reflection_coefficient(const Boundary& boundary, double frequency_hz, double grazing_rad,
                               double sound_speed_mps, double density_gcm3) {
    return reflection_coefficient(boundary,
                                  slices_of(boundary.layers, 2 * pi * frequency_hz, fine_slices),
                                  frequency_hz, grazing_rad, sound_speed_mps, density_gcm3);
}

Complex reflection_coefficient(const Boundary& boundary, const std::vector<Slice>& slices,
                               double frequency_hz, double grazing_rad, double sound_speed_mps,
                               double density_gcm3) {
    const double omega = 2 * pi * frequency_hz;
    Complex r = -1;
    if (boundary.kind == BoundaryKind::table)
        r = table(boundary.table, grazing_rad * 180 / pi);
    else if (boundary.kind == BoundaryKind::half_space || !slices.empty())
        r = stack(boundary, slices, omega, grazing_rad, sound_speed_mps, density_gcm3);
    else if (boundary.kind == BoundaryKind::rigid)
        r = 1;
    if (boundary.roughness_m > 0) {
        const double rayleigh =
            omega / sound_speed_mps * boundary.roughness_m * std::sin(grazing_rad);
        r *= std::exp(-2 * rayleigh * rayleigh);
    }
    return r;
}

Boundary grain_half_space(double grain_phi, double sound_speed_mps, double density_gcm3) {
    if (!(grain_phi >= -1 && grain_phi <= 9))
        throw DataError(fmt::format("grain size {} is outside -1 to 9 phi", grain_phi));
    Boundary sediment;
    sediment.kind = BoundaryKind::half_space;
    sediment.sound_speed_mps = speed_ratio(grain_phi) * sound_speed_mps;
    sediment.density_gcm3 = density_ratio(grain_phi) * density_gcm3;
    // dB/(m kHz) over a wavelength.
    sediment.attenuation_db_per_wavelength =
        attenuation_db_per_m_khz(grain_phi) * sediment.sound_speed_mps / 1000;
    return sediment;
}

}  // namespace seautils::propagation
