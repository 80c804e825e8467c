#ifndef SEAUTILS_QUEUE_MESSAGE_HPP
#define SEAUTILS_QUEUE_MESSAGE_HPP

#include "seautils/queue/config.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace seautils::queue {

/// The present on two clocks: ages and waits are told by one that never steps, so that a wall clock
/// which is set (a first GPS fix) makes nothing expire; the other tells what people read.
struct Now {
    std::int64_t steady_ns = 0;  ///< since any origin; never decreases
    std::int64_t utc_us = 0;     ///< microseconds since 1970, UTC; may step
};

/// A message as an application hands it over.
struct Message {
    QueueKey queue;
    std::uint32_t src = 0;                   ///< modem ID of the sender; 0: this vehicle's
    std::optional<bool> ack_requested;       ///< absent: as the queue is configured
    std::optional<std::int64_t> created_us;  ///< UTC, when its content was true; absent: now
    std::string data;                        ///< 1 byte to as many as the largest frame holds
};

/// A message that was accepted.
struct Accepted {
    std::uint64_t sequence =
        0;                     ///< its name, unique among those queued; of equals in age the order
    Message message;           ///< created_us is set
    std::int64_t born_ns = 0;  ///< steady clock, when its content was true
    std::uint32_t sends = 0;   ///< times that it was sent without being acknowledged
};

/// No message is taken to be older: 100 years.
inline constexpr std::int64_t oldest_us = std::int64_t{100} * 366 * 86400 * 1'000'000;

/// Gives a message its place in time: its age is what created_us says, at least 0, at most
/// oldest_us; from here on the steady clock counts it.
Accepted accept(Message message, std::uint64_t sequence, Now now);

enum class DropReason {
    expired,    ///< older than its ttl
    overflow,   ///< its queue holds max_queue messages
    too_large,  ///< no frame holds it
    refused,    ///< not a message for this modem
};

/// A message that will not be sent.
struct Drop {
    Message message;
    DropReason reason = DropReason::refused;
    std::string why;  ///< one line, with the value and its bound
    std::int64_t age_ns = 0;
    std::uint32_t sends = 0;
    std::uint64_t sequence = 0;  ///< of an accepted one; 0: it never was
};

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_MESSAGE_HPP
