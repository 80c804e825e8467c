#ifndef SEAUTILS_SIM_WATER_HPP
#define SEAUTILS_SIM_WATER_HPP

#include "seautils/sim/scenario.hpp"

#include <cstdint>
#include <initializer_list>

namespace seautils::sim {

/// Chance that depends on nothing but the seed and what it is asked about: what happens to one
/// packet at one receiver stays the same whatever else happens, and in whatever order.
class Chance {
public:
    explicit Chance(std::uint64_t seed) : seed_(seed) {}

    /// True with probability p (0 to 1), always the same for the same words.
    bool happens(double p, std::initializer_list<std::uint64_t> words) const;

    /// 64 bits, by SplitMix64's finalizer over one word after the other.
    std::uint64_t bits(std::initializer_list<std::uint64_t> words) const;

private:
    std::uint64_t seed_;
};

/// How sound comes from a place to another.
struct Path {
    Time arrives = 0;        ///< the first sound
    double range_m = 0;      ///< from where it was sent to where it is heard
    double closing_mps = 0;  ///< how fast the range shrinks
    double tl_db = 0;        ///< transmission loss: of the table, else 20 log10(range)
    double snr_db = 0;       ///< source level less transmission loss less noise
    bool audible = true;     ///< within max_range_m and, with a table, above the rate's threshold
};

/// The water between modems: delay, range, loss. Sound goes straight at one speed.
class Water {
public:
    Water(const WaterSpec& spec, std::uint64_t seed) : spec_(spec), chance_(seed) {}

    /// Sound of a packet of `rate` that leaves `from` at `sent`: the receiver moves until it
    /// arrives, which is solved by repetition (each step gains a factor of speed / sound speed).
    Path path(const Track& from, const Track& to, Time sent, unsigned rate) const;

    /// Whether a packet is lost by chance: by its range or whatever its range.
    /// @param source    number of the emitter, from 0
    /// @param packet    number of its packet, from 0
    /// @param receiver  number of the receiver, from 0
    bool is_lost(double range_m, std::uint64_t source, std::uint64_t packet,
                 std::uint64_t receiver) const;

    /// Whether a frame (from 0) of it is spoilt.
    bool is_spoilt(std::uint64_t source, std::uint64_t packet, std::uint64_t receiver,
                   std::uint64_t frame) const;

    const WaterSpec& spec() const { return spec_; }

private:
    double threshold_db(unsigned rate) const;

    WaterSpec spec_;
    Chance chance_;
};

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_WATER_HPP
