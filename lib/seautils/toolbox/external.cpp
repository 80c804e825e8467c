#include "seautils/toolbox/external.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/toolbox/arr_file.hpp"
#include "seautils/toolbox/env_writer.hpp"
#include "seautils/toolbox/green.hpp"
#include "seautils/toolbox/oast_file.hpp"
#include "seautils/toolbox/shd_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace seautils::toolbox {

namespace pg = propagation;

namespace {

constexpr std::array<std::pair<std::string_view, Program>, 6> programs{
    {{"bellhop", Program::bellhop},
     {"bellhopcxx", Program::bellhopcxx},
     {"kraken", Program::kraken},
     {"krakenc", Program::krakenc},
     {"scooter", Program::scooter},
     {"oases", Program::oases}}};

constexpr std::size_t most_bytes = std::size_t{1} << 30;

std::string name_of(Program program) {
    return std::string(programs[static_cast<std::size_t>(program)].first);
}

void write_file(const std::string& path, const std::string& text) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"),
                                                               std::fclose);
    if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
        std::fflush(file.get()) != 0)
        throw Error(ExitCode::cannot_create, path + ": cannot be written");
}

/// Empty where there is none.
std::string read_file(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        std::fopen(path.c_str(), "rb"),
        [](std::FILE* f) { return f == nullptr ? 0 : std::fclose(f); });
    std::string all;
    if (!file) return all;
    for (std::array<char, 65536> block{}; all.size() < most_bytes;) {
        const std::size_t n = std::fread(block.data(), 1, block.size(), file.get());
        if (n == 0) break;
        all.append(block.data(), n);
    }
    return all;
}

/// A run of one or two programs in a folder, where all files are called `sea`.
class Run {
public:
    explicit Run(const ExternalRun& run) : run_(run), folder_(run.temporary) {}

    void feed(const Files& files) {
        for (const auto& [extension, text] : files) write_file(path(extension), text);
    }

    /// Runs a program, and gives its result.
    std::string result_of(const std::string& name, std::vector<std::string> options,
                          const std::string& extension) {
        std::remove(path(extension).c_str());
        options.emplace_back("sea");
        try {
            run_program({name, name + ".exe"}, options, folder_.path(), run_.limits);
        } catch (const DataError& e) {
            throw DataError(e.what() + complaint());
        }
        const std::string said = complaint();
        if (!said.empty()) throw DataError(name + " failed" + said);
        std::string result = read_file(path(extension));
        if (result.empty()) throw DataError(name + " left no result");
        return result;
    }

    void forget(const std::string& extension) const { std::remove(path(extension).c_str()); }
    std::string file(const std::string& extension) const { return read_file(path(extension)); }

private:
    std::string path(const std::string& extension) const {
        return folder_.path() + "/sea." + extension;
    }

    /// What its log says of a fatal error: the Fortran programs end with status 0 then.
    std::string complaint() const {
        const std::string log = read_file(path("prt"));
        const std::size_t at = log.find("FATAL ERROR");
        if (at == log.npos) return {};
        std::string words;
        std::size_t lines = 0;
        for (std::size_t begin = at; begin < log.size() && lines < 4; ++lines) {
            const std::size_t end = std::min(log.find('\n', begin), log.size());
            const std::string_view line(log.data() + begin, end - begin);
            const std::size_t first = line.find_first_not_of(" *\t\r");
            if (lines > 0 && first != line.npos)
                words.append(words.empty() ? "" : " ").append(line.substr(first));
            begin = end + 1;
        }
        return ": " + quote(words);
    }

    const ExternalRun& run_;
    PrivateFolder folder_;
};

/// Losses of pressures; below the bottom, above the surface and at range 0 there are none.
pg::Field field_of(const pg::Environment& e, const pg::FieldOptions& options,
                   const std::vector<std::complex<float>>& pressure) {
    pg::Field field;
    field.depths = e.receivers.pairs ? 1 : e.receivers.depth_m.size();
    field.ranges = e.receivers.range_m.size();
    field.loss_db.resize(pressure.size());
    for (std::size_t k = 0; k < pressure.size(); ++k) {
        const double range_m = e.receivers.range_at_m(k), depth_m = e.receivers.depth_at_m(k);
        const bool is_water = range_m != 0 && depth_m <= bottom_depth_m(e, range_m) &&
                              depth_m >= surface_depth_m(e, range_m);
        const double size = std::abs(std::complex<double>(pressure[k]));
        field.loss_db[k] = !is_water  ? std::numeric_limits<float>::quiet_NaN()
                           : size > 0 ? static_cast<float>(-20 * std::log10(size))
                                      : std::numeric_limits<float>::infinity();
    }
    if (options.sum == pg::Sum::coherent) field.pressure = pressure;
    return field;
}

ShdFile read_result(const std::string& name, const std::string& bytes) {
    try {
        return read_shd(bytes);
    } catch (const DataError& e) {
        throw DataError(name + ": its result is not as it should be: " + e.what());
    }
}

/// @throws DataError  a result of another size: it is not of what was asked
void check_size(const std::string& name, const pg::Environment& e, std::size_t depths,
                std::size_t ranges) {
    const std::size_t d = e.receivers.depth_m.size(), r = e.receivers.range_m.size();
    if (depths == d && ranges == r) return;
    throw DataError(fmt::format("{}: its result has {} depths and {} ranges in place of {} and {}",
                                name, depths, ranges, d, r));
}

double least_speed_mps(const pg::Environment& e) {
    double least = std::numeric_limits<double>::infinity();
    for (const pg::SpeedPoint& point : e.water.profile)
        least = std::min(least, point.sound_speed_mps);
    for (const pg::SedimentLayer& l : e.bottom.layers)
        least = std::min({least, l.sound_speed_top_mps, l.sound_speed_bottom_mps});
    return least;
}

/// Trapped modes, leaky ones too, or all that propagates.
PhaseSpeeds phase_speeds(Program program, const pg::Environment& e) {
    const double least = 0.93 * least_speed_mps(e);
    const bool is_open = e.bottom.kind != pg::BoundaryKind::half_space;
    if (program == Program::scooter || is_open) return {least, 1e9};
    return {least, e.bottom.sound_speed_mps * (program == Program::kraken ? 1 : 2.4)};
}

bool is_bellhop(Program program) {
    return program == Program::bellhop || program == Program::bellhopcxx;
}

/// bellhopcxx would reserve gigabytes.
std::vector<std::string> options_of(Program program, const ExternalRun& run) {
    if (program != Program::bellhopcxx) return {};
    return {"--2D", fmt::format("--memory={}MiB",
                                std::max<std::uint64_t>(run.limits.memory_bytes >> 22U, 64))};
}

/// Spans of receivers' depths in the water that are equally spaced: all of them, or each by itself.
std::vector<EvenDepths> even_depths(const std::vector<double>& depth_m) {
    const std::size_t n = depth_m.size();
    if (n == 0) return {};
    const double step_m =
        n > 1 ? (depth_m.back() - depth_m.front()) / static_cast<double>(n - 1) : 0;
    bool even = true;
    for (std::size_t k = 0; k < n; ++k)
        even = even && std::abs(depth_m[k] - depth_m[0] - step_m * static_cast<double>(k)) <
                           1e-6 * step_m + 1e-9;
    if (even) return {{depth_m.front(), depth_m.back(), n}};
    std::vector<EvenDepths> each;
    for (const double z : depth_m) each.push_back({z, z, 1});
    return each;
}

/// Curves over range that OAST leaves for some depths.
std::vector<PlotCurve> curves_of(Run& one, const pg::Environment& e, const EvenDepths& depths) {
    one.feed({{"dat", write_oast(e, depths)}});
    one.forget("plp");
    const std::string values = one.result_of("oast", {}, "plt");
    std::vector<PlotCurve> curves;
    try {
        curves = read_plots(one.file("plp"), values);
    } catch (const DataError& fault) {
        throw DataError(std::string("oast: its result is not as it should be: ") + fault.what());
    }
    if (curves.size() == depths.count) return curves;
    throw DataError(fmt::format("oast: its result has {} plots over range in place of {}",
                                curves.size(), depths.count));
}

/// Losses of a curve as pressures without a phase.
void put_curve(const PlotCurve& curve, const std::vector<double>& range_m,
               std::complex<float>* pressure) {
    try {
        for (const double r : range_m) {
            const double loss_db = r > 0 ? value_at(curve, r / 1000) : 0;
            *pressure++ = static_cast<float>(std::pow(10, -loss_db / 20));
        }
    } catch (const DataError& fault) {
        throw DataError(std::string("oast: ") + fault.what());
    }
}

/// Losses of OAST at the receivers that lie in the water.
pg::Field oast_field(Run& one, const pg::Environment& e, const pg::FieldOptions& options) {
    if (options.sum != pg::Sum::coherent)
        throw DataError("oases adds coherently alone (--sum coherent)");
    const pg::Receivers& r = e.receivers;
    std::vector<std::size_t> row;
    std::vector<double> depth_m;
    for (std::size_t k = 0; k < r.depth_m.size(); ++k) {
        if (r.depth_m[k] < surface_depth_m(e, 0) || r.depth_m[k] > bottom_depth_m(e, 0)) continue;
        row.push_back(k);
        depth_m.push_back(r.depth_m[k]);
    }
    std::vector<std::complex<float>> pressure(r.depth_m.size() * r.range_m.size());
    std::size_t k = 0;
    for (const EvenDepths& span : even_depths(depth_m))
        for (const PlotCurve& curve : curves_of(one, e, span))
            put_curve(curve, r.range_m, &pressure[row[k++] * r.range_m.size()]);
    pg::Field field = field_of(e, options, pressure);
    field.basis.remarks.emplace_back(
        "losses are those of OAST between its ranges; pressures have no phase");
    return field;
}

/// Pairs in the order in which BELLHOP wants them, its ranges growing; else the receivers as they are.
struct Ordered {
    explicit Ordered(const pg::Environment& given) : environment(given) {
        if (!given.receivers.pairs) return;
        const std::vector<double>& range_m = given.receivers.range_m;
        order.resize(range_m.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return range_m[a] < range_m[b]; });
        pg::Receivers& r = environment.receivers;
        for (std::size_t k = 0; k < order.size(); ++k) {
            r.range_m[k] = range_m[order[k]];
            r.depth_m[k] = given.receivers.depth_m[order[k]];
            if (k > 0 && r.range_m[k] == r.range_m[k - 1])
                throw DataError(
                    fmt::format("bellhop takes pairs of receivers at ranges that differ: {} m is "
                                "there twice",
                                r.range_m[k]));
        }
    }
    /// Values as they were asked for.
    template <class T>
    void restore(std::vector<T>& values) const {
        const std::vector<T> sorted = values;
        for (std::size_t k = 0; k < order.size() && k < values.size(); ++k)
            values[order[k]] = sorted[k];
    }

    pg::Environment environment;
    std::vector<std::size_t> order;
};

pg::Field bellhop_field(Program program, const pg::Environment& given,
                        const pg::FieldOptions& options, const ExternalRun& run) {
    const std::string name = name_of(program);
    const Ordered ordered(given);
    const pg::Environment& e = ordered.environment;
    Run one(run);
    one.feed(write_bellhop(e, options, false));
    const ShdFile shd = read_result(name, one.result_of(name, options_of(program, run), "shd"));
    check_size(name, e, shd.receiver_depth_m.size(), shd.range_m.size());
    if (shd.irregular != e.receivers.pairs)
        throw DataError(name + (shd.irregular ? ": its result is of pairs in place of a grid"
                                              : ": its result is of a grid in place of pairs"));
    pg::Field field = field_of(e, options, shd.pressure);
    ordered.restore(field.loss_db);
    if (!field.pressure.empty()) ordered.restore(field.pressure);
    return field;
}

}  // namespace

Program parse_program(std::string_view name) {
    for (const auto& [known, program] : programs)
        if (name == known) return program;
    throw DataError(quote(name) +
                    " is none of bellhop, bellhopcxx, kraken, krakenc, scooter, oases");
}

pg::Field external_field(Program program, const pg::Environment& e, const pg::FieldOptions& options,
                         const ExternalRun& run) {
    const std::string name = name_of(program);
    if (is_bellhop(program)) return bellhop_field(program, e, options, run);
    if (e.receivers.pairs)
        throw DataError("engine " + quote(name) + " takes no receivers that are pairs");
    Run one(run);
    if (program == Program::oases) return oast_field(one, e, options);
    const double reach_km = e.receivers.range_m.back() / 1000;
    const bool is_scooter = program == Program::scooter;
    one.feed(
        write_kraken(e, options, phase_speeds(program, e), is_scooter ? 4 * reach_km : reach_km));
    if (is_scooter) {
        if (options.sum != pg::Sum::coherent)
            throw DataError("scooter adds coherently alone (--sum coherent)");
        const ShdFile grn = read_result(name, one.result_of(name, {}, "grn"));
        check_size(name, e, grn.receiver_depth_m.size(), e.receivers.range_m.size());
        return field_of(e, options, transform_green(grn, e.receivers.range_m));
    }
    one.result_of(name, {}, "mod");
    const ShdFile shd = read_result("field", one.result_of("field", {}, "shd"));
    check_size("field", e, shd.receiver_depth_m.size(), shd.range_m.size());
    return field_of(e, options, shd.pressure);
}

std::vector<pg::ReceiverArrivals> external_arrivals(Program program, const pg::Environment& given,
                                                    const pg::FieldOptions& options,
                                                    const ExternalRun& run) {
    const std::string name = name_of(program);
    if (!is_bellhop(program)) throw DataError("engine " + quote(name) + " knows no arrivals");
    const Ordered ordered(given);
    const pg::Environment& e = ordered.environment;
    Run one(run);
    one.feed(write_bellhop(e, options, true));
    const std::string text = one.result_of(name, options_of(program, run), "arr");
    ArrFile arr;
    try {
        arr = read_arr(text, e.receivers.pairs);
    } catch (const DataError& fault) {
        throw DataError(name + ": its result is not as it should be: " + fault.what());
    }
    check_size(name, e, arr.receiver_depth_m.size(), arr.range_m.size());
    for (pg::ReceiverArrivals& receiver : arr.receivers)
        std::sort(receiver.arrivals.begin(), receiver.arrivals.end(),
                  [](const auto& a, const auto& b) { return a.delay_s < b.delay_s; });
    ordered.restore(arr.receivers);
    return std::move(arr.receivers);
}

}  // namespace seautils::toolbox
