#ifndef SEAUTILS_ACOUSTICS_SOUND_SPEED_HPP
#define SEAUTILS_ACOUSTICS_SOUND_SPEED_HPP

#include <array>
#include <cstdint>
#include <string_view>

namespace seautils::acoustics {

/// What the speed of sound in sea water follows from; what a formula does not use is no matter.
struct Water {
    double temperature_c = 0;  ///< in situ, ITS-90
    double salinity = 0;       ///< practical salinity, PSS-78
    double pressure_dbar = 0;  ///< gauge: 0 at the surface
    double depth_m = 0;        ///< positive down
    double latitude_deg = 45;  ///< north positive
};

/// The equations for the speed of sound. Temperatures are ITS-90; those that were fitted to IPTS-68
/// get it converted where the coefficients were not.
enum class SpeedFormula : std::uint8_t {
    chen_millero,  ///< UNESCO's, with the coefficients for ITS-90; pressure
    del_grosso,    ///< with the coefficients for ITS-90; pressure. The best below 1000 m
    mackenzie,     ///< nine terms; depth
    leroy,         ///< Leroy, Robinson and Goldsmith; depth and latitude
    medwin,        ///< for the upper 1000 m; depth
    coppens,       ///< depth
};
inline constexpr std::array<SpeedFormula, 6> all_formulas{
    SpeedFormula::chen_millero, SpeedFormula::del_grosso, SpeedFormula::mackenzie,
    SpeedFormula::leroy,        SpeedFormula::medwin,     SpeedFormula::coppens};

/// `chen-millero`, `del-grosso`, `mackenzie`, `leroy`, `medwin`, `coppens`.
std::string_view name(SpeedFormula formula);
/// @throws DataError  none of these: lists them
SpeedFormula parse_formula(std::string_view text);

/// Where a formula holds. `vertical` is a pressure in dbar where by_pressure, else a depth in metres.
struct SpeedRange {
    double least_temperature_c, most_temperature_c;
    double least_salinity, most_salinity;
    double most_vertical;
    bool by_pressure;
};
const SpeedRange& range_of(SpeedFormula formula);

/// Speed of sound, m/s, and whether the water lies outside the formula's range (NaN too). Within half
/// a metre above the surface a depth counts as within.
struct SoundSpeed {
    double mps = 0;
    bool extrapolated = false;
};
SoundSpeed sound_speed(SpeedFormula formula, const Water& water);

/// The equations themselves, at any value: m/s.
///
/// C.-T. Chen, F. J. Millero, J. Acoust. Soc. Am. 62, 1129-1135 (1977), doi:10.1121/1.381646, as in
/// N. P. Fofonoff, R. C. Millard, UNESCO Technical Papers in Marine Science 44 (1983); coefficients
/// for ITS-90: G. S. K. Wong, S. Zhu, J. Acoust. Soc. Am. 97, 1732-1736 (1995),
/// doi:10.1121/1.413048. 0 to 40 °C, 0 to 40, 0 to 10000 dbar.
/// Check value: 4 °C, 35, 1000 dbar give 1483.080.
double chen_millero_mps(double temperature_c, double salinity, double pressure_dbar);
/// The same for temperatures on IPTS-68. Check value: 40 °C, 40, 10000 dbar give 1731.995.
double chen_millero_68_mps(double temperature_68_c, double salinity, double pressure_dbar);
/// V. A. Del Grosso, J. Acoust. Soc. Am. 56, 1084-1091 (1974), doi:10.1121/1.1903388; coefficients
/// for ITS-90 of Wong and Zhu. 0 to 30 °C, 30 to 40, 0 to 1000 kg/cm² (9806.65 dbar).
/// Check value: 1.5 °C, 34.6, 6000 dbar give 1556.849.
double del_grosso_mps(double temperature_c, double salinity, double pressure_dbar);
/// K. V. Mackenzie, J. Acoust. Soc. Am. 70, 807-812 (1981), doi:10.1121/1.386920.
/// 2 to 30 °C, 25 to 40, 0 to 8000 m. Check value: 25 °C, 35, 1000 m give 1550.744.
double mackenzie_mps(double temperature_c, double salinity, double depth_m);
/// C. C. Leroy, S. P. Robinson, M. J. Goldsmith, J. Acoust. Soc. Am. 124, 2774-2782 (2008),
/// doi:10.1121/1.2988296. All oceans: -2 to 34 °C, 0 to 42, 0 to 12000 m; within 0.2 m/s.
/// Check value: 20 °C, 35, the surface give 1521.578.
double leroy_mps(double temperature_c, double salinity, double depth_m, double latitude_deg);
/// H. Medwin, J. Acoust. Soc. Am. 58, 1318-1319 (1975), doi:10.1121/1.380790.
/// 0 to 35 °C, 0 to 45, 0 to 1000 m. Check value: 20 °C, 35, the surface give 1521.520.
double medwin_mps(double temperature_c, double salinity, double depth_m);
/// A. B. Coppens, J. Acoust. Soc. Am. 69, 862-863 (1981), doi:10.1121/1.385486.
/// 0 to 35 °C, 0 to 45, 0 to 4000 m. Check value: 10 °C, 35, the surface give 1489.770.
double coppens_mps(double temperature_c, double salinity, double depth_m);

/// The temperature at which water of this salinity, pressure, depth and latitude has this speed of
/// sound; water.temperature_c is not used. The speed grows with temperature up to 40 °C.
/// @return  -4 to 40 °C; the nearer end where the speed lies beyond
double temperature_at_speed_c(SpeedFormula formula, double sound_speed_mps, Water water);

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_SOUND_SPEED_HPP
