#include "seautils/propagation/ray_beam.hpp"

#include "seautils/propagation/reflection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

void bounce(const RaySea& sea, Leg& leg) {
    const auto& wall = leg.touch == Touch::surface ? sea.surface : sea.bottom;
    if (wall.boundary.is_free()) {
        leg.phase_rad = std::numbers::pi;
        return;
    }
    const double speed_mps = leg.speed_mps + leg.range_gradient * leg.whole.along_m +
                             leg.depth_gradient * leg.whole.down_m;
    const auto r = reflection_coefficient(wall.boundary, wall.slices, sea.frequency_hz,
                                          std::asin(std::min(1., leg.grazing_sine)), speed_mps,
                                          sea.density_gcm3);
    leg.magnitude = std::abs(r);
    leg.phase_rad = std::arg(r);
}

}  // namespace

void finish(const RaySea& sea, Leg& leg) {
    if (leg.touch != Touch::none) bounce(sea, leg);
}

Leg leg_at_launch(const RaySea& sea, const RayTracer& tracer) {
    Leg leg;
    leg.touch = tracer.touch_at_launch();
    leg.grazing_sine = tracer.grazing_sine_at_launch();
    leg.speed_mps = sea.source_speed_mps;
    finish(sea, leg);
    return leg;
}

}  // namespace seautils::propagation
