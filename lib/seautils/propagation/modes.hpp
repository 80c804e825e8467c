#ifndef SEAUTILS_PROPAGATION_MODES_HPP
#define SEAUTILS_PROPAGATION_MODES_HPP

#include "seautils/propagation/field.hpp"

namespace seautils::propagation {

/// Loss by a sum of normal modes, leaky ones included; the sea must not depend on range.
/// @throws DataError  check() does; the sea depends on range; more modes than `most_modes` would be needed
Field mode_field(const Environment& environment, const FieldOptions& options);

/// Loss by integration over horizontal wavenumber: exact for level fluid layers, and slow.
/// @throws DataError  check() does; the sea depends on range; the frequency is too high for the depth
Field wavenumber_field(const Environment& environment, const FieldOptions& options);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_MODES_HPP
