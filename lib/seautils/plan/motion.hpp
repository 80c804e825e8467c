#ifndef SEAUTILS_PLAN_MOTION_HPP
#define SEAUTILS_PLAN_MOTION_HPP

#include "seautils/plan/loss_field.hpp"

#include <optional>

namespace seautils::plan {

/// Speed at which the range grows, by own motion alone.
/// @param speed_mps    own speed over ground, m/s
/// @param opening_deg  between the course and the direction away from the contact; 0: directly away, 180: towards it
double range_rate_mps(double speed_mps, double opening_deg);

/// Ranges that are met within a time: [r, r + Δr] when opening, [r + Δr, r] when closing, not below 0; Δr = |v| cos Θ τ
/// (eq 4.1 of the thesis).
/// Check value: 1.47 m/s for 120 s make 176.4 m; with Θ = 60° half of it.
/// @param range_m  0 or more
RangeWindow range_window(double range_m, double range_rate_mps, double horizon_s);

/// How fast depth changes: v sin(pitch).
/// Check value: 1.5 m/s at 20° are 0.513 m/s, so that 1000 m take 32.5 min (not the 0.75 m/s and 20 min of the thesis,
/// which belong to 30° and to nothing).
double depth_rate_mps(double speed_mps, double pitch_deg);

/// A moving thing on a plane: metres east and north of some datum.
struct Mover {
    double x_m = 0, y_m = 0;
    double speed_mps = 0;
    double heading_deg = 0;  ///< of its motion: true, clockwise from north

    /// Where it is after some time, on the same heading.
    Mover after(double seconds) const;
};

/// Where a position lies on a plane that touches the ellipsoid (WGS84) at a datum: within 0.1 % to 100 km, up to 80°
/// of latitude.
struct PlanePoint {
    double x_m = 0, y_m = 0;
};
PlanePoint on_plane(double latitude_deg, double longitude_deg, double datum_latitude_deg,
                    double datum_longitude_deg);

/// Horizontal distance, and how fast it grows by the motion of both. At distance 0 it grows by the whole of it.
struct Separation {
    double range_m = 0, range_rate_mps = 0;
};
Separation separation(const Mover& own, const Mover& contact);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_MOTION_HPP
