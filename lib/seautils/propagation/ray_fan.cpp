#include "seautils/propagation/ray_fan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

constexpr double pi = std::numbers::pi, rad_per_deg = pi / 180;

/// An automatic fan's spacing grows from that of flat rays: by √2 at this angle, in proportion to
/// it beyond. Steep rays matter near the source, or have lost much to the bottom. Phases want all
/// rays close.
double flat_deg(const FieldOptions& options) { return options.sum == Sum::coherent ? 90 : 10; }
/// Spacing of flat rays over 100 m of water, chosen against beams ten times as many: 0.05 dB in the
/// median, 0.5 dB for 95 % of the cells. Deep water folds its rays more sharply.
constexpr double widest_rad = 0.0020, depth_power = -0.1;
/// Neighbours are no farther apart at the last receiver than this part of the depth: over many
/// bounces errors add up.
constexpr double depth_share = 0.2;
constexpr double narrowest_rad = 2e-4;
/// … or than this many least widths of a Gaussian beam: those blur what lies between.
constexpr double least_widths = 2.1;
/// Hats blur nothing: what folds rays shows.
constexpr double hat_share = 0.5;
constexpr double most_rad = 0.008;
/// Of the fringes of the source and its image in the surface, to a beam.
constexpr double fringe_share = 0.06, fringe_folds = 0.75;
/// Where the source is weak, beams stand up to this many times wider.
constexpr double weak_most = 2;

double least_depth_m(const RaySea& sea, double last_m) {
    const double above_m = sea.surface.depth_at(0);
    const double half_way_m = sea.bottom.depth_at(0.5 * last_m) - above_m;
    return std::clamp(half_way_m, 0.1 * (sea.bottom.depth_at(0) - above_m), 1e5);
}

/// As geometry wants it.
double folds_rad(const Environment& environment, const RaySea& sea) {
    const double last_m = reach_m(environment);
    const double depth_m = least_depth_m(sea, last_m);
    const double folds = widest_rad * std::pow(std::max(depth_m, 1.) / 100, depth_power);
    return std::min(folds, std::max(depth_share * depth_m / last_m, narrowest_rad));
}

double flat_spacing_rad(const Environment& environment, const RaySea& sea,
                        const FieldOptions& options) {
    const double last_m = reach_m(environment);
    const double wavelength_m = sea.source_speed_mps / sea.frequency_hz;
    const bool hat = options.beam == Beam::hat;
    const double waves = hat ? 0 : least_widths * pi * wavelength_m / last_m;
    const double finer = hat ? hat_share : options.sum == Sum::semi_coherent ? fringe_folds : 1;
    const double folds = finer * folds_rad(environment, sea);
    const double spacing = std::min(std::max(folds, waves), most_rad);
    if (options.sum == Sum::semi_coherent)
        return std::min(spacing, fringe_share * wavelength_m / std::max(sea.source_depth_m, 1e-3));
    if (options.sum == Sum::coherent)  // over a beam a plane front is off by little
        return std::min(spacing, 0.3 * std::sqrt(wavelength_m / (6 * last_m)));
    return spacing;
}

Launch launch_at(const Environment& environment, double angle_deg, double spacing_deg) {
    const double angle_rad = angle_deg * rad_per_deg;
    return {angle_rad, spacing_deg * rad_per_deg, level_at(environment.source.pattern, angle_deg),
            std::abs(std::cos(angle_rad))};
}

std::vector<Launch> even_fan(const Environment& environment) {
    const auto& fan = environment.fan;
    const double span_deg = fan.most_deg - fan.least_deg;
    const double spacing_deg = span_deg / std::max(1U, fan.beams - 1);
    std::vector<Launch> out;
    for (std::uint32_t k = 0; k < fan.beams; ++k)
        out.push_back(launch_at(environment, fan.least_deg + spacing_deg * k, spacing_deg));
    return out;
}

/// How much wider beams may stand in a direction.
double width_of_weak(const std::vector<PatternPoint>& pattern, double loudest_db,
                     double angle_deg) {
    const double level = level_at(pattern, angle_deg) / std::pow(10, loudest_db / 20);
    return std::min(weak_most, 1 / std::sqrt(std::max(level, 1e-3)));
}

/// Angles flat·sinh(u), evenly in u, or in a measure of u that is less where the source is weak.
class FlatFan {
public:
    FlatFan(const Environment& environment, double flat)
        : environment_(environment),
          flat_(flat),
          from_(std::asinh(environment.fan.least_deg / flat)),
          step_((std::asinh(environment.fan.most_deg / flat) - from_) / pieces) {
        const auto& pattern = environment.source.pattern;
        double loudest_db = -1e9;
        for (const auto& point : pattern) loudest_db = std::max(loudest_db, point.level_db);
        for (int k = 0; k < pieces; ++k) {
            const double angle_deg = flat * std::sinh(from_ + (k + 0.5) * step_);
            width_.push_back(pattern.empty() ? 1 : width_of_weak(pattern, loudest_db, angle_deg));
            total_ += step_ / width_.back();
        }
    }

    std::vector<Launch> launches(double spacing_rad) const {
        const double wanted = std::ceil(total_ * flat_ * rad_per_deg / spacing_rad);
        const auto beams = static_cast<std::uint32_t>(
            std::clamp(wanted, 16., static_cast<double>(most_automatic_beams)));
        const double share = total_ / beams;
        std::vector<Launch> out;
        std::size_t piece = 0;
        double before = 0;  // measure of the pieces before
        for (std::uint32_t k = 0; k < beams; ++k) {
            const double at = (k + 0.5) * share;
            for (; piece + 1 < pieces && before + step_ / width_[piece] < at; ++piece)
                before += step_ / width_[piece];
            const double u =
                from_ + step_ * static_cast<double>(piece) + (at - before) * width_[piece];
            out.push_back(launch_at(environment_, flat_ * std::sinh(u),
                                    flat_ * std::cosh(u) * share * width_[piece]));
        }
        return out;
    }

private:
    static constexpr int pieces = 1000;
    const Environment& environment_;
    double flat_, from_, step_, total_ = 0;
    std::vector<double> width_;
};

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

double fan_spacing_rad(const Environment& environment, const RaySea& sea,
                       const FieldOptions& options) {
    return environment.fan.beams > 0 ? 0 : flat_spacing_rad(environment, sea, options);
}

std::vector<Launch> make_fan(const Environment& environment, const RaySea& sea,
                             const FieldOptions& options) {
    if (environment.fan.beams > 0) return even_fan(environment);
    const FlatFan fan(environment, flat_deg(options));
    return fan.launches(flat_spacing_rad(environment, sea, options));
}

std::vector<Launch> make_bracketing_fan(const Environment& environment, const RaySea& sea) {
    if (environment.fan.beams > 0) return even_fan(environment);
    return FlatFan(environment, flat_deg({})).launches(folds_rad(environment, sea));
}

BeamKind beam_kind(const Environment& environment, const FieldOptions& options) {
    BeamKind kind;
    kind.sum = options.sum;
    kind.beam = options.beam;
    kind.least_amplitude = options.least_amplitude;
    kind.baffle_from_sine = std::sin(std::clamp(options.baffle_from_deg, -90., 90.) * rad_per_deg);
    kind.baffle_to_sine = std::sin(std::clamp(options.baffle_to_deg, -90., 90.) * rad_per_deg);
    if (environment.fan.beams > 0 || options.sum == Sum::coherent) return kind;
    kind.width_factor = 0.5;
    kind.mirrored = true;
    return kind;
}

}  // namespace seautils::propagation
