// Decisions of depth-plan, written.
#ifndef SEAUTILS_TOOLS_DEPTH_RECORDS_HPP
#define SEAUTILS_TOOLS_DEPTH_RECORDS_HPP

#include "depth_schema.hpp"
#include "record_form.hpp"

#include "seautils/cli/io.hpp"
#include "seautils/core/time.hpp"
#include "seautils/plan/limits.hpp"
#include "seautils/plan/objective.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/number_text.hpp"

#include <cmath>
#include <optional>
#include <string>

namespace seautils::tools {

/// As in plan.proto.
enum class DepthRule : std::uint8_t { none, best, follow, approach, steepest, limit };

struct DepthDecision {
    std::int64_t time_ns = 0;
    DepthRule rule = DepthRule::none;
    std::string reason;
    double range_m = plan::not_known, range_rate_mps = plan::not_known;
    std::optional<plan::RangeWindow> window;
    double loss_db = plan::not_known, loss_limit_db = plan::not_known;
    std::optional<double> pitch_deg, ahead_s;
    plan::Choice choice{
        .depth_m = {}, .utility = plan::not_known, .free_depth_m = {}, .bound_by = {}};
    plan::Objective objective;  ///< no points: none
    bool stale = false;
};

class DecisionWriter {
public:
    explicit DecisionWriter(cli::Io& io) : io_(io) {}

    void write(const DepthDecision& d, const std::vector<plan::DepthBand>& allowed) {
        if (io_.format == "csv")
            write_row(d);
        else if (io_.format == "objective")
            write_objective(d, allowed);
        else
            write_record(d);
        io_.out.commit();
    }

private:
    void put(const schema::Values& values) { append_record(values, io_.format, io_.out.buffer()); }

    void write_record(const DepthDecision& d) {
        namespace f = field::decision;
        SlotWriter w(schema_.decision());
        w.time(f::time, d.time_ns);
        w.real(f::depth_m, d.choice.depth_m, 100);
        w.whole(f::rule, static_cast<std::uint64_t>(d.rule));
        w.text(f::reason, d.reason);
        w.real(f::utility, d.choice.utility, 1e6);
        w.real(f::range_m, d.range_m, 10);
        w.real(f::range_rate_mps, d.range_rate_mps, 1000);
        if (d.window) {
            w.real(f::window_from_m, d.window->from_m, 10);
            w.real(f::window_to_m, d.window->to_m, 10);
        }
        w.real(f::tl_db, d.loss_db, 100);
        w.real(f::loss_limit_db, d.loss_limit_db, 100);
        w.real(f::pitch_deg, d.pitch_deg, 100);
        w.real(f::ahead_s, d.ahead_s, 1000);
        if (!d.choice.bound_by.empty()) w.real(f::free_depth_m, d.choice.free_depth_m, 100);
        for (const plan::Limit limit : d.choice.bound_by) w.add_text(f::bound_by, name(limit));
        if (d.stale) w.whole(f::stale, 1);
        w.reals(f::curve_depth_m, d.objective.depth_m, 100);
        w.reals(f::curve_utility, d.objective.utility, 1e6);
        put(w.values());
    }

    /// Few points; nothing that is not allowed is of any use.
    void write_objective(const DepthDecision& d, const std::vector<plan::DepthBand>& allowed) {
        if (d.objective.depth_m.empty()) return;
        namespace f = field::objective;
        const plan::Objective few = simplified(within(d.objective, allowed), 0.005);
        SlotWriter w(schema_.objective());
        w.time(f::time, d.time_ns);
        w.text(f::name, few.name);
        w.real(f::weight, few.weight, 1e6);
        w.reals(f::depth_m, few.depth_m, 100);
        w.reals(f::utility, few.utility, 1e6);
        put(w.values());
    }

    /// Steps to nothing where what is allowed ends.
    static plan::Objective within(const plan::Objective& o,
                                  const std::vector<plan::DepthBand>& allowed) {
        plan::Objective part{.name = o.name, .weight = o.weight, .depth_m = {}, .utility = {}};
        const auto add = [&part](double depth_m, double utility) {
            part.depth_m.push_back(depth_m);
            part.utility.push_back(std::isnan(utility) ? 0 : std::min(utility, 1.0));
        };
        const double first_m = o.depth_m.front(), last_m = o.depth_m.back();
        const auto step = [&](double depth_m, double before, double behind) {
            // bands may touch: there is no step down and up again
            const bool touches = !part.depth_m.empty() && part.depth_m.back() >= depth_m;
            if (!touches) add(depth_m, before);
            add(depth_m, behind);
        };
        for (const plan::DepthBand& band : allowed) {
            const double from_m = std::max(band.from_m, first_m),
                         to_m = std::min(band.to_m, last_m);
            if (from_m >= to_m || (!part.depth_m.empty() && from_m <= part.depth_m.back()))
                continue;
            step(from_m, 0, utility_at(o, from_m));
            for (std::size_t k = 0; k < o.depth_m.size(); ++k)
                if (o.depth_m[k] > from_m && o.depth_m[k] < to_m) add(o.depth_m[k], o.utility[k]);
            step(to_m, utility_at(o, to_m), 0);
        }
        if (part.depth_m.empty()) add(first_m, 0);
        return part;
    }

    void write_row(const DepthDecision& d) {
        std::string& out = io_.out.buffer();
        if (!header_)
            out +=
                "time,depth_m,rule,utility,range_m,window_from_m,window_to_m,tl_db,pitch_deg,"
                "bound_by,stale\n";
        header_ = true;
        if (d.time_ns > 0) out += format_utc_ns(d.time_ns);
        cell(d.choice.depth_m, 100);
        out += ',';
        out += schema_.decision()
                   .fields[field::decision::rule]
                   .enumeration->values[static_cast<std::size_t>(d.rule)]
                   .name;
        cell(d.choice.utility, 1e6);
        cell(d.range_m, 10);
        cell(d.window ? d.window->from_m : plan::not_known, 10);
        cell(d.window ? d.window->to_m : plan::not_known, 10);
        cell(d.loss_db, 100);
        cell(d.pitch_deg, 100);
        out += ',';
        for (std::size_t k = 0; k < d.choice.bound_by.size(); ++k)
            out.append(k > 0 ? " " : "").append(name(d.choice.bound_by[k]));
        out += d.stale ? ",1\n" : ",0\n";
    }
    void cell(std::optional<double> x, double per) {
        std::string& out = io_.out.buffer();
        out += ',';
        if (x && !std::isnan(*x))
            schema::append_double(out, std::isfinite(*x) ? rounded(*x, per) : *x);
    }

    cli::Io& io_;
    DepthSchema schema_;
    bool header_ = false;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_RECORDS_HPP
