#include "seautils/propagation/ray_beam.hpp"
#include "seautils/propagation/rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

constexpr std::size_t most_points = 20'000;
/// The picture's width over the longest way between two points.
constexpr double points_over_width = 400;

void add_point(RayPath& path, double range_m, double depth_m) {
    path.range_m.push_back(range_m);
    path.depth_m.push_back(depth_m);
}

/// Points behind the beginning of a leg, up to its end or the stop.
void add_leg(RayPath& path, const Leg& leg, double begin_m, double stop_m) {
    const double along_m = std::min(leg.whole.along_m, stop_m - begin_m);
    const double points = std::ceil(std::abs(along_m) * points_over_width / stop_m);
    for (double k = 1; k < points; ++k) {
        const double to_m = along_m * k / points;
        add_point(path, begin_m + to_m, leg.depth_m + leg.part(to_m).down_m);
    }
    const double down_m = along_m < leg.whole.along_m ? leg.part(along_m).down_m : leg.whole.down_m;
    add_point(path, begin_m + along_m, leg.depth_m + down_m);
}

}  // namespace

std::vector<RayPath> ray_paths(const Environment& environment, const FieldOptions& options,
                               std::size_t count) {
    check(environment);
    std::vector<std::string> remarks;
    const RaySea sea = make_ray_sea(environment, remarks);
    const double stop_m = std::max(environment.receivers.range_m.back(), 1.0);
    BeamWalk walk(sea, most_points);
    std::vector<RayPath> paths(count);
    for (std::size_t k = 0; k < count; ++k) {
        RayPath& path = paths[k];
        const double share =
            count == 1 ? 0.5 : static_cast<double>(k) / static_cast<double>(count - 1);
        path.launch_deg = std::lerp(environment.fan.least_deg, environment.fan.most_deg, share);
        add_point(path, 0, sea.source_depth_m);
        walk.run<UntimedState>(path.launch_deg * std::numbers::pi / 180, stop_m,
                               options.least_amplitude,
                               [&](const Leg& leg, const BeamState& state) {
                                   add_leg(path, leg, state.range_m, stop_m);
                                   return path.range_m.size() < most_points;
                               });
    }
    return paths;
}

}  // namespace seautils::propagation
