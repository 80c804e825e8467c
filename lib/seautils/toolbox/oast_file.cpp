#include "seautils/toolbox/oast_file.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/propagation/absorption.hpp"
#include "seautils/propagation/column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

namespace seautils::toolbox {

namespace pg = propagation;

namespace {

// ---- what it is fed ----

constexpr std::size_t most_layers = 400;
/// Over so much 1/c² that is linear and c that is differ by 0.006 m/s.
constexpr double most_change_mps = 5;
constexpr std::size_t pieces_of_curve = 8;

void check_said(const pg::Environment& e) {
    const auto refuse = [](const char* what) { throw DataError(fmt::format("oases: {}", what)); };
    if (!is_range_independent(e)) refuse("the sea depends on range");
    if (!e.source.pattern.empty()) refuse("source.pattern is not empty");
    if (e.source.line) refuse("source.line is true");
    if (e.surface.kind != pg::BoundaryKind::vacuum)
        refuse("the surface is none of pressure release");
    if (e.bottom.kind != pg::BoundaryKind::half_space && e.bottom.kind != pg::BoundaryKind::vacuum)
        refuse("the bottom is no half-space");
    if (e.surface.roughness_m > 0 || e.bottom.roughness_m > 0) refuse("a boundary is rough");
}

/// Depths at which layers of water begin, and where the water ends.
std::vector<double> edges(const pg::Environment& e, const pg::Column& column) {
    const double top_m = column.surface_m(), floor_m = top_m + column.height_m();
    std::vector<double> points{top_m};
    const auto& profile = e.water.profile;
    for (const pg::SpeedPoint& point : profile)
        if (point.depth_m > top_m && point.depth_m < floor_m) points.push_back(point.depth_m);
    points.push_back(floor_m);
    const bool is_curved = e.water.interpolation == pg::SpeedInterpolation::pchip ||
                           e.water.interpolation == pg::SpeedInterpolation::spline;
    const auto speed_mps = [&](double z) { return 1 / std::sqrt(column.squared_slowness(z)); };
    std::vector<double> all;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const double change = std::abs(speed_mps(points[k + 1]) - speed_mps(points[k]));
        const auto pieces = static_cast<std::size_t>(std::max(
            std::ceil(change / most_change_mps), is_curved && change > 0 ? pieces_of_curve : 1.));
        for (std::size_t i = 0; i < pieces; ++i)
            all.push_back(std::lerp(points[k], points[k + 1],
                                    static_cast<double>(i) / static_cast<double>(pieces)));
        if (all.size() > most_layers)
            throw DataError(fmt::format("oases: the water has more than {} layers", most_layers));
    }
    all.push_back(floor_m);
    return all;
}

class Writer {
public:
    explicit Writer(const pg::Environment& e) : e_(e), column_(e) {}

    std::string write(const EvenDepths& depths) {
        std::string title = e_.title.substr(0, 80);
        std::replace_if(
            title.begin(), title.end(), [](char c) { return static_cast<unsigned char>(c) < 32; },
            ' ');
        line("{}", title.empty() ? "sea" : title);
        line("N T J");
        line("{0} {0} 1 0", e_.frequency_hz);
        layers();
        line("{}", e_.source.depth_m);
        line("{} {} {} 1", depths.first_m, depths.last_m, depths.count);
        line("{} 1E8", 0.9 * slowest_mps_);
        line("-1 1 1");
        const double last_km = e_.receivers.range_m.back() / 1000;
        line("0 {} 20 {}", last_km, last_km / 5);
        line("20 120 12 20");
        return std::move(text_);
    }

private:
    template <class... T>
    void line(fmt::format_string<T...> form, T&&... values) {
        fmt::format_to(std::back_inserter(text_), form, std::forward<T>(values)...);
        text_ += '\n';
    }
    /// A layer, where `bottom_mps` is that of its bottom, or a half-space without.
    void row(double depth_m, double top_mps, double bottom_mps, double db, double gcm3) {
        line("{:.9g} {:.9g} {:.9g} {:.6g} 0 {} 0", depth_m, top_mps,
             bottom_mps == top_mps ? 0 : -bottom_mps, db, gcm3);
        slowest_mps_ = std::min({slowest_mps_, top_mps, bottom_mps});
    }

    void layers() {
        const std::vector<double> edge_m = edges(e_, column_);
        const double db_per_m = absorption_db_per_km(e_.water.absorption, e_.frequency_hz) / 1000;
        line("{}", 1 + (edge_m.size() - 1) + e_.bottom.layers.size() + 1);
        line("0 0 0 0 0 0 0");
        const auto speed_mps = [&](double z) { return 1 / std::sqrt(column_.squared_slowness(z)); };
        for (std::size_t k = 0; k + 1 < edge_m.size(); ++k) {
            const double top_mps = speed_mps(edge_m[k]);
            row(edge_m[k], top_mps, speed_mps(edge_m[k + 1]), db_per_m * top_mps / e_.frequency_hz,
                e_.water.density_gcm3);
        }
        double z = edge_m.back();
        for (const pg::SedimentLayer& layer : e_.bottom.layers) {
            row(z, layer.sound_speed_top_mps, layer.sound_speed_bottom_mps,
                layer.attenuation_db_per_wavelength, layer.density_gcm3);
            z += layer.thickness_m;
        }
        below(z);
    }

    void below(double depth_m) {
        const pg::Boundary& b = e_.bottom;
        if (b.kind == pg::BoundaryKind::vacuum) return line("{} 0 0 0 0 0 0", depth_m);
        line("{:.9g} {} {} {} {} {} 0", depth_m, b.sound_speed_mps, b.shear_speed_mps,
             b.attenuation_db_per_wavelength, b.shear_attenuation_db_per_wavelength,
             b.density_gcm3);
        if (b.shear_speed_mps > 0) slowest_mps_ = std::min(slowest_mps_, b.shear_speed_mps);
    }

    const pg::Environment& e_;
    pg::Column column_;
    std::string text_;
    double slowest_mps_ = std::numeric_limits<double>::infinity();
};

// ---- what it leaves ----

constexpr std::size_t most_values = 20'000'000;
constexpr std::size_t most_plots = 100'000;

/// As Fortran writes them: D for E, or a sign alone.
bool parse_fortran(std::string_view token, double& x) {
    std::string plain;
    for (std::size_t k = 0; k < token.size(); ++k) {
        const char c = token[k];
        const bool is_exponent = c == 'D' || c == 'd' || c == 'E' || c == 'e';
        const bool is_sign = (c == '-' || c == '+') && k > 0 && token[k - 1] != 'D' &&
                             token[k - 1] != 'd' && token[k - 1] != 'E' && token[k - 1] != 'e';
        if (is_exponent || is_sign) plain += 'e';
        if (!is_exponent && !(c == '+' && (k == 0 || is_sign || plain.back() == 'e'))) plain += c;
    }
    const auto [end, fault] = std::from_chars(plain.data(), plain.data() + plain.size(), x);
    return fault == std::errc{} && end == plain.data() + plain.size() && std::isfinite(x);
}

std::string_view next_token(std::string_view& rest) {
    const std::size_t first = std::min(rest.find_first_not_of(" \t\r\n"), rest.size());
    rest.remove_prefix(first);
    const std::string_view token = rest.substr(0, rest.find_first_of(" \t\r\n"));
    rest.remove_prefix(token.size());
    return token;
}

class Parameters {
public:
    explicit Parameters(std::string_view text) : rest_(text) {}

    [[noreturn]] void refuse(const std::string& what) const {
        throw DataError(fmt::format("the .plp file: line {}: {}", line_, what));
    }
    std::string_view text(const char* what) {
        ++line_;
        if (rest_.empty()) refuse(fmt::format("it ends where {} is expected", what));
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        return line;
    }
    double number(const char* what) {
        std::string_view line = text(what);
        const std::string_view token = next_token(line);
        double x = 0;
        if (!parse_fortran(token, x))
            refuse(fmt::format("{} {} is not a number", what,
                               quote(std::string(token.substr(0, 40)))));
        return x;
    }
    std::size_t count(const char* what, std::size_t most) {
        const double x = number(what);
        if (!(x >= 0 && x <= static_cast<double>(most)) || x != std::floor(x))
            refuse(fmt::format("{} {} is not a whole number of 0 to {}", what, x, most));
        return static_cast<std::size_t>(x);
    }
    void numbers(std::initializer_list<const char*> what) {
        for (const char* name : what) number(name);
    }

private:
    std::string_view rest_;
    std::size_t line_ = 0;
};

class Values {
public:
    explicit Values(std::string_view text) : rest_(text) {}

    std::vector<double> next(std::size_t n) {
        std::vector<double> all;
        while (all.size() < n) {
            const std::string_view token = next_token(rest_);
            double x = 0;
            ++read_;
            if (token.empty())
                throw DataError(fmt::format("the .plt file: it ends before value {}", read_));
            if (!parse_fortran(token, x))
                throw DataError(fmt::format("the .plt file: value {}: {} is not a number", read_,
                                            quote(std::string(token.substr(0, 40)))));
            all.push_back(x);
        }
        return all;
    }
    void end() {
        if (!next_token(rest_).empty())
            throw DataError(fmt::format("the .plt file: there are more than {} values", read_));
    }

private:
    std::string_view rest_;
    std::size_t read_ = 0;
};

PlotCurve read_curve(Parameters& plp, Values& plt) {
    PlotCurve curve;
    const std::size_t n = plp.count("N", most_values);
    curve.first = plp.number("XMIN");
    curve.step = plp.number("DX");
    plp.number("YMIN");
    const double step_y = plp.number("DY");
    if (curve.step <= 0 || step_y != 0) plp.refuse("a curve is not over equal steps of its x axis");
    curve.y = plt.next(n);
    return curve;
}

}  // namespace

std::string write_oast(const pg::Environment& environment, const EvenDepths& depths) {
    check_said(environment);
    return Writer(environment).write(depths);
}

std::vector<PlotCurve> read_plots(std::string_view plp_text, std::string_view plt_text) {
    Parameters plp(plp_text);
    Values plt(plt_text);
    std::vector<PlotCurve> plots;
    plp.number("MODULO");
    for (;;) {
        if (plp.text("a plot, or PLTEND,").find("PLTEND") != std::string_view::npos) break;
        plp.text("the title");
        plp.text("the second title");
        for (std::size_t labels = plp.count("NUMBER OF LABELS", 1000); labels > 0; --labels)
            plp.text("a label");
        plp.numbers({"XLEN", "YLEN", "GRID TYPE", "XLEFT", "XRIGHT", "XINC", "XDIV"});
        const bool is_range = plp.text("the x axis").find("Range") != std::string_view::npos;
        plp.text("LIN or LOG");
        plp.numbers({"YDOWN", "YUP", "YINC", "YDIV"});
        plp.text("the y axis");
        plp.text("LIN or LOG");
        for (std::size_t k = 0, n = plp.count("NC", 1000); k < n; ++k) {
            PlotCurve curve = read_curve(plp, plt);
            if (is_range && k == 0) plots.push_back(std::move(curve));
        }
        if (plots.size() > most_plots) plp.refuse(fmt::format("more than {} plots", most_plots));
    }
    plt.end();
    return plots;
}

double value_at(const PlotCurve& curve, double x) {
    const double place = (x - curve.first) / curve.step;
    if (place < -1e-9) return std::numeric_limits<double>::quiet_NaN();
    const double last = static_cast<double>(curve.y.size()) - 1;
    if (!(place <= last + 1e-6))
        throw DataError(fmt::format("its curves end at {:.6g} km, before {:.6g} km",
                                    curve.first + last * curve.step, x));
    const auto k = static_cast<std::size_t>(std::clamp(place, 0., std::max(last - 1, 0.)));
    if (k + 1 >= curve.y.size()) return curve.y[k];
    return std::lerp(curve.y[k], curve.y[k + 1],
                     std::clamp(place - static_cast<double>(k), 0., 1.));
}

}  // namespace seautils::toolbox
