#include "seautils/plan/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::plan {

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

double range_rate_mps(double speed_mps, double opening_deg) {
    return std::abs(speed_mps) * std::cos(radians(opening_deg));
}

RangeWindow range_window(double range_m, double range_rate_mps, double horizon_s) {
    const double end_m = std::max(range_m + range_rate_mps * horizon_s, 0.0);
    return {std::min(range_m, end_m), std::max(range_m, end_m)};
}

double depth_rate_mps(double speed_mps, double pitch_deg) {
    return speed_mps * std::sin(radians(pitch_deg));
}

Mover Mover::after(double seconds) const {
    Mover moved = *this;
    moved.x_m += speed_mps * std::sin(radians(heading_deg)) * seconds;
    moved.y_m += speed_mps * std::cos(radians(heading_deg)) * seconds;
    return moved;
}

PlanePoint on_plane(double latitude_deg, double longitude_deg, double datum_latitude_deg,
                    double datum_longitude_deg) {
    // Radii of curvature of the ellipsoid, in the middle between the two latitudes.
    constexpr double equatorial_m = 6378137, e2 = 6.69437999014e-3;
    const double middle = radians((latitude_deg + datum_latitude_deg) / 2);
    const double w2 = 1 - e2 * std::sin(middle) * std::sin(middle);
    const double across_m = equatorial_m / std::sqrt(w2);
    const double along_m = equatorial_m * (1 - e2) / (w2 * std::sqrt(w2));
    const double east_deg = std::remainder(longitude_deg - datum_longitude_deg, 360);
    return {radians(east_deg) * across_m * std::cos(middle),
            radians(latitude_deg - datum_latitude_deg) * along_m};
}

Separation separation(const Mover& own, const Mover& contact) {
    const double x = own.x_m - contact.x_m, y = own.y_m - contact.y_m;
    const Mover own_then = own.after(1), contact_then = contact.after(1);
    const double vx = own_then.x_m - own.x_m - (contact_then.x_m - contact.x_m);
    const double vy = own_then.y_m - own.y_m - (contact_then.y_m - contact.y_m);
    const double range_m = std::hypot(x, y);
    return {range_m, range_m > 0 ? (x * vx + y * vy) / range_m : std::hypot(vx, vy)};
}

}  // namespace seautils::plan
