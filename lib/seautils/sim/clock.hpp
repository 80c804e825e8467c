#ifndef SEAUTILS_SIM_CLOCK_HPP
#define SEAUTILS_SIM_CLOCK_HPP

#include "seautils/sim/track.hpp"

#include <cmath>

namespace seautils::sim {

/// A clock that was set once and runs fast or slow since.
class DriftingClock {
public:
    /// @param drift_ppm  microseconds that it gains in a second
    explicit DriftingClock(double drift_ppm) : drift_(drift_ppm * 1e-6) {}

    void set(Time now, Time reading) {
        set_at_ = now;
        reading_ = reading;
    }

    /// What it shows at a time; never before 1970.
    Time at(Time now) const {
        const Time since = now - set_at_;
        const Time reading =
            reading_ + since + static_cast<Time>(std::llround(static_cast<double>(since) * drift_));
        return reading < 0 ? 0 : reading;
    }

private:
    double drift_;
    Time set_at_ = 0, reading_ = 0;
};

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_CLOCK_HPP
