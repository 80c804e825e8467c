#ifndef SEAUTILS_PROPAGATION_BEAM_PRESSURE_HPP
#define SEAUTILS_PROPAGATION_BEAM_PRESSURE_HPP

#include "seautils/propagation/beam_columns.hpp"
#include "seautils/propagation/beam_kind.hpp"
#include "seautils/propagation/ray_beam.hpp"

#include <complex>
#include <vector>

namespace seautils::propagation {

/// Sums pressures of beams over columns, spec §7: a plane front about the ray. Phases in double,
/// sums in float.
class PressureSum {
public:
    PressureSum(const RaySea& sea, const Columns& columns, const BeamKind& kind);

    /// Traces the ray of an angle and adds its beam.
    /// @param even  every second beam of the fan: twins of columns take it for two
    void add(const Launch& launch, bool even);
    void add(const PressureSum& other);
    void finish() {}                                          // as of IntensitySum
    std::uint64_t cut() const { return cut_ + walk_.cut(); }  ///< rays ended for their legs
    /// Pressure re 1 at 1 m, at depths of a column as Columns has them.
    const std::complex<float>* column(std::size_t column) const {
        return sum_.data() + columns_.offset(column);
    }

private:
    struct Spot;
    void meet(const Leg& leg, const BeamState& state, std::size_t column);
    void put(const Leg& leg, const BeamState& state, std::size_t column, double share);
    void spread(const Spot& spot, std::size_t column);
    static void add_evenly(const Spot& spot, bool hat, double n, double depth_m, double step_m,
                           std::complex<float>* out, const std::complex<float>* end);

    const RaySea& sea_;
    const Columns& columns_;
    BeamKind kind_;
    BeamWalk walk_;
    std::uint64_t cut_ = 0;  // by others
    Launch launch_;          // of the ray under way, and
    bool even_ = false;      // as add() has it
    std::vector<std::complex<float>> sum_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_BEAM_PRESSURE_HPP
