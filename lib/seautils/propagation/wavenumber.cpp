#include "seautils/propagation/modes.hpp"

#include "seautils/core/error.hpp"

namespace seautils::propagation {

Field wavenumber_field(const Environment&, const FieldOptions&) {
    throw DataError("not there yet");
}

}  // namespace seautils::propagation
