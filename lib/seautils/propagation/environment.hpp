#ifndef SEAUTILS_PROPAGATION_ENVIRONMENT_HPP
#define SEAUTILS_PROPAGATION_ENVIRONMENT_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seautils::propagation {

/// The sea between a source and receivers, in a vertical plane: range from the source, depth positive down, angles in
/// degrees from the horizontal, positive down. Lists that grow do so strictly. check() says what else must hold.

/// How the speed of sound runs between the points of a profile; the letters of the Acoustics Toolbox.
enum class SpeedInterpolation : std::uint8_t {
    c_linear,   ///< C: c is linear in depth
    n2_linear,  ///< N: 1/c² is
    pchip,      ///< P: monotone piecewise cubic
    spline,     ///< S: cubic spline, not-a-knot
};

struct SpeedPoint {
    double depth_m = 0;
    double sound_speed_mps = 0;

    bool operator==(const SpeedPoint&) const = default;
};

/// Speeds on a rectangular mesh: linear in depth at each range, linear in range between (Q). Beyond its ranges that of
/// the end.
struct SpeedMesh {
    std::vector<double> range_m;          ///< grows; may begin below 0
    std::vector<double> depth_m;          ///< grows
    std::vector<double> sound_speed_mps;  ///< [depth][range]

    bool operator==(const SpeedMesh&) const = default;
};

enum class AbsorptionModel : std::uint8_t {
    none,
    thorp,  ///< the form of the Acoustics Toolbox: 3.3e-3 + 0.11f²/(1+f²) + …
    francois_garrison,
    ainslie_mccolm,
    fixed,  ///< db_per_km
};

/// Absorption by the water, one value for all of it, and what it was computed from.
struct Absorption {
    AbsorptionModel model = AbsorptionModel::none;
    double temperature_c = 10;
    double salinity = 35;
    double ph = 8;
    double depth_m = 0;
    double db_per_km = 0;  ///< of `fixed`

    bool operator==(const Absorption&) const = default;
};

struct WaterColumn {
    SpeedInterpolation interpolation = SpeedInterpolation::c_linear;
    std::vector<SpeedPoint>
        profile;  ///< 1 point at least; constant above the first and below the last
    std::optional<SpeedMesh> mesh;  ///< in place of the profile
    double density_gcm3 = 1;
    Absorption absorption;

    bool operator==(const WaterColumn&) const = default;
};

/// A reflection coefficient over grazing angle: linear in magnitude and in unwrapped phase; 0 beyond its ends.
struct ReflectionRow {
    double grazing_deg = 0;  ///< 0 to 90
    double magnitude = 0;    ///< 0 to 1
    double phase_deg = 0;    ///< as the Acoustics Toolbox has it: conjugate of exp(-iωt)

    bool operator==(const ReflectionRow&) const = default;
};

enum class BoundaryKind : std::uint8_t {
    vacuum,      ///< pressure release: R = -1
    rigid,       ///< R = +1
    half_space,  ///< fluid, or elastic where shear_speed_mps is not 0
    table,
};

/// A fluid layer between the water and what lies below. Its speed is linear in depth, from its top to its bottom.
struct SedimentLayer {
    double thickness_m = 0;
    double sound_speed_top_mps = 1600, sound_speed_bottom_mps = 1600;
    double density_gcm3 = 1.8;
    double attenuation_db_per_wavelength = 0;

    bool operator==(const SedimentLayer&) const = default;
};

/// Below (or above) the water. A grain size is turned into a half-space by grain_half_space().
struct Boundary {
    BoundaryKind kind = BoundaryKind::vacuum;
    double sound_speed_mps = 1600;
    double shear_speed_mps = 0;
    double density_gcm3 = 1.8;
    double attenuation_db_per_wavelength = 0;
    double shear_attenuation_db_per_wavelength = 0;
    double roughness_m = 0;            ///< rms; 0: smooth. Coherent (Kirchhoff) loss
    std::vector<ReflectionRow> table;  ///< of `table`; grows in angle
    /// Of a bottom that is no table: from the water down to what `kind` says. They follow bathymetry, each as thick
    /// everywhere. Roughness is that of the water's boundary.
    std::vector<SedimentLayer> layers{};

    /// Pressure release without loss: R = -1.
    bool is_free() const noexcept {
        return kind == BoundaryKind::vacuum && roughness_m == 0 && layers.empty();
    }
    bool operator==(const Boundary&) const = default;
};

/// The depth of a boundary over range: straight between its points, or curved; flat beyond its ends.
struct Line {
    bool curved = false;
    std::vector<double> range_m;  ///< grows; may begin below 0
    std::vector<double> depth_m;  ///< as many

    bool operator==(const Line&) const = default;
};

/// Amplitude pattern of a source over launch angle; linear in amplitude between; constant beyond its ends.
struct PatternPoint {
    double angle_deg = 0;  ///< -180 to 180, positive down
    double level_db = 0;

    bool operator==(const PatternPoint&) const = default;
};

struct Source {
    double depth_m = 0;
    std::vector<PatternPoint> pattern;  ///< empty: omnidirectional
    bool line = false;                  ///< a line across the plane, in place of a point

    bool operator==(const Source&) const = default;
};

/// A grid: each depth at each range. Or pairs, as along a track: depth_m[k] at range_m[k], in any order.
struct Receivers {
    std::vector<double> depth_m;
    std::vector<double> range_m;
    bool pairs = false;

    std::size_t count() const { return pairs ? range_m.size() : depth_m.size() * range_m.size(); }
    /// Of a value in the order of a Field. @pre there are ranges
    double depth_at_m(std::size_t k) const { return depth_m[pairs ? k : k / range_m.size()]; }
    double range_at_m(std::size_t k) const { return range_m[pairs ? k : k % range_m.size()]; }

    bool operator==(const Receivers&) const = default;
};

/// Launch angles; equally spaced.
struct Fan {
    double least_deg = -80, most_deg = 80;
    std::uint32_t beams = 0;  ///< 0: the engine chooses

    bool operator==(const Fan&) const = default;
};

struct Environment {
    std::string title;
    double frequency_hz = 0;
    Source source;
    Receivers receivers;
    WaterColumn water;
    Boundary surface;
    std::optional<Line> surface_line;  ///< altimetry; none: flat, at depth 0
    Boundary bottom;
    double bottom_depth_m = 0;        ///< where bottom_line is none
    std::optional<Line> bottom_line;  ///< bathymetry
    Fan fan;
};

/// What check() holds numbers to; all are finite.
struct Bounds {
    static constexpr double least_frequency_hz = 0.1, most_frequency_hz = 1e7;
    static constexpr double most_depth_m = 12000;  ///< from -100, where a surface has waves
    static constexpr double most_range_m = 2.1e7;
    static constexpr double least_speed_mps = 100, most_speed_mps = 10000;
    static constexpr double least_density_gcm3 = 0.001, most_density_gcm3 = 20;
    static constexpr std::size_t most_points = 2'000'000;      ///< of any list
    static constexpr std::size_t most_receivers = 20'000'000;  ///< depths times ranges
    static constexpr std::size_t most_layers = 1000;
    static constexpr double least_thickness_m = 1e-4, most_thickness_m = 20000;  ///< of a layer
    static constexpr std::size_t most_pairs = 100'000;                           ///< of receivers
    static constexpr std::uint32_t most_beams = 1'000'000;
};

/// What would be computed from it means something: numbers are within Bounds, lists grow and match,
/// and the source lies in the water.
/// @throws DataError  `FIELD VALUE is outside LEAST to MOST UNIT`, or what else is wrong with a field,
///                    which is named as here: `water.profile[3].sound_speed_mps`
void check(const Environment& environment);

/// Depth of a line at a range, straight between points.
double depth_at_m(const Line& line, double range_m);
/// Surface and bottom at a range.
double surface_depth_m(const Environment& environment, double range_m);
double bottom_depth_m(const Environment& environment, double range_m);
/// Neither boundary nor speed depends on range.
bool is_range_independent(const Environment& environment);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_ENVIRONMENT_HPP
