#include "seautils/propagation/rays.hpp"

#include "seautils/core/error.hpp"

namespace seautils::propagation {

Field ray_field(const Environment&, const FieldOptions&) { throw DataError("not there yet"); }
std::vector<ReceiverArrivals> ray_arrivals(const Environment&, const FieldOptions&) {
    throw DataError("not there yet");
}

}  // namespace seautils::propagation
