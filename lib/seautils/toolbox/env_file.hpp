#ifndef SEAUTILS_TOOLBOX_ENV_FILE_HPP
#define SEAUTILS_TOOLBOX_ENV_FILE_HPP

#include "seautils/propagation/field.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::toolbox {

/// An environment file of the Acoustics Toolbox with those that it asks for, as BELLHOP reads them, or KRAKEN and SCOOTER
/// with a .flp for FIELD.
struct EnvFile {
    propagation::Environment environment;  ///< with the first source
    std::vector<double> source_depth_m;    ///< one at least; grows
    propagation::FieldOptions options;     ///< as the run type has it
    propagation::Engine engine = propagation::Engine::automatic;
    bool arrivals = false;             ///< they are wanted, in place of losses
    std::vector<std::string> remarks;  ///< what was clamped, sorted out or left alone
};

/// Gives the text of the file beside it with this extension, as "bty"; none where there is none.
using Companion = std::function<std::optional<std::string>(const std::string& extension)>;

/// @throws DataError  says the line (of which file, where it is another), the name of the value, and what is wrong with it;
///                    or names what this does not read: elastic layers, biological absorption, and
///                    rays as a result
/// Media below the first are layers of the bottom.
/// Format: section 11 of the project's acoustics specification; the Toolbox's user manual.
EnvFile read_env(std::string_view text, const Companion& companion);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_ENV_FILE_HPP
