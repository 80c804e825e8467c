#include "seautils/propagation/ray_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seautils::propagation {
namespace {

/// No ray runs quite along a layer: directions are no flatter than this.
constexpr double least_sine = 1e-9;

double away_from_zero(double sine) {
    return std::abs(sine) < least_sine ? std::copysign(least_sine, sine) : sine;
}

double root_of_rest(double x) { return std::sqrt(std::max(0., 1 - x * x)); }

/// asin(u)/u and asinh(x)/x by their series where that is exact.
double arc_over_chord(double u) {
    const double u2 = u * u;
    if (u2 < 0.01) return 1 + u2 * (1. / 6 + u2 * (3. / 40 + u2 * (15. / 336 + u2 * 105 / 3456)));
    return std::asin(std::clamp(u, -1., 1.)) / u;
}

double slowing(double x) {
    const double x2 = x * x;
    if (x2 < 0.01) return 1 - x2 * (1. / 6 - x2 * (3. / 40 - x2 * (15. / 336 - x2 * 105 / 3456)));
    return std::asinh(x) / x;
}

/// ∫c ds: Simpson's rule on a flat arc, else what runs along the lines of equal speed over its
/// share of the slowness.
double spread_of(const Leg& leg, const Advance& to, double end_speed_mps, double chord_m) {
    const double u = 0.5 * leg.curvature * chord_m, u2 = u * u;
    if (u2 < 0.003) {
        const double sagitta = 0.125 * leg.curvature * chord_m * (1 + 0.25 * u2);
        const double across =
            (leg.depth_gradient * to.along_m - leg.range_gradient * to.down_m) * sagitta;
        const double middle_mps = 0.5 * (leg.speed_mps + end_speed_mps) - across;
        return to.length_m * (leg.speed_mps + 4 * middle_mps + end_speed_mps) / 6;
    }
    const double level =
        leg.cosine * leg.depth_gradient - leg.sine * leg.range_gradient;  // × the gradient
    return (to.along_m * leg.depth_gradient - to.down_m * leg.range_gradient) * leg.speed_mps /
           level;
}

/// Length, delay (where it is wanted) and spread of an advance whose ends are known.
void measure(const Leg& leg, Advance& to, bool timed) {
    const double end_speed_mps =
        leg.speed_mps + leg.range_gradient * to.along_m + leg.depth_gradient * to.down_m;
    const double chord_m = std::sqrt(to.along_m * to.along_m + to.down_m * to.down_m);
    to.length_m = chord_m * arc_over_chord(0.5 * leg.curvature * chord_m);
    if (timed) {
        const double slowness = 1 / std::sqrt(leg.speed_mps * end_speed_mps);
        to.delay_s = chord_m * slowness * slowing(0.5 * leg.gradient * chord_m * slowness);
    }
    to.spread = spread_of(leg, to, end_speed_mps, chord_m);
}

/// Where a ray at a distance from a straight wall meets it, in the wall's frame: `along` it, at
/// that angle.
struct Meeting {
    bool is = false;
    double along_m = 0, cosine = 1, sine = 0;
};

Meeting meet(double distance_m, double cosine, double sine, double curvature) {
    Meeting to;
    to.cosine = cosine - curvature * distance_m;
    if (std::abs(to.cosine) > 1 || (sine <= 0 && curvature <= 0)) return to;
    to.is = true;
    to.sine = std::max(root_of_rest(to.cosine), least_sine);
    to.along_m = sine > 0 ? distance_m * (cosine + to.cosine) / (sine + to.sine)
                          : (to.sine - sine) / curvature;
    return to;
}

}  // namespace

Advance Leg::part(double along_m) const {
    Advance to;
    to.along_m = along_m;
    to.sine = std::clamp(sine + curvature * along_m, -1., 1.);
    to.cosine = std::copysign(root_of_rest(to.sine), cosine);
    to.down_m = along_m * (sine + to.sine) / (cosine + to.cosine);
    measure(*this, to, true);
    return to;
}

RayTracer::RayTracer(const RaySea& sea, double launch_rad, double stop_m, bool timed)
    : sea_(sea),
      stop_m_(stop_m),
      depth_m_(sea.source_depth_m),
      cosine_(std::cos(launch_rad)),
      sine_(away_from_zero(std::sin(launch_rad))),
      strip_(sea.strip_at(0)),
      timed_(timed) {
    const bool on_surface = sea.surface.level && depth_m_ <= sea.surface.depth_m && sine_ < 0;
    const bool on_bottom = sea.bottom.level && depth_m_ >= sea.bottom.depth_m && sine_ > 0;
    if (on_surface || on_bottom) {
        launch_touch_ = on_surface ? Touch::surface : Touch::bottom;
        sine_ = -sine_;
    }
    start_sine_ = sine_;
    set_layer();
}

/// Of a ray that begins at an edge, the layer it goes into.
void RayTracer::set_layer() {
    const auto& edges = sea_.layer_edge_m;
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, depth_m_);
    layer_ = static_cast<std::size_t>(above - edges.begin()) - 1;
    if (sine_ < 0 && layer_ > 0 && edges[layer_] == depth_m_) --layer_;
}

void RayTracer::begin(Leg& leg) const {
    const Cell& c = cell();
    leg.range_m = range_m_;
    leg.depth_m = depth_m_;
    leg.cosine = cosine_;
    leg.sine = sine_;
    leg.speed_mps = c.speed_at(range_m_, depth_m_);
    leg.range_gradient = c.range_gradient;
    leg.depth_gradient = c.depth_gradient;
    leg.gradient =
        std::sqrt(c.range_gradient * c.range_gradient + c.depth_gradient * c.depth_gradient);
    leg.curvature = (leg.range_gradient * sine_ - leg.depth_gradient * cosine_) / leg.speed_mps;
    leg.kick = 0;
    leg.magnitude = 1;
    leg.phase_rad = 0;
    leg.touch = Touch::none;
}

/// Up to the edge of the layer that it runs to, or back to the one it came from where it turns
/// before.
void RayTracer::to_layer(Leg& leg) const {
    const double top_m = sea_.layer_edge_m[layer_], floor_m = sea_.layer_edge_m[layer_ + 1];
    Advance& to = leg.whole;
    to.down_m = (sine_ > 0 ? floor_m : top_m) - depth_m_;
    to.cosine = cosine_ - leg.curvature * to.down_m;
    if (std::abs(to.cosine) <= 1) {
        to.sine = std::copysign(std::max(root_of_rest(to.cosine), least_sine), sine_);
        to.along_m = to.down_m * (cosine_ + to.cosine) / (sine_ + to.sine);
        return;
    }
    to.down_m = (sine_ > 0 ? top_m : floor_m) - depth_m_;
    to.cosine = cosine_ - leg.curvature * to.down_m;
    to.sine = -std::copysign(std::max(root_of_rest(to.cosine), least_sine), sine_);
    to.along_m = std::abs(to.cosine) <= 1 ? (to.sine - sine_) / leg.curvature
                                          : std::copysign(far_m, cosine_);
}

/// The level wall at the edge of the layer to which a leg leads, if one is there.
RayTracer::End RayTracer::level_wall(const Leg& leg) const {
    const bool down = leg.whole.sine > 0;
    const double edge_m = sea_.layer_edge_m[layer_ + (down ? 1 : 0)];
    if (down && sea_.bottom.level && edge_m >= sea_.bottom.depth_m) return End::bottom;
    if (!down && sea_.surface.level && edge_m <= sea_.surface.depth_m) return End::surface;
    return End::layer;
}

/// No farther than the strip, or than the ray goes at all.
RayTracer::End RayTracer::to_strip(Leg& leg, End end) const {
    const bool forward = leg.whole.along_m > 0;
    const double edge_m = sea_.strip_edge_m[strip_ + (forward ? 1 : 0)];
    const double stop_m = forward ? stop_m_ : 0;
    const bool stops = forward ? stop_m <= edge_m : stop_m >= edge_m;
    const double most_m = (stops ? stop_m : edge_m) - range_m_;
    if (std::abs(leg.whole.along_m) <= std::abs(most_m)) return end;
    Advance& to = leg.whole;
    to.along_m = most_m;
    to.sine = std::clamp(sine_ + leg.curvature * most_m, -1., 1.);
    to.cosine = std::copysign(root_of_rest(to.sine), cosine_);
    to.down_m = most_m * (sine_ + to.sine) / (cosine_ + to.cosine);
    return stops ? End::stop : End::strip;
}

/// No farther than a wall that is not level.
RayTracer::End RayTracer::to_wall(Leg& leg, const Wall& wall, End hit, End end) {
    const double out = hit == End::bottom ? 1 : -1;  // the way out of the water
    Advance& to = leg.whole;
    const double turn_m = to.sine * sine_ < 0 && leg.curvature != 0
                              ? (cosine_ - std::copysign(1., cosine_)) / leg.curvature
                              : 0;
    const double reach = out * depth_m_ + std::max({0., out * to.down_m, out * turn_m});
    const double end_m = range_m_ + to.along_m;
    const double least_m = std::min(range_m_, end_m), most_m = std::max(range_m_, end_m);
    const std::size_t step = to.along_m < 0 ? static_cast<std::size_t>(-1) : 1;
    for (std::size_t k = wall.facet_at(range_m_); k < wall.facet.size(); k += step) {
        const Facet& f = wall.facet[k];
        if (f.range_m > most_m || f.end_m < least_m) break;
        if (reach < std::min(out * f.depth_m, out * f.end_depth_m)) continue;
        const double line_m = f.depth_m + (range_m_ - f.range_m) * f.sine / f.cosine;
        const double distance_m = std::max(0., out * (line_m - depth_m_) * f.cosine);
        const auto at = meet(distance_m, cosine_ * f.cosine + sine_ * f.sine,
                             out * (sine_ * f.cosine - cosine_ * f.sine), out * leg.curvature);
        if (!at.is) continue;
        const double along_m = at.along_m * f.cosine - out * distance_m * f.sine;
        const double range_m = range_m_ + along_m, slack_m = 1e-9 * (1 + std::abs(range_m));
        if (along_m * to.along_m < 0 || std::abs(along_m) > std::abs(to.along_m) ||
            range_m < f.range_m - slack_m || range_m > f.end_m + slack_m)
            continue;
        to.along_m = along_m;
        to.down_m = at.along_m * f.sine + out * distance_m * f.cosine;
        to.cosine = at.cosine * f.cosine - out * at.sine * f.sine;
        to.sine = at.cosine * f.sine + out * at.sine * f.cosine;
        facet_ = k;
        return hit;
    }
    return end;
}

/// The paraxial p jumps where the gradient does: p -= q·Δg·a²/sinθ.
void RayTracer::cross_layer(Leg& leg) {
    const bool down = sine_ > 0;
    depth_m_ = sea_.layer_edge_m[layer_ + (down ? 1 : 0)];
    if (layer_ + 1 == sea_.layers() && down) ended_ = true;
    if (layer_ == 0 && !down) ended_ = true;
    if (ended_) return;
    const auto gradient = [&] {
        return cell().depth_gradient + cell().twist * (range_m_ - cell().range_m);
    };
    const double before = gradient();
    layer_ += down ? 1 : static_cast<std::size_t>(-1);
    const double slowness = cosine_ / cell().speed_at(range_m_, depth_m_);
    leg.kick -= (gradient() - before) * slowness * slowness / sine_;
}

void RayTracer::cross_strip(Leg& leg) {
    const bool forward = cosine_ > 0;
    range_m_ = sea_.strip_edge_m[strip_ + (forward ? 1 : 0)];
    const auto gradient = [&] {
        return cell().range_gradient + cell().twist * (depth_m_ - cell().depth_m);
    };
    const double before = gradient();
    strip_ += forward ? 1 : static_cast<std::size_t>(-1);
    const double speed_mps = cell().speed_at(range_m_, depth_m_);
    const double cosine = std::copysign(std::max(std::abs(cosine_), 1e-3), cosine_);
    leg.kick -= (gradient() - before) * sine_ * sine_ / (cosine * speed_mps * speed_mps);
}

/// Direction and curvature of a wall where a ray meets it.
struct Slope {
    double cosine = 1, sine = 0, curvature = 0;
};

static Slope slope_at(const Facet& f, double range_m) {
    const double part = std::clamp((range_m - f.range_m) / (f.end_m - f.range_m), 0., 1.);
    Slope s{f.cosine_from + (f.cosine_to - f.cosine_from) * part,
            f.sine_from + (f.sine_to - f.sine_from) * part,
            f.curvature_from + (f.curvature_to - f.curvature_from) * part};
    const double size = std::hypot(s.cosine, s.sine);
    s.cosine /= size;
    s.sine /= size;
    return s;
}

/// A mirror: a reflection is a crossing into the mirrored water, and a curved wall bends the front
/// besides.
void RayTracer::reflect(Leg& leg, const Wall& wall, Touch touch) {
    const double out = touch == Touch::bottom ? 1 : -1;
    if (wall.level) depth_m_ = wall.depth_m;
    const Slope s = wall.level ? Slope{} : slope_at(wall.facet[facet_], range_m_);
    const double along = cosine_ * s.cosine + sine_ * s.sine;
    const double across =
        std::max(out * (sine_ * s.cosine - cosine_ * s.sine), least_sine);  // outward
    const double speed_mps = cell().speed_at(range_m_, depth_m_);
    const double gradient_out = out * (leg.depth_gradient * s.cosine - leg.range_gradient * s.sine);
    leg.kick +=
        2 * (gradient_out * along * along / speed_mps + out * s.curvature) / (speed_mps * across);
    leg.touch = touch;
    leg.grazing_sine = across;
    cosine_ = along * s.cosine + out * across * s.sine;
    sine_ = along * s.sine - out * across * s.cosine;
}

/// To the end of a leg.
void RayTracer::move(const Leg& leg) {
    range_m_ += leg.whole.along_m;
    depth_m_ += leg.whole.down_m;
    cosine_ = leg.whole.cosine;
    sine_ = leg.whole.sine;
}

/// What is there.
void RayTracer::cross(Leg& leg, End end) {
    if (end == End::layer) cross_layer(leg);
    if (end == End::strip) cross_strip(leg);
    if (end == End::surface) reflect(leg, sea_.surface, Touch::surface);
    if (end == End::bottom) reflect(leg, sea_.bottom, Touch::bottom);
    if (end == End::stop) ended_ = true;
}

bool RayTracer::next(Leg& leg) {
    if (ended_) return false;
    sine_ = away_from_zero(sine_);
    begin(leg);
    to_layer(leg);
    End end = to_strip(leg, level_wall(leg));
    if (!sea_.surface.level) end = to_wall(leg, sea_.surface, End::surface, end);
    if (!sea_.bottom.level) end = to_wall(leg, sea_.bottom, End::bottom, end);
    move(leg);
    measure(leg, leg.whole, timed_);
    const double twist = cell().twist;
    if (twist != 0 && leg.whole.length_m > 0)
        leg.kick += 2 * twist * leg.whole.along_m * leg.whole.down_m /
                    (leg.whole.length_m * leg.speed_mps * leg.speed_mps);
    cross(leg, end);
    return true;
}

bool RayTracer::next(Leg& leg, const Leg& came_by) {
    if (ended_) return false;
    const Advance& there = came_by.whole;
    if (there.along_m < 0 || range_m_ + there.along_m > stop_m_) return next(leg);
    leg = came_by;
    leg.range_m = range_m_;
    leg.depth_m = depth_m_;
    leg.cosine = there.cosine;
    leg.sine = -there.sine;
    leg.speed_mps += came_by.depth_gradient * there.down_m;
    leg.whole.down_m = -there.down_m;
    leg.whole.cosine = came_by.cosine;
    leg.whole.sine = -came_by.sine;
    leg.kick = 0;
    leg.magnitude = 1;
    leg.phase_rad = 0;
    leg.touch = Touch::none;
    move(leg);
    cross(leg, level_wall(leg));
    return true;
}

}  // namespace seautils::propagation
