// Answers of tl-model: records, grids and lists of arrivals.
#ifndef SEAUTILS_TOOLS_TL_ANSWER_HPP
#define SEAUTILS_TOOLS_TL_ANSWER_HPP

#include "tl_request.hpp"
#include "tl_schema.hpp"

#include "seautils/propagation/absorption.hpp"
#include "seautils/propagation/engine.hpp"
#include "seautils/propagation/spread.hpp"
#include "seautils/schema/number_text.hpp"
#include "seautils/schema/values.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace seautils::tools {

/// What became of a task.
struct TlResult {
    std::shared_ptr<const TlTask> task;  ///< none where the request could not be read
    std::string error;                   ///< else all is well
    pg::Field field;
    std::vector<pg::ReceiverArrivals> arrivals;
};

inline std::string_view name_of(pg::Sum sum) {
    static constexpr std::string_view names[] = {"coherent", "semicoherent", "incoherent"};
    return names[static_cast<std::size_t>(sum)];
}
inline std::string_view name_of(pg::Beam beam) {
    return beam == pg::Beam::gaussian ? "gaussian" : "hat";
}
/// A loss in dB with two decimals; nothing where there is none.
inline void append_hundredths(std::string& out, float db) {
    if (!std::isnan(db)) schema::append_fixed(out, double{db}, 2);
}

/// Losses at pairs: a row for each, in their order.
inline void append_pairs_csv(const pg::Receivers& receivers, const std::vector<float>& loss_db,
                             std::string& out) {
    out += "range_m,depth_m,loss_db\n";
    for (std::size_t k = 0; k < loss_db.size(); ++k) {
        schema::append_double(out, receivers.range_m[k]);
        out += ',';
        schema::append_double(out, receivers.depth_m[k]);
        out += ',';
        append_hundredths(out, loss_db[k]);
        out += '\n';
    }
}

/// Losses as a table: ranges in the first row, depths in the first column; two decimals, `inf` where there is no energy,
/// and an empty cell where there is no value.
inline void append_csv(const pg::Receivers& receivers, const std::vector<float>& loss_db,
                       std::string& out) {
    if (receivers.pairs) return append_pairs_csv(receivers, loss_db, out);
    out += "depth_m\\range_m";
    for (const double range_m : receivers.range_m) {
        out += ',';
        schema::append_double(out, range_m);
    }
    out += '\n';
    const float* loss = loss_db.data();
    for (const double depth_m : receivers.depth_m) {
        schema::append_double(out, depth_m);
        for (std::size_t k = 0; k < receivers.range_m.size(); ++k, ++loss) {
            out += ',';
            append_hundredths(out, *loss);
        }
        out += '\n';
    }
}

/// One line for each receiver, its paths as rows of numbers.
class TlArrivalLines {
public:
    explicit TlArrivalLines(double frequency_hz)
        : per_db_s_(-std::numbers::ln10 / 20 / (2 * std::numbers::pi * frequency_hz)) {}

    void append(const pg::ReceiverArrivals& receiver, std::string& out) const {
        out += "{\"engine\":\"rays\",\"depth_m\":";
        schema::append_double(out, receiver.depth_m);
        out += ",\"range_m\":";
        schema::append_double(out, receiver.range_m);
        out +=
            ",\"columns\":[\"amplitude\",\"phase_deg\",\"delay_s\",\"delay_imag_s\","
            "\"launch_deg\",\"arrival_deg\",\"n_surface\",\"n_bottom\",\"n_caustic\"],"
            "\"arrivals\":[";
        const char* comma = "";
        for (const pg::Arrival& a : receiver.arrivals) {
            out += comma;
            fmt::format_to(std::back_inserter(out), "[{:.7g},", a.amplitude);
            schema::append_fixed(out, a.phase_deg, 4);
            out += ',';
            schema::append_fixed(out, a.delay_s, 10);
            fmt::format_to(std::back_inserter(out), ",{:.7g},", a.absorption_db * per_db_s_ + 0.0);
            schema::append_fixed(out, a.launch_deg, 6);
            out += ',';
            schema::append_fixed(out, a.arrival_deg, 6);
            for (const std::uint32_t n : {a.surface_bounces, a.bottom_bounces, a.caustics}) {
                out += ',';
                schema::append_integer(out, std::uint64_t{n});
            }
            out += ']';
            comma = ",";
        }
        out += "]}\n";
    }

private:
    double per_db_s_;  ///< imaginary delay that a decibel of absorption is written as
};

/// Slots into which an answer is put.
class TlAnswerWriter {
public:
    /// The answer as slots, until the next call.
    /// @throws DataError  more than a record can hold
    const schema::Values& put(const TlResult& result) {
        values_.reset(schema_.answer());
        if (result.task && result.task->id) whole(field::answer::id, *result.task->id);
        if (!result.error.empty()) {
            values_.set_text(field::answer::error, result.error);
            return values_;
        }
        const TlTask& task = *result.task;
        if (!task.loss && !task.arrivals) return values_;
        if (task.loss) {
            reals(field::answer::depth_m, task.environment.receivers.depth_m);
            reals(field::answer::range_m, task.environment.receivers.range_m);
            losses(result.field.loss_db);
            if (task.environment.receivers.pairs) {
                values_[field::answer::pairs].i = 1;
                values_[field::answer::pairs].present = true;
            }
            if (task.levels) levels(task, result.field.loss_db);
        }
        for (const pg::ReceiverArrivals& receiver : result.arrivals) paths(receiver);
        basis(task, result.field.basis);
        real(field::answer::source_depth_m, task.environment.source.depth_m);
        return values_;
    }

private:
    void real(std::uint32_t slot, double x) {
        values_[slot].d = x;
        values_[slot].present = true;
    }
    void whole(std::uint32_t slot, std::uint64_t x) {
        values_[slot].u = x;
        values_[slot].present = true;
    }

    template <class List, class Get>
    void list(std::uint32_t slot, const List& all, Get get) {
        if (all.empty()) return;
        const auto n = static_cast<std::uint32_t>(all.size());
        const std::uint32_t first = values_.add_elements(slot, n);
        for (std::uint32_t k = 0; k < n; ++k) {
            if constexpr (std::is_integral_v<decltype(get(all[k]))>)
                whole(first + k, get(all[k]));
            else
                real(first + k, get(all[k]));
        }
    }
    void reals(std::uint32_t slot, const std::vector<double>& all) {
        list(slot, all, [](double x) { return x; });
    }
    /// To hundredths: the nearest binary32 number.
    static double hundredths(double x) {
        return static_cast<double>(static_cast<float>(std::round(x * 100) / 100));
    }
    void losses(const std::vector<float>& all) {
        list(field::answer::tl_db, all, [](float x) { return hundredths(double{x}); });
    }

    void levels(const TlTask& task, const std::vector<float>& loss_db) {
        const pg::Environment& e = task.environment;
        const pg::SonarLevels levels = task.levels->in(e);
        std::vector<double> snr_db(loss_db.size());
        for (std::size_t k = 0; k < snr_db.size(); ++k)
            snr_db[k] = signal_to_noise_db(levels, double{loss_db[k]}, e.receivers.depth_at_m(k));
        list(field::answer::snr_db, snr_db, hundredths);
        if (const auto& least = task.levels->threshold_db)
            list(field::answer::signal_excess_db, snr_db,
                 [&](double x) { return hundredths(x - *least); });
        real(field::answer::noise_in_band_db, noise_in_band_db(levels, 0));
        if (const auto depth_m = TlLevels::critical_depth_of(e))
            real(field::answer::critical_depth_m, *depth_m);
    }

    void paths(const pg::ReceiverArrivals& receiver) {
        namespace f = field::paths;
        const std::uint32_t element = values_.append_element(field::answer::arrivals);
        const std::uint32_t block =
            values_.add_block(element, *schema_.answer().fields[field::answer::arrivals].message);
        real(block + f::depth_m, receiver.depth_m);
        real(block + f::range_m, receiver.range_m);
        const auto& all = receiver.arrivals;
        using pg::Arrival;
        list(block + f::amplitude, all, [](const Arrival& a) { return a.amplitude; });
        list(block + f::phase_deg, all, [](const Arrival& a) { return a.phase_deg; });
        list(block + f::delay_s, all, [](const Arrival& a) { return a.delay_s; });
        list(block + f::absorption_db, all, [](const Arrival& a) { return a.absorption_db; });
        list(block + f::launch_deg, all, [](const Arrival& a) { return a.launch_deg; });
        list(block + f::arrival_deg, all, [](const Arrival& a) { return a.arrival_deg; });
        list(block + f::surface_bounces, all, [](const Arrival& a) { return a.surface_bounces; });
        list(block + f::bottom_bounces, all, [](const Arrival& a) { return a.bottom_bounces; });
        list(block + f::caustics, all, [](const Arrival& a) { return a.caustics; });
        if (!all.empty()) spread(block, pg::spread_of(all));
    }

    void spread(std::uint32_t block, const pg::Spread& s) {
        namespace f = field::paths;
        if (!std::isfinite(s.rms_delay_s)) return;  // all of them are silent
        real(block + f::delay_spread_s, s.rms_delay_s);
        real(block + f::mean_delay_s, s.mean_delay_s);
        real(block + f::peak_to_mean_db, s.peak_to_mean_db);
        whole(block + f::within_20db, s.within_20db);
        real(block + f::span_10db_s, s.span_10db_s);
        real(block + f::span_20db_s, s.span_20db_s);
    }

    void basis(const TlTask& task, const pg::Basis& b) {
        namespace f = field::basis;
        const std::uint32_t block = values_.add_block(
            field::answer::basis, *schema_.answer().fields[field::answer::basis].message);
        const auto text = [&](std::uint32_t at, std::string_view what) {
            if (!what.empty()) values_.set_text(block + at, what);
        };
        text(f::engine, task.program.empty() ? pg::name(b.engine) : std::string_view(task.program));
        text(f::why, b.why);
        text(f::sum, name_of(task.options.sum));
        if (b.engine == pg::Engine::rays) text(f::beam, name_of(task.options.beam));
        const pg::Absorption& absorption = task.environment.water.absorption;
        const pg::AbsorptionRate rate = absorption_rate(absorption, task.environment.frequency_hz);
        text(f::absorption, pg::name(absorption.model));
        real(block + f::absorption_db_per_km, rate.db_per_km);
        if (b.beams > 0) whole(block + f::beams, b.beams);
        if (b.modes > 0) whole(block + f::modes, b.modes);
        if (b.estimated_error_db > 0) real(block + f::estimated_error_db, b.estimated_error_db);
        const auto say = [&](std::string_view remark) {
            values_.set_text(values_.append_element(block + f::remark), remark);
        };
        for (const std::string& remark : b.remarks) say(remark);
        if (rate.extrapolated) say("absorption is extrapolated: outside the range of its formula");
    }

    TlSchema schema_;
    schema::Values values_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_ANSWER_HPP
