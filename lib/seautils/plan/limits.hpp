#ifndef SEAUTILS_PLAN_LIMITS_HPP
#define SEAUTILS_PLAN_LIMITS_HPP

#include "seautils/plan/objective.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace seautils::plan {

struct DepthBand {
    double from_m = 0, to_m = 0;
};

/// Where a vehicle may be told to be, whatever is to be gained elsewhere.
struct Limits {
    double least_depth_m = 0;
    double most_depth_m = std::numeric_limits<double>::infinity();
    double least_altitude_m = 0;  ///< above the seabed; not 0: the water's depth must be known
    std::vector<DepthBand> excluded{};  ///< open: their ends are allowed. May be crossed
};

/// What keeps a vehicle from a depth.
enum class Limit : std::uint8_t {
    least_depth,
    most_depth,
    least_altitude,
    excluded_band,
    water_depth_unknown,  ///< so that nothing deeper than now is allowed
};

/// `least_depth`, …
std::string_view name(Limit limit);

/// What the vehicle knows of itself.
struct Situation {
    double depth_m = 0;  ///< own
    std::optional<double> water_depth_m;
};

/// The depths that are allowed, from shallow to deep, apart from each other; empty: none.
std::vector<DepthBand> allowed_depths(const Limits& limits, const Situation& situation);

/// Every limit that forbids a depth.
std::vector<Limit> forbidden_by(const Limits& limits, const Situation& situation, double depth_m);

/// The allowed depth nearest to one; nothing: none is.
std::optional<double> nearest_allowed(const std::vector<DepthBand>& allowed, double depth_m);

struct Choice {
    std::optional<double> depth_m;       ///< nothing: no reason to go anywhere, or no allowed depth
    double utility = 0;                  ///< there; NaN: no value there
    std::optional<double> free_depth_m;  ///< where it would be without limits
    std::vector<Limit> bound_by;         ///< what forbids that
};

/// The allowed depth of highest utility: one of the objective's, or an end of what is allowed. Of equals the nearest to the
/// own depth, then the shallower. Where no allowed depth has a value: the nearest allowed to the own depth if
/// that is forbidden, which bound_by says, else none.
Choice choose_depth(const Objective& objective, const Limits& limits, const Situation& situation);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_LIMITS_HPP
