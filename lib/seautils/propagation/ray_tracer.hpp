#ifndef SEAUTILS_PROPAGATION_RAY_TRACER_HPP
#define SEAUTILS_PROPAGATION_RAY_TRACER_HPP

#include "seautils/propagation/ray_sea.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace seautils::propagation {

enum class Touch : std::uint8_t { none, surface, bottom };

/// How far along an arc, in all that adds up. `spread` is ∫c ds.
struct Advance {
    double along_m = 0, down_m = 0;  ///< in range and in depth
    double cosine = 1, sine = 0;     ///< of the direction at its end; down is positive
    double length_m = 0, delay_s = 0, spread = 0;
};

/// An arc of a circle in water of constant gradient, and what happens at its end: the paraxial p
/// changes by kick·q (at the end of the arc), then a wall may reflect.
struct Leg {
    double range_m = 0, depth_m = 0, cosine = 1, sine = 0;  ///< where it begins
    double curvature = 0;                                   ///< dθ/ds, 1/m
    double speed_mps = 0, range_gradient = 0, depth_gradient = 0, gradient = 0;
    Advance whole;
    double kick = 0, magnitude = 1, phase_rad = 0;
    Touch touch = Touch::none;
    double grazing_sine = 0;  ///< where it touches

    /// Up to `along_m` in range, between 0 and whole.along_m. Exact, but for the twist of a cell.
    Advance part(double along_m) const;
};

/// Traces one ray, leg by leg. Spec: arcs in layers of linear c, §6.1; in the cells of a mesh the
/// gradient is that of the middle of the leg's cell.
class RayTracer {
public:
    /// @param launch_rad  -π/2 to π/2, down is positive
    /// @param stop_m      range at which it ends
    /// @param timed       legs have their delay
    RayTracer(const RaySea& sea, double launch_rad, double stop_m, bool timed);

    /// The next leg; false when the ray has ended before it.
    bool next(Leg& leg);
    /// The same where nothing depends on range, and the ray, which has met a wall or turned, goes
    /// back by a leg that it came by: in its mirror image.
    bool next(Leg& leg, const Leg& came_by);
    /// Back at the depth of the source, in the direction of the launch.
    bool at_start() const { return depth_m_ == sea_.source_depth_m && sine_ * start_sine_ > 0; }
    /// The source lies on a wall, and the ray was launched into it.
    Touch touch_at_launch() const { return launch_touch_; }
    double grazing_sine_at_launch() const { return std::abs(start_sine_); }

private:
    enum class End : std::uint8_t { layer, strip, surface, bottom, stop };

    const Cell& cell() const { return sea_.at(strip_, layer_); }
    void set_layer();
    void begin(Leg& leg) const;
    void to_layer(Leg& leg) const;
    End level_wall(const Leg& leg) const;
    End to_strip(Leg& leg, End end) const;
    End to_wall(Leg& leg, const Wall& wall, End hit, End end);
    void cross_layer(Leg& leg);
    void cross_strip(Leg& leg);
    void reflect(Leg& leg, const Wall& wall, Touch touch);
    void move(const Leg& leg);
    void cross(Leg& leg, End end);

    const RaySea& sea_;
    double stop_m_, start_sine_;
    double range_m_ = 0, depth_m_, cosine_, sine_;
    std::size_t strip_, layer_ = 0;
    std::size_t facet_ = 0;  // of the wall that was hit
    Touch launch_touch_ = Touch::none;
    bool timed_, ended_ = false;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_TRACER_HPP
