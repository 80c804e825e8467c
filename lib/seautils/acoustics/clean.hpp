#ifndef SEAUTILS_ACOUSTICS_CLEAN_HPP
#define SEAUTILS_ACOUSTICS_CLEAN_HPP

#include "seautils/acoustics/sample.hpp"

#include <span>
#include <vector>

namespace seautils::acoustics {

/// Which samples of a cast or of a vehicle's way are left out.
struct Cleaning {
    /// A speed of sound, or a depth, that is farther from the median of the seven scans around it than so
    /// many of their standard deviations (1.4826 times the median distance), and than 0.5 m/s or 1 m, is
    /// a spike; 0: none is. Near the ends there are fewer scans around; the first and the last one are
    /// judged by their depth alone.
    double spike_deviations = 5;
    /// Scans that lie more than this behind the farthest so far of a dive or a climb, and that the sensor
    /// passes again within loop_s (or ever, where no times are known), are a loop; 0: none are.
    double loop_m = 0.1;
    double loop_s = 60;
    /// Scans between whose neighbours the depth changes more slowly are slow; 0: none are. Needs times.
    double least_speed_mps = 0;
    /// By how much the sensor comes back where a dive or a climb ends.
    double turn_m = 10;
};

/// Why each sample is left out; Drop::none: it is not.
std::vector<Drop> clean(std::span<const Sample> samples, const Cleaning& how);

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_CLEAN_HPP
