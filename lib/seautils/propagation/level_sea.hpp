#ifndef SEAUTILS_PROPAGATION_LEVEL_SEA_HPP
#define SEAUTILS_PROPAGATION_LEVEL_SEA_HPP

#include "seautils/propagation/field.hpp"
#include "seautils/propagation/mesh_rows.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace seautils::propagation {

/// What modes and wavenumber integration share: a sea that does not depend on range, and the receivers in it.
struct LevelSea {
    /// @param engine  as a message names it
    /// @throws DataError  what rays alone can do is asked for: says what
    LevelSea(const Environment& environment, const FieldOptions& options, const char* engine);

    Column column;
    Edge surface, bottom;
    Waveguide guide;
    double most_k2 = 0;             ///< of the water, rad²/m²
    std::vector<std::size_t> rows;  ///< of the grid: depths in the water
    std::vector<double> depth_m;    ///< theirs

    LevelSea(const LevelSea&) = delete;
    LevelSea& operator=(const LevelSea&) = delete;
};

/// A grid without values: NaN.
Field empty_field(const Environment& environment, const FieldOptions& options, Engine engine);

/// Puts a pressure (exp(-iωt), 1 at 1 m) in its cell, or the root of an intensity.
void put_pressure(Field& field, std::size_t cell, const std::complex<double>& pressure);
void put_intensity(Field& field, std::size_t cell, double intensity);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_LEVEL_SEA_HPP
