#ifndef SEAUTILS_POSITION_RECEIVER_HPP
#define SEAUTILS_POSITION_RECEIVER_HPP

#include "seautils/position/packet.hpp"
#include "seautils/position/track_state.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::position {

/// What a packet brought.
struct Arrival {
    enum class Outcome {
        decoded,      ///< new positions, or such as were known
        stale,        ///< of a session that has ended, or from before what the sender builds on
        undecodable,  ///< damaged, old, or for a receiver that knows something else
    };
    Outcome outcome = Outcome::undecodable;
    std::vector<Fix> fixes;  ///< each position once, in the order in which it became known
    std::string ack;         ///< to be sent back; empty: nothing is to be said
    std::string why;         ///< undecodable: for people
};

/// The receiving end. What it decodes is what was sampled: a packet that was damaged, came twice,
/// late, or was meant for a receiver that knows something else brings nothing.
///
/// It keeps what it knew at the oldest reference that the sender may still use, and the positions
/// after it. After 8 packets in a row that it cannot decode (at once, if it knows nothing), it
/// asks the sender to begin anew.
///
/// To go on after a restart, keep save() in a file before an acknowledgement leaves.
class Receiver {
public:
    /// As Sender().
    Receiver(const LinkOptions& options, const Codec& codec, const Horizon& horizon);
    ~Receiver();
    Receiver(Receiver&&) noexcept;
    Receiver& operator=(Receiver&&) noexcept;

    /// Any bytes. Time is bounded: nothing is decoded whose check is wrong.
    Arrival packet(std::string_view bytes);

    /// As those of Sender.
    std::string save() const;
    void load(std::string_view state);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_RECEIVER_HPP
