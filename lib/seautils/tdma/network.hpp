#ifndef SEAUTILS_TDMA_NETWORK_HPP
#define SEAUTILS_TDMA_NETWORK_HPP

#include "seautils/core/random.hpp"
#include "seautils/tdma/rule.hpp"

#include <cstdint>
#include <vector>

namespace seautils::tdma {

/// What a simulated vehicle does in a slot.
enum class Does : char {
    send = 'S',    ///< speaks; it hears nothing meanwhile
    listen = 'L',  ///< somebody's turn whom it knows
    blank = 'B',   ///< nobody's turn, as far as it knows
    wait = 'W',    ///< has learned of somebody, and waits for the new cycle to begin
};

struct Vehicle {
    explicit Vehicle(int own_address) : address(own_address), world(own_address) {}

    int address;
    World world;
    std::uint64_t resume = 0;  ///< first slot in which it takes its turns
    // Of the last slot:
    std::uint64_t cycle = 0;  ///< number of the cycle that the slot lay in, by its own count
    Does does = Does::wait;
    std::vector<int> heard;
};

struct NetworkOptions {
    Excitation excitation;
    double p_collide = 1;  ///< probability that a slot in which several speak is lost, 0 to 1
    std::uint64_t seed = 0;
};

/// Vehicles that find each other: all hear each other without loss, each always speaks in its turn,
/// clocks agree, and nobody is forgotten. Time is a number of slots since the origin.
///
/// A vehicle that comes takes its turns from the first cycle on that begins then or later. One that
/// hears of another takes it into its world and waits for the first cycle of the grown length
/// that begins strictly after the end of the slot that it heard it in. Of several that speak in one
/// slot, either nothing gets through (a collision) or all who listen hear all.
///
/// Source: T. Schneider, PhD thesis (MIT/WHOI, 2013), section 2.5.
/// Check value: {1, 3}, goby1, C = 5 from slot 0 know each other in slot 7 and all take turns again
/// from slot 9 on (table 2.7).
class Network {
public:
    /// @param addresses  1 to max_address, different, at least one
    /// @param start      slot at which all start
    Network(const std::vector<int>& addresses, std::uint64_t start, const NetworkOptions& options);

    /// A vehicle that is new comes.
    void join(int address);

    /// Plays the next slot.
    void step();

    std::uint64_t start() const { return start_; }
    std::uint64_t slot() const { return slot_; }  ///< the next one to be played
    const std::vector<Vehicle>& vehicles() const { return vehicles_; }

    bool got_through() const { return got_through_; }  ///< in the last slot somebody's sound did
    bool all_known() const;                            ///< everybody knows everybody
    /// The first slot from which on everybody takes its turns, if nobody learns any more.
    std::uint64_t settled() const;
    /// Whether it has been shown that nobody will learn any more: all slots lost to collisions, and
    /// two whole periods without change. Never so where chance or Rule::hash is at play.
    bool is_stuck() const;

private:
    void act();
    void hear(Vehicle& vehicle);
    bool is_lost();
    void changed();

    std::vector<Vehicle> vehicles_;  ///< by address
    NetworkOptions options_;
    SplitMix64 random_;
    std::uint64_t start_, slot_;
    std::uint64_t period_ = 0;      ///< of the worlds as they are; 0: none
    std::uint64_t stuck_from_ = 0;  ///< slot from which on is_stuck
    std::vector<int> senders_;
    bool got_through_ = false;
};

/// How a run of a network ended.
struct Outcome {
    bool succeeded = false;           ///< everybody knows everybody
    bool is_proven = false;           ///< it failed, and would for ever
    bool was_quiet = false;           ///< in the first two slots nothing got through, heard or not
    std::uint64_t known_slots = 0;    ///< slots until everybody knew everybody; of success only
    std::uint64_t settled_slots = 0;  ///< slots until all took turns again; of success only
};

/// Runs until everybody knows everybody, this is shown never to be, or `limit` slots are over.
Outcome run(Network& network, std::uint64_t limit);

}  // namespace seautils::tdma

#endif  // SEAUTILS_TDMA_NETWORK_HPP
