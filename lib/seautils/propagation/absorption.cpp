#include "seautils/propagation/absorption.hpp"

#include <cmath>

namespace seautils::propagation {

namespace {

/// A relaxation's share: f0 f² / (f0² + f²), kHz.
double relaxation(double f0, double f) { return f0 * f * f / (f0 * f0 + f * f); }

double khz(double frequency_hz) { return frequency_hz / 1000; }

bool is_within(double value, double least, double most) { return value >= least && value <= most; }

bool holds_francois_garrison(const Absorption& a, double hz) {
    return is_within(hz, 200, 1e6) && is_within(a.temperature_c, -2, 22) &&
           is_within(a.salinity, 30, 35) && a.depth_m <= 3500;
}

bool holds_ainslie_mccolm(const Absorption& a, double hz) {
    return is_within(hz, 100, 1e6) && is_within(a.temperature_c, -6, 35) &&
           is_within(a.salinity, 5, 50) && is_within(a.ph, 7.7, 8.3) && a.depth_m <= 7000;
}

}  // namespace

std::string_view name(AbsorptionModel model) {
    switch (model) {
        case AbsorptionModel::none:
            return "none";
        case AbsorptionModel::thorp:
            return "thorp";
        case AbsorptionModel::francois_garrison:
            return "francois-garrison";
        case AbsorptionModel::ainslie_mccolm:
            return "ainslie-mccolm";
        case AbsorptionModel::fixed:
            break;
    }
    return "fixed";
}

double thorp_db_per_km(double frequency_hz) {
    const double f2 = khz(frequency_hz) * khz(frequency_hz);
    return 3.3e-3 + 0.11 * f2 / (1 + f2) + 44 * f2 / (4100 + f2) + 3e-4 * f2;
}

double thorp_1967_db_per_km(double frequency_hz) {
    constexpr double metres_per_yard = 0.9144;
    const double f2 = khz(frequency_hz) * khz(frequency_hz);
    return (0.1 * f2 / (1 + f2) + 40 * f2 / (4100 + f2)) / metres_per_yard;
}

double francois_garrison_db_per_km(double frequency_hz, const AbsorbingWater& w) {
    const double f = khz(frequency_hz), t = w.temperature_c, s = w.salinity, d = w.depth_m;
    const double c = 1412 + 3.21 * t + 1.19 * s + 0.0167 * d;
    // Boric acid.
    const double a1 = 8.86 / c * std::pow(10, 0.78 * w.ph - 5);
    const double f1 = 2.8 * std::sqrt(s / 35) * std::pow(10, 4 - 1245 / (t + 273));
    // Magnesium sulphate.
    const double a2 = 21.44 * s / c * (1 + 0.025 * t);
    const double p2 = 1 - 1.37e-4 * d + 6.2e-9 * d * d;
    const double f2 = 8.17 * std::pow(10, 8 - 1990 / (t + 273)) / (1 + 0.0018 * (s - 35));
    // Viscosity.
    const double p3 = 1 - 3.83e-5 * d + 4.9e-10 * d * d;
    const double a3 = t <= 20 ? 4.937e-4 - 2.59e-5 * t + 9.11e-7 * t * t - 1.50e-8 * t * t * t
                              : 3.964e-4 - 1.146e-5 * t + 1.45e-7 * t * t - 6.5e-10 * t * t * t;
    return a1 * relaxation(f1, f) + a2 * p2 * relaxation(f2, f) + a3 * p3 * f * f;
}

double ainslie_mccolm_db_per_km(double frequency_hz, const AbsorbingWater& w) {
    const double f = khz(frequency_hz), t = w.temperature_c, z_km = w.depth_m / 1000;
    const double f1 = 0.78 * std::sqrt(w.salinity / 35) * std::exp(t / 26);
    const double f2 = 42 * std::exp(t / 17);
    return 0.106 * relaxation(f1, f) * std::exp((w.ph - 8) / 0.56) +
           0.52 * (1 + t / 43) * (w.salinity / 35) * relaxation(f2, f) * std::exp(-z_km / 6) +
           4.9e-4 * f * f * std::exp(-(t / 27 + z_km / 17));
}

AbsorptionRate absorption_rate(const Absorption& a, double frequency_hz) {
    const AbsorbingWater water{a.temperature_c, a.salinity, a.ph, a.depth_m};
    switch (a.model) {
        case AbsorptionModel::none:
            return {};
        case AbsorptionModel::thorp:
            return {thorp_db_per_km(frequency_hz), false};
        case AbsorptionModel::francois_garrison:
            return {francois_garrison_db_per_km(frequency_hz, water),
                    !holds_francois_garrison(a, frequency_hz)};
        case AbsorptionModel::ainslie_mccolm:
            return {ainslie_mccolm_db_per_km(frequency_hz, water),
                    !holds_ainslie_mccolm(a, frequency_hz)};
        case AbsorptionModel::fixed:
            break;
    }
    return {a.db_per_km, false};
}

}  // namespace seautils::propagation
