// States in, decisions out: depth-plan acomms and snr.
#ifndef SEAUTILS_TOOLS_DEPTH_SESSION_HPP
#define SEAUTILS_TOOLS_DEPTH_SESSION_HPP

#include "depth_options.hpp"
#include "depth_records.hpp"
#include "depth_state.hpp"
#include "depth_state_csv.hpp"

#include "seautils/cli/app.hpp"
#include "seautils/cli/io.hpp"
#include "seautils/schema/json.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::tools {

/// What both planners share: reading, what is known, and who decides. A planner has
///   window(range, rate), margin_m(window) and decide(DepthDecision&, …).
template <class Planner>
class DepthSession {
public:
    DepthSession(cli::Io& io, const DepthOptions& options, Planner& planner)
        : io_(io), options_(options), planner_(planner), sea_(options.sea), writer_(io) {}

    void run() {
        io_.for_each(cli::Framing::lines, [this](std::string_view line) { take(line); });
    }

private:
    /// The keys of the four kinds of records are no other's; in a text they would stand behind a backslash.
    void take(std::string_view line) {
        if (is_row(line)) {
            if (csv_.read(line, values_)) take_state();
            return;
        }
        const auto has = [&](std::string_view key) { return line.find(key) != line.npos; };
        if (has("\"utility\"")) return take_objective(line);
        if (has("\"tl_db\"")) return sea_.take_answer(line);
        if (has("\"sound_speed_mps\"")) return sea_.take_profile(line);
        reader_.read(line, schema_.state(), values_);
        take_state();
    }

    bool is_row(std::string_view line) const {
        if (io_.input_format != "auto") return io_.input_format == "csv";
        const std::size_t first = line.find_first_not_of(" \t");
        return first == line.npos || line[first] != '{';
    }

    void take_objective(std::string_view line) {
        namespace f = field::objective;
        reader_.read(line, schema_.objective(), values_);
        plan::Objective o;
        o.name = std::string(values_.text(values_[f::name]));
        if (values_[f::weight].present) o.weight = values_[f::weight].d;
        o.depth_m = list(f::depth_m);
        o.utility = list(f::utility);
        check(o);
        for (plan::Objective& other : others_)
            if (other.name == o.name) return void(other = std::move(o));
        if (others_.size() >= 100) throw DataError("more than 100 objectives");
        others_.push_back(std::move(o));
    }

    std::vector<double> list(std::uint32_t f) const {
        std::vector<double> all;
        const schema::Slot& slot = values_[f];
        for (std::uint32_t k = 0; slot.present && k < slot.aux; ++k)
            all.push_back(values_[static_cast<std::uint32_t>(slot.u) + k].d);
        return all;
    }

    void take_state() {
        const std::int64_t now_ns = time();
        known_.merge(values_, now_ns);
        const double since_s = static_cast<double>(now_ns - decided_ns_.value_or(0)) * 1e-9;
        if (decided_ns_ && since_s >= 0 && since_s < options_.every_s) return;
        decided_ns_ = now_ns;
        decide(now_ns);
    }

    /// The record's own; else the clock's.
    std::int64_t time() {
        const schema::Slot& slot = values_[field::state::time];
        if (!slot.present) return io_.clock.now_ns();
        const auto block = static_cast<std::uint32_t>(slot.u);
        constexpr std::int64_t last_s = 9'223'372'035;  // nanoseconds end in 2262
        const std::int64_t seconds = values_[block].i;
        if (seconds < 0 || seconds > last_s) throw DataError("time is outside 1970 to 2262");
        const std::int64_t ns = seconds * 1'000'000'000 + values_[block + 1].i;
        io_.clock.advance(ns);
        return ns;
    }

    void decide(std::int64_t now_ns) {
        DepthDecision d;
        d.time_ns = now_ns;
        std::string fault;
        plan_for(d, now_ns, fault);
        const plan::Situation situation{known_.depth_m.value_or(0), known_.water_depth_m};
        d.stale = sea_.is_stale();
        if (d.rule == DepthRule::none && known_.depth_m) obey_limits(d, situation);
        writer_.write(d, allowed_depths(options_.limits, situation));
        if (!fault.empty()) throw DataError(fault);
    }

    void plan_for(DepthDecision& d, std::int64_t now_ns, std::string& fault) {
        if (!known_.depth_m) return void(d.reason = "the own depth is not known");
        const auto where = known_.separation(now_ns, options_.most_age_s, d.reason);
        if (!where) return;
        d.range_m = where->range_m;
        d.range_rate_mps = where->range_rate_mps;
        d.window = planner_.window(*where);
        try {
            sea_.provide(need(*d.window), now_ns);
        } catch (const DataError& e) {
            fault = e.what();
        }
        if (sea_.fields().empty()) return void(d.reason = "no losses are known");
        const plan::Situation situation{*known_.depth_m, known_.water_depth_m};
        planner_.decide(d, sea_.fields(), situation, known_.speed_mps(), others_);
    }

    SeaNeed need(plan::RangeWindow window) const {
        return {.window = window,
                .margin_m = std::max(window.to_m - window.from_m, 10 * options_.range_step_m),
                .range_step_m = options_.range_step_m,
                .depth_step_m = options_.depth_step_m,
                .source_depth_m = known_.contact_depth_m,
                .water_depth_m = known_.water_depth_m};
    }

    /// Also where there is nothing to plan with.
    void obey_limits(DepthDecision& d, const plan::Situation& situation) const {
        if (d.choice.depth_m) return void(d.rule = DepthRule::limit);
        d.choice.bound_by = forbidden_by(options_.limits, situation, situation.depth_m);
        if (d.choice.bound_by.empty()) return;
        d.choice.depth_m =
            nearest_allowed(allowed_depths(options_.limits, situation), situation.depth_m);
        d.rule = d.choice.depth_m ? DepthRule::limit : DepthRule::none;
    }

    cli::Io& io_;
    const DepthOptions& options_;
    Planner& planner_;
    DepthSea sea_;
    DecisionWriter writer_;
    DepthKnown known_;
    std::vector<plan::Objective> others_;
    std::optional<std::int64_t> decided_ns_;
    DepthSchema schema_;
    schema::JsonReader reader_;
    DepthStateCsv csv_{schema_.state()};
    schema::Values values_;
};

/// How a choice reads for people, behind what it rests on.
inline std::string with_limits(std::string reason, const plan::Choice& choice) {
    if (choice.bound_by.empty() || !choice.free_depth_m) return reason;
    reason += fmt::format("; without limits {:.1f} m, forbidden by", *choice.free_depth_m);
    for (const plan::Limit limit : choice.bound_by) reason.append(" ").append(name(limit));
    return reason;
}

class AcommsPlanner {
public:
    explicit AcommsPlanner(const AcommsToolOptions& options) : options_(options) {}

    plan::RangeWindow window(const plan::Separation& where) const {
        return plan::range_window(where.range_m, where.range_rate_mps, options_.horizon_s);
    }

    void decide(DepthDecision& d, const std::vector<plan::LossField>& fields,
                const plan::Situation& situation, double /*speed_mps*/,
                const std::vector<plan::Objective>& others) const {
        plan::AcommsCurve curve = acomms_curve(fields, *d.window, options_.acomms);
        curve.objective.weight = options_.common.weight;
        d.loss_limit_db = curve.loss_limit_db;
        d.objective = combined(curve.objective, others);
        d.choice = choose_depth(d.objective, options_.common.limits, situation);
        if (!d.choice.depth_m || std::isnan(d.choice.utility)) {
            d.reason = curve.cover == plan::Cover::none
                           ? "the losses do not reach as far as the window"
                           : "no allowed depth has a loss in the window";
            return;
        }
        d.rule = DepthRule::best;
        const auto nearest = std::lower_bound(d.objective.depth_m.begin(),
                                              d.objective.depth_m.end(), *d.choice.depth_m) -
                             d.objective.depth_m.begin();
        d.loss_db = curve.loss_db[static_cast<std::size_t>(nearest)];
        d.reason = with_limits(
            fmt::format("highest utility over {:.0f} to {:.0f} m{}", d.window->from_m,
                        d.window->to_m,
                        curve.cover == plan::Cover::part ? ", part of which has no losses" : ""),
            d.choice);
    }

private:
    const AcommsToolOptions& options_;
};

class SnrPlanner {
public:
    explicit SnrPlanner(const SnrToolOptions& options) : options_(options) {}

    plan::RangeWindow window(const plan::Separation& where) const {
        return plan::range_window(where.range_m, where.range_rate_mps, options_.snr.horizon_s);
    }

    void decide(DepthDecision& d, const std::vector<plan::LossField>& fields,
                const plan::Situation& situation, double speed_mps,
                const std::vector<plan::Objective>& others) const {
        const plan::Limits& limits = options_.common.limits;
        const plan::SnrForecast forecast = forecast_snr(
            fields, d.range_m, d.range_rate_mps, [this](double z) { return options_.noise_db(z); },
            [this](double z) { return options_.gain_db(z); }, options_.snr);
        const plan::SnrDecision s =
            plan::decide(forecast, limits, situation, speed_mps, options_.snr, others);
        d.choice = s.choice;
        d.choice.depth_m = s.depth_m;
        plan::Objective own = forecast.objective(s.time, allowed_depths(limits, situation));
        own.weight = options_.common.weight;
        d.objective = combined(own, others);
        for (double& u : d.objective.utility) u = std::min(u, 1.0);
        if (s.rule == plan::SnrRule::none) {
            d.choice.utility = plan::not_known;
            d.reason = std::isnan(s.choice.utility) ? "no allowed depth has a loss at this range"
                                                    : "no depth ahead can be reached without speed";
            return;
        }
        d.rule = s.rule == plan::SnrRule::follow     ? DepthRule::follow
                 : s.rule == plan::SnrRule::approach ? DepthRule::approach
                                                     : DepthRule::steepest;
        d.pitch_deg = s.pitch_deg;
        d.ahead_s = forecast.time_s[s.time];
        d.loss_db = mean_loss_at_db(fields, *s.depth_m, forecast.range_m[s.time]);
        d.reason = with_limits(why(s, forecast), s.choice);
    }

private:
    static std::string why(const plan::SnrDecision& s, const plan::SnrForecast& forecast) {
        const double ahead_s = forecast.time_s[s.time], range_m = forecast.range_m[s.time];
        if (s.rule == plan::SnrRule::follow)
            return fmt::format("good here; best in {:.0f} s at {:.0f} m range", ahead_s, range_m);
        if (s.rule == plan::SnrRule::approach)
            return fmt::format("least pitch meets the best depth in {:.0f} s at {:.0f} m range",
                               ahead_s, range_m);
        return fmt::format("too steep; least so for the best depth in {:.0f} s at {:.0f} m range",
                           ahead_s, range_m);
    }

    const SnrToolOptions& options_;
};

template <class Options, class Planner>
int depth_main(int argc, char** argv, const char* name, const char* summary, const char* example) {
    Options options;
    cli::App app{name, summary, example, {.config = true, .clock = true}};
    app.input_formats({"auto", "csv", "ndjson"});
    app.output_formats({"ndjson", "csv", "delimited", "objective"});
    options.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) {
        options.settle();
        Planner planner(options);
        DepthSession<Planner>(io, options.common, planner).run();
    });
}

inline int acomms_main(int argc, char** argv) {
    return depth_main<AcommsToolOptions, AcommsPlanner>(
        argc, argv, "depth-plan acomms", "Plan the depth at which a modem is heard best.",
        "  depth-plan acomms --loss losses.csv --min-altitude 10 states.ndjson\n");
}
inline int snr_main(int argc, char** argv) {
    return depth_main<SnrToolOptions, SnrPlanner>(
        argc, argv, "depth-plan snr",
        "Plan the depth of the best signal-to-noise ratio, and the way there.",
        "  depth-plan snr --loss losses.csv --critical-depth 4000 states.ndjson\n");
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_SESSION_HPP
