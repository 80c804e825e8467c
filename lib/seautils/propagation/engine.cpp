#include "seautils/propagation/engine.hpp"

#include "seautils/core/error.hpp"

namespace seautils::propagation {

std::string_view name(Engine) { throw DataError("not there yet"); }
Field compute_field(const Environment&, Engine, const FieldOptions&) {
    throw DataError("not there yet");
}

}  // namespace seautils::propagation
