#ifndef SEAUTILS_TOOLBOX_ENV_WRITER_HPP
#define SEAUTILS_TOOLBOX_ENV_WRITER_HPP

#include "seautils/propagation/field.hpp"

#include <map>
#include <string>

namespace seautils::toolbox {

/// Texts of files by their extension, as "env".
using Files = std::map<std::string, std::string>;

/// What BELLHOP is to be fed: .env, and .bty, .ati, .ssp, .sbp, .brc, .trc where they are needed.
/// @param arrivals  in place of losses
/// @throws DataError  the environment has what cannot be said there: layers of the bottom
Files write_bellhop(const propagation::Environment& environment,
                    const propagation::FieldOptions& options, bool arrivals);

/// Phase speeds between which modes are looked for, and wavenumbers integrated.
struct PhaseSpeeds {
    double least_mps = 0, most_mps = 0;
};

/// What KRAKEN, KRAKENC and SCOOTER are to be fed: .env, .brc and .trc, and a .flp for FIELD. Layers of the bottom are media.
/// @param reach_km  how far the field is to be computed without wrapping around
/// @throws DataError  the environment depends on range, or has what cannot be said there
Files write_kraken(const propagation::Environment& environment,
                   const propagation::FieldOptions& options, PhaseSpeeds speeds, double reach_km);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_ENV_WRITER_HPP
