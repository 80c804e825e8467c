#include "seautils/propagation/reflection.hpp"

#include "seautils/core/error.hpp"

namespace seautils::propagation {

// not there yet

}  // namespace seautils::propagation
