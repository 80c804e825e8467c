#ifndef SEAUTILS_PROPAGATION_RAY_LAYERS_HPP
#define SEAUTILS_PROPAGATION_RAY_LAYERS_HPP

#include "seautils/propagation/environment.hpp"

#include <string>
#include <vector>

namespace seautils::propagation {

/// At most so many layers are traced through; a longer profile is thinned, and that is remarked.
inline constexpr std::size_t most_layers = 2000;

/// A profile as points between which c is linear: of `c_linear` its own points, thinned where they
/// are more than `most_layers`; of the others as many as keep c within 0.5 to 3 mm/s (the deeper, the
/// more), and right on average, while `most_layers` allow.
/// @param profile  1 point at least; depths grow
/// @param remarks  takes what was done to it, for people
std::vector<SpeedPoint> linear_profile(const std::vector<SpeedPoint>& profile,
                                       SpeedInterpolation interpolation,
                                       std::vector<std::string>& remarks);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_LAYERS_HPP
