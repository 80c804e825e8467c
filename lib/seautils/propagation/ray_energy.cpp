#include "seautils/propagation/ray_energy.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::propagation {
namespace {

EnergyLeg energy_leg(const RaySea& sea, const Leg& leg) {
    const double along_m = leg.whole.along_m, length_m = leg.whole.length_m;
    const double fade =
        sea.absorption_np_per_m == 0 ? 1 : std::exp(-2 * sea.absorption_np_per_m * length_m);
    const auto single = [](double x) { return static_cast<float>(x); };
    return {.along_m = leg.whole.along_m,
            .spread = leg.whole.spread,
            .kick = leg.kick,
            .length_m = single(leg.whole.length_m),
            .magnitude = single(leg.magnitude),
            .fade = single(fade),
            .length_per_m = single(along_m == 0 ? 0 : length_m / along_m),
            .spread_per_m = single(along_m == 0 ? 0 : leg.whole.spread / along_m),
            .depth_m = single(leg.depth_m),
            .cosine = single(leg.cosine),
            .sine = single(leg.sine),
            .curvature = single(leg.curvature),
            .speed_mps = single(leg.speed_mps),
            .range_gradient = single(leg.range_gradient),
            .depth_gradient = single(leg.depth_gradient)};
}

}  // namespace

EnergyState EnergyCycle::after(const EnergyState& start) const {
    return {.range_m = start.range_m + range_m,
            .length_m = start.length_m + length_m,
            .p = pq * start.q + pp * start.p,
            .q = qq * start.q + qp * start.p,
            .amplitude = start.amplitude * amplitude,
            .fade = start.fade * fade};
}

void EnergyCycle::append(const EnergyLeg& leg) {
    range_m += leg.along_m;
    length_m += double{leg.length_m};
    amplitude *= double{leg.magnitude};
    fade *= double{leg.fade};
    qq += pq * leg.spread;
    qp += pp * leg.spread;
    pq += leg.kick * qq;
    pp += leg.kick * qp;
}

EnergyCycle EnergyCycle::then(const EnergyCycle& next) const {
    return {.range_m = range_m + next.range_m,
            .length_m = length_m + next.length_m,
            .amplitude = amplitude * next.amplitude,
            .fade = fade * next.fade,
            .qq = next.qq * qq + next.qp * pq,
            .qp = next.qq * qp + next.qp * pp,
            .pq = next.pq * qq + next.pp * pq,
            .pp = next.pq * qp + next.pp * pp};
}

EnergyCycle EnergyCycle::times(std::uint64_t n) const {
    EnergyCycle all, power = *this;
    for (; n > 0; n /= 2) {
        if (n % 2 == 1) all = all.then(power);
        if (n > 1) power = power.then(power);
    }
    return all;
}

KeptRay& KeptRay::operator=(KeptRay&& other) noexcept {
    tracer.reset();
    if (other.tracer) tracer.emplace(*other.tracer);
    start = other.start;
    whole = other.whole;
    legs = std::move(other.legs);
    cycle = other.cycle;
    so_far = std::move(other.so_far);
    marks = std::move(other.marks);
    return *this;
}

void KeptRay::forget() {
    tracer.reset();
    start = {};
    whole = false;
    legs.clear();
    cycle = {};
    so_far.clear();
    marks.clear();
}

void EnergyWalk::begin(KeptRay& ray, double launch_rad) const {
    ray.tracer.emplace(sea_, launch_rad, far_m, false);
    if (ray.tracer->touch_at_launch() != Touch::none)
        pass(energy_leg(sea_, leg_at_launch(sea_, *ray.tracer)), ray.start);
}

bool EnergyWalk::next(RayTracer& tracer, EnergyLeg& out) const {
    Leg leg;
    if (!tracer.next(leg)) return false;
    finish(sea_, leg);
    out = energy_leg(sea_, leg);
    return true;
}

/// One leg more of the first cycle.
bool EnergyWalk::extend(KeptRay& ray) const {
    if (!next(*ray.tracer, ray.legs.emplace_back())) {
        ray.legs.pop_back();
        return false;
    }
    ray.cycle.append(ray.legs.back());
    if (ray.legs.size() % stride == 0) ray.so_far.push_back(ray.cycle);
    ray.whole = ray.tracer->at_start();
    return true;
}

bool EnergyWalk::ends(const Way& way) {
    if (way.left == 0) ++cut_;
    return way.left == 0 || way.state.amplitude < least_amplitude_ || way.state.range_m >= stop_m_;
}

/// Over the cycles that end before the first range, and over legs that do.
/// @return whether the ray goes on
bool EnergyWalk::jump(const KeptRay& ray, Way& way) {
    if (ray.legs.empty()) return true;
    const EnergyCycle& one = ray.cycle;
    const std::uint64_t size = ray.legs.size(), most = legs_of_ray_ / size;
    const double wanted = ray.whole ? std::floor(first_m_ / one.range_m) : 0;
    auto n = wanted < static_cast<double>(most) ? static_cast<std::uint64_t>(wanted) : most;
    if (n > 0 && static_cast<double>(n) * one.range_m > first_m_) --n;
    if (way.state.range_m > 0 && n == 0) return true;  // it has come here leg by leg
    EnergyCycle all = one.times(n);
    all.range_m = static_cast<double>(n) * one.range_m;
    way = {all.after(ray.start), legs_of_ray_ - n * size};
    way.at_cycle = way.state;
    if (way.left > 0) skip(ray, way);
    return !ends(way);
}

/// Over the eights of legs of this cycle that end before the first range.
void EnergyWalk::skip(const KeptRay& ray, Way& way) const {
    std::size_t k = 0;
    while (k < ray.so_far.size() && way.at_cycle.range_m + ray.so_far[k].range_m < first_m_) ++k;
    if (k == 0 || k * stride >= std::min<std::uint64_t>(way.left, ray.legs.size())) return;
    way.leg = k * stride;
    way.left -= way.leg;
    way.state = ray.so_far[k - 1].after(way.at_cycle);
}

void EnergyWalk::mark(KeptRay& ray, const RayTracer& tracer, const Way& way) const {
    if (mark_every_m_ == 0) return;
    const double last_m = ray.marks.empty() ? 0 : ray.marks.back().state.range_m;
    if (way.state.range_m < (std::floor(last_m / mark_every_m_) + 1) * mark_every_m_) return;
    ray.marks.push_back({tracer, way.state, way.left});
}

}  // namespace seautils::propagation
