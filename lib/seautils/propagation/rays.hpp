#ifndef SEAUTILS_PROPAGATION_RAYS_HPP
#define SEAUTILS_PROPAGATION_RAYS_HPP

#include "seautils/propagation/field.hpp"

#include <vector>

namespace seautils::propagation {

/// Loss by geometric beams around rays.
/// @throws DataError  check() does
Field ray_field(const Environment& environment, const FieldOptions& options);

/// All paths from the source to each receiver, depth by depth, each refined to its own launch angle.
std::vector<ReceiverArrivals> ray_arrivals(const Environment& environment,
                                           const FieldOptions& options);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAYS_HPP
