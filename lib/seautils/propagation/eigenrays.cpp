#include "seautils/propagation/eigenrays.hpp"

#include "seautils/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace seautils::propagation {
namespace {

/// The ray where a leg has come to a range.
Probe probe_on(const Leg& leg, const BeamState& state, double launch_rad, double range_m) {
    const Advance at = leg.part(range_m - state.range_m);
    Probe probe;
    probe.launch_rad = launch_rad;
    probe.reached = true;
    probe.depth_m = leg.depth_m + at.down_m;
    probe.sine = at.sine;
    probe.cosine = at.cosine;
    probe.speed_mps =
        leg.speed_mps + leg.range_gradient * at.along_m + leg.depth_gradient * at.down_m;
    probe.state = state;
    const double q = state.q + state.p * at.spread;
    if ((state.q > 0 && q <= 0) || (state.q < 0 && q >= 0)) ++probe.state.caustics;
    probe.state.q = q;
    probe.state.range_m = range_m;
    probe.state.delay_s += at.delay_s;
    probe.state.length_m += at.length_m;
    return probe;
}

/// The last step of a search is not traced again, where it is no longer than this …
constexpr double last_step_m = 0.02, last_step_rad = 1e-5;
/// … the front spreads over it by no more than this part, and its direction is known to this.
constexpr double last_growth = 0.01, last_doubt = 1e-6;

/// As a mirror at a depth shows it.
Probe mirrored(Probe ray, double mirror_m) {
    ray.depth_m = 2 * mirror_m - ray.depth_m;
    ray.sine = -ray.sine;
    return ray;
}

/// Changes of a ray's sine with its launch.
double turning(const Probe& a, const Probe& b) {
    return (b.sine - a.sine) / (b.launch_rad - a.launch_rad);
}

/// Goes that step: direction and spreading change over it as they do between the ends of the
/// bracket. False: it is too long.
bool step_on(Probe& at, const Probe& from, const Probe& to, double down_m, double step_rad) {
    const double width_rad = to.launch_rad - from.launch_rad;
    const double part = (at.launch_rad - from.launch_rad) / width_rad;
    const double before = turning(from, at), behind = turning(at, to);
    const double growth = (to.state.q - from.state.q) / width_rad * step_rad;
    const bool is_short = std::abs(down_m) <= last_step_m && std::abs(step_rad) <= last_step_rad &&
                          std::abs(growth) <= last_growth * std::abs(at.state.q) &&
                          std::abs((behind - before) * step_rad) <= last_doubt;
    if (!is_short) return false;
    const double turn = std::lerp(before, behind, part) * step_rad;
    at.state.delay_s += down_m * (at.sine + 0.5 * turn) / at.speed_mps;
    at.state.q += growth;
    at.launch_rad += step_rad;
    at.sine = std::clamp(at.sine + turn, -1., 1.);
    at.cosine = std::copysign(std::sqrt(1 - at.sine * at.sine), at.cosine);
    return true;
}

}  // namespace

EigenraySearch::EigenraySearch(const RaySea& sea, const std::vector<double>& depth_m,
                               double least_amplitude)
    : sea_(sea), depth_m_(depth_m), least_amplitude_(least_amplitude), walk_(sea, most_legs) {}

std::vector<Probe> EigenraySearch::trace(double launch_rad, const std::vector<double>& range_m) {
    count_probe();
    std::vector<Probe> out(range_m.size());
    std::size_t next = 0;
    walk_.run<UntimedState>(launch_rad, range_m.back(), least_amplitude_,
                            [&](const Leg& leg, const BeamState& state) {
                                const double end_m = state.range_m + leg.whole.along_m;
                                for (; next < range_m.size() && range_m[next] <= end_m; ++next)
                                    out[next] = probe_on(leg, state, launch_rad, range_m[next]);
                                return next < range_m.size();
                            });
    for (; next < range_m.size(); ++next) out[next].launch_rad = launch_rad;
    return out;
}

void EigenraySearch::count_probe() {
    if (walk_.legs() + 50 * ++probes_ > most_search)
        throw DataError("receivers.range_m: more paths lead there than can be found");
}

Probe EigenraySearch::probe(double launch_rad, double range_m) {
    count_probe();
    Probe out;
    out.launch_rad = launch_rad;
    walk_.run<BeamState>(launch_rad, range_m, least_amplitude_,
                         [&](const Leg& leg, const BeamState& state) {
                             if (state.range_m + leg.whole.along_m < range_m) return true;
                             out = probe_on(leg, state, launch_rad, range_m);
                             return false;
                         });
    return out;
}

/// q of one sign, and the step in depth that q lets expect, from `least` to `most` times.
bool EigenraySearch::runs_one_way(const Probe& a, const Probe& b, double least, double most) const {
    if ((a.state.q > 0) != (b.state.q > 0)) return false;
    const double expected_m =
        0.5 * (a.metres_per_rad(sea_.source_speed_mps) + b.metres_per_rad(sea_.source_speed_mps)) *
        (b.launch_rad - a.launch_rad);
    const double step_m = std::abs(b.depth_m - a.depth_m);
    return step_m > least * expected_m && step_m < most * expected_m;
}

/// The depth of the level wall that one of them has met once more than the other, if that is all:
/// the one comes from it, the other goes to it, and behind the mirror depth runs one way.
std::optional<double> EigenraySearch::mirror_between(const Probe& a, const Probe& b) const {
    if (!mirrors_ || !a.reached || !b.reached) return std::nullopt;
    const auto more = [](std::uint32_t x, std::uint32_t y) {
        return std::int64_t{x} - std::int64_t{y};
    };
    const auto at_surface = more(b.state.surface_bounces, a.state.surface_bounces);
    const auto at_bottom = more(b.state.bottom_bounces, a.state.bottom_bounces);
    if (std::abs(at_surface) + std::abs(at_bottom) != 1) return std::nullopt;
    const Wall& wall = at_surface != 0 ? sea_.surface : sea_.bottom;
    if (!wall.level) return std::nullopt;
    const Probe &before = at_surface + at_bottom > 0 ? a : b, &behind = &before == &a ? b : a;
    const double out = at_surface != 0 ? -1 : 1;
    if (out * before.sine <= 0 || out * behind.sine >= 0) return std::nullopt;
    return runs_one_way(a, mirrored(b, wall.depth_m), 0.8, 1.25) ? std::optional(wall.depth_m)
                                                                 : std::nullopt;
}

/// Depths between two rays reach no farther than their steepest change allows, with something to
/// spare.
bool EigenraySearch::may_hold_depth(const Probe& a, const Probe& b) const {
    if (!a.reached || !b.reached) return a.reached || b.reached;
    const double slack_m =
        2 * (b.launch_rad - a.launch_rad) *
        std::max(a.metres_per_rad(sea_.source_speed_mps), b.metres_per_rad(sea_.source_speed_mps));
    const double least_m = std::min(a.depth_m, b.depth_m) - slack_m;
    const double most_m = std::max(a.depth_m, b.depth_m) + slack_m;
    const auto first = std::lower_bound(depth_m_.begin(), depth_m_.end(), least_m);
    return first != depth_m_.end() && *first <= most_m;
}

void EigenraySearch::split(const Probe& a, const Probe& b, double range_m, int halvings) {
    if (!may_hold_depth(a, b)) return;
    const bool same = a.same_history(b);
    const auto mirror = same ? std::nullopt : mirror_between(a, b);
    if (halvings > 0 && !mirror && !(same && runs_one_way(a, b, 0.6, 1.6))) {
        const Probe middle = probe(0.5 * (a.launch_rad + b.launch_rad), range_m);
        split(a, middle, range_m, halvings - 1);
        split(middle, b, range_m, halvings - 1);
        return;
    }
    if (same) add_brackets(a, b, std::nullopt);
    if (mirror) add_brackets(a, mirrored(b, *mirror), mirror);
}

/// Of one depth, without mirrors.
void EigenraySearch::split_again(const Bracket& bracket, double range_m) {
    mirrors_ = false;
    only_ = bracket.depth;
    split(bracket.a, mirrored(bracket.b, *bracket.mirror), range_m, most_halvings);
    mirrors_ = true;
    only_.reset();
}

/// Depths that lie between those of two rays, and those whose mirror images do. One at the second
/// ray is met in the next interval.
void EigenraySearch::add_brackets(const Probe& a, const Probe& b, std::optional<double> mirror) {
    const double least_m = std::min(a.depth_m, b.depth_m), most_m = std::max(a.depth_m, b.depth_m);
    const auto add = [&](double from_m, double to_m, bool is_image) {
        auto depth = std::lower_bound(depth_m_.begin(), depth_m_.end(), from_m);
        for (; depth != depth_m_.end() && *depth <= to_m; ++depth) {
            const auto k = static_cast<std::size_t>(depth - depth_m_.begin());
            if (only_ && *only_ != k) continue;
            if (is_image && *depth == *mirror) continue;  // it is its own image
            const double target_m = is_image ? 2 * *mirror - *depth : *depth;
            if (target_m != b.depth_m) brackets_.push_back({a, b, k, mirror, target_m});
        }
    };
    add(least_m, most_m, false);
    if (mirror) add(2 * *mirror - most_m, 2 * *mirror - least_m, true);
}

/// The cubic through both ends of a bracket with the slopes that q gives there, launch over depth.
double EigenraySearch::launch_for(const Probe& from, const Probe& to, double depth_m) const {
    const double down_m = to.depth_m - from.depth_m, way = down_m > 0 ? 1 : -1;
    const double part = (depth_m - from.depth_m) / down_m, rest = 1 - part;
    const auto bend = [&](const Probe& end) {
        const double slope = way / std::max(end.metres_per_rad(sea_.source_speed_mps), 1e-9);
        return slope * down_m - (to.launch_rad - from.launch_rad);
    };
    const double launch_rad = std::lerp(from.launch_rad, to.launch_rad, part) +
                              part * rest * (rest * bend(from) - part * bend(to));
    const bool inside = launch_rad > from.launch_rad && launch_rad < to.launch_rad;
    return inside ? launch_rad : std::midpoint(from.launch_rad, to.launch_rad);
}

/// Nothing where no ray comes there: depth does not run one way behind the mirror after all.
std::optional<Probe> EigenraySearch::refine(const Bracket& bracket, double range_m) {
    const double depth_m = bracket.depth_m;
    Probe from = bracket.a, to = bracket.b, at = bracket.a;
    if (from.depth_m == depth_m) return probe(from.launch_rad, range_m);
    const double way = to.depth_m > from.depth_m ? 1 : -1;
    bool is_image = false;
    for (int k = 0; k < 40; ++k) {
        at = probe(launch_for(from, to, depth_m), range_m);
        is_image = bracket.mirror && at.reached && !at.same_history(bracket.a);
        if (is_image && !at.same_history(bracket.b)) return std::nullopt;
        if (is_image) at = mirrored(at, *bracket.mirror);
        const double short_m = way * (depth_m - at.depth_m);
        const double step_rad = short_m / at.metres_per_rad(sea_.source_speed_mps);
        if (!at.reached || std::abs(short_m) < 1e-7) break;
        if (step_on(at, from, to, depth_m - at.depth_m, step_rad)) break;
        (short_m > 0 ? from : to) = at;
        if (to.launch_rad - from.launch_rad < 1e-15) break;
    }
    if (bracket.mirror && (!at.reached || std::abs(depth_m - at.depth_m) > last_step_m))
        return std::nullopt;
    if (is_image) at = mirrored(at, *bracket.mirror);
    return at;
}

}  // namespace seautils::propagation
