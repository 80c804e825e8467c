#include "seautils/propagation/ray_fan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace seautils::propagation {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180;

}  // namespace

double level_at(const std::vector<PatternPoint>& pattern, double angle_deg) {
    const auto amplitude = [](const PatternPoint& p) { return std::pow(10, p.level_db / 20); };
    if (pattern.empty()) return 1;
    const auto above =
        std::upper_bound(pattern.begin(), pattern.end(), angle_deg,
                         [](double angle, const PatternPoint& p) { return angle < p.angle_deg; });
    if (above == pattern.begin()) return amplitude(pattern.front());
    if (above == pattern.end()) return amplitude(pattern.back());
    const auto& below = *(above - 1);
    const double part = (angle_deg - below.angle_deg) / (above->angle_deg - below.angle_deg);
    return amplitude(below) + (amplitude(*above) - amplitude(below)) * part;
}

std::vector<Launch> make_fan(const Environment& environment, const RaySea&, const FieldOptions&) {
    const auto& fan = environment.fan;
    static const double A0 = getenv("A0") ? atof(getenv("A0")) : 0;
    std::vector<Launch> out;
    const std::uint32_t beams = fan.beams ? fan.beams : 2000;
    if (A0 > 0) {
        const double u0 = std::asinh(fan.least_deg / A0), u1 = std::asinh(fan.most_deg / A0),
                     h = (u1 - u0) / beams;
        for (std::uint32_t k = 0; k < beams; ++k) {
            const double u = u0 + (k + 0.5) * h, a = A0 * std::sinh(u);
            out.push_back({a * rad_per_deg, A0 * std::cosh(u) * h * rad_per_deg,
                           level_at(environment.source.pattern, a)});
        }
        return out;
    }
    const double spacing_deg = (fan.most_deg - fan.least_deg) / std::max(1U, beams - 1);
    for (std::uint32_t k = 0; k < beams; ++k) {
        const double angle_deg = fan.least_deg + spacing_deg * k;
        out.push_back({angle_deg * rad_per_deg, spacing_deg * rad_per_deg,
                       level_at(environment.source.pattern, angle_deg)});
    }
    return out;
}

BeamKind beam_kind(const Environment&, const FieldOptions& options) {
    static const double GS = getenv("GS") ? atof(getenv("GS")) : 1;
    static const bool FOLD = getenv("FOLD");
    BeamKind kind{options.sum,
                  options.beam,
                  options.least_amplitude,
                  std::sin(options.baffle_from_deg * rad_per_deg),
                  std::sin(options.baffle_to_deg * rad_per_deg),
                  GS,
                  FOLD};
    return kind;
}

}  // namespace seautils::propagation
