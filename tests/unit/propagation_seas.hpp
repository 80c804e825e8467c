#ifndef SEAUTILS_TESTS_PROPAGATION_SEAS_HPP
#define SEAUTILS_TESTS_PROPAGATION_SEAS_HPP

#include "seautils/core/error.hpp"
#include "seautils/propagation/engine.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace seautils::propagation {

inline std::vector<double> evenly(double from, double to, int count) {
    std::vector<double> out;
    for (int k = 0; k < count; ++k) out.push_back(from + (to - from) * k / std::max(1, count - 1));
    return out;
}

inline Boundary half_space(double mps, double gcm3, double db) {
    Boundary b;
    b.kind = BoundaryKind::half_space;
    b.sound_speed_mps = mps;
    b.density_gcm3 = gcm3;
    b.attenuation_db_per_wavelength = db;
    return b;
}

/// Isovelocity water of 100 m over sand, at 250 Hz; each 5 m of depth, each 100 m to 5 km.
inline Environment pekeris() {
    Environment e;
    e.frequency_hz = 250;
    e.source.depth_m = 36;
    e.water.profile = {{0, 1500}};
    e.bottom = half_space(1700, 1.8, 0.5);
    e.bottom_depth_m = 100;
    e.receivers = {evenly(5, 95, 19), evenly(100, 5000, 50)};
    return e;
}

inline FieldOptions coherent() {
    FieldOptions o;
    o.sum = Sum::coherent;
    return o;
}

/// What is said of the changed environment: "accepted", or why not.
inline std::string refusal(Environment e, const std::function<void(Environment&)>& change) {
    change(e);
    try {
        check(e);
    } catch (const DataError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace seautils::propagation

#endif  // SEAUTILS_TESTS_PROPAGATION_SEAS_HPP
