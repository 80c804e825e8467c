#ifndef SEAUTILS_PROPAGATION_ENGINE_HPP
#define SEAUTILS_PROPAGATION_ENGINE_HPP

#include "seautils/propagation/field.hpp"

#include <string_view>

namespace seautils::propagation {

/// `auto`, `rays`, `modes`, `wavenumber`.
std::string_view name(Engine engine);

/// Checks, chooses an engine where it is `automatic`, and computes. A basis says which, and why.
/// @throws DataError  as check() and the engines do
Field compute_field(const Environment& environment, Engine engine, const FieldOptions& options);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_ENGINE_HPP
