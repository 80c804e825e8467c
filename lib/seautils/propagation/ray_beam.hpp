#ifndef SEAUTILS_PROPAGATION_RAY_BEAM_HPP
#define SEAUTILS_PROPAGATION_RAY_BEAM_HPP

#include "seautils/propagation/ray_tracer.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace seautils::propagation {

/// What a ray has gathered where a leg begins.
struct BeamState {
    double range_m = 0, delay_s = 0, length_m = 0;
    double p = 1, q = 0;  ///< the Acoustics Toolbox's: q = c0·s where c is constant
    double amplitude = 1, phase_rad = 0;
    std::uint32_t surface_bounces = 0, bottom_bounces = 0, caustics = 0;
};

/// A ray stops after so many legs, whatever the world.
inline constexpr std::uint64_t most_legs = 200'000;

/// Multiplies a state by what a wall does.
void bounce(const RaySea& sea, Leg& leg);

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

/// Legs of one ray, and of its first cycle where the sea is periodic.
class BeamWalk {
public:
    explicit BeamWalk(const RaySea& sea) : sea_(sea) {}

    /// Calls visit(leg, state) for each leg up to `stop_m` in range, with the state at its beginning; the leg's own
    /// range_m counts within the cycle. visit returns false to end the ray. It ends by itself when its amplitude is
    /// below `least_amplitude`.
    template <class Visit>
    void run(double launch_rad, double stop_m, double least_amplitude, Visit&& visit) {
        RayTracer tracer(sea_, launch_rad, stop_m);
        BeamState state;
        launch(tracer, state);
        cycle_.clear();
        std::uint64_t left = most_legs;
        const auto step = [&](const Leg& leg) {
            if (!visit(leg, std::as_const(state))) return false;
            pass(leg, state);
            return state.amplitude >= least_amplitude && state.range_m < stop_m && --left > 0;
        };
        Leg leg;
        bool whole = false;
        while (!whole && tracer.next(leg)) {
            if (leg.touch != Touch::none) bounce(sea_, leg);
            if (!step(leg)) return;
            if (!sea_.periodic) continue;
            cycle_.push_back(leg);
            whole = tracer.at_start();
        }
        while (whole)
            for (const auto& again : cycle_)
                if (!step(again)) return;
    }

private:
    void launch(const RayTracer& tracer, BeamState& state) const;

    const RaySea& sea_;
    std::vector<Leg> cycle_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_BEAM_HPP
