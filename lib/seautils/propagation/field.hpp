#ifndef SEAUTILS_PROPAGATION_FIELD_HPP
#define SEAUTILS_PROPAGATION_FIELD_HPP

#include "seautils/propagation/environment.hpp"

#include <complex>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::propagation {

/// How the paths (or modes) that meet at a receiver are added.
enum class Sum : std::uint8_t {
    coherent,       ///< with their phases
    semi_coherent,  ///< intensities, with the source's image in the surface in phase
    incoherent,     ///< intensities
};

enum class Beam : std::uint8_t { gaussian, hat };

enum class Engine : std::uint8_t { automatic, rays, modes, wavenumber };

struct FieldOptions {
    Sum sum = Sum::incoherent;
    Beam beam = Beam::gaussian;  ///< of rays
    std::uint32_t threads = 1;   ///< 1 to 64
    double least_amplitude =
        1e-4;  ///< a ray is given up when its boundaries have left less: -80 dB
    /// Elevations in which arrivals at the receiver are blocked by its vehicle; 0, 0: none.
    double baffle_from_deg = 0, baffle_to_deg = 0;
};

/// What a result rests on.
struct Basis {
    Engine engine = Engine::rays;
    std::string why;          ///< why this engine, where it was chosen
    std::uint64_t beams = 0;  ///< rays traced; 0 of other engines
    std::uint64_t modes = 0;
    /// Numerical, 95 % of the cells: of the number of beams, of meshes and samples; not of what is left
    /// out, of which the remarks tell. 0: not estimated
    double estimated_error_db = 0;
    std::vector<std::string> remarks;  ///< what was assumed, extended or clamped, for people
};

/// Transmission loss on the grid of receivers; of pairs 1 depth, and a range for each.
struct Field {
    std::size_t depths = 0, ranges = 0;
    /// [depth][range], dB re 1 m. NaN: no value (below the seabed, above the surface, range 0); infinite: no energy.
    std::vector<float> loss_db;
    /// [depth][range], re 1 at 1 m; the conjugate of the exp(-iωt) convention, as the Acoustics Toolbox has it. Empty
    /// where the sum is not coherent.
    std::vector<std::complex<float>> pressure;
    Basis basis;
};

/// One path from the source to a receiver.
struct Arrival {
    double amplitude =
        0;  ///< re 1 m: spreading, boundaries and pattern, without absorption by the water
    double phase_deg =
        0;  ///< of boundaries and caustics, without delay; the Acoustics Toolbox's convention
    double delay_s = 0;
    double absorption_db = 0;  ///< by the water along the path; positive
    double launch_deg = 0;     ///< positive down
    double arrival_deg = 0;    ///< of its direction of travel; positive down
    std::uint32_t surface_bounces = 0;
    std::uint32_t bottom_bounces = 0;
    std::uint32_t caustics = 0;
};

struct ReceiverArrivals {
    double depth_m = 0, range_m = 0;
    std::vector<Arrival> arrivals;  ///< by delay
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_FIELD_HPP
