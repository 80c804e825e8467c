#ifndef SEAUTILS_PLAN_OBJECTIVE_HPP
#define SEAUTILS_PLAN_OBJECTIVE_HPP

#include <span>
#include <string>
#include <vector>

namespace seautils::plan {

/// How much some interest likes each depth: straight between its points, and beyond them as at the nearest one.
struct Objective {
    std::string name;
    double weight = 1;            ///< 0 to 1e6
    std::vector<double> depth_m;  ///< grows, or repeats a depth once, where utility steps
    std::vector<double> utility;  ///< as many, 0 to 1; NaN: no value, which only our own have
};

/// 1 to 100000 points, depths 0 to 1e5 m that do not shrink, all within bounds.
/// @throws DataError  names what is wrong, the value and the bound
void check(const Objective& objective);

/// NaN: no value beside it. At a step the larger of both.
double utility_at(const Objective& objective, double depth_m);

/// Weighted mean of the first one and others at the depths of the first: what has no value in the first has none. Where
/// all weights are 0 the first one.
Objective combined(const Objective& first, std::span<const Objective> others);

/// The same with fewer points: straight pieces that are nowhere farther than `tolerance` from the points. Where there is
/// no value, utility is 0.
/// @param tolerance  0 or more
Objective simplified(const Objective& objective, double tolerance);

/// A one-pole low-pass over depth, from the first to the last point: y += Δz / (Δz + length) (x - y). It starts at the first
/// value; points without a value are left out.
void low_pass_down(std::span<const double> depth_m, std::vector<double>& values, double length_m);
/// The same from the last to the first.
void low_pass_up(std::span<const double> depth_m, std::vector<double>& values, double length_m);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_OBJECTIVE_HPP
