#ifndef SEAUTILS_SIM_OCEAN_HPP
#define SEAUTILS_SIM_OCEAN_HPP

#include "seautils/sim/packet.hpp"
#include "seautils/sim/scenario.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::sim {

/// What became of a packet on its way to a receiver.
enum class Outcome {
    received,
    collision,     ///< overlapped another arrival at the receiver
    half_duplex,   ///< the receiver was sending
    out_of_range,  ///< not audible there
    lost,     ///< by chance, or not understood: its announcement was not heard, it was cut short
    bad_crc,  ///< came, with spoilt frames
    deaf,     ///< the receiver was starting anew
};

/// Ground truth, as Record.Acoustic has it.
struct Truth {
    unsigned src = 0;       ///< address of who sent it; a transponder: 0
    unsigned receiver = 0;  ///< address of who could have heard it; a transponder: 0
    unsigned dest = 0, rate = 0;
    PacketKind kind = PacketKind::data;
    Time sent = 0;                ///< the first sound left
    std::optional<Time> heard{};  ///< the first sound arrived; none: out of range
    Time air = 0;
    double range_m = 0;
    std::optional<double> tl_db{};  ///< where a table of transmission loss is used
    Outcome outcome = Outcome::received;
    std::size_t bytes = 0;
    std::vector<unsigned> bad_frames{};  ///< from 0
};

/// Where an ocean says what happens, in the order of time.
class Sink {
public:
    virtual ~Sink() = default;
    /// The last byte of a sentence, with its line end, has come to the host.
    /// @param node  its place in Scenario::nodes
    virtual void to_host(std::size_t node, Time time, std::string_view sentence) = 0;
    /// The fate of a packet at a receiver is known: when its last sound has come there, or, where
    /// it is not audible, when it leaves.
    virtual void truth(Time time, const Truth& truth) = 0;
};

/// Modems, and the water between them. It has no clock: time is passed in.
///
/// - Sound goes straight from where its source is when it leaves to where the receiver is when it
///   arrives. A packet that is not audible at a receiver is silent there.
/// - Two audible packets that overlap at a receiver, by however little, spoil each other: collision.
///   Packets that are lost by chance still do. The receiver noticed the first one's beginning.
/// - A modem that sends hears nothing: what is arriving when it begins, or begins to arrive while
///   it sends, is spoilt there.
/// - Long-baseline pings have their own frequencies: they spoil nothing and nothing spoils them.
/// - Chance is drawn by packet and receiver: what happens elsewhere does not change it.
/// - Sentences leave one after the other at the speed of the serial line, 10 bits a byte.
class Ocean {
public:
    /// Switches all modems on.
    /// @param start  when: the scenario's epoch, or later where it is joined under way. Restarts that
    ///               it plans for before are left out.
    Ocean(const Scenario& scenario, Sink& sink, Time start);
    ~Ocean();
    Ocean(const Ocean&) = delete;
    Ocean& operator=(const Ocean&) = delete;

    /// A line from a host, without its end; after all that happens before `now`.
    void from_host(std::size_t node, std::string_view line, Time now);

    /// Lets happen what is due until `now`, which never goes back.
    void advance(Time now);

    /// When the next thing is due; `never` where nothing is.
    Time next() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_OCEAN_HPP
