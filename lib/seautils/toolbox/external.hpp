#ifndef SEAUTILS_TOOLBOX_EXTERNAL_HPP
#define SEAUTILS_TOOLBOX_EXTERNAL_HPP

#include "seautils/propagation/field.hpp"
#include "seautils/toolbox/program.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace seautils::toolbox {

/// Programs of others that compute a field. They must be installed (as NAME or NAME.exe), KRAKEN with FIELD; of OASES it
/// is OAST.
enum class Program : std::uint8_t { bellhop, bellhopcxx, kraken, krakenc, scooter, oases };

/// @throws DataError  another name
Program parse_program(std::string_view name);

/// Where and how they run.
struct ExternalRun {
    std::string temporary;  ///< folder in which a private one is made for each run
    ProgramLimits limits;
};

/// Losses that a program computes. It runs in a folder of its own, in which there are no results when it begins; what
/// counts as a result is a file of the size that was asked for, and no fatal error in its log.
/// @throws DataError  the environment cannot be said to it; it failed, with what its log says; and as run_program()
propagation::Field external_field(Program program, const propagation::Environment& environment,
                                  const propagation::FieldOptions& options, const ExternalRun& run);

/// Arrivals by BELLHOP. @throws DataError  another program
std::vector<propagation::ReceiverArrivals> external_arrivals(
    Program program, const propagation::Environment& environment,
    const propagation::FieldOptions& options, const ExternalRun& run);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_EXTERNAL_HPP
