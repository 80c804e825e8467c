#ifndef SEAUTILS_PROPAGATION_BEAM_INTENSITY_HPP
#define SEAUTILS_PROPAGATION_BEAM_INTENSITY_HPP

#include "seautils/propagation/beam_columns.hpp"
#include "seautils/propagation/beam_kind.hpp"
#include "seautils/propagation/ray_energy.hpp"

#include <array>
#include <vector>

namespace seautils::propagation {

/// Where beams meet columns, many at a time.
struct Spots {
    static constexpr std::size_t most = 256;
    using Floats = std::array<float, most>;
    std::size_t count = 0;
    std::array<std::uint32_t, most> column;
    // What they are made of: the arc up to the column, speed at its beginning, and what the ray has
    // gathered.
    Floats cosine, sine, turn, along_m, depth_m, speed_mps, gradient, width_m, path_m, energy;
    // What follows: the kernel over depth, and how far it reaches.
    Floats height, steepness, half_m, mirrored;
    std::array<std::uint8_t, most> hat;
};

/// Sums intensities of beams over columns, spec §7: the energy of a beam spread over a kernel of
/// unit area, in floats.
class IntensitySum {
public:
    IntensitySum(const RaySea& sea, const Columns& columns, const BeamKind& kind);

    /// Traces the ray of an angle and adds its beam.
    /// @param even  every second beam of the fan: twins of columns take it for two
    /// @param ray   what is known of the ray, and is known afterwards
    void add(const Launch& launch, bool even, KeptRay& ray);
    void add(const Launch& launch, bool even);
    void add(const IntensitySum& other);
    /// After the last beam.
    void finish() { flush(); }
    std::uint64_t cut() const { return cut_ + walk_.cut(); }  ///< rays ended for their legs
    /// Intensity re 1 m, at depths of a column as Columns has them. After finish().
    const float* column(std::size_t column) const { return sum_.data() + columns_.offset(column); }

private:
    void meet(const EnergyArc& arc, const EnergyState& state, std::size_t column);
    void put(const EnergyArc& arc, const EnergyState& state, std::size_t column, double share);
    void put_twin(const EnergyArc& arc, const EnergyState& state, std::size_t column);
    void flush();
    void spread_all();
    void spread_all_wide();
    void shape();
    void spread(std::size_t spot);
    void spread(std::size_t spot, const Columns::View& column, float depth_m, float height);

    const RaySea& sea_;
    const Columns& columns_;
    BeamKind kind_;
    EnergyWalk walk_;
    KeptRay forgotten_;      // of a ray that is not kept: its room
    std::uint64_t cut_ = 0;  // by others
    Spots spots_;
    bool even_ = false;                            // of the ray under way
    double energy_ = 0, width_per_q_ = 0;          // of the ray under way
    float least_per_m_ = 0, least_at_most_m_ = 0;  // width of a beam over its path; 0 of hats
    std::vector<float> sum_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_BEAM_INTENSITY_HPP
