// Requests of tl-model: what each says is merged over what is known.
#ifndef SEAUTILS_TOOLS_TL_REQUEST_HPP
#define SEAUTILS_TOOLS_TL_REQUEST_HPP

#include "ssp_schema.hpp"
#include "tl_fields.hpp"
#include "tl_part.hpp"
#include "tl_task.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/reflection.hpp"
#include "seautils/schema/values.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seautils::tools {

/// Everything that requests have said so far.
class TlKnown {
public:
    /// A record may hold so many losses.
    static constexpr std::size_t most_cells = 200'000;
    static constexpr std::size_t most_span = 100'000;

    /// @param start  what holds before the first request
    /// @param is_whole  it is a whole environment; else requests must say what it lacks
    TlKnown(TlTask start, bool is_whole)
        : start_(std::move(start)), is_whole_(is_whole), task_(start_) {
        if (is_whole_) said_ = all;
    }

    /// Merges a request.
    /// @throws DataError  names the field; what is known then is not to be used any more
    void merge(const schema::Values& values) {
        TlPart request{values, 0, ""};
        if (request.flag(field::request::reset).value_or(false)) *this = TlKnown(start_, is_whole_);
        task_.id = request.whole(field::request::id);
        merge_water(request);
        merge_boundaries(request);
        merge_source(request);
        merge_options(request);
        if (const auto levels = request.part(field::request::levels, "levels")) {
            if (!task_.levels) task_.levels.emplace();
            task_.levels->merge(*levels);
        }
    }

    /// What is to be computed now; nothing may be wanted.
    /// @throws DataError  something that is needed was never said, or there are too many cells
    TlTask task() const {
        if (!task_.loss && !task_.arrivals) return task_;
        static constexpr std::pair<unsigned, const char*> needed[] = {
            {frequency, "frequency_hz"},
            {source, "source.depth_m"},
            {depths, "receivers.depth_m"},
            {ranges, "receivers.range_m"},
            {water, "profile"},
            {bottom, "bottom"},
            {bottom_depth, "bottom_depth_m"},
        };
        for (const auto& [part, name] : needed)
            if ((said_ & part) == 0) throw DataError(std::string(name) + " is not given");
        const pg::Receivers& r = task_.environment.receivers;
        const std::size_t cells = r.count();
        if (cells > most_cells)
            throw DataError(
                fmt::format("receivers of {} depths and {} ranges are {} cells, which is "
                            "outside 1 to {}",
                            r.depth_m.size(), r.range_m.size(), cells, most_cells));
        TlTask now = task_;
        if (grain_) now.environment.bottom = grain_bottom(now.environment);
        return now;
    }

private:
    enum : unsigned {
        frequency = 1,
        source = 2,
        depths = 4,
        ranges = 8,
        water = 16,
        bottom = 32,
        bottom_depth = 64,
        all = 127,
    };

    void merge_water(const TlPart& request) {
        pg::WaterColumn& w = task_.environment.water;
        if (const auto p = request.part(field::request::profile, "profile")) merge_profile(*p);
        if (const auto m = request.part(field::request::mesh, "mesh")) {
            pg::SpeedMesh mesh{m->list(field::mesh::range_m), m->list(field::mesh::depth_m),
                               m->list(field::mesh::sound_speed_mps)};
            m->same(mesh.range_m.size() * mesh.depth_m.size(), "range_m by depth_m",
                    mesh.sound_speed_mps.size(), "sound_speed_mps");
            w.mesh = std::move(mesh);
            if (w.profile.empty()) w.profile = first_column(*w.mesh);
            said_ |= water;
        }
        // The order of names in the schema is that of the enumeration.
        request.choice(field::request::interpolation, w.interpolation);
        request.number(field::request::water_density_gcm3, w.density_gcm3);
        const auto a = request.part(field::request::absorption, "absorption");
        if (!a) return;
        a->choice(field::absorption::model, w.absorption.model);
        a->number(field::absorption::temperature_c, w.absorption.temperature_c);
        a->number(field::absorption::salinity, w.absorption.salinity);
        a->number(field::absorption::ph, w.absorption.ph);
        a->number(field::absorption::depth_m, w.absorption.depth_m);
        a->number(field::absorption::db_per_km, w.absorption.db_per_km);
    }

    void merge_profile(const TlPart& p) {
        pg::WaterColumn& w = task_.environment.water;
        const std::vector<double> depth_m = p.list(SspSchema::depth_m),
                                  speed_mps = p.list(SspSchema::sound_speed_mps);
        p.same(depth_m.size(), "depth_m", speed_mps.size(), "sound_speed_mps");
        w.profile.clear();
        for (std::size_t k = 0; k < depth_m.size(); ++k)
            w.profile.push_back({depth_m[k], speed_mps[k]});
        w.mesh.reset();
        said_ |= water;
    }

    static std::vector<pg::SpeedPoint> first_column(const pg::SpeedMesh& mesh) {
        std::vector<pg::SpeedPoint> points;
        for (std::size_t k = 0; k < mesh.depth_m.size(); ++k)
            points.push_back({mesh.depth_m[k], mesh.sound_speed_mps[k * mesh.range_m.size()]});
        return points;
    }

    void merge_boundaries(const TlPart& request) {
        pg::Environment& e = task_.environment;
        if (const auto s = request.part(field::request::surface, "surface")) {
            merge_boundary(*s, e.surface);
            if (s->has(field::boundary::grain_phi))
                throw DataError("surface.grain_phi is for a bottom");
            if (has_layers(*s)) throw DataError("surface.layer_thickness_m is for a bottom");
        }
        if (const auto b = request.part(field::request::bottom, "bottom")) {
            merge_boundary(*b, e.bottom);
            if (b->has(field::boundary::sound_speed_mps) || b->has(field::boundary::kind))
                grain_.reset();
            if (b->has(field::boundary::grain_phi)) {
                grain_ = 0;
                b->bounded(field::boundary::grain_phi, "grain_phi", -1, 9, *grain_);
            }
            said_ |= bottom;
        }
        if (const auto l = request.part(field::request::altimetry, "altimetry"))
            e.surface_line = line_of(*l);
        request.number(field::request::bottom_depth_m, e.bottom_depth_m);
        if (const auto l = request.part(field::request::bathymetry, "bathymetry"))
            e.bottom_line = line_of(*l);
        if (request.has(field::request::bottom_depth_m) || e.bottom_line) said_ |= bottom_depth;
    }

    static void merge_boundary(const TlPart& p, pg::Boundary& b) {
        namespace f = field::boundary;
        const bool has_table = p.has(f::magnitude);
        const bool is_material = p.has(f::sound_speed_mps) || p.has(f::grain_phi);
        if (has_table) b.kind = pg::BoundaryKind::table;
        if (is_material) b.kind = pg::BoundaryKind::half_space;
        p.choice(f::kind, b.kind);
        p.number(f::sound_speed_mps, b.sound_speed_mps);
        p.number(f::shear_speed_mps, b.shear_speed_mps);
        p.number(f::density_gcm3, b.density_gcm3);
        p.number(f::attenuation, b.attenuation_db_per_wavelength);
        p.number(f::shear_attenuation, b.shear_attenuation_db_per_wavelength);
        p.number(f::roughness_m, b.roughness_m);
        if (p.has(f::kind) || has_layers(p)) b.layers = layers_of(p);
        if (!has_table) return;
        const std::vector<double> grazing = p.list(f::grazing_deg), size = p.list(f::magnitude),
                                  phase = p.list(f::phase_deg);
        p.same(grazing.size(), "grazing_deg", size.size(), "magnitude");
        p.same(grazing.size(), "grazing_deg", phase.size(), "phase_deg");
        b.table.clear();
        for (std::size_t k = 0; k < size.size(); ++k)
            b.table.push_back({grazing[k], size[k], phase[k]});
    }

    static bool has_layers(const TlPart& p) {
        namespace f = field::boundary;
        for (std::uint32_t k = f::layer_thickness_m; k <= f::layer_attenuation; ++k)
            if (p.has(k)) return true;
        return false;
    }

    static std::vector<pg::SedimentLayer> layers_of(const TlPart& p) {
        namespace f = field::boundary;
        std::vector<pg::SedimentLayer> layers;
        for (const double thickness_m : p.list(f::layer_thickness_m))
            layers.push_back({.thickness_m = thickness_m});
        const auto fill = [&](std::uint32_t field, const char* name,
                              double pg::SedimentLayer::*to) {
            const std::vector<double> values = p.list(field);
            if (values.empty()) return;
            p.same(layers.size(), "layer_thickness_m", values.size(), name);
            for (std::size_t k = 0; k < values.size(); ++k) layers[k].*to = values[k];
        };
        using Layer = pg::SedimentLayer;
        if (!layers.empty() && !p.has(f::layer_speed_mps))
            throw DataError(p.path + "layer_speed_mps is not given");
        fill(f::layer_speed_mps, "layer_speed_mps", &Layer::sound_speed_top_mps);
        fill(f::layer_speed_mps, "layer_speed_mps", &Layer::sound_speed_bottom_mps);
        fill(f::layer_bottom_speed_mps, "layer_bottom_speed_mps", &Layer::sound_speed_bottom_mps);
        fill(f::layer_density_gcm3, "layer_density_gcm3", &Layer::density_gcm3);
        fill(f::layer_attenuation, "layer_attenuation_db_per_wavelength",
             &Layer::attenuation_db_per_wavelength);
        return layers;
    }

    static std::optional<pg::Line> line_of(const TlPart& p) {
        pg::Line line{p.flag(field::line::curved).value_or(false), p.list(field::line::range_m),
                      p.list(field::line::depth_m)};
        p.same(line.range_m.size(), "range_m", line.depth_m.size(), "depth_m");
        if (line.range_m.empty()) return std::nullopt;
        return line;
    }

    pg::Boundary grain_bottom(const pg::Environment& e) const {
        const double speed_mps =
            e.water.profile.empty() ? 1500 : e.water.profile.back().sound_speed_mps;
        pg::Boundary b = pg::grain_half_space(*grain_, speed_mps, e.water.density_gcm3);
        b.roughness_m = e.bottom.roughness_m;
        b.layers = e.bottom.layers;
        return b;
    }

    void merge_source(const TlPart& request) {
        pg::Environment& e = task_.environment;
        request.number(field::request::frequency_hz, e.frequency_hz);
        if (request.has(field::request::frequency_hz)) said_ |= frequency;
        if (const auto s = request.part(field::request::source, "source")) {
            s->number(field::source::depth_m, e.source.depth_m);
            if (s->has(field::source::depth_m)) said_ |= source;
            e.source.line = s->flag(field::source::line).value_or(e.source.line);
            if (s->has(field::source::pattern_deg) || s->has(field::source::pattern_db))
                e.source.pattern = pattern_of(*s);
        }
        if (const auto r = request.part(field::request::receivers, "receivers")) {
            namespace f = field::receivers;
            if (axis(*r, f::depth_m, f::depths, "depth", e.receivers.depth_m)) said_ |= depths;
            if (axis(*r, f::range_m, f::ranges, "range", e.receivers.range_m)) said_ |= ranges;
            e.receivers.pairs = r->flag(f::pairs).value_or(e.receivers.pairs);
            task_.arrivals_at.reset();
        }
        if (const auto f = request.part(field::request::fan, "fan")) {
            f->number(field::fan::min_deg, e.fan.least_deg);
            f->number(field::fan::max_deg, e.fan.most_deg);
            e.fan.beams = f->whole(field::fan::beams).value_or(e.fan.beams);
        }
    }

    static std::vector<pg::PatternPoint> pattern_of(const TlPart& s) {
        const std::vector<double> angle = s.list(field::source::pattern_deg),
                                  level = s.list(field::source::pattern_db);
        s.same(angle.size(), "pattern_deg", level.size(), "pattern_db");
        std::vector<pg::PatternPoint> points;
        for (std::size_t k = 0; k < angle.size(); ++k) points.push_back({angle[k], level[k]});
        return points;
    }

    /// @return whether the request says it
    static bool axis(const TlPart& r, std::uint32_t list, std::uint32_t span, const char* name,
                     std::vector<double>& values) {
        if (r.has(list) && r.has(span))
            throw DataError(
                fmt::format("receivers.{0}_m and receivers.{0}s exclude each other", name));
        if (r.has(list)) values = r.list(list);
        if (const auto s = r.part(span, fmt::format("{}s", name))) {
            const double start = s->number(field::span::start_m).value_or(0),
                         stop = s->number(field::span::stop_m).value_or(0);
            const std::uint32_t n = s->whole(field::span::count).value_or(0);
            if (n < 1 || n > most_span)
                throw DataError(
                    fmt::format("{}count {} is outside 1 to {}", s->path, n, most_span));
            values.assign(n, start);
            for (std::uint32_t k = 1; k < n; ++k) values[k] = start + (stop - start) * k / (n - 1);
        }
        return r.has(list) || r.has(span);
    }

    void merge_options(const TlPart& request) {
        namespace f = field::request;
        static constexpr pg::Sum sums[] = {pg::Sum::incoherent, pg::Sum::semi_coherent,
                                           pg::Sum::coherent};
        if (request.has(f::sum)) task_.options.sum = sums[request[f::sum].i];
        request.choice(f::beam, task_.options.beam);
        if (request.has(f::engine)) {
            try {
                task_.engine = parse_engine(request.values.text(request[f::engine]));
            } catch (const DataError& e) {
                throw DataError(std::string("engine ") + e.what());
            }
        }
        request.bounded(f::min_amp, "min_amp", 0, 1, task_.options.least_amplitude);
        request.bounded(f::baffle_from_deg, "baffle_from_deg", -180, 180,
                        task_.options.baffle_from_deg);
        request.bounded(f::baffle_to_deg, "baffle_to_deg", -180, 180, task_.options.baffle_to_deg);
        task_.smooth = request.flag(f::smooth).value_or(task_.smooth);
        task_.loss = request.flag(f::loss).value_or(task_.loss);
        task_.arrivals = request.flag(f::arrivals).value_or(task_.arrivals);
    }

    TlTask start_;
    bool is_whole_ = false;
    TlTask task_;
    std::optional<double> grain_;
    unsigned said_ = 0;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_REQUEST_HPP
