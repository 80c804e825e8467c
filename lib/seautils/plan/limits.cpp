#include "seautils/plan/limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace seautils::plan {

namespace {

/// The deepest allowed depth, but for bands.
double floor_m(const Limits& limits, const Situation& s) {
    double most = limits.most_depth_m;
    if (s.water_depth_m) return std::min(most, *s.water_depth_m - limits.least_altitude_m);
    return limits.least_altitude_m > 0 ? std::min(most, s.depth_m) : most;
}

/// The best point so far.
struct Best {
    std::optional<double> depth_m;
    double utility = 0;

    void look_at(double depth, double u, double own_m) {
        if (std::isnan(u) || (depth_m && !is_better(depth, u, own_m))) return;
        depth_m = depth;
        utility = u;
    }
    bool is_better(double depth, double u, double own_m) const {
        if (u != utility) return u > utility;
        const double far = std::abs(depth - own_m), farther = std::abs(*depth_m - own_m);
        return far != farther ? far < farther : depth < *depth_m;
    }
};

Best best_of(const Objective& o, const DepthBand& band, double own_m) {
    Best best;
    const bool reaches =
        !o.depth_m.empty() && band.from_m <= o.depth_m.back() && band.to_m >= o.depth_m.front();
    if (!reaches) return best;
    for (std::size_t k = 0; k < o.depth_m.size(); ++k)
        if (o.depth_m[k] >= band.from_m && o.depth_m[k] <= band.to_m)
            best.look_at(o.depth_m[k], o.utility[k], own_m);
    for (const double end : {band.from_m, band.to_m})
        if (end > o.depth_m.front() && end < o.depth_m.back())
            best.look_at(end, utility_at(o, end), own_m);
    return best;
}

void cut(std::vector<DepthBand>& allowed, const DepthBand& band) {
    std::vector<DepthBand> rest;
    for (const DepthBand& a : allowed) {
        if (band.to_m <= a.from_m || band.from_m >= a.to_m) {
            rest.push_back(a);
            continue;
        }
        if (a.from_m <= band.from_m) rest.push_back({a.from_m, band.from_m});
        if (a.to_m >= band.to_m) rest.push_back({band.to_m, a.to_m});
    }
    allowed = std::move(rest);
}

}  // namespace

std::string_view name(Limit limit) {
    static constexpr std::array<std::string_view, 5> names = {
        "least_depth", "most_depth", "least_altitude", "excluded_band", "water_depth_unknown"};
    return names[static_cast<std::size_t>(limit)];
}

std::vector<DepthBand> allowed_depths(const Limits& limits, const Situation& situation) {
    const double deepest_m = floor_m(limits, situation);
    if (!(limits.least_depth_m <= deepest_m)) return {};
    std::vector<DepthBand> allowed{{limits.least_depth_m, deepest_m}};
    for (const DepthBand& band : limits.excluded) cut(allowed, band);
    return allowed;
}

std::vector<Limit> forbidden_by(const Limits& limits, const Situation& s, double depth_m) {
    std::vector<Limit> all;
    if (depth_m < limits.least_depth_m) all.push_back(Limit::least_depth);
    if (depth_m > limits.most_depth_m) all.push_back(Limit::most_depth);
    if (s.water_depth_m && depth_m > *s.water_depth_m - limits.least_altitude_m)
        all.push_back(Limit::least_altitude);
    if (std::any_of(limits.excluded.begin(), limits.excluded.end(), [&](const DepthBand& band) {
            return depth_m > band.from_m && depth_m < band.to_m;
        }))
        all.push_back(Limit::excluded_band);
    if (!s.water_depth_m && limits.least_altitude_m > 0 && depth_m > s.depth_m)
        all.push_back(Limit::water_depth_unknown);
    return all;
}

std::optional<double> nearest_allowed(const std::vector<DepthBand>& allowed, double depth_m) {
    std::optional<double> nearest;
    for (const DepthBand& band : allowed) {
        const double there = std::clamp(depth_m, band.from_m, band.to_m);
        if (!nearest || std::abs(there - depth_m) < std::abs(*nearest - depth_m)) nearest = there;
    }
    return nearest;
}

Choice choose_depth(const Objective& objective, const Limits& limits, const Situation& situation) {
    const double own_m = situation.depth_m;
    Choice choice;
    choice.utility = std::numeric_limits<double>::quiet_NaN();
    const Best free = best_of(objective, {0, std::numeric_limits<double>::infinity()}, own_m);
    choice.free_depth_m = free.depth_m;
    choice.bound_by = forbidden_by(limits, situation, free.depth_m.value_or(own_m));
    const auto allowed = allowed_depths(limits, situation);
    Best best;
    for (const DepthBand& band : allowed) {
        const Best here = best_of(objective, band, own_m);
        if (here.depth_m) best.look_at(*here.depth_m, here.utility, own_m);
    }
    if (best.depth_m) {
        choice.depth_m = best.depth_m;
        choice.utility = best.utility;
    } else if (const auto now = forbidden_by(limits, situation, own_m); !now.empty()) {
        choice.depth_m = nearest_allowed(allowed, own_m);
        choice.bound_by = now;
    }
    return choice;
}

}  // namespace seautils::plan
