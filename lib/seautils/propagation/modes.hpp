#ifndef SEAUTILS_PROPAGATION_MODES_HPP
#define SEAUTILS_PROPAGATION_MODES_HPP

#include "seautils/propagation/field.hpp"

#include <cstdint>

namespace seautils::propagation {

/// What modes may cost: how many; times nodes of their mesh; times depths of receivers; times receivers; times slices of
/// the bottom's layers. What wavenumbers may: samples times receivers, (10 times) nodes, and (120 times) slices. Each a few seconds and some hundred megabytes.
inline constexpr std::uint64_t most_modes = 5000, most_mode_nodes = 40'000'000,
                               most_mode_values = 10'000'000, most_mode_work = 20'000'000'000,
                               most_wavenumber_work = 2'000'000'000, most_mode_slices = 200'000;

/// Both boundaries send back what meets them at some low angle: 3 % of its amplitude at least. Else there are no
/// modes to sum: water over water.
bool holds_modes(const Environment& environment);

/// Loss by a sum of normal modes, leaky ones included. Steep ones that leave less than 1 % of their amplitude
/// where the sum is to hold are left out: near the source, within three depths, some loss is missing
/// where there are more than 200 modes. The wave along the bottom is not in it.
/// Where the bottom has layers, modes are followed from those without losses.
/// Check values (Pekeris: 100 m of 1500 m/s over 1700 m/s of 1.8 g/cm³, 250 Hz): the first and the
/// last of 16 trapped wavenumbers are 1.0467587796 and 0.9266745618 rad/m.
/// @throws DataError  check() does; the sea depends on range; a source with a pattern or a line source; a
///                    semi-coherent sum, or a baffle: these are of rays; a boundary that is a table, or holds no modes; more
///                    modes, or work, than those would be needed
Field mode_field(const Environment& environment, const FieldOptions& options);

/// Loss by integration over horizontal wavenumber: all that there is in level fluid layers, and slow.
/// @throws DataError  as mode_field(), also for an incoherent sum; more work than most_wavenumber_work
Field wavenumber_field(const Environment& environment, const FieldOptions& options);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_MODES_HPP
