#include "seautils/queue/scheduler.hpp"

#include "seautils/queue/scheduler_impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace seautils::queue {

namespace {

constexpr std::uint32_t most_id = 32767;
constexpr std::uint32_t most_dest = 30;
constexpr std::size_t flights_kept = 64;

bool names_queue(QueueKey key) { return key.id <= most_id && key.dest <= most_dest; }

}  // namespace

Accepted accept(Message message, std::uint64_t sequence, Now now) {
    const std::int64_t created_us = message.created_us.value_or(now.utc_us);
    message.created_us = created_us;
    const std::int64_t age_us = std::clamp<std::int64_t>(now.utc_us - created_us, 0, oldest_us);
    return {sequence, std::move(message), now.steady_ns - age_us * 1000, 0};
}

Scheduler::Impl::Impl(SchedulerOptions options_given, Now now)
    : options(std::move(options_given)),
      start{now.steady_ns, 0, false},
      next_transmission(options.first_transmission) {}

Queue& Scheduler::Impl::queue_of(QueueKey key) {
    const auto [place, is_new] = index.try_emplace(key, static_cast<std::uint32_t>(queues.size()));
    if (is_new) {
        Queue& queue = queues.emplace_back();
        queue.key = queue.stats.queue = key;
        queue.index = place->second;
        queue.config = options.queues.of(key);
        queue.last = start;
    }
    return queues[place->second];
}

Entry* Scheduler::Impl::find(std::uint64_t sequence) {
    const auto found = entries.find(sequence);
    return found == entries.end() ? nullptr : &found->second;
}

/// The first instant at which a waiting message of the queue is too old.
void Scheduler::Impl::watch(Queue& queue) {
    const FitNode* const oldest = queue.waiting.oldest();
    queue.expiry_ns = oldest == nullptr || queue.config.is_infinite()
                          ? never_ns
                          : oldest->born_ns + queue.config.ttl_ns + 1;
    next_event_ns = std::min(next_event_ns, queue.expiry_ns);
}

// --- In

std::string Scheduler::Impl::refusal(const Message& m) const {
    if (m.queue.id > most_id) return fmt::format("id {} is outside 0 to 32767", m.queue.id);
    if (m.queue.dest > most_dest) return fmt::format("dest {} is outside 0 to 30", m.queue.dest);
    if (m.src != 0 && m.src != options.own_id)
        return fmt::format("src {} is not this vehicle, {}", m.src, options.own_id);
    if (m.queue.dest == options.own_id) return fmt::format("dest {} is this vehicle", m.queue.dest);
    return m.data.empty() ? "a message without data" : "";
}

Entry& Scheduler::Impl::insert(Accepted&& accepted) {
    Queue& queue = queue_of(accepted.message.queue);
    Entry& entry = entries[accepted.sequence];
    entry.sequence = accepted.sequence;
    entry.born_ns = accepted.born_ns;
    entry.bytes = static_cast<std::uint32_t>(accepted.message.data.size());
    entry.ack = queue.key.dest != 0 && accepted.message.ack_requested.value_or(queue.config.ack);
    entry.data = std::move(accepted.message.data);
    entry.created_us = accepted.message.created_us.value_or(0);
    entry.src = accepted.message.src;
    entry.queue = queue.index;
    entry.sends = accepted.sends;
    queue.waiting.insert(entry);
    ++queue.count;
    ++queue.stats.accepted;
    queue.stats.bytes += entry.bytes;
    return entry;
}

void Scheduler::Impl::overflow(Queue& queue, Entry& newcomer, Now now) {
    if (queue.count <= queue.config.max_queue) return;
    FitNode* victim = &newcomer;
    if (queue.config.newest_first) {
        victim = queue.waiting.oldest();
        const FitNode* const other = queue.under_way.oldest();
        if (other != nullptr && std::pair(other->born_ns, other->sequence) <
                                    std::pair(victim->born_ns, victim->sequence))
            victim = queue.under_way.oldest();
    }
    drop(static_cast<Entry&>(*victim), DropReason::overflow,
         fmt::format("queue {}.{} holds {} messages", queue.key.id, queue.key.dest,
                     queue.config.max_queue),
         now);
}

// --- Out

/// Takes a message away, for good; what it was is lost.
void Scheduler::Impl::remove(Entry& entry) {
    Queue& queue = queue_of(entry);
    const bool waits = entry.transmission == 0;
    (waits ? queue.waiting : queue.under_way).erase(entry);
    if (!waits) --queue.stats.under_way;
    --queue.count;
    queue.stats.bytes -= entry.bytes;
    changes.gone.push_back(entry.sequence);
    entries.erase(entry.sequence);
    if (waits) watch(queue);
}

void Scheduler::Impl::drop(Entry& entry, DropReason reason, std::string why, Now now) {
    Queue& queue = queue_of(entry);
    ++(reason == DropReason::expired ? queue.stats.expired : queue.stats.overflowed);
    Message message{queue.key, entry.src, entry.ack, entry.created_us, std::move(entry.data)};
    changes.drops.push_back({std::move(message), reason, std::move(why),
                             now.steady_ns - entry.born_ns, entry.sends, entry.sequence});
    remove(entry);
}

void Scheduler::Impl::deliver(Entry& entry, Now now) {
    Queue& queue = queue_of(entry);
    ++queue.stats.delivered;
    queue.delivered_age_ns += static_cast<double>(now.steady_ns - entry.born_ns);
    remove(entry);
}

void Scheduler::Impl::expire(Queue& queue, Now now) {
    while (now.steady_ns >= queue.expiry_ns) {
        drop(static_cast<Entry&>(*queue.waiting.oldest()), DropReason::expired,
             fmt::format("older than {} s", static_cast<double>(queue.config.ttl_ns) / 1e9), now);
    }
}

// --- Under way

void Scheduler::Impl::place(Entry& entry, OpenFrame& frame, Packet& packet, Flight& flight,
                            Now now) {
    Queue& queue = queue_of(entry);
    if (queue.last.transmission != flight.number)
        flight.served.push_back({queue.index, queue.last});
    queue.last = {now.steady_ns, flight.number, true};
    queue.waiting.erase(entry);
    queue.under_way.insert(entry);
    watch(queue);
    entry.transmission = flight.number;
    ++queue.stats.under_way;
    ++queue.stats.sends;
    packet.carried.push_back({entry.sequence, frame.index, ++entry.sends, queue.key});
    packet.ack_requested = packet.ack_requested || entry.ack;
    packet.frames.resize(frame.index + 1);
    packet.frames.back() += entry.data;
    frame.free_bytes -= entry.bytes;
    if (!frame.dest) frame.dest = queue.key.dest;
}

/// What is still under way in a transmission waits again.
void Scheduler::Impl::give_back(Flight& flight, bool was_sent) {
    flight.over = true;
    for (const Carried& carried : flight.carried) {
        Entry* const entry = find(carried.sequence);
        if (entry == nullptr || entry->transmission != flight.number) continue;
        Queue& queue = queue_of(*entry);
        queue.under_way.erase(*entry);
        queue.waiting.insert(*entry);
        --queue.stats.under_way;
        ++queue.stats.returned;
        entry->transmission = 0;
        if (!was_sent) --entry->sends;
        watch(queue);
    }
}

/// Claims are what they would be without this transmission.
void Scheduler::Impl::restore_last(const Flight& flight) {
    for (const Flight::Served& served : flight.served) {
        Last& last = queues[served.queue].last;
        if (last.transmission == flight.number) last = served.before;
        for (auto& [number, other] : flights) {
            for (Flight::Served& later : other.served) {
                if (later.queue == served.queue && later.before.transmission == flight.number)
                    later.before = served.before;
            }
        }
    }
}

void Scheduler::Impl::end_waits(Now now) {
    for (auto& [number, flight] : flights) {
        if (!flight.over && now.steady_ns >= flight.end_ns) give_back(flight, true);
    }
}

void Scheduler::Impl::forget_flights() {
    while (flights.size() > flights_kept && flights.begin()->second.over)
        flights.erase(flights.begin());
}

void Scheduler::Impl::find_next_event() {
    next_event_ns = never_ns;
    for (const Queue& queue : queues) next_event_ns = std::min(next_event_ns, queue.expiry_ns);
    for (const auto& [number, flight] : flights) {
        if (!flight.over) next_event_ns = std::min(next_event_ns, flight.end_ns);
    }
}

// --- For all to call

Scheduler::Scheduler(SchedulerOptions options, Now start)
    : impl_(std::make_unique<Impl>(std::move(options), start)) {}

Scheduler::~Scheduler() = default;

std::optional<Drop> Scheduler::check(const Message& message, Now now) {
    Impl& s = *impl_;
    DropReason reason = DropReason::refused;
    std::string why = s.refusal(message);
    if (why.empty()) {
        if (message.data.size() <= s.options.max_frame_bytes) return {};
        reason = DropReason::too_large;
        why = fmt::format("{} bytes where the largest frame holds {}", message.data.size(),
                          s.options.max_frame_bytes);
    }
    return refuse(message, reason, std::move(why), now);
}

Drop Scheduler::refuse(const Message& message, DropReason reason, std::string why, Now now) {
    if (names_queue(message.queue)) ++impl_->queue_of(message.queue).stats.refused;
    Accepted accepted = accept(message, 0, now);
    return {std::move(accepted.message),      reason, std::move(why),
            now.steady_ns - accepted.born_ns, 0,      0};
}

void Scheduler::push(Accepted accepted, Now now) {
    Impl& s = *impl_;
    advance(now);
    Entry& entry = s.insert(std::move(accepted));
    Queue& queue = s.queue_of(entry);
    s.watch(queue);
    const bool is_expired = now.steady_ns >= queue.expiry_ns;  // then it is this one
    if (is_expired)
        s.expire(queue, now);
    else
        s.overflow(queue, entry, now);
}

std::optional<Packet> Scheduler::fill(const Turn& turn, Now now,
                                      const std::function<void(const Contest&)>& tell) {
    Impl& s = *impl_;
    advance(now);
    Packet packet;
    packet.number = s.next_transmission;
    Flight flight;
    flight.number = packet.number;
    OpenFrame frame{packet.number, 0, 0, turn.dest, turn.acks, turn.arrival_ns};
    for (; frame.index < turn.frames && packet.frames.size() == frame.index; ++frame.index) {
        frame.free_bytes = turn.frame_bytes;
        while (Entry* const entry = s.contest(frame, now, tell))
            s.place(*entry, frame, packet, flight, now);
    }
    if (packet.frames.empty()) return {};
    packet.dest = flight.dest = *frame.dest;
    flight.carried = packet.carried;
    flight.end_ns = std::max(now.steady_ns, turn.arrival_ns) + s.options.ack_wait_ns;
    s.next_event_ns = std::min(s.next_event_ns, flight.end_ns);
    s.flights.emplace(flight.number, std::move(flight));
    s.forget_flights();
    if (++s.next_transmission == 0) s.next_transmission = 1;
    return packet;
}

void Scheduler::acknowledge(std::uint32_t src, std::uint32_t transmission,
                            std::span<const std::uint32_t> frames, Now now) {
    Impl& s = *impl_;
    const auto found = s.flights.find(transmission);
    if (found == s.flights.end() || src == 0 || found->second.dest != src) return;
    for (const Carried& carried : found->second.carried) {
        if (carried.queue.dest != src) continue;
        if (std::find(frames.begin(), frames.end(), carried.frame) == frames.end()) continue;
        if (Entry* const entry = s.find(carried.sequence)) s.deliver(*entry, now);
    }
}

void Scheduler::settle(std::uint32_t transmission, Outcome outcome, Now now) {
    Impl& s = *impl_;
    const auto found = s.flights.find(transmission);
    if (found == s.flights.end()) return;
    Flight& flight = found->second;
    if (outcome != Outcome::sent) {
        s.give_back(flight, false);
        s.restore_last(flight);
        return;
    }
    for (const Carried& carried : flight.carried) {
        Entry* const entry = s.find(carried.sequence);
        if (entry != nullptr && !entry->ack) s.deliver(*entry, now);
    }
}

void Scheduler::advance(Now now) {
    Impl& s = *impl_;
    if (now.steady_ns < s.next_event_ns) return;
    s.end_waits(now);
    for (Queue& queue : s.queues) s.expire(queue, now);
    s.find_next_event();
}

std::int64_t Scheduler::next_event_ns() const { return impl_->next_event_ns; }

Changes Scheduler::take_changes() { return std::exchange(impl_->changes, {}); }

void Scheduler::set_last(QueueKey queue, std::int64_t last_ns) {
    impl_->queue_of(queue).last = {last_ns, 0, true};
}

std::uint32_t Scheduler::own_id() const { return impl_->options.own_id; }

std::uint32_t Scheduler::next_transmission() const { return impl_->next_transmission; }

std::vector<QueueStats> Scheduler::stats(Now now) const {
    std::vector<QueueStats> all;
    for (const auto& [key, place] : impl_->index) {
        const Queue& queue = impl_->queues[place];
        QueueStats& stats = all.emplace_back(queue.stats);
        stats.queued = queue.count;
        if (const FitNode* const oldest = queue.waiting.oldest())
            stats.oldest_age_ns = now.steady_ns - oldest->born_ns;
        if (stats.delivered > 0) {
            stats.mean_age_ns = static_cast<std::int64_t>(queue.delivered_age_ns /
                                                          static_cast<double>(stats.delivered));
        }
    }
    return all;
}

}  // namespace seautils::queue
