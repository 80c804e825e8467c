// What scheduler.cpp and contest.cpp share.
#ifndef SEAUTILS_QUEUE_SCHEDULER_IMPL_HPP
#define SEAUTILS_QUEUE_SCHEDULER_IMPL_HPP

#include "seautils/queue/fit_tree.hpp"
#include "seautils/queue/scheduler.hpp"

#include <limits>
#include <map>
#include <unordered_map>

namespace seautils::queue {

inline constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

/// A queued message: in one of the trees of its queue.
struct Entry : FitNode {
    std::string data;
    std::int64_t created_us = 0;
    std::uint32_t src = 0;
    std::uint32_t queue = 0;  ///< index of its queue
    std::uint32_t sends = 0;
    std::uint32_t transmission = 0;  ///< that it is under way in; 0: waits
};

/// When a queue was served last.
struct Last {
    std::int64_t ns = 0;             ///< never served: the start
    std::uint32_t transmission = 0;  ///< 0: none of this run
    bool ever = false;
};

struct Queue {
    QueueKey key;
    std::uint32_t index = 0;
    std::uint32_t count = 0;  ///< messages in both trees
    FitTree waiting;
    FitTree under_way;
    Last last;
    QueueConfig config;
    std::int64_t expiry_ns = never_ns;  ///< first instant at which a waiting message is too old
    QueueStats stats;             ///< but for `queued` and the ages, which are made when asked for
    double delivered_age_ns = 0;  ///< sum over the delivered ones
};

/// A transmission that something may still be heard of.
struct Flight {
    struct Served {
        std::uint32_t queue = 0;
        Last before;
    };
    std::uint32_t number = 0;
    std::uint32_t dest = 0;
    std::int64_t end_ns = 0;  ///< when it is waited for no longer
    bool over = false;        ///< nothing of it is under way any more
    std::vector<Carried> carried;
    std::vector<Served> served;
};

struct Scheduler::Impl {
    Impl(SchedulerOptions options_given, Now start);

    // contest.cpp: who goes next
    Entry* contest(const OpenFrame& frame, Now now,
                   const std::function<void(const Contest&)>& tell);
    Queue* best(const OpenFrame& frame, Now now);
    Claim claim(const Queue& queue, Now now) const;
    bool beats(const Queue& a, const Queue& b, Now now) const;
    Skip skip(const Queue& queue, const OpenFrame& frame, Now now) const;
    Candidate candidate(const Queue& queue, const OpenFrame& frame, Now now) const;
    Contest describe(const OpenFrame& frame, Now now) const;

    // scheduler.cpp: what becomes of messages
    Queue& queue_of(QueueKey key);
    Queue& queue_of(const Entry& entry) { return queues[entry.queue]; }
    Entry* find(std::uint64_t sequence);
    std::string refusal(const Message& message) const;
    Entry& insert(Accepted&& accepted);
    void overflow(Queue& queue, Entry& newcomer, Now now);
    void place(Entry& entry, OpenFrame& frame, Packet& packet, Flight& flight, Now now);
    void remove(Entry& entry);
    void drop(Entry& entry, DropReason reason, std::string why, Now now);
    void deliver(Entry& entry, Now now);
    void give_back(Flight& flight, bool was_sent);
    void restore_last(const Flight& flight);
    void expire(Queue& queue, Now now);
    void end_waits(Now now);
    void forget_flights();
    void watch(Queue& queue);
    void find_next_event();

    SchedulerOptions options;
    Last start;
    std::vector<Queue> queues;
    std::map<QueueKey, std::uint32_t> index;
    std::unordered_map<std::uint64_t, Entry> entries;  ///< by sequence
    std::map<std::uint32_t, Flight> flights;           ///< by number
    std::uint32_t next_transmission;
    std::int64_t next_event_ns = never_ns;
    Changes changes;
};

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_SCHEDULER_IMPL_HPP
