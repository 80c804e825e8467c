#ifndef SEAUTILS_PROPAGATION_BEAM_KIND_HPP
#define SEAUTILS_PROPAGATION_BEAM_KIND_HPP

#include "seautils/propagation/field.hpp"

#include <cstdint>

namespace seautils::propagation {

/// What beams are added, and how.
struct BeamKind {
    Sum sum = Sum::incoherent;
    Beam beam = Beam::gaussian;
    double least_amplitude = 0;
    std::uint64_t legs = 0;                           ///< after which a ray ends
    double mark_every_m = 0;                          ///< of kept rays; 0: none
    double baffle_from_sine = 0, baffle_to_sine = 0;  ///< of elevation; equal: none
    /// A Gaussian beam's width over the distance between neighbours.
    double width_factor = 1;
    /// What of a beam wider than least_width_m() would lie outside the water is mirrored into it.
    bool mirrored = false;
    bool wide = true;  ///< by vectors of eight, where the processor has them: the sums are the same
};

/// One beam of a fan.
struct Launch {
    double angle_rad = 0;
    double spacing_rad = 0;  ///< share of the fan
    double level = 1;        ///< amplitude of the source in that direction
    double cosine = 1;       ///< of the angle
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_BEAM_KIND_HPP
