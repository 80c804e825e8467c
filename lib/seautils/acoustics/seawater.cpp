#include "seautils/acoustics/seawater.hpp"

#include <cmath>
#include <numbers>

namespace seautils::acoustics {

namespace {

double square_of_sine(double latitude_deg) {
    const double sine = std::sin(latitude_deg * (std::numbers::pi / 180));
    return sine * sine;
}

/// Gravity at the surface, m/s².
double unesco_gravity_mps2(double latitude_deg) {
    const double x = square_of_sine(latitude_deg);
    return 9.780318 * (1 + (5.2788e-3 + 2.36e-5 * x) * x);
}

/// The root of a growing function between low and high, by halving.
template <class Function>
double solve(Function function, double wanted, double low, double high) {
    for (int k = 0; k < 70; ++k) {
        const double middle = (low + high) / 2;
        (function(middle) < wanted ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace

double depth_at_pressure_m(double p, double latitude_deg) {
    const double gravity = unesco_gravity_mps2(latitude_deg) + 1.092e-6 * p;
    return (((-1.82e-15 * p + 2.279e-10) * p - 2.2512e-5) * p + 9.72659) * p / gravity;
}

double pressure_at_depth_dbar(double depth_m, double latitude_deg) {
    double p = depth_m * 1.01;  // 1.5 % off at most; each step gains more than two digits
    for (int k = 0; k < 12; ++k) {
        const double off = depth_m - depth_at_pressure_m(p, latitude_deg);
        p += off * 1.01;
        if (std::fabs(off) < 1e-10) break;
    }
    return p;
}

double leroy_parthiot_standard_dbar(double z, double latitude_deg) {
    const double gravity = 9.7803 * (1 + 5.3e-3 * square_of_sine(latitude_deg));
    const double at_45 = z * (1.00818e-2 + z * (2.465e-8 + z * (-1.25e-13 + z * 2.8e-19)));
    return 100 * at_45 * (gravity - 2e-5 * z) / (9.80612 - 2e-5 * z);
}

double leroy_parthiot_open_ocean_dbar(double z, double latitude_deg) {
    const double correction = 1.0e-2 * z / (z + 100) + 6.2e-6 * z;
    return leroy_parthiot_standard_dbar(z, latitude_deg) - 100 * correction;
}

double saunders_depth_m(double p, double latitude_deg) {
    const double c1 = (5.92 + 5.25 * square_of_sine(latitude_deg)) * 1e-3;
    return (1 - c1) * p - 2.21e-6 * p * p;
}

double saunders_pressure_dbar(double depth_m, double latitude_deg) {
    const double c1 = (5.92 + 5.25 * square_of_sine(latitude_deg)) * 1e-3, c2 = 2.21e-6;
    return ((1 - c1) - std::sqrt((1 - c1) * (1 - c1) - 4 * c2 * depth_m)) / (2 * c2);
}

double practical_salinity_of_ratio(double ratio, double t, double p) {
    if (!(ratio > 0)) return 0;
    const double of_pressure =
        1 + p * (2.070e-5 + p * (-6.370e-10 + p * 3.989e-15)) /
                (1 + t * (3.426e-2 + t * 4.464e-4) + (4.215e-1 - 3.107e-3 * t) * ratio);
    const double of_temperature =
        0.6766097 + t * (2.00564e-2 + t * (1.104259e-4 + t * (-6.9698e-7 + t * 1.0031e-9)));
    const double x = std::sqrt(ratio / (of_pressure * of_temperature));
    const double at_15 =
        0.0080 + x * (-0.1692 + x * (25.3851 + x * (14.0941 + x * (-7.0261 + x * 2.7081))));
    const double away =
        0.0005 + x * (-0.0056 + x * (-0.0066 + x * (-0.0375 + x * (0.0636 - x * 0.0144))));
    return at_15 + (t - 15) / (1 + 0.0162 * (t - 15)) * away;
}

double practical_salinity(double conductivity, double temperature_c, double pressure_dbar) {
    return practical_salinity_of_ratio(conductivity / standard_conductivity_spm,
                                       to_ipts_68_c(temperature_c), pressure_dbar);
}

double conductivity_spm(double salinity, double temperature_c, double pressure_dbar) {
    return solve([&](double c) { return practical_salinity(c, temperature_c, pressure_dbar); },
                 salinity, 1e-4, 12);
}

}  // namespace seautils::acoustics
