#ifndef SEAUTILS_PROPAGATION_ENGINE_HPP
#define SEAUTILS_PROPAGATION_ENGINE_HPP

#include "seautils/propagation/rays.hpp"

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
/// Most depth in wavelengths, fD/c, for modes; of water and layers.
inline constexpr double most_wavelengths_of_modes = 30;
Choice choose_engine(const Environment& environment, const FieldOptions& options);

/// Checks, chooses an engine where it is `automatic`, and computes: receivers that are pairs too, which the engines
/// themselves do not know. A basis says which, and why.
/// @throws DataError  as check() and the engines do
Field compute_field(const Environment& environment, Engine engine, const FieldOptions& options);

/// Computes one field after another, each to the same bits as compute_field(), and sooner where only
/// receivers have moved: rays are kept, see RayFields. What modes and wavenumbers need is not.
/// No more than one thread at a time.
class FieldComputer {
public:
    /// A shelf takes 20,000.
    static constexpr std::size_t default_legs = 130'000;
    /// @param legs  of rays, at most, of 100 bytes each
    explicit FieldComputer(std::size_t legs = default_legs) : rays_(legs) {}

    Field compute(const Environment& environment, Engine engine, const FieldOptions& options);

private:
    Field on_grid(const Environment& environment, Engine engine, const FieldOptions& options);

    RayFields rays_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_ENGINE_HPP
