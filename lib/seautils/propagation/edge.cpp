#include "seautils/propagation/edge.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/absorption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {

namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};
constexpr double pi = std::numbers::pi;
constexpr double free_admittance = 1e12;  ///< of no pressure, 1/m

/// So many dB a wavelength to the letter: reflection_coefficient() has the speed complex in its place, as the Acoustics
/// Toolbox does, which differs by the square of the loss.
Complex squared_wavenumber(double frequency_hz, double speed_mps, double db_per_wavelength) {
    const double loss = db_per_wavelength / (2 * pi * db_per_neper);
    const Complex k = 2 * pi * frequency_hz / speed_mps * Complex(1, loss);
    return k * k;
}

/// √(ξ - k²): decays, or goes away.
Complex outward_root(const Complex& difference) {
    return difference.real() >= 0 ? std::sqrt(difference) : -i * std::sqrt(-difference);
}

}  // namespace

Edge::Edge(const Boundary& b, const char* name, double frequency_hz, double water_density_gcm3)
    : kind_(b.kind),
      roughness_m_(b.roughness_m),
      density_ratio_(water_density_gcm3 / b.density_gcm3),
      water_density_gcm3_(water_density_gcm3),
      slices_(slices_of(b.layers, 2 * pi * frequency_hz, fine_slices)),
      compressional_(
          squared_wavenumber(frequency_hz, b.sound_speed_mps, b.attenuation_db_per_wavelength)) {
    if (kind_ == BoundaryKind::table)
        throw DataError(fmt::format("{}.table: modes and wavenumbers need a half-space", name));
    if (b.shear_speed_mps > 0)
        shear_ = squared_wavenumber(frequency_hz, b.shear_speed_mps,
                                    b.shear_attenuation_db_per_wavelength);
    for (const Slice& slice : slices_)
        slice_k2_.push_back(squared_wavenumber(frequency_hz, slice.sound_speed_mps,
                                               slice.attenuation_db_per_wavelength));
}

Complex Edge::half_space_admittance(const Complex& xi) const {
    const Complex p = outward_root(xi - compressional_);
    Complex g = density_ratio_ * p;
    if (shear_ != 0.0) {
        const Complex s = outward_root(xi - shear_), sum = 2.0 * xi - shear_;
        g *= shear_ * shear_ / (sum * sum - 4.0 * s * p * xi);
    }
    return g;
}

/// Of what is below all layers, or without them.
Complex Edge::smooth_admittance(const Complex& xi) const {
    if (kind_ != BoundaryKind::half_space)
        return kind_ == BoundaryKind::vacuum ? free_admittance : 0;
    const Complex g = half_space_admittance(xi);
    if (share_ == 1) return g;
    const Complex difference = xi - compressional_.real();
    const Complex lossless = difference.real() > 0 ? density_ratio_ * std::sqrt(difference) : 0;
    return lossless + share_ * (g - lossless);
}

Edge Edge::losing(double share) const {
    Edge edge(*this);
    edge.share_ = share;
    edge.roughness_m_ *= std::sqrt(share);
    for (Complex& k2 : edge.slice_k2_) k2.imag(k2.imag() * share);
    return edge;
}

Complex Edge::stack_admittance(const Complex& xi, const Complex& base) const {
    StackWave wave{base / water_density_gcm3_, 1};
    if (kind_ == BoundaryKind::vacuum) wave = {1, 0};
    for (std::size_t k = 0; k < slices_.size(); ++k)
        wave = through(slices_[k], xi, slice_k2_[k], wave);
    const Complex flow = water_density_gcm3_ * wave.flow;
    return std::abs(flow) < free_admittance * std::abs(wave.pressure) ? flow / wave.pressure
                                                                      : free_admittance;
}

double Edge::most_k2() const noexcept {
    double most = 0;
    for (const Complex& k2 : slice_k2_) most = std::max(most, k2.real());
    return most;
}

Complex Edge::admittance(const Complex& xi, const Complex& water) const {
    Complex g = smooth_admittance(xi);
    if (!slices_.empty()) g = stack_admittance(xi, g);
    const Complex squared = water - xi;
    if (roughness_m_ == 0 || squared.real() <= 0) return g;
    const Complex across = i * std::sqrt(squared);
    const Complex r =
        (across + g) / (across - g) * std::exp(-2.0 * squared * (roughness_m_ * roughness_m_));
    return -across * (1.0 - r) / (1.0 + r);
}

Edge::RealStack Edge::real_stack(double xi) const {
    double g = kind_ == BoundaryKind::vacuum ? free_admittance : 0;
    if (kind_ == BoundaryKind::half_space)
        g = density_ratio_ * std::sqrt(std::max(0.0, xi - compressional_.real()));
    if (slices_.empty()) return {g, 0};
    RealWave wave{g / water_density_gcm3_, 1};
    if (kind_ == BoundaryKind::vacuum) wave = {1, 0};
    for (std::size_t k = 0; k < slices_.size(); ++k)
        wave = through(slices_[k], xi, slice_k2_[k].real(), wave);
    g = water_density_gcm3_ * wave.flow / wave.pressure;
    return {std::isfinite(g) ? std::clamp(g, -free_admittance, free_admittance) : free_admittance,
            wave.zeros};
}

Complex Edge::excess_phase(double xi, double water) const {
    if (xi >= water) return 0;
    const Complex across = i * std::sqrt(water - xi);
    const auto reflection = [&](const Complex& g) { return (across + g) / (across - g); };
    const Complex ratio = reflection(admittance(xi, water)) / reflection(real_admittance(xi));
    return std::abs(ratio) > 1e-6 ? -i * std::log(ratio) : Complex(0, 14);
}

}  // namespace seautils::propagation
