#ifndef SEAUTILS_PROPAGATION_SPREAD_HPP
#define SEAUTILS_PROPAGATION_SPREAD_HPP

#include "seautils/propagation/field.hpp"

#include <cstdint>
#include <span>

namespace seautils::propagation {

/// How the paths to a receiver spread what is sent over time; weighted by their intensities, absorption included.
struct Spread {
    double mean_delay_s = 0;        ///< behind the first path
    double rms_delay_s = 0;         ///< delay spread: around the mean
    double peak_to_mean_db = 0;     ///< intensity of the strongest path over the mean of all
    std::uint32_t within_20db = 0;  ///< paths within 20 dB of the strongest
    double span_10db_s =
        0;  ///< from the first to the last of the paths within 10 dB of the strongest
    double span_20db_s = 0;
};

/// Check value: intensities 1, 0.5, 0.1 at 0, 5, 20 ms give a mean of 2.8125 ms and a delay spread of 4.990225 ms.
/// @param arrivals  one at least, of some amplitude
/// Source: eq 4.5 of T. Schneider, Advances in Integrating Autonomy with Acoustic Communications for Intelligent
/// Networks of Marine Robots, MIT/WHOI 2013.
Spread spread_of(std::span<const Arrival> arrivals);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_SPREAD_HPP
