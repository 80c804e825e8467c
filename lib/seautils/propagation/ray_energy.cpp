#include "seautils/propagation/ray_energy.hpp"

#include <algorithm>

namespace seautils::propagation {
namespace {

EnergyLeg energy_leg(const Leg& leg) {
    const auto single = [](double x) { return static_cast<float>(x); };
    return {.along_m = leg.whole.along_m,
            .spread = leg.whole.spread,
            .kick = leg.kick,
            .length_m = single(leg.whole.length_m),
            .magnitude = single(leg.magnitude),
            .fade = single(leg.fade),
            .length_per_m = single(leg.length_per_m),
            .spread_per_m = single(leg.spread_per_m),
            .depth_m = single(leg.depth_m),
            .cosine = single(leg.cosine),
            .sine = single(leg.sine),
            .curvature = single(leg.curvature),
            .speed_mps = single(leg.speed_mps),
            .range_gradient = single(leg.range_gradient),
            .depth_gradient = single(leg.depth_gradient)};
}

EnergyCycle cycle_of(const std::vector<EnergyLeg>& legs) {
    EnergyState a, b;
    a.p = 0;
    a.q = 1;
    for (const EnergyLeg& leg : legs) {
        pass(leg, a);
        pass(leg, b);
    }
    return {.range_m = b.range_m,
            .length_m = b.length_m,
            .amplitude = b.amplitude,
            .fade = b.fade,
            .qq = a.q,
            .qp = b.q,
            .pq = a.p,
            .pp = b.p};
}

}  // namespace

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
    marks = std::move(other.marks);
    return *this;
}

/// A source on a wall: the ray that would leave the water begins as its reflection.
void EnergyWalk::begin(KeptRay& ray, double launch_rad) const {
    ray.tracer.emplace(sea_, launch_rad, far_m, false);
    if (ray.tracer->touch_at_launch() == Touch::none) return;
    Leg leg;
    leg.touch = ray.tracer->touch_at_launch();
    leg.grazing_sine = ray.tracer->grazing_sine_at_launch();
    leg.speed_mps = sea_.source_speed_mps;
    finish(sea_, leg);
    pass(energy_leg(leg), ray.start);
}

bool EnergyWalk::next(RayTracer& tracer, EnergyLeg& out) const {
    Leg leg;
    if (!tracer.next(leg)) return false;
    finish(sea_, leg);
    out = energy_leg(leg);
    return true;
}

/// One leg more of the first cycle.
bool EnergyWalk::extend(KeptRay& ray) const {
    if (!next(*ray.tracer, ray.legs.emplace_back())) {
        ray.legs.pop_back();
        return false;
    }
    ray.whole = ray.tracer->at_start();
    if (ray.whole) ray.cycle = cycle_of(ray.legs);
    return true;
}

/// Over the cycles that end before the first range.
/// @return whether the ray goes on
bool EnergyWalk::jump(const KeptRay& ray, Way& way) {
    const EnergyCycle& one = ray.cycle;
    const std::uint64_t size = ray.legs.size(), most = legs_of_ray_ / size;
    const double wanted = std::floor(first_m_ / one.range_m);
    auto n = wanted < static_cast<double>(most) ? static_cast<std::uint64_t>(wanted) : most;
    if (n > 0 && static_cast<double>(n) * one.range_m > first_m_) --n;
    if (n == 0) return true;
    const EnergyCycle all = one.times(n);
    const EnergyState from = ray.start;
    way.state.range_m = static_cast<double>(n) * one.range_m;
    way.state.length_m = from.length_m + static_cast<double>(n) * one.length_m;
    way.state.q = all.qq * from.q + all.qp * from.p;
    way.state.p = all.pq * from.q + all.pp * from.p;
    way.state.amplitude = from.amplitude * all.amplitude;
    way.state.fade = from.fade * all.fade;
    way.left = legs_of_ray_ - n * size;
    if (way.state.amplitude < least_amplitude_) return false;
    if (way.left == 0) ++cut_;
    return way.left > 0;
}

void EnergyWalk::mark(KeptRay& ray, const RayTracer& tracer, const Way& way) const {
    if (mark_every_m_ == 0) return;
    const double last_m = ray.marks.empty() ? 0 : ray.marks.back().state.range_m;
    if (way.state.range_m < (std::floor(last_m / mark_every_m_) + 1) * mark_every_m_) return;
    ray.marks.push_back({tracer, way.state, way.left});
}

}  // namespace seautils::propagation
