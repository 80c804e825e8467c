#ifndef SEAUTILS_POSITION_OBSERVER_HPP
#define SEAUTILS_POSITION_OBSERVER_HPP

#include "seautils/position/cell.hpp"
#include "seautils/position/codec.hpp"
#include "seautils/position/state_bytes.hpp"

#include <array>
#include <cstdint>
#include <memory>

namespace seautils::position {

/// Where a vehicle is expected to be next.
struct Prediction {
    std::array<std::int64_t, 3> cell{};  ///< x, y, z, rounded; may lie outside of the limits
    std::int64_t deviation = 1;          ///< of each axis, in 1/65536 cell; 1 to 2^40
};

/// What both ends make of a vehicle's last positions. Integers only; lengths inside are in 1/65536
/// of a cell, and times in steps of the interval.
class Observer {
public:
    virtual ~Observer() = default;
    virtual std::unique_ptr<Observer> clone() const = 0;

    virtual void restart(const Cell& cell) = 0;
    virtual Prediction predict() const = 0;
    /// The next position, which may be max_delta at most away from the prediction.
    virtual void learn(const Cell& next) = 0;

    virtual void save(StateWriter& out) const = 0;
    /// @throws DataError  damaged; the observer is then to be thrown away
    virtual void load(StateReader& in) = 0;
};

/// Farthest that a delta can be from its prediction, in cells.
inline constexpr std::int64_t max_delta = 5000;

/// The way s*tau that a vehicle makes in an interval, in 1/65536 cell; at most 2^38 (2^22 cells).
std::int64_t step_length(const CodecOptions& options);

/// Goes on for s*tau along the line of the last two positions, eq. 3.5 and 3.6 of the thesis; and
/// in depth as much as the last time: z[n-1] + (z[n-1] - z[n-2]). (Eq. 3.7 as printed has z[n-1]
/// less that difference; it then costs 3 bits more.)
///
/// After a restart there is no heading, so that the vehicle is expected to stay; where it did not
/// move the heading is kept. The deviation is s*tau.
std::unique_ptr<Observer> make_fixed_observer(const CodecOptions& options);

/// A Kalman filter for each axis of position, velocity and acceleration, eq. 3.8 to 3.20: process
/// noise g g' sigma_j² with g = [tau²/2, tau, 1] (eq. 3.14 and 3.15, an axis at a time) and
/// sigma_j² = 1e-3 m²/s⁴; noise of a measurement R = 25 m².
///
/// At a restart the vehicle rests, with the covariance diag(R, s², (s/tau)²): with it, and
/// the deviation of the prediction's own covariance (without R), the reference figures are met to
/// the last digit given. The filter's gains do not depend on the positions; they are computed
/// once, for 256 positions after a restart, and then stay. Where an interval is so long or a speed
/// so high that the covariance is beyond 2^16 R (or 2^20 R at a restart), that is taken for it: the
/// gains are what they are for any greater one.
std::unique_ptr<Observer> make_kalman_observer(const CodecOptions& options);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_OBSERVER_HPP
