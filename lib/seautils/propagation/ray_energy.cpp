#include "seautils/propagation/ray_energy.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::propagation {
namespace {

EnergyLeg energy_leg(const Leg& leg) {
    const double along_m = leg.whole.along_m, length_m = leg.whole.length_m;
    const auto single = [](double x) { return static_cast<float>(x); };
    return {.along_m = leg.whole.along_m,
            .spread = leg.whole.spread,
            .kick = leg.kick,
            .length_m = single(leg.whole.length_m),
            .magnitude = single(leg.magnitude),
            .arc = {.length_per_m = single(along_m == 0 ? 0 : length_m / along_m),
                    .spread_per_m = single(along_m == 0 ? 0 : leg.whole.spread / along_m),
                    .depth_m = single(leg.depth_m),
                    .cosine = single(leg.cosine),
                    .sine = single(leg.sine),
                    .curvature = single(leg.curvature),
                    .speed_mps = single(leg.speed_mps),
                    .range_gradient = single(leg.range_gradient),
                    .depth_gradient = single(leg.depth_gradient)}};
}

}  // namespace

void EnergyCycle::append(const EnergyLeg& leg) {
    range_m += leg.along_m;
    length_m += double{leg.length_m};
    amplitude *= double{leg.magnitude};
    qq += pq * leg.spread;
    qp += pp * leg.spread;
    pq += leg.kick * qq;
    pp += leg.kick * qp;
}

EnergyCycle EnergyCycle::then(const EnergyCycle& next) const {
    return {.range_m = range_m + next.range_m,
            .length_m = length_m + next.length_m,
            .amplitude = amplitude * next.amplitude,
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
    arcs = std::move(other.arcs);
    so_far = std::move(other.so_far);
    end_m = std::move(other.end_m);
    marks = std::move(other.marks);
    return *this;
}

void KeptRay::forget() {
    tracer.reset();
    start = {};
    whole = false;
    arcs.clear();
    so_far.clear();
    end_m.clear();
    marks.clear();
}

void EnergyWalk::begin(KeptRay& ray, double launch_rad) const {
    ray.tracer.emplace(sea_, launch_rad, far_m, false);
    if (ray.tracer->touch_at_launch() != Touch::none)
        pass(energy_leg(leg_at_launch(sea_, *ray.tracer)), ray.start);
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
    EnergyLeg leg;
    if (!next(*ray.tracer, leg)) return false;
    ray.arcs.push_back(leg.arc);
    ray.so_far.push_back(ray.so_far.empty() ? EnergyCycle{} : ray.so_far.back());
    ray.so_far.back().append(leg);
    ray.end_m.push_back(ray.so_far.back().range_m);
    ray.whole = ray.tracer->at_start();
    return true;
}

/// The start of the cycle in which a range lies, the `least`th or a later one, or of the last that
/// may be walked. It does not hang on what was met before.
EnergyWalk::Place EnergyWalk::cycle_of(const KeptRay& ray, double range_m,
                                       std::uint64_t least) const {
    if (!ray.whole) return {ray.start, legs_of_ray_};
    const EnergyCycle& one = ray.so_far.back();
    const std::uint64_t size = ray.so_far.size(), most = legs_of_ray_ / size;
    const double wanted = std::floor(range_m / one.range_m);
    auto n = wanted < static_cast<double>(most) ? static_cast<std::uint64_t>(wanted) : most;
    if (n > 0 && static_cast<double>(n) * one.range_m > range_m) --n;
    n = std::max(n, least);
    EnergyCycle all = one.times(n);
    all.range_m = static_cast<double>(n) * one.range_m;
    return {all.after(ray.start), legs_of_ray_ - n * size, n};
}

/// To the leg on which the ray is at a range; false where it ends before: amplitudes only shrink.
bool EnergyWalk::go_to(KeptRay& ray, double range_m, Place& place) {
    for (;;) {
        const std::size_t known = std::min<std::uint64_t>(ray.end_m.size(), place.left);
        const double* end_m = ray.end_m.data();
        const double along_m = range_m - place.at.range_m;
        std::size_t leg = place.leg;
        while (leg < known && end_m[leg] < along_m) ++leg;
        place.leg = leg;
        const double left = leg == 0 ? 1 : ray.so_far[leg - 1].amplitude;
        if (place.at.amplitude * left < least_amplitude_) return false;
        if (leg < known) return true;
        if (leg == place.left) {
            ++cut_;
            return false;
        }
        if (ray.whole)
            place = cycle_of(ray, range_m, place.cycle + 1);
        else if (!extend(ray))
            return false;
    }
}

void EnergyWalk::mark(KeptRay& ray, const RayTracer& tracer, const EnergyState& state,
                      std::uint64_t left) const {
    if (mark_every_m_ == 0) return;
    const double last_m = ray.marks.empty() ? 0 : ray.marks.back().state.range_m;
    if (state.range_m < (std::floor(last_m / mark_every_m_) + 1) * mark_every_m_) return;
    ray.marks.push_back({tracer, state, left});
}

}  // namespace seautils::propagation
