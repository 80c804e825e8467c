#ifndef SEAUTILS_PROPAGATION_ABSORPTION_HPP
#define SEAUTILS_PROPAGATION_ABSORPTION_HPP

#include "seautils/propagation/environment.hpp"

#include <string_view>

namespace seautils::propagation {

/// 1 neper in decibels: 20 / ln 10.
inline constexpr double db_per_neper = 8.685889638065037;

/// `none`, `thorp`, `francois-garrison`, `ainslie-mccolm`, `fixed`.
std::string_view name(AbsorptionModel model);

/// Absorption by sea water, dB/km. Check values are for 25.12 kHz.
///
/// W. H. Thorp, J. Acoust. Soc. Am. 42, 270 (1967), in the form of F. B. Jensen et al., Computational
/// Ocean Acoustics, which the Acoustics Toolbox uses. Check value: 6.17107.
double thorp_db_per_km(double frequency_hz);
/// As printed in 1967. Check value: 5.94376.
double thorp_1967_db_per_km(double frequency_hz);

/// What the other formulas ask of the water.
struct AbsorbingWater {
    double temperature_c = 10;
    double salinity = 35;
    double ph = 8;
    double depth_m = 0;
};
/// R. E. Francois, G. R. Garrison, J. Acoust. Soc. Am. 72, 1879-1890 (1982), doi:10.1121/1.388673.
/// 200 Hz to 1 MHz, -2 to 22 °C, 30 to 35, to 3500 m. Check values: 10 °C, 35, pH 8, 0 m give
/// 5.04061; 4 °C, 35, pH 8, 4000 m give 3.17637.
double francois_garrison_db_per_km(double frequency_hz, const AbsorbingWater& water);
/// M. A. Ainslie, J. G. McColm, J. Acoust. Soc. Am. 103, 1671-1672 (1998), doi:10.1121/1.421258.
/// 100 Hz to 1 MHz, -6 to 35 °C, 5 to 50, pH 7.7 to 8.3, to 7000 m. Check value: 10 °C, 35, pH 8,
/// 0 m give 5.15074.
double ainslie_mccolm_db_per_km(double frequency_hz, const AbsorbingWater& water);

/// By the model that is asked for, and whether the water or the frequency lies outside of its range.
struct AbsorptionRate {
    double db_per_km = 0;
    bool extrapolated = false;
};
AbsorptionRate absorption_rate(const Absorption& absorption, double frequency_hz);

/// The former alone.
inline double absorption_db_per_km(const Absorption& absorption, double frequency_hz) {
    return absorption_rate(absorption, frequency_hz).db_per_km;
}

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_ABSORPTION_HPP
