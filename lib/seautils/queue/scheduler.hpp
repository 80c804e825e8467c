#ifndef SEAUTILS_QUEUE_SCHEDULER_HPP
#define SEAUTILS_QUEUE_SCHEDULER_HPP

#include "seautils/queue/config.hpp"
#include "seautils/queue/contest.hpp"
#include "seautils/queue/message.hpp"
#include "seautils/queue/priority.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seautils::queue {

struct SchedulerOptions {
    QueueConfigs queues;
    Policy policy = Policy::priority;
    std::uint32_t own_id = 0;             ///< modem ID of this vehicle, 1 to 30
    std::uint32_t max_frame_bytes = 256;  ///< of the largest frame of any rate
    /// How long after its arrival a transmission is given to be acknowledged, or its result to be
    /// told; then what it carried may be sent again.
    std::int64_t ack_wait_ns = 10 * QueueConfig::ns_per_s;
    std::uint32_t first_transmission = 1;  ///< number of the first; 1 up
};

/// A turn to fill: a packet's shape and what may go into it.
struct Turn {
    std::uint32_t frames = 1;           ///< at most so many
    std::uint32_t frame_bytes = 32;     ///< at most so many bytes in each
    std::optional<std::uint32_t> dest;  ///< modem ID; absent: the first message's
    bool acks = true;                   ///< whether messages that want an acknowledgement may go
    std::int64_t arrival_ns = 0;        ///< steady clock, when it will have arrived: the turn's end
};

/// A message in a packet.
struct Carried {
    std::uint64_t sequence = 0;
    std::uint32_t frame = 0;
    std::uint32_t sends = 0;  ///< with this one
    QueueKey queue;
};

/// What is to be sent in a turn.
struct Packet {
    std::uint32_t number = 0;  ///< of the transmission
    std::uint32_t dest = 0;
    bool ack_requested = false;       ///< some message in it wants one
    std::vector<std::string> frames;  ///< messages back to back; none is empty
    std::vector<Carried> carried;
};

/// What became of a transmission.
enum class Outcome { sent, late, busy, failed, refused };

/// How one queue does; counts since the start.
struct QueueStats {
    QueueKey queue;
    std::uint32_t queued = 0;     ///< waiting or under way
    std::uint64_t bytes = 0;      ///< in them
    std::uint32_t under_way = 0;  ///< sent, and neither acknowledged nor given up
    std::uint64_t accepted = 0, sends = 0, delivered = 0, returned = 0;
    std::uint64_t expired = 0, overflowed = 0, refused = 0;
    std::int64_t oldest_age_ns = 0;  ///< of the oldest message waiting
    std::int64_t mean_age_ns = 0;    ///< of messages when they were delivered

    /// Each accepted message is in exactly one place.
    bool is_conserved() const { return accepted == queued + delivered + expired + overflowed; }
};

/// What happened to messages since it was last asked.
struct Changes {
    std::vector<Drop> drops;
    std::vector<std::uint64_t> gone;  ///< sequences of those dropped or delivered
};

/// Queues of messages, and which of them is worth sending next. No clock, no file: time comes in with
/// each call, and never goes back on the steady clock.
///
/// A queue is named by DCCL id and destination, and is made by its first message. For each place in
/// a frame the queues hold a contest, which the greatest claim wins (priority.hpp); of equals the
/// lowest id, then the lowest destination. A queue that was never served has waited since the start.
/// The winner sends its newest message that fits (or oldest: newest_first), so that a large one in
/// front blocks nobody. Order and expiry go by the time a message was created.
///
/// A message that was put into a packet is under way until
/// - its receiver acknowledges its frame, or the packet was sent and it wants no acknowledgement:
///   it is delivered;
/// - the packet was not sent: it waits again at once, and its queue's claim is what it was before;
/// - nothing is heard of it for ack_wait_ns: it waits again. An acknowledgement that comes even later
///   still counts, while the transmission is among the last 64.
/// What is under way does not expire before that; but when a queue overflows it may be dropped.
class Scheduler {
public:
    Scheduler(SchedulerOptions options, Now start);
    ~Scheduler();
    Scheduler(const Scheduler&) = delete;
    Scheduler& operator=(const Scheduler&) = delete;

    /// Why a message can never be queued (too_large, refused), and counts it; nothing: it can.
    std::optional<Drop> check(const Message& message, Now now);

    /// A message that is not taken for a reason of the caller's; counts it.
    Drop refuse(const Message& message, DropReason reason, std::string why, Now now);

    /// Queues a message that check() lets through. It, or another of its queue, may be dropped by
    /// this: see take_changes(). Takes time in proportion to the logarithm of the queue's length.
    /// @param accepted  its sequence is greater than those of earlier pushes
    void push(Accepted accepted, Now now);

    /// Fills a packet. Takes time in proportion to queues × messages that go.
    /// @param tell  called with each contest, the last one, which nobody wins, too; may be empty
    /// @return      nothing: nothing can go
    std::optional<Packet> fill(const Turn& turn, Now now,
                               const std::function<void(const Contest&)>& tell = {});

    /// Frames arrived. Nothing happens unless `src` is whom that transmission went to.
    void acknowledge(std::uint32_t src, std::uint32_t transmission,
                     std::span<const std::uint32_t> frames, Now now);

    /// A transmission has ended so. Nothing happens when it is not known.
    void settle(std::uint32_t transmission, Outcome outcome, Now now);

    /// Drops what has expired, takes back what was waited for long enough.
    void advance(Now now);
    /// When advance() has something to do next, steady clock; it may turn out to be nothing.
    std::int64_t next_event_ns() const;

    Changes take_changes();

    /// When queues were served last, for the next start.
    void set_last(QueueKey queue, std::int64_t last_ns);

    std::uint32_t own_id() const;
    std::uint32_t next_transmission() const;       ///< the number that the next packet will have
    std::vector<QueueStats> stats(Now now) const;  ///< in the order of id and destination

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_SCHEDULER_HPP
