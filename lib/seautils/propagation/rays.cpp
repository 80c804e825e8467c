#include "seautils/propagation/rays.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/beam_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace seautils::propagation {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180;

double level_at(const std::vector<PatternPoint>& pattern, double angle_deg) {
    const auto amplitude = [](const PatternPoint& p) { return std::pow(10, p.level_db / 20); };
    if (pattern.empty()) return 1;
    const auto above =
        std::upper_bound(pattern.begin(), pattern.end(), angle_deg,
                         [](double angle, const PatternPoint& p) { return angle < p.angle_deg; });
    if (above == pattern.begin()) return amplitude(pattern.front());
    if (above == pattern.end()) return amplitude(pattern.back());
    const auto& a = *(above - 1);
    const double part = (angle_deg - a.angle_deg) / (above->angle_deg - a.angle_deg);
    return amplitude(a) + (amplitude(*above) - amplitude(a)) * part;
}

}  // namespace

Field ray_field(const Environment& environment, const FieldOptions& options) {
    check(environment);
    Field field;
    const RaySea sea = make_ray_sea(environment, field.basis.remarks);
    const Columns columns(environment.receivers);
    const auto& fan = environment.fan;
    const std::uint32_t beams = fan.beams ? fan.beams : 2000;
    const double step_deg = (fan.most_deg - fan.least_deg) / (beams - 1);
    BeamKind kind{options.sum,
                  options.beam,
                  step_deg * rad_per_deg,
                  options.least_amplitude,
                  options.baffle_from_deg,
                  options.baffle_to_deg};
    BeamSum sum(sea, columns, kind);
    for (std::uint32_t k = 0; k < beams; ++k) {
        const double angle_deg = fan.least_deg + step_deg * k;
        sum.add(angle_deg * rad_per_deg, level_at(environment.source.pattern, angle_deg));
    }
    field.depths = environment.receivers.depth_m.size();
    field.ranges = environment.receivers.range_m.size();
    field.basis.beams = beams;
    field.loss_db.assign(field.depths * field.ranges, std::numeric_limits<float>::quiet_NaN());
    const std::size_t skipped = field.ranges - columns.range_m.size();
    for (std::size_t j = 0; j < columns.range_m.size(); ++j)
        for (std::size_t i = 0; i < field.depths; ++i) {
            const double z = environment.receivers.depth_m[i], r = columns.range_m[j];
            if (z > sea.bottom.depth_at(r) || z < sea.surface.depth_at(r)) continue;
            const std::size_t at = j * columns.stride + i;
            const double intensity =
                options.sum == Sum::coherent ? std::norm(sum.pressure()[at]) : sum.intensity()[at];
            field.loss_db[i * field.ranges + j + skipped] =
                static_cast<float>(-10 * std::log10(intensity));
        }
    return field;
}

std::vector<ReceiverArrivals> ray_arrivals(const Environment&, const FieldOptions&) {
    throw DataError("not there yet");
}

}  // namespace seautils::propagation
