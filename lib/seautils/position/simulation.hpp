#ifndef SEAUTILS_POSITION_SIMULATION_HPP
#define SEAUTILS_POSITION_SIMULATION_HPP

#include "seautils/position/codec.hpp"
#include "seautils/position/horizon.hpp"
#include "seautils/position/link_options.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace seautils::position {

/// What becomes of packets: each is lost by itself, by chance; so is each acknowledgement. One packet
/// may go for each position, and its acknowledgement is back before the next.
struct Losses {
    double packet = 0;  ///< 0 to below 1
    double ack = 0;     ///< 0 to below 1
    std::uint64_t seed = 0;
};

/// What sending a track costs, and how late it comes.
struct LinkCost {
    double bits = 0;        ///< on average for each position sampled
    double age = 0;         ///< of the newest position known, on average, in intervals
    bool is_stable = true;  ///< false: more is sampled than arrives; the age grows for ever
};

/// A full position for each that is sampled, never again: what bits a position costs, and
/// p / (1 - p) intervals of age (Fig 3.10 of the thesis).
LinkCost simulate_full(double full_bits, const Losses& losses, std::size_t slots);

/// Differences of a constant size, each sent until it is acknowledged: a packet holds the oldest that
/// are not, as many as fit (Fig 3.10). Bits are those of full packets; the age that of packets with
/// what is there.
/// Source: T. Schneider's thesis, MIT/WHOI 2013, section 3.5.
/// Check values: 11.1 bits in packets of 55, no acknowledgement lost: bits are 13.75 / (1 - p).
/// @throws ConfigError  not one fits
LinkCost simulate_arq(double delta_bits, double packet_bits, const Losses& losses,
                      std::size_t slots);

/// What a Sender and a Receiver make of a track: numbers are of all runs together.
struct LinkReport {
    LinkCost cost;           ///< bits of header and positions of a packet, once the start of the
                             ///< session is acknowledged; neither check nor filling
    double header_bits = 0;  ///< of these, the header
    double start_bits = 0;   ///< of all packets of a run before that
    double air_bytes = 0;    ///< of a packet, all of it
    std::size_t sampled = 0;
    std::size_t arrived = 0;  ///< when the track ended
    std::size_t wrong = 0;    ///< other than what was sampled: none
    std::size_t starts = 0;   ///< packets before the start is acknowledged
    std::size_t packets = 0;  ///< after that
};

/// @param track      at least one, in order of time
/// @param max_bytes  of a packet, with its check
/// @param runs       how often the track is sent, from nothing, over a sea with the next seed
LinkReport simulate_link(std::span<const Fix> track, const LinkOptions& options, const Codec& codec,
                         const Horizon& horizon, std::size_t max_bytes, const Losses& losses,
                         std::size_t runs = 1);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_SIMULATION_HPP
