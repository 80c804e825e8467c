#ifndef SEAUTILS_PROPAGATION_RAY_FAN_HPP
#define SEAUTILS_PROPAGATION_RAY_FAN_HPP

#include "seautils/propagation/beam_kind.hpp"
#include "seautils/propagation/ray_sea.hpp"

#include <vector>

namespace seautils::propagation {

/// No more beams than this are chosen.
inline constexpr std::uint32_t most_automatic_beams = 100'000;

/// Amplitude of a source in a direction: linear between its points; 1 without any.
double level_at(const std::vector<PatternPoint>& pattern, double angle_deg);

/// The environment's fan: as many beams as it says, equally spaced from end to end; else as many as
/// the sum needs, at most `most_automatic_beams`, densest where they are flat.
std::vector<Launch> make_fan(const Environment& environment, const RaySea& sea,
                             const FieldOptions& options);

/// All that fan has of the receivers and of the sea: of flat rays. 0 where the environment gives the
/// number of beams.
double fan_spacing_rad(const Environment& environment, const RaySea& sea,
                       const FieldOptions& options);

/// A fan whose neighbours bracket the rays that meet receivers.
std::vector<Launch> make_bracketing_fan(const Environment& environment, const RaySea& sea);

/// How the beams of that fan are added: as the Acoustics Toolbox does where the environment gives
/// their number. Of an automatic fan, Gaussian beams are narrower, so that fewer do.
BeamKind beam_kind(const Environment& environment, const FieldOptions& options);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_FAN_HPP
