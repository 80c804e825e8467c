#ifndef SEAUTILS_PROPAGATION_RAY_BEAM_HPP
#define SEAUTILS_PROPAGATION_RAY_BEAM_HPP

#include "seautils/propagation/ray_tracer.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace seautils::propagation {

/// What a ray has gathered where a leg begins: all of it.
struct BeamState {
    double range_m = 0, delay_s = 0, length_m = 0;
    double p = 1, q = 0;  ///< the Acoustics Toolbox's: q = c0·s where c is constant
    double amplitude = 1, phase_rad = 0;
    std::uint32_t surface_bounces = 0, bottom_bounces = 0, caustics = 0;
};

/// The same of a ray whose delay is not wanted: its legs have none.
struct UntimedState : BeamState {};

/// A ray ends after so many legs, whatever the world; of a large fan, when its share of
/// `most_legs_of_fan` is used up.
inline constexpr std::uint64_t least_legs = 20'000, most_legs = 200'000;
inline constexpr std::uint64_t most_legs_of_fan = 2'000'000'000;

inline std::uint64_t legs_of_ray(std::size_t beams) {
    return std::clamp<std::uint64_t>(most_legs_of_fan / (beams + 1), least_legs, most_legs);
}

/// Adds to a leg what its wall does.
void finish(const RaySea& sea, Leg& leg);

/// Of a source on a wall, the ray that would leave the water begins as its reflection: a leg without length.
/// @pre tracer.touch_at_launch() is a wall
Leg leg_at_launch(const RaySea& sea, const RayTracer& tracer);

inline void pass(const Leg& leg, BeamState& state) {
    const double q = state.q + state.p * leg.whole.spread;
    if ((state.q > 0 && q <= 0) || (state.q < 0 && q >= 0)) ++state.caustics;
    state.q = q;
    state.p += leg.kick * q;
    state.range_m += leg.whole.along_m;
    state.delay_s += leg.whole.delay_s;
    state.length_m += leg.whole.length_m;
    if (leg.touch == Touch::none) return;
    state.amplitude *= leg.magnitude;
    state.phase_rad += leg.phase_rad;
    ++(leg.touch == Touch::surface ? state.surface_bounces : state.bottom_bounces);
}

/// Where nothing depends on range: which of the legs that it came by a ray that met a wall or
/// turned goes back by, until it is where it began.
class WayBack {
public:
    bool goes_on() const { return back_; }
    /// Among those of the ray. @pre goes_on()
    const Leg& leg(const std::vector<Leg>& legs) const { return legs[end_ - 1]; }
    /// The kth leg is this one.
    void add(std::size_t k, const Leg& leg) {
        if (back_) {
            --end_;
        } else {
            const bool touched = leg.touch != Touch::none;
            back_ = touched || leg.sine * leg.whole.sine < 0;
            end_ = touched ? k + 1 : k;  // the leg on which it turns is its own image
        }
        if (!back_ || end_ > first_) return;
        back_ = false;
        first_ = k + 1;
    }

private:
    std::size_t first_ = 0, end_ = 0;  ///< of the legs not gone back by
    bool back_ = false;
};

/// Legs of one ray; where the sea is periodic, of its first cycle, again and again.
class BeamWalk {
public:
    /// @param legs  after which a ray ends
    BeamWalk(const RaySea& sea, std::uint64_t legs) : sea_(sea), legs_of_ray_(legs) {}

    /// Legs walked by all rays, and rays that ended for their number.
    std::uint64_t legs() const { return legs_; }
    std::uint64_t cut() const { return cut_; }

    /// Calls visit(leg, state) for each leg up to `stop_m` in range, with the state at its
    /// beginning; the leg's own range_m counts within the cycle. The ray ends there, when visit
    /// returns false, or when its amplitude is below `least_amplitude`.
    template <class State, class Visit>
    void run(double launch_rad, double stop_m, double least_amplitude, Visit&& visit) {
        RayTracer tracer(sea_, launch_rad, stop_m, std::is_same_v<State, BeamState>);
        State state;
        if (tracer.touch_at_launch() != Touch::none) pass(leg_at_launch(sea_, tracer), state);
        std::uint64_t left = legs_of_ray_;
        const auto step = [&](const Leg& leg) {
            ++legs_;
            if (!visit(leg, std::as_const(state))) return false;
            pass(leg, state);
            if (--left == 0) ++cut_;
            return state.amplitude >= least_amplitude && state.range_m < stop_m && left > 0;
        };
        std::size_t known = 0;
        bool whole = false;
        WayBack back;
        while (!whole) {
            if (known == room_.size()) room_.emplace_back();
            Leg& leg = room_[known];
            if (!(back.goes_on() ? tracer.next(leg, back.leg(room_)) : tracer.next(leg))) return;
            finish(sea_, leg);
            if (!step(leg)) return;
            if (!sea_.periodic) continue;
            back.add(known++, leg);
            whole = tracer.at_start();
        }
        for (std::size_t k = 0; step(room_[k]); k = k + 1 < known ? k + 1 : 0) {
        }
    }

private:
    const RaySea& sea_;
    std::uint64_t legs_of_ray_, legs_ = 0, cut_ = 0;
    std::vector<Leg> room_;  // of a cycle: its legs come first
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_BEAM_HPP
