#ifndef SEAUTILS_ACOUSTICS_SEAWATER_HPP
#define SEAUTILS_ACOUSTICS_SEAWATER_HPP

namespace seautils::acoustics {

/// Temperature scales: t68 = 1.00024 t90 (P. M. Saunders, WOCE Newsletter 10 (1990)).
constexpr double to_ipts_68_c(double temperature_90_c) { return temperature_90_c * 1.00024; }
constexpr double to_its_90_c(double temperature_68_c) { return temperature_68_c / 1.00024; }

/// Depth in metres, positive down, of a gauge pressure in standard ocean (35, 0 °C).
///
/// @param pressure_dbar  0 to 12000; a sensor in air may say a little less than 0
/// @param latitude_deg   -90 to 90
/// Source: P. M. Saunders, N. P. Fofonoff, Deep-Sea Research 23, 109-111 (1976),
/// doi:10.1016/0011-7471(76)90813-5, as in UNESCO Technical Papers in Marine Science 44 (1983).
/// Check value: 10000 dbar at 30 degrees are 9712.653 m.
double depth_at_pressure_m(double pressure_dbar, double latitude_deg);
/// The pressure at which depth_at_pressure_m() is this depth, within 1e-9 dbar; to 12000 m.
double pressure_at_depth_dbar(double depth_m, double latitude_deg);

/// Gauge pressure at a depth of 0 to 12000 m, in dbar: the standard ocean (35, 0 °C), or what holds
/// for common open oceans.
///
/// Source: C. C. Leroy, F. Parthiot, J. Acoust. Soc. Am. 103, 1346-1352 (1998),
/// doi:10.1121/1.421275. Check values: 5000 m at 45 degrees are 5101.031 and 5096.951 dbar.
double leroy_parthiot_standard_dbar(double depth_m, double latitude_deg);
double leroy_parthiot_open_ocean_dbar(double depth_m, double latitude_deg);

/// P. M. Saunders, J. Phys. Oceanogr. 11, 573-574 (1981): 0 to 11000 dbar and m. The second is the
/// inverse of the first. Check value: 7321.45 m at 30 degrees are 7500.007 dbar.
double saunders_depth_m(double pressure_dbar, double latitude_deg);
double saunders_pressure_dbar(double depth_m, double latitude_deg);

/// The conductivity of standard sea water (35, 15 °C IPTS-68, 0 dbar), S/m.
inline constexpr double standard_conductivity_spm = 4.2914;

/// Practical salinity, no unit, of a conductivity in situ; 0 where that is not above 0.
///
/// @param conductivity_spm  S/m (a tenth of mS/cm)
/// @param temperature_c     ITS-90, -2 to 35
/// @param pressure_dbar     0 to 10000
/// It holds from 2 to 42: practical_salinity_holds().
/// Source: PSS-78, UNESCO Technical Papers in Marine Science 37 (1981) and 44 (1983).
/// Check values, of the ratio to standard_conductivity_spm and IPTS-68: 1, 15 °C, 0 dbar give 35;
/// 1.2, 20 °C, 2000 dbar give 37.245628; 0.65, 5 °C, 1500 dbar give 27.995347.
double practical_salinity(double conductivity_spm, double temperature_c, double pressure_dbar);
/// The same of the ratio of conductivities, and of a temperature on IPTS-68.
double practical_salinity_of_ratio(double ratio, double temperature_68_c, double pressure_dbar);
constexpr bool practical_salinity_holds(double salinity) { return salinity >= 2 && salinity <= 42; }

/// The conductivity, S/m, at which practical_salinity() is this salinity, within 1e-10 S/m.
/// @param salinity  0 to 42
double conductivity_spm(double salinity, double temperature_c, double pressure_dbar);

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_SEAWATER_HPP
