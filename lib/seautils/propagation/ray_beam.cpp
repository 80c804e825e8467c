#include "seautils/propagation/ray_beam.hpp"

#include "seautils/propagation/reflection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

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

}  // namespace

void finish(const RaySea& sea, Leg& leg) {
    if (leg.touch != Touch::none) bounce(sea, leg);
    const double along_m = leg.whole.along_m;
    leg.length_per_m = along_m == 0 ? 0 : leg.whole.length_m / along_m;
    leg.spread_per_m = along_m == 0 ? 0 : leg.whole.spread / along_m;
    leg.fade = sea.absorption_np_per_m == 0
                   ? 1
                   : std::exp(-2 * sea.absorption_np_per_m * leg.whole.length_m);
}

}  // namespace seautils::propagation
