#include "seautils/plan/max_snr_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace seautils::plan {

namespace {

bool is_allowed(const std::vector<DepthBand>& allowed, double depth_m) {
    return std::any_of(allowed.begin(), allowed.end(), [&](const DepthBand& band) {
        return depth_m >= band.from_m && depth_m <= band.to_m;
    });
}

/// Two sections in a row, exact for values that are straight between depths: with slope s and C, D what they are behind by at
/// the upper end, the first is x - s L + C e^(-z/L), the second x - 2 s L + (D + C z/L) e^(-z/L).
void smooth(const std::vector<double>& depth_m, std::vector<double>& column_db, double length_m) {
    if (length_m <= 0) return;
    bool started = false;
    double first = 0, second = 0, last_x = 0, last_m = 0;
    for (std::size_t k = 0; k < column_db.size(); ++k) {
        const double x = column_db[k];
        if (std::isnan(x)) continue;
        const double steps = (depth_m[k] - last_m) / length_m;
        if (!started) {
            first = second = x;
        } else if (steps > 1e-9) {
            const double e = std::exp(-steps);
            const double rise = (x - last_x) / steps;  // s L
            const double c = first - last_x + rise, d = second - last_x + 2 * rise;
            first = x - rise + c * e;
            second = x - 2 * rise + (d + c * steps) * e;
        }
        started = true;
        last_x = x;
        last_m = depth_m[k];
        column_db[k] = second;
    }
}

/// Fields, and what does not depend on range: one column after another.
class Columns {
public:
    Columns(std::span<const LossField> fields, std::vector<double> rest, const SnrOptions& options)
        : fields_(fields), rest_(std::move(rest)), options_(options) {}

    double last_range_m() const {
        double last = 0;
        for (const LossField& field : fields_) last = std::max(last, field.range_m.back());
        return last;
    }

    void add(double range_m, SnrForecast& forecast) const {
        std::vector<std::vector<double>> each;
        std::vector<double> loss_db, at_depth(fields_.size());
        for (const LossField& field : fields_) each.push_back(losses(field, range_m));
        for (std::size_t k = 0; k < rest_.size(); ++k) {
            for (std::size_t i = 0; i < each.size(); ++i) at_depth[i] = each[i][k];
            loss_db.push_back(loss_of_mean_db(at_depth));
        }
        forecast.snr_db.push_back(smoothed(loss_db));
        forecast.deviation_db.emplace_back(rest_.size(), 0.0);
        if (fields_.size() < 2) return;
        for (std::vector<double>& one : each) one = smoothed(one);
        for (std::size_t k = 0; k < rest_.size(); ++k) {
            for (std::size_t i = 0; i < each.size(); ++i) at_depth[i] = each[i][k];
            forecast.deviation_db.back()[k] = deviation_db(at_depth, HUGE_VAL);
        }
    }

private:
    /// Nearer than the field begins its first range counts.
    std::vector<double> losses(const LossField& field, double range_m) const {
        std::vector<double> all;
        for (std::size_t k = 0; k < rest_.size(); ++k)
            all.push_back(loss_at_db(field, k, std::max(range_m, field.range_m.front())));
        return all;
    }

    std::vector<double> smoothed(const std::vector<double>& loss_db) const {
        std::vector<double> s(rest_.size(), not_known);
        for (std::size_t k = 0; k < s.size(); ++k)
            if (!std::isnan(loss_db[k]))
                s[k] = rest_[k] -
                       options_.signal_weight * std::min(loss_db[k], options_.worst_loss_db);
        smooth(fields_.front().depth_m, s, options_.smoothing_m);
        return s;
    }

    std::span<const LossField> fields_;
    std::vector<double> rest_;
    const SnrOptions& options_;
};

/// The way to the best depth at a time.
struct Way {
    std::size_t time = 0;
    Choice choice;
    double climb = HUGE_VAL;  ///< sine of the pitch; above 1: it cannot be reached
};

class Decider {
public:
    Decider(const SnrForecast& forecast, const Limits& limits, const Situation& situation,
            double speed_mps, const SnrOptions& options, std::span<const Objective> others)
        : forecast_(forecast),
          limits_(limits),
          situation_(situation),
          allowed_(allowed_depths(limits, situation)),
          speed_mps_(speed_mps),
          options_(options),
          others_(others) {}

    SnrDecision decide() const {
        const Choice now = choice_at(0);
        if (!now.depth_m || std::isnan(now.utility)) return forced(now);
        const auto ahead =
            static_cast<std::size_t>(std::ceil(options_.short_horizon_s / options_.step_s));
        if (is_good_here(now))
            return towards(way_to(std::min(ahead, forecast_.time_s.size() - 1)), SnrRule::follow);
        Way least;
        for (std::size_t k = 1; k < forecast_.time_s.size(); ++k)
            if (const Way way = way_to(k); way.climb < least.climb) least = way;
        if (!std::isfinite(least.climb)) return {SnrRule::none, 0, std::nullopt, 0, now};
        return towards(least, SnrRule::approach);
    }

private:
    Objective objective_at(std::size_t time) const {
        Objective own = forecast_.objective(time, allowed_);
        own.weight = options_.weight;
        return combined(own, others_);
    }
    Choice choice_at(std::size_t time) const {
        return choose_depth(objective_at(time), limits_, situation_);
    }

    /// Limits that the vehicle has left count even where nothing is known.
    static SnrDecision forced(const Choice& now) { return {SnrRule::none, 0, now.depth_m, 0, now}; }

    bool is_good_here(const Choice& now) const {
        if (!is_allowed(allowed_, situation_.depth_m)) return false;
        if (std::abs(situation_.depth_m - *now.depth_m) < options_.near_m) return true;
        const double here = utility_at(objective_at(0), situation_.depth_m);
        return here >= (1 - options_.near_best) * now.utility;
    }

    Way way_to(std::size_t time) const {
        Way way{time, choice_at(time), HUGE_VAL};
        if (!way.choice.depth_m || std::isnan(way.choice.utility)) return way;
        const double rise_m = std::abs(*way.choice.depth_m - situation_.depth_m);
        const double path_m = speed_mps_ * forecast_.time_s[time];
        way.climb = path_m > 0 ? rise_m / path_m : rise_m > 0 ? HUGE_VAL : 0;
        return way;
    }

    SnrDecision towards(const Way& way, SnrRule rule) const {
        const double most = std::sin(options_.most_pitch_deg * std::numbers::pi / 180);
        SnrDecision d{rule, way.time, way.choice.depth_m, 0, way.choice};
        if (!d.depth_m) return {SnrRule::none, way.time, std::nullopt, 0, way.choice};
        if (way.climb > most && rule == SnrRule::approach) d.rule = SnrRule::steepest;
        const double size = std::asin(std::min(way.climb, most)) * 180 / std::numbers::pi;
        d.pitch_deg = *d.depth_m < situation_.depth_m ? -size : size;
        return d;
    }

    const SnrForecast& forecast_;
    const Limits& limits_;
    const Situation& situation_;
    std::vector<DepthBand> allowed_;
    double speed_mps_;
    const SnrOptions& options_;
    std::span<const Objective> others_;
};

}  // namespace

std::string_view name(SnrRule rule) {
    static constexpr std::array<std::string_view, 4> names = {"follow", "approach", "steepest",
                                                              "none"};
    return names[static_cast<std::size_t>(rule)];
}

Objective SnrForecast::objective(std::size_t time, const std::vector<DepthBand>& allowed) const {
    Objective o{.name = "snr", .weight = 1, .depth_m = depth_m, .utility = snr_db[time]};
    double least = HUGE_VAL, most = -HUGE_VAL;
    std::vector<bool> counts;
    for (std::size_t k = 0; k < depth_m.size(); ++k) {
        counts.push_back(is_allowed(allowed, depth_m[k]));
        if (std::isnan(o.utility[k]) || !counts.back()) continue;
        least = std::min(least, o.utility[k]);
        most = std::max(most, o.utility[k]);
    }
    const double span = most - least;
    for (double& u : o.utility) {
        if (std::isnan(u)) continue;
        u = span > 0 ? std::max((u - least) / span, 0.0) : 1.0;
    }
    blend(o, deviation_db[time], uncertainty, counts);
    return o;
}

SnrForecast forecast_snr(std::span<const LossField> fields, double range_m, double range_rate_mps,
                         const std::function<double(double)>& noise_db,
                         const std::function<double(double)>& gain_db, const SnrOptions& options) {
    check_depths(fields);
    SnrForecast forecast{.depth_m = fields.front().depth_m,
                         .time_s = {},
                         .range_m = {},
                         .snr_db = {},
                         .deviation_db = {},
                         .uncertainty = {options.uncertainty_db, options.smoothing_m}};
    std::vector<double> rest;
    for (const double z : forecast.depth_m)
        rest.push_back(options.gain_weight * gain_db(z) - options.noise_weight * noise_db(z));
    const Columns columns(fields, std::move(rest), options);
    for (std::size_t n = 0; static_cast<double>(n) * options.step_s <= options.horizon_s; ++n) {
        const double t = static_cast<double>(n) * options.step_s;
        const double r = std::max(range_m + range_rate_mps * t, 0.0);
        if (n > 0 && r > columns.last_range_m()) continue;
        forecast.time_s.push_back(t);
        forecast.range_m.push_back(r);
        columns.add(r, forecast);
    }
    return forecast;
}

SnrDecision decide(const SnrForecast& forecast, const Limits& limits, const Situation& situation,
                   double speed_mps, const SnrOptions& options, std::span<const Objective> others) {
    return Decider(forecast, limits, situation, speed_mps, options, others).decide();
}

}  // namespace seautils::plan
