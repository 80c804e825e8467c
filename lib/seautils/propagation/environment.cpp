#include "seautils/propagation/environment.hpp"

#include "seautils/core/error.hpp"

namespace seautils::propagation {

void check(const Environment&) {}

}  // namespace seautils::propagation
