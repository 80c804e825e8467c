#include "seautils/toolbox/env_writer.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/absorption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

namespace seautils::toolbox {

namespace pg = propagation;

namespace {

class Writer {
public:
    Writer(const pg::Environment& environment, const pg::FieldOptions& options)
        : e_(environment), options_(options) {}

    Files bellhop(bool arrivals) {
        if (!e_.bottom.layers.empty())
            throw DataError(
                "BELLHOP knows no layers below the bottom: bottom.layers is not empty (kraken, "
                "krakenc, scooter and the engines of tl-model can)");
        depth_m_ = deepest();
        head(true);
        vector({e_.source.depth_m}, 1);
        vector(e_.receivers.depth_m, 1);
        vector(e_.receivers.range_m, 1e-3);
        line("'{}{}{}{}{}'", arrivals ? 'A' : letter_of_sum(),
             options_.beam == pg::Beam::hat || arrivals ? 'G' : 'B',
             e_.source.pattern.empty() ? 'O' : '*', e_.source.line ? 'X' : 'R',
             e_.receivers.pairs ? 'I' : 'R');
        line("{}", e_.fan.beams);
        line("{} {} /", e_.fan.least_deg, e_.fan.most_deg);
        const std::vector<double>& range_m = e_.receivers.range_m;  // pairs are in any order
        line("0 {} {}", 1.01 * depth_m_ + 1,
             1.01e-3 * *std::max_element(range_m.begin(), range_m.end()));
        pattern();
        return std::move(files_);
    }

    Files kraken(PhaseSpeeds speeds, double reach_km) {
        if (e_.receivers.pairs) throw DataError("modes know no receivers that are pairs");
        if (!is_range_independent(e_))
            throw DataError("modes need a sea that does not depend on range");
        if (!e_.source.pattern.empty()) throw DataError("modes know no beam pattern");
        depth_m_ = e_.bottom_depth_m;
        head(false);
        line("{} {}", speeds.least_mps, speeds.most_mps);
        line("{}", reach_km);
        vector({e_.source.depth_m}, 1);
        vector(e_.receivers.depth_m, 1);
        text_ = &files_["flp"];
        line("/");
        line("'{}A {}'", e_.source.line ? 'X' : 'R', options_.sum == pg::Sum::coherent ? 'C' : 'I');
        line("99999");
        line("1\n0.0 /");
        vector(e_.receivers.range_m, 1e-3);
        vector({e_.source.depth_m}, 1);
        vector(e_.receivers.depth_m, 1);
        line("{}\n0.0 /", e_.receivers.depth_m.size());
        return std::move(files_);
    }

private:
    template <class... T>
    void line(fmt::format_string<T...> form, T&&... values) {
        fmt::format_to(std::back_inserter(*text_), form, std::forward<T>(values)...);
        *text_ += '\n';
    }

    void vector(const std::vector<double>& x, double unit) {
        line("{}", x.size());
        std::size_t k = 0;
        for (const double value : x) {
            *text_ += k++ % 10 == 9 ? '\n' : ' ';
            fmt::format_to(std::back_inserter(*text_), "{:.12g}", value * unit);
        }
        line(" /");
    }

    char letter_of_sum() const {
        return options_.sum == pg::Sum::coherent     ? 'C'
               : options_.sum == pg::Sum::incoherent ? 'I'
                                                     : 'S';
    }

    /// Of profile and bottom: for BELLHOP neither may end above the other.
    double deepest() const {
        double z = e_.bottom_depth_m;
        if (e_.bottom_line)
            z = *std::max_element(e_.bottom_line->depth_m.begin(), e_.bottom_line->depth_m.end());
        return std::max(
            z, e_.water.mesh ? e_.water.mesh->depth_m.back() : e_.water.profile.back().depth_m);
    }

    /// All up to the bottom.
    void head(bool for_rays) {
        text_ = &files_["env"];
        std::string title = e_.title.substr(0, 80);
        std::replace_if(
            title.begin(), title.end(),
            [](char c) { return c == '\'' || static_cast<unsigned char>(c) < 32; }, ' ');
        line("'{}'", title);
        line("{}", e_.frequency_hz);
        line("{}", 1 + e_.bottom.layers.size());
        line("'{}{}W{}{}'", letter_of_speed(), letter_of(e_.surface), letter_of_absorption(),
             for_rays && e_.surface_line ? '~' : ' ');
        const pg::Absorption& a = e_.water.absorption;
        if (a.model == pg::AbsorptionModel::francois_garrison)
            line("{} {} {} {}", a.temperature_c, a.salinity, a.ph, a.depth_m);
        boundary(e_.surface, 0, "trc");
        profile();
        const bool has_line = for_rays && (e_.bottom_line || depth_m_ > e_.bottom_depth_m);
        const double below_m = layers();
        line("'{}{}' {}", letter_of(e_.bottom), has_line ? '~' : ' ',
             e_.bottom.layers.empty() ? e_.bottom.roughness_m : 0);
        boundary(e_.bottom, below_m, "brc");
        if (for_rays && e_.surface_line) boundary_line("ati", *e_.surface_line);
        if (has_line)
            boundary_line("bty",
                          e_.bottom_line
                              ? *e_.bottom_line
                              : pg::Line{false, {0, 1e5}, {e_.bottom_depth_m, e_.bottom_depth_m}});
        text_ = &files_["env"];
    }

    /// Each as a medium. @return where the last one ends
    double layers() {
        double top_m = depth_m_, roughness_m = e_.bottom.roughness_m;
        for (const pg::SedimentLayer& l : e_.bottom.layers) {
            const double bottom_m = top_m + l.thickness_m;
            line("0 {} {:.15g}", roughness_m, bottom_m);
            line("{:.15g} {} 0 {} {} 0 /", top_m, l.sound_speed_top_mps, l.density_gcm3,
                 l.attenuation_db_per_wavelength);
            line("{:.15g} {} 0 {} {} 0 /", bottom_m, l.sound_speed_bottom_mps, l.density_gcm3,
                 l.attenuation_db_per_wavelength);
            top_m = bottom_m;
            roughness_m = 0;
        }
        return top_m;
    }

    char letter_of_speed() const {
        static constexpr std::string_view letters = "CNPS";
        return e_.water.mesh ? 'Q' : letters[static_cast<std::size_t>(e_.water.interpolation)];
    }
    static char letter_of(const pg::Boundary& b) {
        static constexpr std::string_view letters = "VRAF";
        return letters[static_cast<std::size_t>(b.kind)];
    }
    char letter_of_absorption() const {
        switch (e_.water.absorption.model) {
            case pg::AbsorptionModel::thorp:
                return 'T';
            case pg::AbsorptionModel::francois_garrison:
                return 'F';
            default:
                return ' ';
        }
    }

    void boundary(const pg::Boundary& b, double depth_m, const char* table) {
        if (b.kind == pg::BoundaryKind::half_space)
            line("{} {} {} {} {} {} /", depth_m, b.sound_speed_mps, b.shear_speed_mps,
                 b.density_gcm3, b.attenuation_db_per_wavelength,
                 b.shear_attenuation_db_per_wavelength);
        if (b.kind != pg::BoundaryKind::table) return;
        std::string* const before = text_;
        text_ = &files_[table];
        line("{}", b.table.size());
        for (const pg::ReflectionRow& row : b.table)
            line("{} {} {}", row.grazing_deg, row.magnitude, row.phase_deg);
        text_ = before;
    }

    /// Points down to depth_m_, where the last one must lie.
    std::vector<pg::SpeedPoint> points() const {
        std::vector<pg::SpeedPoint> all;
        if (e_.water.mesh) {
            const pg::SpeedMesh& m = *e_.water.mesh;
            for (std::size_t k = 0; k < m.depth_m.size(); ++k)
                all.push_back({m.depth_m[k], m.sound_speed_mps[k * m.range_m.size()]});
        } else {
            all = e_.water.profile;
        }
        if (all.front().depth_m > 0) all.insert(all.begin(), {0, all.front().sound_speed_mps});
        if (all.back().depth_m < depth_m_) all.push_back({depth_m_, all.back().sound_speed_mps});
        while (all.size() > 1 && all[all.size() - 2].depth_m >= depth_m_) all.pop_back();
        if (all.back().depth_m > depth_m_) {
            const pg::SpeedPoint& a = all[all.size() - 2];
            pg::SpeedPoint& b = all.back();
            const double share = (depth_m_ - a.depth_m) / (b.depth_m - a.depth_m);
            b = {depth_m_, a.sound_speed_mps + share * (b.sound_speed_mps - a.sound_speed_mps)};
        }
        return all;
    }

    void profile() {
        // What the Toolbox has no letter for stands in the rows.
        const double db_per_m =
            letter_of_absorption() == ' '
                ? absorption_db_per_km(e_.water.absorption, e_.frequency_hz) / 1000
                : 0;
        line("0 {} {:.12g}", e_.surface.roughness_m, depth_m_);
        const std::vector<pg::SpeedPoint> all = points();
        for (const pg::SpeedPoint& point : all)
            line("{:.12g} {:.12g} 0 {} {:.9g} 0 /", point.depth_m, point.sound_speed_mps,
                 e_.water.density_gcm3, db_per_m * point.sound_speed_mps / e_.frequency_hz);
        if (e_.water.mesh) mesh(all);
    }

    void mesh(const std::vector<pg::SpeedPoint>& rows) {
        const pg::SpeedMesh& m = *e_.water.mesh;
        std::string* const before = text_;
        text_ = &files_["ssp"];
        line("{}", m.range_m.size());
        for (const double range_m : m.range_m) line("{:.12g}", range_m / 1000);
        for (const pg::SpeedPoint& row : rows) {
            const auto at = std::lower_bound(m.depth_m.begin(), m.depth_m.end(), row.depth_m);
            const std::size_t k = std::min<std::size_t>(
                static_cast<std::size_t>(at - m.depth_m.begin()), m.depth_m.size() - 1);
            for (std::size_t i = 0; i < m.range_m.size(); ++i)
                line("{:.12g}", m.sound_speed_mps[k * m.range_m.size() + i]);
        }
        text_ = before;
    }

    void boundary_line(const char* extension, const pg::Line& l) {
        text_ = &files_[extension];
        line("'{}'", l.curved ? 'C' : 'L');
        line("{}", l.range_m.size());
        for (std::size_t k = 0; k < l.range_m.size(); ++k)
            line("{:.12g} {:.12g}", l.range_m[k] / 1000, l.depth_m[k]);
    }

    void pattern() {
        if (e_.source.pattern.empty()) return;
        text_ = &files_["sbp"];
        line("{}", e_.source.pattern.size());
        for (const pg::PatternPoint& point : e_.source.pattern)
            line("{} {}", point.angle_deg, point.level_db);
    }

    const pg::Environment& e_;
    const pg::FieldOptions& options_;
    double depth_m_ = 0;
    Files files_;
    std::string* text_ = nullptr;
};

}  // namespace

Files write_bellhop(const pg::Environment& environment, const pg::FieldOptions& options,
                    bool arrivals) {
    return Writer(environment, options).bellhop(arrivals);
}

Files write_kraken(const pg::Environment& environment, const pg::FieldOptions& options,
                   PhaseSpeeds speeds, double reach_km) {
    return Writer(environment, options).kraken(speeds, reach_km);
}

}  // namespace seautils::toolbox
