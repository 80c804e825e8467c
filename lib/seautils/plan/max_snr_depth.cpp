#include "seautils/plan/max_snr_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seautils::plan {

namespace {

bool is_allowed(const std::vector<DepthBand>& allowed, double depth_m) {
    return std::any_of(allowed.begin(), allowed.end(), [&](const DepthBand& band) {
        return depth_m >= band.from_m && depth_m <= band.to_m;
    });
}

/// Two sections, of ratios.
void smooth(const std::vector<double>& depth_m, std::vector<double>& column_db, double length_m) {
    if (length_m <= 0) return;
    for (double& x : column_db) x = std::pow(10, x / 10);
    for (int section = 0; section < 2; ++section) low_pass_down(depth_m, column_db, length_m);
    for (double& x : column_db) x = 10 * std::log10(x);
}

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
    for (std::size_t k = 0; k < depth_m.size(); ++k) {
        if (std::isnan(o.utility[k]) || !is_allowed(allowed, depth_m[k])) continue;
        least = std::min(least, o.utility[k]);
        most = std::max(most, o.utility[k]);
    }
    const double span = most - least;
    for (double& u : o.utility) {
        if (std::isnan(u)) continue;
        u = span > 0 ? std::max((u - least) / span, 0.0) : 1.0;
    }
    return o;
}

SnrForecast forecast_snr(const LossField& field, double range_m, double range_rate_mps,
                         const std::function<double(double)>& noise_db,
                         const std::function<double(double)>& gain_db, const SnrOptions& options) {
    SnrForecast forecast{.depth_m = field.depth_m, .time_s = {}, .range_m = {}, .snr_db = {}};
    std::vector<double> rest;  // what does not depend on range
    for (const double z : field.depth_m)
        rest.push_back(options.gain_weight * gain_db(z) - options.noise_weight * noise_db(z));
    const double first_m = field.range_m.front(), last_m = field.range_m.back();
    for (std::size_t n = 0; static_cast<double>(n) * options.step_s <= options.horizon_s; ++n) {
        const double t = static_cast<double>(n) * options.step_s;
        const double r = std::max(range_m + range_rate_mps * t, 0.0);
        if (n > 0 && r > last_m) continue;
        std::vector<double> column;
        for (std::size_t k = 0; k < rest.size(); ++k) {
            const double h = loss_at_db(field, k, std::max(r, first_m));
            column.push_back(rest[k] - options.signal_weight * std::min(h, options.worst_loss_db));
            if (std::isnan(h)) column.back() = not_known;
        }
        smooth(forecast.depth_m, column, options.smoothing_m);
        forecast.time_s.push_back(t);
        forecast.range_m.push_back(r);
        forecast.snr_db.push_back(std::move(column));
    }
    return forecast;
}

SnrDecision decide(const SnrForecast& forecast, const Limits& limits, const Situation& situation,
                   double speed_mps, const SnrOptions& options, std::span<const Objective> others) {
    return Decider(forecast, limits, situation, speed_mps, options, others).decide();
}

}  // namespace seautils::plan
