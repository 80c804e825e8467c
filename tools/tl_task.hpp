// What tl-model is to compute.
#ifndef SEAUTILS_TOOLS_TL_TASK_HPP
#define SEAUTILS_TOOLS_TL_TASK_HPP

#include "tl_levels.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/propagation/field.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::tools {

inline pg::Sum parse_sum(std::string_view name) {
    if (name == "incoherent") return pg::Sum::incoherent;
    if (name == "semicoherent") return pg::Sum::semi_coherent;
    if (name == "coherent") return pg::Sum::coherent;
    throw DataError(quote(name) + " is none of incoherent, semicoherent, coherent");
}
inline pg::Beam parse_beam(std::string_view name) {
    if (name == "gaussian") return pg::Beam::gaussian;
    if (name == "hat") return pg::Beam::hat;
    throw DataError(quote(name) + " is none of gaussian, hat");
}
inline pg::Engine parse_engine(std::string_view name) {
    if (name == "auto") return pg::Engine::automatic;
    if (name == "rays") return pg::Engine::rays;
    if (name == "modes") return pg::Engine::modes;
    if (name == "wavenumber") return pg::Engine::wavenumber;
    throw DataError(quote(name) + " is none of auto, rays, modes, wavenumber");
}

/// What is to be computed.
struct TlTask {
    pg::Environment environment;
    std::optional<pg::Receivers> arrivals_at;  ///< else at the grid
    pg::FieldOptions options;
    pg::Engine engine = pg::Engine::automatic;
    std::string program;  ///< somebody else's engine in place of ours
    bool smooth = false, loss = true, arrivals = false;
    std::optional<TlLevels> levels;
    std::optional<std::uint32_t> id;
    std::string place;  ///< of the request, for messages
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_TASK_HPP
