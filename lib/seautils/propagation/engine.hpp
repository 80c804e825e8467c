#ifndef SEAUTILS_PROPAGATION_ENGINE_HPP
#define SEAUTILS_PROPAGATION_ENGINE_HPP

#include "seautils/propagation/field.hpp"

#include <string>
#include <string_view>

namespace seautils::propagation {

/// `auto`, `rays`, `modes`, `wavenumber`.
std::string_view name(Engine engine);

/// Which engine `auto` is, and why. Modes where a coherent sum is wanted of few of them: there rays are
/// wrong by a decibel and more, and slower. Rays everywhere else, and where a number of beams is given.
struct Choice {
    Engine engine = Engine::rays;
    std::string why;
};
/// Most depth in wavelengths, fD/c, for modes.
inline constexpr double most_wavelengths_of_modes = 30;
Choice choose_engine(const Environment& environment, const FieldOptions& options);

/// Checks, chooses an engine where it is `automatic`, and computes. A basis says which, and why.
/// @throws DataError  as check() and the engines do
Field compute_field(const Environment& environment, Engine engine, const FieldOptions& options);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_ENGINE_HPP
