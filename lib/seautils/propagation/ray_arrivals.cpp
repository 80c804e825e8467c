#include "seautils/propagation/absorption.hpp"
#include "seautils/propagation/eigenrays.hpp"
#include "seautils/propagation/ray_fan.hpp"
#include "seautils/propagation/rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

constexpr double deg_per_rad = 180 / std::numbers::pi;
/// Ranges that one pass through the fan looks at.
constexpr std::size_t ranges_at_once = 16;

double turned_into_circle(double phase_deg) {
    const double rest = std::fmod(phase_deg, 360);
    return rest < 0 ? rest + 360 : rest;
}

Arrival arrival_of(const Probe& ray, const RaySea& sea, const Environment& environment) {
    const BeamState& state = ray.state;
    const double launch_deg = ray.launch_rad * deg_per_rad;
    const double q = std::max(std::abs(state.q), 1e-6);
    Arrival arrival;
    arrival.amplitude =
        level_at(environment.source.pattern, launch_deg) * state.amplitude *
        std::sqrt(std::abs(std::cos(ray.launch_rad)) * ray.speed_mps / (q * state.range_m));
    arrival.phase_deg = turned_into_circle(state.phase_rad * deg_per_rad + 90.0 * state.caustics);
    arrival.delay_s = state.delay_s;
    arrival.absorption_db = sea.absorption_np_per_m * db_per_neper * state.length_m;
    arrival.launch_deg = launch_deg;
    arrival.arrival_deg = std::atan2(ray.sine, ray.cosine) * deg_per_rad;
    arrival.surface_bounces = state.surface_bounces;
    arrival.bottom_bounces = state.bottom_bounces;
    arrival.caustics = state.caustics;
    return arrival;
}

bool baffled(const Probe& ray, const FieldOptions& options) {
    const double elevation_deg = std::asin(std::clamp(ray.sine, -1., 1.)) * deg_per_rad;
    return options.baffle_from_deg < options.baffle_to_deg &&
           elevation_deg >= options.baffle_from_deg && elevation_deg <= options.baffle_to_deg;
}

/// All rays of the fan at some ranges, and those between them that meet receivers.
class Arrivals {
public:
    Arrivals(const Environment& environment, const FieldOptions& options, const RaySea& sea)
        : environment_(environment),
          options_(options),
          sea_(sea),
          search_(sea, environment.receivers.depth_m, options.least_amplitude),
          fan_(make_bracketing_fan(environment, sea)) {}

    void find(std::size_t first, const std::vector<double>& range_m,
              std::vector<ReceiverArrivals>& out) {
        std::vector<Probe> last;
        for (const auto& launch : fan_) {
            auto now = search_.trace(launch.angle_rad, range_m);
            for (std::size_t j = 0; j < range_m.size() && !last.empty(); ++j)
                search_.between(last[j], now[j], range_m[j],
                                [&](std::size_t depth, const Probe& ray) {
                                    keep(ray, out[place(depth, first + j)]);
                                });
            last = std::move(now);
        }
    }

private:
    std::size_t place(std::size_t depth, std::size_t range) const {
        return depth * environment_.receivers.range_m.size() + range;
    }
    void keep(const Probe& ray, ReceiverArrivals& receiver) const {
        if (!ray.reached || baffled(ray, options_)) return;
        const Arrival arrival = arrival_of(ray, sea_, environment_);
        if (arrival.amplitude > 0) receiver.arrivals.push_back(arrival);
    }

    const Environment& environment_;
    const FieldOptions& options_;
    const RaySea& sea_;
    EigenraySearch search_;
    std::vector<Launch> fan_;
};

bool is_wet(const RaySea& sea, const ReceiverArrivals& receiver) {
    return receiver.depth_m >= sea.surface.depth_at(receiver.range_m) &&
           receiver.depth_m <= sea.bottom.depth_at(receiver.range_m);
}

}  // namespace

std::vector<ReceiverArrivals> ray_arrivals(const Environment& environment,
                                           const FieldOptions& options) {
    check(environment);
    std::vector<std::string> remarks;
    const RaySea sea = make_ray_sea(environment, remarks);
    const auto& ranges = environment.receivers.range_m;
    std::vector<ReceiverArrivals> out;
    for (const double depth_m : environment.receivers.depth_m)
        for (const double range_m : ranges) out.push_back({depth_m, range_m, {}});
    Arrivals arrivals(environment, options, sea);
    std::size_t first = 0;
    while (first < ranges.size() && ranges[first] <= 0) ++first;
    for (; first < ranges.size(); first += ranges_at_once) {
        const auto end = std::min(first + ranges_at_once, ranges.size());
        arrivals.find(first, {ranges.data() + first, ranges.data() + end}, out);
    }
    for (auto& receiver : out) {
        if (!is_wet(sea, receiver)) receiver.arrivals.clear();
        std::sort(receiver.arrivals.begin(), receiver.arrivals.end(),
                  [](const Arrival& a, const Arrival& b) { return a.delay_s < b.delay_s; });
    }
    return out;
}

}  // namespace seautils::propagation
