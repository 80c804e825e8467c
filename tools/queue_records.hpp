// The queues' structs and the records' kinds, into each other.
#ifndef SEAUTILS_TOOLS_QUEUE_RECORDS_HPP
#define SEAUTILS_TOOLS_QUEUE_RECORDS_HPP

#include "seautils/queue/scheduler.hpp"
#include "seautils/record/record.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace seautils::tools {

inline double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

/// A count in a record; the most where it is larger.
inline std::uint32_t counted_in_record(std::uint64_t n) {
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(n, std::numeric_limits<std::uint32_t>::max()));
}

inline queue::Message to_message(const record::Message& r) {
    queue::Message m;
    m.queue = {r.id, r.dest};
    m.src = r.src;
    m.ack_requested = r.ack_requested;
    if (r.created) m.created_us = r.created->ns / 1000;
    m.data = r.data;
    return m;
}

inline record::Drop to_record(queue::Drop&& d, std::uint32_t own_id) {
    record::Drop r;
    r.id = d.message.queue.id;
    r.src = d.message.src == 0 ? own_id : d.message.src;
    r.dest = d.message.queue.dest;
    r.reason = static_cast<record::Drop::Reason>(d.reason);
    r.why = std::move(d.why);
    r.created = record::UtcTime{d.message.created_us.value_or(0) * 1000};
    r.age_s = seconds(d.age_ns);
    r.sends = d.sends;
    r.bytes = static_cast<std::uint32_t>(d.message.data.size());
    r.data = std::move(d.message.data);
    return r;
}

inline record::Transmission to_record(queue::Packet&& p, const record::Slot& slot) {
    record::Transmission r;
    r.number = p.number;
    r.src = slot.src;
    r.dest = p.dest;
    r.rate = slot.rate;
    r.ack_requested = p.ack_requested;
    r.frame = std::move(p.frames);
    r.deadline = slot.end;
    r.polled = slot.polled;
    r.slot_index = slot.index;
    return r;
}

inline record::Contest to_record(const queue::Contest& c, const record::Slot& slot) {
    record::Contest r;
    r.slot_index = slot.index;
    r.transmission = c.transmission;
    r.frame = c.frame;
    r.free_bytes = c.free_bytes;
    for (const queue::Candidate& k : c.candidates) {
        record::Contest::Candidate candidate{k.queue.id,
                                             k.queue.dest,
                                             k.priority,
                                             k.queued,
                                             static_cast<record::Contest::Skip>(k.skip),
                                             {}};
        if (k.bytes > 0) candidate.bytes = k.bytes;
        r.candidate.push_back(candidate);
    }
    if (!c.winner) return r;
    r.winner_id = c.winner->id;
    r.winner_dest = c.winner->dest;
    r.sends = c.sends;
    r.age_s = seconds(c.age_ns);
    return r;
}

inline record::QueueStats to_record(const queue::QueueStats& s) {
    record::QueueStats r;
    r.id = s.queue.id;
    r.dest = s.queue.dest;
    r.queued = s.queued;
    r.bytes = counted_in_record(s.bytes);
    r.under_way = s.under_way;
    r.accepted = counted_in_record(s.accepted);
    r.sends = counted_in_record(s.sends);
    r.delivered = counted_in_record(s.delivered);
    r.returned = counted_in_record(s.returned);
    r.expired = counted_in_record(s.expired);
    r.overflowed = counted_in_record(s.overflowed);
    r.refused = counted_in_record(s.refused);
    if (s.queued > s.under_way) r.oldest_age_s = seconds(s.oldest_age_ns);
    if (s.delivered > 0) r.mean_age_s = seconds(s.mean_age_ns);
    return r;
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_QUEUE_RECORDS_HPP
