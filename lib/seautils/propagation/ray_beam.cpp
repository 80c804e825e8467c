#include "seautils/propagation/ray_beam.hpp"

#include "seautils/propagation/reflection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {

void bounce(const RaySea& sea, Leg& leg) {
    const auto& wall = leg.touch == Touch::surface ? sea.surface : sea.bottom;
    if (wall.boundary.kind == BoundaryKind::vacuum && wall.boundary.roughness_m == 0) {
        leg.phase_rad = std::numbers::pi;
        return;
    }
    const double speed_mps = leg.speed_mps + leg.range_gradient * leg.whole.along_m +
                             leg.depth_gradient * leg.whole.down_m;
    const auto r = reflection_coefficient(wall.boundary, sea.frequency_hz,
                                          std::asin(std::min(1., leg.grazing_sine)), speed_mps,
                                          sea.density_gcm3);
    leg.magnitude = std::abs(r);
    leg.phase_rad = std::arg(r);
}

/// A source on a wall: the ray that would leave the water begins as its reflection.
void BeamWalk::launch(const RayTracer& tracer, BeamState& state) const {
    if (tracer.touch_at_launch() == Touch::none) return;
    Leg leg;
    leg.touch = tracer.touch_at_launch();
    leg.grazing_sine = tracer.grazing_sine_at_launch();
    leg.speed_mps = sea_.source_speed_mps;
    bounce(sea_, leg);
    pass(leg, state);
    state.q = 0;
}

}  // namespace seautils::propagation
