#ifndef SEAUTILS_PROPAGATION_BEAM_SUM_HPP
#define SEAUTILS_PROPAGATION_BEAM_SUM_HPP

#include "seautils/propagation/field.hpp"
#include "seautils/propagation/ray_beam.hpp"

#include <complex>
#include <vector>

namespace seautils::propagation {

/// Receivers as beams meet them: column by column.
struct Columns {
    std::vector<double> range_m;  ///< those above 0
    std::vector<float> depth_m;
    std::size_t stride = 0;  ///< depths, rounded up to whole vectors

    /// @param receivers  ranges and depths grow
    explicit Columns(const Receivers& receivers);
    /// First depth that is not above `depth`.
    std::size_t first_below(float depth) const;

private:
    float top_m_ = 0, per_bin_ = 0;
    std::vector<std::uint32_t> bin_;
};

/// The widths of beams and the fan that they stand in.
struct BeamKind {
    Sum sum = Sum::incoherent;
    Beam beam = Beam::gaussian;
    double spacing_rad = 0;
    double least_amplitude = 0;
    double baffle_from_deg = 0, baffle_to_deg = 0;
};

/// Sums beams over columns of receivers: intensities, or pressures where the sum is coherent.
class BeamSum {
public:
    BeamSum(const RaySea& sea, const Columns& columns, const BeamKind& kind);

    /// Traces the ray of an angle and adds its beam.
    /// @param level  amplitude of the source in that direction
    void add(double launch_rad, double level);
    void add(const BeamSum& other);

    const std::vector<float>& intensity() const { return intensity_; }  ///< [range][stride]
    const std::vector<std::complex<float>>& pressure() const { return pressure_; }

private:
    struct Spot;
    void deposit(const Leg& leg, const BeamState& state, std::size_t column);
    void add_intensity(const Spot& spot, std::size_t column);
    void add_pressure(const Spot& spot, const BeamState& state, std::size_t column);

    const RaySea& sea_;
    const Columns& columns_;
    BeamKind kind_;
    BeamWalk walk_;
    double cosine_ = 1, level_ = 1;  // of the ray under way
    std::vector<float> intensity_;
    std::vector<std::complex<float>> pressure_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_BEAM_SUM_HPP
