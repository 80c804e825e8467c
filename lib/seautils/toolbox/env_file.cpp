#include "seautils/toolbox/env_file.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/propagation/reflection.hpp"
#include "seautils/toolbox/attenuation.hpp"
#include "seautils/toolbox/companions.hpp"
#include "seautils/toolbox/list_directed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace seautils::toolbox {

namespace pg = propagation;

namespace {

using Read = ListDirected::Read;

constexpr std::size_t most_values = 1'000'000;

/// A row of a profile or of a half-space. What a row leaves out is as in the row before it.
struct Row {
    double depth_m = 0, speed_mps = 1500, shear_mps = 0, density = 1, attenuation = 0,
           shear_attenuation = 0;
};

class Reader {
public:
    Reader(std::string_view text, const Companion& companion)
        : file_(text), companion_(companion) {}

    EnvFile read() {
        pg::Environment& e = result_.environment;
        file_.read([&](Read& r) { r.text(e.title, "the title"); });
        file_.read([&](Read& r) { e.frequency_hz = real(r, "frequency"); });
        std::int64_t media = 1;
        file_.read([&](Read& r) { r.whole(media, "NMEDIA", 1, 1'000'000); });
        top();
        profile();
        sediment(media);
        bottom();
        place_layers();
        has_run_type() ? bellhop() : kraken();
        clamp_depths();
        e.source.depth_m = result_.source_depth_m.front();
        return std::move(result_);
    }

private:
    double real(Read& r, std::string_view name) {
        double x = 0;
        if (!r.real(x, name)) file_.refuse(fmt::format("{} is not given", name));
        return x;
    }

    std::string letters(std::string_view name, std::size_t least) {
        std::string text;
        file_.read([&](Read& r) { r.text(text, name); });
        text.resize(std::max(text.size(), least), ' ');
        return text;
    }

    /// The text of a file beside this one; its refusals say so.
    template <class Parse>
    void with(const std::string& extension, std::string_view why, Parse parse) {
        const std::optional<std::string> text = companion_(extension);
        if (!text)
            throw DataError(
                fmt::format("{} asks for a .{} file, which is not there", why, extension));
        try {
            parse(*text);
        } catch (const DataError& e) {
            throw DataError(fmt::format("the .{} file: {}", extension, e.what()));
        }
    }

    void top() {
        const std::size_t line = file_.line();
        option_ = letters("TOPOPT", 7);
        const auto refuse = [&](std::size_t k, std::string_view what) {
            throw DataError(
                fmt::format("line {}: TOPOPT {}: letter {} {}", line, quote(option_), k, what));
        };
        pg::WaterColumn& w = result_.environment.water;
        switch (option_[0]) {
            case 'C':
            case 'Q':
                break;
            case 'N':
                w.interpolation = pg::SpeedInterpolation::n2_linear;
                break;
            case 'P':
                w.interpolation = pg::SpeedInterpolation::pchip;
                break;
            case 'S':
                w.interpolation = pg::SpeedInterpolation::spline;
                break;
            default:
                refuse(1, "is none of C, N, P, S, Q");
        }
        if (std::string_view("NFMWQL ").find(option_[2]) == std::string_view::npos)
            refuse(3, "is none of N, F, M, W, Q, L");
        if (option_[2] == ' ') option_[2] = 'W';
        absorption(refuse);
        if (std::string_view("VRAFG").find(option_[1]) == std::string_view::npos)
            refuse(2, "is none of V, R, A, F, G");
        boundary(option_[1], "trc", result_.environment.surface);
        if (option_[4] == '~' || option_[4] == '*')
            with("ati", "TOPOPT", [&](const std::string& text) {
                result_.environment.surface_line = read_boundary_file(text, result_.remarks);
            });
    }

    template <class Refuse>
    void absorption(const Refuse& refuse) {
        pg::Absorption& a = result_.environment.water.absorption;
        switch (option_[3]) {
            case ' ':
                break;
            case 'T':
                a.model = pg::AbsorptionModel::thorp;
                break;
            case 'F':
                a.model = pg::AbsorptionModel::francois_garrison;
                file_.read([&](Read& r) {
                    a.temperature_c = real(r, "temperature");
                    a.salinity = real(r, "salinity");
                    a.ph = real(r, "pH");
                    a.depth_m = real(r, "the depth of absorption");
                });
                break;
            default:
                refuse(4, "is none of blank, T, F");
        }
    }

    /// A half-space's row, a table's file, or nothing. @pre the letter is one of V, R, A, F, G
    void boundary(char kind, const char* table, pg::Boundary& b) {
        switch (kind) {
            case 'R':
                b.kind = pg::BoundaryKind::rigid;
                return;
            case 'A':
                row();
                half_space(b);
                return;
            case 'G':
                grain(b);
                return;
            case 'F':
                b.kind = pg::BoundaryKind::table;
                with(table, "letter F",
                     [&](const std::string& text) { b.table = read_reflection_file(text); });
                return;
            default:
                b.kind = pg::BoundaryKind::vacuum;
        }
    }

    void row() {
        file_.read([&](Read& r) {
            row_.depth_m = real(r, "depth");
            r.real(row_.speed_mps, "sound speed");
            r.real(row_.shear_mps, "shear speed");
            r.real(row_.density, "density");
            r.real(row_.attenuation, "attenuation");
            r.real(row_.shear_attenuation, "shear attenuation");
        });
    }

    void half_space(pg::Boundary& b) {
        b.kind = pg::BoundaryKind::half_space;
        b.sound_speed_mps = row_.speed_mps;
        b.shear_speed_mps = row_.shear_mps;
        b.density_gcm3 = row_.density;
        b.attenuation_db_per_wavelength = per_wavelength(row_.attenuation, row_.speed_mps);
        b.shear_attenuation_db_per_wavelength =
            row_.shear_mps == 0 ? 0 : per_wavelength(row_.shear_attenuation, row_.shear_mps);
    }

    void grain(pg::Boundary& b) {
        double phi = 0;
        file_.read([&](Read& r) {
            real(r, "depth");
            phi = real(r, "grain size");
        });
        b = pg::grain_half_space(phi, row_.speed_mps, row_.density);
    }

    /// From the unit of TOPOPT. @param speed_mps  not 0
    double per_wavelength(double x, double speed_mps) const {
        return attenuation_db_per_wavelength(option_[2], x, speed_mps,
                                             result_.environment.frequency_hz);
    }

    void profile() {
        pg::Environment& e = result_.environment;
        file_.read([&](Read& r) {
            double mesh = 0;
            r.real(mesh, "NMESH");
            r.real(e.surface.roughness_m, "SIGMA");
            e.bottom_depth_m = real(r, "the bottom's depth");
        });
        pg::WaterColumn& w = e.water;
        bool absorbs = false, changes = false;
        do {
            const Row before = row_;
            const std::size_t line = file_.line();
            row();
            if (row_.depth_m > e.bottom_depth_m + 1e-5 || w.profile.size() >= most_values)
                throw DataError(fmt::format("line {}: depth {} is below the bottom's {} m", line,
                                            row_.depth_m, e.bottom_depth_m));
            if (row_.shear_mps != 0)
                throw DataError(fmt::format("line {}: the water has a shear speed of {} m/s", line,
                                            row_.shear_mps));
            changes = changes ||
                      (!w.profile.empty() &&
                       (row_.density != before.density ||
                        std::fabs(db_per_m(row_) - db_per_m(before)) > 1e-6 * db_per_m(before)));
            absorbs = absorbs || row_.attenuation != 0;
            if (w.profile.empty()) first_row(w);
            w.profile.push_back({row_.depth_m, row_.speed_mps});
        } while (std::fabs(row_.depth_m - e.bottom_depth_m) > 1e-5);
        if (changes)
            result_.remarks.emplace_back(
                "density and attenuation of the water are those of the first row everywhere");
        if (absorbs && option_[3] != ' ')
            result_.remarks.emplace_back(
                "the attenuation of the rows is left alone, as there is a volume absorption");
        if (option_[0] == 'Q') speed_mesh();
    }

    /// The media below the water; what a row leaves out is as in the row before it, in another medium too.
    void sediment(std::int64_t media) {
        double top_m = result_.environment.bottom_depth_m, sigma = 0;
        for (std::int64_t k = 2; k <= media; ++k) {
            double bottom_m = 0;
            file_.read([&](Read& r) {
                double mesh = 0;
                r.real(mesh, "NMESH");
                r.real(sigma, "SIGMA");
                bottom_m = real(r, "the medium's depth");
            });
            (k == 2 ? roughness_m_ : buried_roughness_m_) += sigma;
            medium(k, top_m, bottom_m);
            top_m = bottom_m;
        }
        if (media > 1 && option_[0] != 'C')
            result_.remarks.emplace_back("the speed in layers of the bottom is linear in depth");
    }

    void medium(std::int64_t number, double top_m, double bottom_m) {
        std::size_t line = file_.line();
        fluid_row(number);
        if (!(std::fabs(row_.depth_m - top_m) <= 1e-5))
            throw DataError(fmt::format("line {}: depth {} is not the {} m where medium {} begins",
                                        line, row_.depth_m, top_m, number));
        do {
            const Row above = row_;
            line = file_.line();
            fluid_row(number);
            if (!(row_.depth_m > above.depth_m))
                throw DataError(fmt::format("line {}: depth {} is not below the {} m before it",
                                            line, row_.depth_m, above.depth_m));
            if (row_.depth_m > bottom_m + 1e-5)
                throw DataError(
                    fmt::format("line {}: depth {} is below the {} m where medium {} "
                                "ends",
                                line, row_.depth_m, bottom_m, number));
            layer(above, line);
        } while (std::fabs(row_.depth_m - bottom_m) > 1e-5);
    }

    void fluid_row(std::int64_t medium) {
        const std::size_t line = file_.line();
        row();
        if (row_.shear_mps != 0)
            throw DataError(
                fmt::format("line {}: medium {} has a shear speed of {} m/s: only the "
                            "lowest half-space may",
                            line, medium, row_.shear_mps));
    }

    /// Between two rows: in steps of a twentieth where the density changes.
    void layer(const Row& above, std::size_t line) {
        const double change = std::fabs(row_.density - above.density) /
                              (0.05 * std::max(row_.density, above.density));
        const int steps = change > 0 ? static_cast<int>(std::min(20.0, std::ceil(change))) : 1;
        const double thickness_m = (row_.depth_m - above.depth_m) / steps;
        const double top_db = per_wavelength(above.attenuation, above.speed_mps),
                     bottom_db = per_wavelength(row_.attenuation, row_.speed_mps);
        for (int k = 0; k < steps; ++k) {
            const double from = static_cast<double>(k) / steps, to = (k + 1.0) / steps,
                         at = (from + to) / 2;
            layers_.push_back({thickness_m, std::lerp(above.speed_mps, row_.speed_mps, from),
                               std::lerp(above.speed_mps, row_.speed_mps, to),
                               std::lerp(above.density, row_.density, at),
                               std::lerp(top_db, bottom_db, at)});
        }
        if (layers_.size() > pg::Bounds::most_layers)
            throw DataError(fmt::format("line {}: the bottom has more than {} layers", line,
                                        pg::Bounds::most_layers));
    }

    /// Roughness is known only where the water ends.
    void place_layers() {
        pg::Boundary& b = result_.environment.bottom;
        if (layers_.empty()) return;
        if (b.roughness_m + buried_roughness_m_ > 0)
            result_.remarks.emplace_back("the roughness below the first layer is left alone");
        b.roughness_m = roughness_m_;
        b.layers = std::move(layers_);
    }

    double db_per_m(const Row& r) const {
        return per_wavelength(r.attenuation, r.speed_mps) * result_.environment.frequency_hz /
               r.speed_mps;
    }

    void first_row(pg::WaterColumn& w) const {
        w.density_gcm3 = row_.density;
        if (row_.attenuation == 0 || option_[3] != ' ') return;
        w.absorption.model = pg::AbsorptionModel::fixed;
        w.absorption.db_per_km = db_per_m(row_) * 1000;
    }

    void speed_mesh() {
        pg::WaterColumn& w = result_.environment.water;
        std::vector<double> depth_m;
        for (const pg::SpeedPoint& point : w.profile) depth_m.push_back(point.depth_m);
        with("ssp", "TOPOPT",
             [&](const std::string& text) { w.mesh = read_ssp_file(text, depth_m); });
    }

    void bottom() {
        pg::Environment& e = result_.environment;
        const std::size_t line = file_.line();
        std::string option;
        file_.read([&](Read& r) {
            r.text(option, "BOTOPT");
            r.real(e.bottom.roughness_m, "SIGMA");
        });
        const double roughness_m = e.bottom.roughness_m;
        option.resize(std::max<std::size_t>(option.size(), 2), ' ');
        if (std::string_view("VRAFG").find(option[0]) == std::string_view::npos)
            throw DataError(fmt::format("line {}: BOTOPT {}: letter 1 is none of V, R, A, F, G",
                                        line, quote(option)));
        boundary(option[0], "brc", e.bottom);
        e.bottom.roughness_m = roughness_m;
        if (option[1] == '~' || option[1] == '*')
            with("bty", "BOTOPT", [&](const std::string& text) {
                e.bottom_line = read_boundary_file(text, result_.remarks);
            });
    }

    /// Whether a text in quotes comes: BELLHOP's run type, which KRAKEN does not have.
    bool has_run_type() const {
        const std::string_view rest = file_.rest();
        for (std::size_t at = 0; at < rest.size();) {
            const std::size_t first = std::min(rest.find_first_not_of(" \t", at), rest.size());
            if (first < rest.size() && (rest[first] == '\'' || rest[first] == '"')) return true;
            at = std::min(rest.find('\n', at), rest.size() - 1) + 1;
        }
        return false;
    }

    void bellhop() {
        pg::Environment& e = result_.environment;
        result_.source_depth_m = sorted(file_.vector("source depth", most_values));
        pg::Receivers at{file_.vector("receiver depth", most_values),
                         file_.vector_km("receiver range", most_values)};
        at.pairs = run_type(at);
        e.receivers =
            at.pairs ? std::move(at)
                     : pg::Receivers{sorted(std::move(at.depth_m)), sorted(std::move(at.range_m))};
        std::int64_t beams = 0;
        file_.read([&](Read& r) { r.whole(beams, "NBEAMS", 0, 100'000'000); });
        file_.read([&](Read& r) {
            e.fan.least_deg = real(r, "the first launch angle");
            e.fan.most_deg = real(r, "the last launch angle");
            double last = 0;
            for (std::int64_t k = 2; k < beams && r.real(last, "launch angle"); ++k)
                e.fan.most_deg = last;
        });
        if (e.fan.most_deg < e.fan.least_deg) std::swap(e.fan.least_deg, e.fan.most_deg);
    }

    /// @return receivers are pairs
    bool run_type(const pg::Receivers& receivers) {
        const std::size_t line = file_.line();
        const std::string type = letters("RUNTYPE", 7);
        const auto refuse = [&](std::string_view what) {
            throw DataError(fmt::format("line {}: RUNTYPE {}: {}", line, quote(type), what));
        };
        switch (type[0]) {
            case 'C':
                result_.options.sum = pg::Sum::coherent;
                break;
            case 'S':
                result_.options.sum = pg::Sum::semi_coherent;
                break;
            case 'I':
                break;
            case 'A':
            case 'a':
            case 'E':
                result_.arrivals = true;
                break;
            case 'R':
                refuse("rays are no result");
                break;
            default:
                refuse("letter 1 is none of C, S, I, A, a, E");
        }
        const bool is_hat = type[1] == 'G' || type[1] == '^' || type[1] == ' ';
        if (is_hat || type[1] == 'g') result_.options.beam = pg::Beam::hat;
        if (!is_hat && type[1] != 'B')
            result_.remarks.push_back(fmt::format("beams of kind {} are taken for {} ones",
                                                  quote(type.substr(1, 1)),
                                                  type[1] == 'g' ? "hat" : "Gaussian"));
        pg::Source& source = result_.environment.source;
        if (type[2] == '*')
            with("sbp", "RUNTYPE",
                 [&](const std::string& text) { source.pattern = read_sbp_file(text); });
        source.line = type[3] == 'X';
        result_.engine = pg::Engine::rays;
        if (type[4] != 'I') return false;
        if (receivers.depth_m.size() != receivers.range_m.size())
            refuse(fmt::format("NRZ {} is not NRR {}, so that receivers are no pairs",
                               receivers.depth_m.size(), receivers.range_m.size()));
        return true;
    }

    void kraken() {
        pg::Environment& e = result_.environment;
        file_.read([&](Read& r) {
            real(r, "the least phase speed");
            real(r, "the largest phase speed");
        });
        file_.read([&](Read& r) { real(r, "the largest range"); });
        result_.source_depth_m = sorted(file_.vector("source depth", most_values));
        e.receivers.depth_m = sorted(file_.vector("receiver depth", most_values));
        with("flp", "an environment for KRAKEN or SCOOTER", [&](const std::string& text) {
            FieldFile flp = read_flp_file(text);
            e.receivers = {sorted(std::move(flp.receiver_depth_m)), sorted(std::move(flp.range_m))};
            result_.source_depth_m = sorted(std::move(flp.source_depth_m));
            e.source.line = flp.line_source;
            result_.options.sum = flp.coherent ? pg::Sum::coherent : pg::Sum::incoherent;
        });
    }

    /// Ascending, each once.
    std::vector<double> sorted(std::vector<double> x) {
        const std::size_t n = x.size();
        std::sort(x.begin(), x.end());
        x.erase(std::unique(x.begin(), x.end()), x.end());
        if (x.size() < n)
            result_.remarks.emplace_back("receivers or sources that are there twice count once");
        return x;
    }

    /// Depths out of the water are those of its boundary.
    void clamp_depths() {
        const pg::Environment& e = result_.environment;
        const double top = e.water.profile.front().depth_m, bottom = e.bottom_depth_m;
        bool clamped = false;
        for (auto* depths : {&result_.source_depth_m, &result_.environment.receivers.depth_m}) {
            for (double& z : *depths) {
                clamped = clamped || z < top || z > bottom;
                z = std::clamp(z, std::min(top, bottom), bottom);
            }
            if (depths == &e.receivers.depth_m && e.receivers.pairs) continue;
            depths->erase(std::unique(depths->begin(), depths->end()), depths->end());
        }
        if (clamped)
            result_.remarks.emplace_back("depths outside of the water are put at its boundary");
    }

    ListDirected file_;
    const Companion& companion_;
    std::string option_;  ///< TOPOPT
    Row row_;
    std::vector<pg::SedimentLayer> layers_;
    double roughness_m_ = 0, buried_roughness_m_ = 0;  ///< of the first layer's top, of others
    EnvFile result_;
};

}  // namespace

EnvFile read_env(std::string_view text, const Companion& companion) {
    return Reader(text, companion).read();
}

}  // namespace seautils::toolbox
