#include "seautils/propagation/environment.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seautils::propagation {

namespace {

constexpr double least_depth_m = -100;

[[noreturn]] void refuse(const std::string& what) { throw DataError(what); }

struct Span {
    double least, most;
    const char* unit;
};
constexpr Span depths{least_depth_m, Bounds::most_depth_m, " m"};
constexpr Span ranges{-Bounds::most_range_m, Bounds::most_range_m, " m"};
constexpr Span speeds{Bounds::least_speed_mps, Bounds::most_speed_mps, " m/s"};
constexpr Span densities{Bounds::least_density_gcm3, Bounds::most_density_gcm3, " g/cm3"};
constexpr Span losses{0, 50, " dB"};
constexpr Span elevations{-180, 180, " degrees"};

/// NaN is in no span.
void within(const std::string& field, double value, const Span& span) {
    if (value >= span.least && value <= span.most) return;
    refuse(
        fmt::format("{} {} is outside {} to {}{}", field, value, span.least, span.most, span.unit));
}

void counted(const std::string& field, std::size_t n, std::size_t least) {
    if (n < least) refuse(fmt::format("{} has {} values, less than {}", field, n, least));
    if (n > Bounds::most_points)
        refuse(fmt::format("{} has {} values, more than {}", field, n, Bounds::most_points));
}

/// Names are made only of what is wrong: a list may be long.
template <typename Value>
void growing(const char* field, const char* part, std::size_t n, const Span& span, Value value) {
    for (std::size_t k = 0; k < n; ++k) {
        const double v = value(k);
        const bool grows = k == 0 || v > value(k - 1);
        if (grows && v >= span.least && v <= span.most) continue;
        const std::string name = fmt::format("{}[{}]{}", field, k, part);
        within(name, v, span);
        refuse(fmt::format("{} {} is not more than the {} before it", name, v, value(k - 1)));
    }
}

template <typename Value>
void each_within(const char* field, const char* part, std::size_t n, const Span& span,
                 Value value) {
    for (std::size_t k = 0; k < n; ++k) {
        const double v = value(k);
        if (!(v >= span.least && v <= span.most))
            within(fmt::format("{}[{}]{}", field, k, part), v, span);
    }
}

auto at(const std::vector<double>& list) {
    return [&list](std::size_t k) { return list[k]; };
}

void check_mesh(const SpeedMesh& mesh) {
    counted("water.mesh.range_m", mesh.range_m.size(), 1);
    counted("water.mesh.depth_m", mesh.depth_m.size(), 1);
    const std::size_t wanted = mesh.range_m.size() * mesh.depth_m.size();
    if (mesh.sound_speed_mps.size() != wanted)
        refuse(fmt::format(
            "water.mesh.sound_speed_mps has {} values, not the {} of {} depths and {} ranges",
            mesh.sound_speed_mps.size(), wanted, mesh.depth_m.size(), mesh.range_m.size()));
    counted("water.mesh.sound_speed_mps", wanted, 1);
    growing("water.mesh.range_m", "", mesh.range_m.size(), ranges, at(mesh.range_m));
    growing("water.mesh.depth_m", "", mesh.depth_m.size(), depths, at(mesh.depth_m));
    each_within("water.mesh.sound_speed_mps", "", wanted, speeds, at(mesh.sound_speed_mps));
}

void check_absorption(const Absorption& a) {
    within("water.absorption.temperature_c", a.temperature_c, {-6, 60, " degrees C"});
    within("water.absorption.salinity", a.salinity, {0, 50, ""});
    within("water.absorption.ph", a.ph, {5, 10, ""});
    within("water.absorption.depth_m", a.depth_m, {0, Bounds::most_depth_m, " m"});
    within("water.absorption.db_per_km", a.db_per_km, {0, 1e6, " dB/km"});
}

void check_water(const WaterColumn& water) {
    if (water.mesh) {
        check_mesh(*water.mesh);
    } else {
        const std::vector<SpeedPoint>& profile = water.profile;
        counted("water.profile", profile.size(), 1);
        growing("water.profile", ".depth_m", profile.size(), depths,
                [&](std::size_t k) { return profile[k].depth_m; });
        each_within("water.profile", ".sound_speed_mps", profile.size(), speeds,
                    [&](std::size_t k) { return profile[k].sound_speed_mps; });
    }
    within("water.density_gcm3", water.density_gcm3, densities);
    check_absorption(water.absorption);
}

void check_table(const std::string& field, const std::vector<ReflectionRow>& rows) {
    counted(field, rows.size(), 1);
    growing(field.c_str(), ".grazing_deg", rows.size(), {0, 90, " degrees"},
            [&](std::size_t k) { return rows[k].grazing_deg; });
    each_within(field.c_str(), ".magnitude", rows.size(), {0, 1, ""},
                [&](std::size_t k) { return rows[k].magnitude; });
    each_within(field.c_str(), ".phase_deg", rows.size(), {-1e6, 1e6, " degrees"},
                [&](std::size_t k) { return rows[k].phase_deg; });
}

void check_layer(const std::string& field, const SedimentLayer& l) {
    within(field + ".thickness_m", l.thickness_m,
           {Bounds::least_thickness_m, Bounds::most_thickness_m, " m"});
    within(field + ".sound_speed_top_mps", l.sound_speed_top_mps, speeds);
    within(field + ".sound_speed_bottom_mps", l.sound_speed_bottom_mps, speeds);
    within(field + ".density_gcm3", l.density_gcm3, densities);
    within(field + ".attenuation_db_per_wavelength", l.attenuation_db_per_wavelength, losses);
}

void check_layers(const Environment& e) {
    if (!e.surface.layers.empty()) refuse("surface.layers: only a bottom has layers");
    const std::vector<SedimentLayer>& layers = e.bottom.layers;
    if (layers.size() > Bounds::most_layers)
        refuse(fmt::format("bottom.layers has {} values, more than {}", layers.size(),
                           Bounds::most_layers));
    if (e.bottom.kind == BoundaryKind::table && !layers.empty())
        refuse("bottom.layers: a table of reflection coefficients has no layers above it");
    for (std::size_t k = 0; k < layers.size(); ++k)
        check_layer(fmt::format("bottom.layers[{}]", k), layers[k]);
}

void check_boundary(const std::string& field, const Boundary& b) {
    within(field + ".sound_speed_mps", b.sound_speed_mps, speeds);
    within(field + ".shear_speed_mps", b.shear_speed_mps, {0, Bounds::most_speed_mps, " m/s"});
    within(field + ".density_gcm3", b.density_gcm3, densities);
    within(field + ".attenuation_db_per_wavelength", b.attenuation_db_per_wavelength, losses);
    within(field + ".shear_attenuation_db_per_wavelength", b.shear_attenuation_db_per_wavelength,
           losses);
    within(field + ".roughness_m", b.roughness_m, {0, 100, " m"});
    if (b.kind == BoundaryKind::table) check_table(field + ".table", b.table);
}

void check_line(const std::string& field, const Line& line) {
    const std::string range = field + ".range_m", depth = field + ".depth_m";
    counted(range, line.range_m.size(), 1);
    if (line.depth_m.size() != line.range_m.size())
        refuse(fmt::format("{} has {} values, not the {} of {}", depth, line.depth_m.size(),
                           line.range_m.size(), range));
    growing(range.c_str(), "", line.range_m.size(), ranges, at(line.range_m));
    each_within(depth.c_str(), "", line.depth_m.size(), depths, at(line.depth_m));
}

void check_source(const Environment& e) {
    const Source& source = e.source;
    within("source.depth_m", source.depth_m, {surface_depth_m(e, 0), bottom_depth_m(e, 0), " m"});
    growing("source.pattern", ".angle_deg", source.pattern.size(), elevations,
            [&](std::size_t k) { return source.pattern[k].angle_deg; });
    each_within("source.pattern", ".level_db", source.pattern.size(), {-1000, 100, " dB"},
                [&](std::size_t k) { return source.pattern[k].level_db; });
    counted("source.pattern", source.pattern.size(), 0);
}

void check_pairs(const Receivers& r) {
    if (r.depth_m.size() != r.range_m.size())
        refuse(fmt::format("receivers.depth_m has {}, receivers.range_m {}, which are no pairs",
                           seautils::counted(r.depth_m.size(), "value"), r.range_m.size()));
    if (r.range_m.size() > Bounds::most_pairs)
        refuse(fmt::format("receivers of {} pairs are outside 1 to {}", r.range_m.size(),
                           Bounds::most_pairs));
    each_within("receivers.depth_m", "", r.depth_m.size(), depths, at(r.depth_m));
    each_within("receivers.range_m", "", r.range_m.size(), {0, Bounds::most_range_m, " m"},
                at(r.range_m));
}

void check_receivers(const Receivers& r) {
    counted("receivers.depth_m", r.depth_m.size(), 1);
    counted("receivers.range_m", r.range_m.size(), 1);
    if (r.pairs) return check_pairs(r);
    if (r.depth_m.size() > Bounds::most_receivers / r.range_m.size())
        refuse(fmt::format("{} depths at {} ranges are more than {} receivers", r.depth_m.size(),
                           r.range_m.size(), Bounds::most_receivers));
    growing("receivers.depth_m", "", r.depth_m.size(), depths, at(r.depth_m));
    growing("receivers.range_m", "", r.range_m.size(), {0, Bounds::most_range_m, " m"},
            at(r.range_m));
}

void check_fan(const Fan& fan) {
    within("fan.least_deg", fan.least_deg, elevations);
    within("fan.most_deg", fan.most_deg, elevations);
    if (fan.least_deg >= fan.most_deg)
        refuse(fmt::format("fan.most_deg {} is not more than fan.least_deg {}", fan.most_deg,
                           fan.least_deg));
    if (fan.beams > Bounds::most_beams)
        refuse(fmt::format("fan.beams {} is outside 0 to {}", fan.beams, Bounds::most_beams));
}

/// There is water everywhere between them, or none at all: never less than none.
void check_depth(const Environment& e) {
    within("bottom_depth_m", bottom_depth_m(e, 0),
           {surface_depth_m(e, 0), Bounds::most_depth_m, " m"});
    if (!(bottom_depth_m(e, 0) > surface_depth_m(e, 0)))
        refuse(
            fmt::format("bottom_depth_m {} leaves no water at the source", bottom_depth_m(e, 0)));
}

}  // namespace

void check(const Environment& e) {
    within("frequency_hz", e.frequency_hz,
           {Bounds::least_frequency_hz, Bounds::most_frequency_hz, " Hz"});
    check_water(e.water);
    check_boundary("surface", e.surface);
    check_boundary("bottom", e.bottom);
    check_layers(e);
    if (e.surface_line) check_line("surface_line", *e.surface_line);
    if (e.bottom_line) check_line("bottom_line", *e.bottom_line);
    check_depth(e);
    check_source(e);
    check_receivers(e.receivers);
    check_fan(e.fan);
}

double depth_at_m(const Line& line, double range_m) {
    const std::vector<double>& r = line.range_m;
    const auto above = std::upper_bound(r.begin(), r.end(), range_m);
    if (above == r.begin()) return line.depth_m.front();
    if (above == r.end()) return line.depth_m.back();
    const auto k = static_cast<std::size_t>(above - r.begin());
    const double share = (range_m - r[k - 1]) / (r[k] - r[k - 1]);
    return std::lerp(line.depth_m[k - 1], line.depth_m[k], share);
}

double surface_depth_m(const Environment& e, double range_m) {
    return e.surface_line ? depth_at_m(*e.surface_line, range_m) : 0;
}

double bottom_depth_m(const Environment& e, double range_m) {
    return e.bottom_line ? depth_at_m(*e.bottom_line, range_m) : e.bottom_depth_m;
}

bool is_range_independent(const Environment& e) {
    const auto is_level = [](const std::optional<Line>& line) {
        return !line || std::all_of(line->depth_m.begin(), line->depth_m.end(),
                                    [&](double z) { return z == line->depth_m.front(); });
    };
    const auto& mesh = e.water.mesh;
    return is_level(e.surface_line) && is_level(e.bottom_line) &&
           (!mesh || mesh->range_m.size() == 1);
}

}  // namespace seautils::propagation
