#include "seautils/queue/contest.hpp"

#include "seautils/queue/scheduler_impl.hpp"

#include <algorithm>
#include <utility>

namespace seautils::queue {

namespace {

/// What a queue's message must satisfy to go into the frame and arrive before it expires.
Fit fit_for(const Queue& queue, const OpenFrame& frame) {
    Fit fit{frame.free_bytes, frame.acks};
    if (!queue.config.is_infinite()) fit.born_ns = frame.arrival_ns - queue.config.ttl_ns;
    return fit;
}

Entry* fitting(const Queue& queue, const OpenFrame& frame) {
    return static_cast<Entry*>(
        queue.waiting.find(fit_for(queue, frame), queue.config.newest_first));
}

/// A packet to somebody also carries what is for everybody, but not the other way round.
bool goes_along(std::uint32_t dest, const OpenFrame& frame) {
    return !frame.dest || dest == *frame.dest || dest == 0;
}

}  // namespace

Claim Scheduler::Impl::claim(const Queue& queue, Now now) const {
    return {queue.config.value_base_e6, queue.config.ttl_ns,
            std::max<std::int64_t>(0, now.steady_ns - queue.last.ns)};
}

bool Scheduler::Impl::beats(const Queue& a, const Queue& b, Now now) const {
    const auto order = compare(options.policy, claim(a, now), claim(b, now));
    return order > 0 || (order == 0 && a.key < b.key);
}

Skip Scheduler::Impl::skip(const Queue& queue, const OpenFrame& frame, Now now) const {
    if (queue.waiting.is_empty()) return Skip::empty;
    if (queue.last.ever && now.steady_ns - queue.last.ns < queue.config.blackout_ns)
        return Skip::blackout;
    if (!queue.waiting.may_fit({frame.free_bytes, true})) return Skip::size;
    if (!goes_along(queue.key.dest, frame)) return Skip::dest;
    if (!queue.waiting.may_fit({frame.free_bytes, frame.acks})) return Skip::ack;
    return fitting(queue, frame) == nullptr ? Skip::expiring : Skip::none;
}

/// Only who would win is asked whether it has a message to go: that is what costs time.
Queue* Scheduler::Impl::best(const OpenFrame& frame, Now now) {
    Queue* winner = nullptr;
    for (Queue& queue : queues) {
        if (queue.waiting.is_empty()) continue;
        if (winner != nullptr && !beats(queue, *winner, now)) continue;
        if (skip(queue, frame, now) == Skip::none) winner = &queue;
    }
    return winner;
}

Candidate Scheduler::Impl::candidate(const Queue& queue, const OpenFrame& frame, Now now) const {
    const Entry* message = fitting(queue, frame);
    if (message == nullptr) {
        constexpr Fit anything{std::numeric_limits<std::uint32_t>::max()};
        message = static_cast<Entry*>(queue.waiting.find(anything, queue.config.newest_first));
    }
    return {queue.key, priority(claim(queue, now)), queue.count - queue.stats.under_way,
            skip(queue, frame, now), message != nullptr ? message->bytes : 0};
}

Contest Scheduler::Impl::describe(const OpenFrame& frame, Now now) const {
    std::vector<std::pair<Candidate, const Queue*>> all;
    for (const Queue& queue : queues) all.emplace_back(candidate(queue, frame, now), &queue);
    std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) {
        const bool a_goes = a.first.skip == Skip::none, b_goes = b.first.skip == Skip::none;
        return a_goes != b_goes ? a_goes : beats(*a.second, *b.second, now);
    });
    Contest contest{frame.transmission, frame.index, frame.free_bytes, {}, {}, 0, 0};
    for (const auto& [candidate, queue] : all) contest.candidates.push_back(candidate);
    return contest;
}

Entry* Scheduler::Impl::contest(const OpenFrame& frame, Now now,
                                const std::function<void(const Contest&)>& tell) {
    const Queue* const winner = best(frame, now);
    Entry* const entry = winner == nullptr ? nullptr : fitting(*winner, frame);
    if (!tell) return entry;
    Contest contest = describe(frame, now);
    if (entry != nullptr) {
        contest.winner = winner->key;
        contest.sends = entry->sends;
        contest.age_ns = now.steady_ns - entry->born_ns;
    }
    tell(contest);
    return entry;
}

}  // namespace seautils::queue
