#ifndef SEAUTILS_PROPAGATION_RAY_BEAM_HPP
#define SEAUTILS_PROPAGATION_RAY_BEAM_HPP

#include "seautils/propagation/ray_tracer.hpp"

#include <cstdint>
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

/// Only what an intensity needs.
struct EnergyState {
    double range_m = 0, length_m = 0, p = 1, q = 0;
    double amplitude = 1;  ///< left by the walls
    double fade = 1;       ///< of intensity, by the water
};

/// A ray stops after so many legs, whatever the world.
inline constexpr std::uint64_t most_legs = 200'000;

/// Adds to a leg what its wall does and what follows from its whole.
void finish(const RaySea& sea, Leg& leg);

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

inline void pass(const Leg& leg, EnergyState& state) {
    state.q += state.p * leg.whole.spread;
    state.p += leg.kick * state.q;
    state.range_m += leg.whole.along_m;
    state.length_m += leg.whole.length_m;
    state.amplitude *= leg.magnitude;
    state.fade *= leg.fade;
}

/// Legs of one ray; where the sea is periodic, of its first cycle, again and again.
class BeamWalk {
public:
    explicit BeamWalk(const RaySea& sea) : sea_(sea) {}

    /// Calls visit(leg, state) for each leg up to `stop_m` in range, with the state at its beginning; the leg's own
    /// range_m counts within the cycle. The ray ends there, when visit returns false, or when its amplitude is below
    /// `least_amplitude`.
    template <class State, class Visit>
    void run(double launch_rad, double stop_m, double least_amplitude, Visit&& visit) {
        RayTracer tracer(sea_, launch_rad, stop_m);
        State state;
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
            finish(sea_, leg);
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
    /// A source on a wall: the ray that would leave the water begins as its reflection.
    template <class State>
    void launch(const RayTracer& tracer, State& state) const {
        if (tracer.touch_at_launch() == Touch::none) return;
        Leg leg;
        leg.touch = tracer.touch_at_launch();
        leg.grazing_sine = tracer.grazing_sine_at_launch();
        leg.speed_mps = sea_.source_speed_mps;
        finish(sea_, leg);
        pass(leg, state);
    }

    const RaySea& sea_;
    std::vector<Leg> cycle_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_BEAM_HPP
