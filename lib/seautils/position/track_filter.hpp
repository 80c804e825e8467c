#ifndef SEAUTILS_POSITION_TRACK_FILTER_HPP
#define SEAUTILS_POSITION_TRACK_FILTER_HPP

#include "seautils/position/integer_math.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace seautils::position {

/// Gains of a Kalman filter of position and velocity, one axis, unit steps of time, whose velocity is
/// driven by white noise of `drift` (cells per step, per root of a step) and whose measurements have the
/// variance `noise` (cells²). It starts from two measurements, and a velocity that is uncertain by
/// `spread` besides: P = [[R, R], [R, 2R + spread²]].
///
/// Source: R. E. Kalman, J. Basic Eng. 82(1), 35-45 (1960), doi:10.1115/1.3662552, in whole numbers.
/// Check value: drift 0.2, noise 0.12, spread 2: the first gains are 0.975 and 0.827.
struct FilterGains {
    static constexpr std::size_t steps = 48;  ///< the last one goes on

    std::array<std::int32_t, steps> position{};    ///< Q16
    std::array<std::int32_t, steps> velocity{};    ///< Q16
    std::array<std::int32_t, steps> innovation{};  ///< its variance that is to be expected, Q16

    /// All Q16.
    FilterGains(std::int32_t drift_q16, std::int32_t noise_q16, std::int32_t spread_q16);
};

/// Position and velocity along one axis; from the origin of the grid, Q16.
struct AxisFilter {
    std::int64_t position = 0, velocity = 0;

    void start(std::int64_t cell, std::int64_t cells_per_step) {
        position = cell * 65536;
        velocity = cells_per_step * 65536;
    }
    void predict() { position += velocity; }
    /// What was measured less what was predicted, Q16.
    std::int64_t innovation(std::int64_t cell) const { return cell * 65536 - position; }
    void correct(std::int64_t innovation, const FilterGains& gains, std::size_t run) {
        position += innovation * gains.position[run] >> 16;
        velocity += innovation * gains.velocity[run] >> 16;
    }
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_TRACK_FILTER_HPP
