#ifndef SEAUTILS_QUEUE_CONTEST_HPP
#define SEAUTILS_QUEUE_CONTEST_HPP

#include "seautils/queue/config.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace seautils::queue {

/// Why a queue cannot win.
enum class Skip {
    none,      ///< it was considered
    empty,     ///< nothing that is not under way already
    blackout,  ///< served less than blackout_time_s ago
    size,      ///< nothing that fits
    dest,      ///< the packet goes to somebody else
    ack,       ///< the turn is for messages without acknowledgement
    expiring,  ///< would expire before it can arrive
};

/// A queue in a contest.
struct Candidate {
    QueueKey queue;
    double priority = 0;       ///< rounded; the contest itself is exact
    std::uint32_t queued = 0;  ///< messages waiting
    Skip skip = Skip::none;
    std::uint32_t bytes = 0;  ///< of the message that would go; 0: none
};

/// A contest for a place in a frame, told to people.
struct Contest {
    std::uint32_t transmission = 0;
    std::uint32_t frame = 0;
    std::uint32_t free_bytes = 0;
    std::vector<Candidate> candidates;  ///< considered ones first, the best of them first
    std::optional<QueueKey> winner;
    std::uint32_t sends = 0;  ///< of the winning message, before this one
    std::int64_t age_ns = 0;  ///< of the winning message
};

/// A frame that is being filled.
struct OpenFrame {
    std::uint32_t transmission = 0;
    std::uint32_t index = 0;
    std::uint32_t free_bytes = 0;
    std::optional<std::uint32_t> dest;  ///< of the packet, as soon as it is fixed
    bool acks = true;                   ///< messages that want an acknowledgement may go
    std::int64_t arrival_ns = 0;        ///< steady clock
};

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_CONTEST_HPP
