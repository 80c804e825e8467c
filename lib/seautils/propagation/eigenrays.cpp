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

/// The same bounces, q of one sign, and the step in depth that q lets expect.
bool EigenraySearch::runs_one_way(const Probe& a, const Probe& b) const {
    if (!a.same_history(b) || (a.state.q > 0) != (b.state.q > 0)) return false;
    const double expected_m =
        0.5 * (a.metres_per_rad(sea_.source_speed_mps) + b.metres_per_rad(sea_.source_speed_mps)) *
        (b.launch_rad - a.launch_rad);
    const double step_m = std::abs(b.depth_m - a.depth_m);
    return step_m > 0.6 * expected_m && step_m < 1.6 * expected_m;
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
    if (halvings > 0 && !runs_one_way(a, b)) {
        const Probe middle = probe(0.5 * (a.launch_rad + b.launch_rad), range_m);
        split(a, middle, range_m, halvings - 1);
        split(middle, b, range_m, halvings - 1);
        return;
    }
    if (!a.same_history(b)) return;
    const double least_m = std::min(a.depth_m, b.depth_m), most_m = std::max(a.depth_m, b.depth_m);
    auto depth = std::lower_bound(depth_m_.begin(), depth_m_.end(), least_m);
    for (; depth != depth_m_.end() && *depth <= most_m; ++depth)
        if (*depth != b.depth_m)  // that is met in the next interval
            brackets_.push_back({a, b, static_cast<std::size_t>(depth - depth_m_.begin())});
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

Probe EigenraySearch::refine(const Bracket& bracket, double range_m) {
    const double depth_m = depth_m_[bracket.depth];
    Probe from = bracket.a, to = bracket.b, at = bracket.a;
    if (from.depth_m == depth_m) return probe(from.launch_rad, range_m);
    const double way = to.depth_m > from.depth_m ? 1 : -1;
    for (int k = 0; k < 40; ++k) {
        at = probe(launch_for(from, to, depth_m), range_m);
        const double short_m = way * (depth_m - at.depth_m);
        const double step_rad = short_m / at.metres_per_rad(sea_.source_speed_mps);
        if (!at.reached || std::abs(short_m) < 1e-7) break;
        if (step_on(at, from, to, depth_m - at.depth_m, step_rad)) break;
        (short_m > 0 ? from : to) = at;
        if (to.launch_rad - from.launch_rad < 1e-15) break;
    }
    return at;
}

}  // namespace seautils::propagation
