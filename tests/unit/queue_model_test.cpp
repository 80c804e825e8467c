// The scheduler against a model of it that looks at every message each time and shares nothing with
// it: whole seconds, plain vectors, small numbers that multiply without loss.
#include "seautils/queue/scheduler.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace seautils::queue {
namespace {

constexpr std::int64_t s_ns = QueueConfig::ns_per_s;
constexpr std::int64_t wait_s = 10;

struct Kind {
    bool ack = true, newest_first = true;
    int blackout_s = 0, max_queue = 3, ttl_s = 30, value = 1;  // ttl_s 0: infinite
};

struct Item {
    std::uint64_t sequence = 0;
    QueueKey key;
    std::int64_t born_s = 0;
    std::string data;
    bool ack = false;
    std::uint32_t sends = 0, flight = 0;
};

struct Served {
    std::int64_t s = 0;
    bool ever = false;
    std::uint32_t by = 0;
};

struct Trip {
    std::uint32_t number = 0, dest = 0;
    std::int64_t end_s = 0;
    bool over = false;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> carried;  ///< sequence, frame
    std::map<QueueKey, Served> before;
};

class Model {
public:
    std::map<std::uint32_t, Kind> kinds;
    std::vector<Item> items;
    std::map<QueueKey, Served> served;
    std::vector<Trip> trips;
    std::int64_t t_s = 0;
    std::multiset<std::string> drops;
    std::uint64_t accepted = 0, delivered = 0, dropped = 0;

    const Kind& kind(QueueKey key) { return kinds.at(key.id); }

    void push(Item item, std::optional<bool> ack) {
        ++accepted;
        const Kind& k = kind(item.key);
        item.ack = item.key.dest != 0 && ack.value_or(k.ack);
        served.try_emplace(item.key);
        items.push_back(item);
        expire();
        std::vector<Item> mine;
        for (const Item& i : items)
            if (i.key == item.key) mine.push_back(i);
        if (static_cast<int>(mine.size()) <= k.max_queue) return;
        const auto older = [](const Item& a, const Item& b) {
            return std::pair(a.born_s, a.sequence) < std::pair(b.born_s, b.sequence);
        };
        drop(k.newest_first ? *std::min_element(mine.begin(), mine.end(), older) : item,
             "overflow");
    }

    void advance() {
        for (Trip& trip : trips) {
            if (!trip.over && t_s >= trip.end_s) give_back(trip, true);
        }
        expire();
    }

    std::vector<std::string> fill(std::uint32_t number, int frames, std::size_t frame_bytes,
                                  std::optional<std::uint32_t> dest, bool acks,
                                  std::int64_t arrival_s) {
        Trip trip{number, 0, std::max(t_s, arrival_s) + wait_s, false, {}, {}};
        std::vector<std::string> packet;
        for (int f = 0; f < frames; ++f) {
            std::string frame;
            while (Item* item = best(frame_bytes - frame.size(), dest, acks, arrival_s)) {
                Served& last = served[item->key];
                trip.before.try_emplace(item->key, last);
                last = {t_s, true, number};
                item->flight = number;
                ++item->sends;
                frame += item->data;
                trip.carried.emplace_back(item->sequence, f);
                if (!dest) dest = item->key.dest;
            }
            if (frame.empty()) break;
            packet.push_back(frame);
        }
        if (packet.empty()) return packet;
        trip.dest = *dest;
        trips.push_back(trip);
        return packet;
    }

    void acknowledge(std::uint32_t src, std::uint32_t number, std::uint32_t frame) {
        for (const Trip& trip : trips) {
            if (trip.number != number || trip.dest != src || src == 0) continue;
            for (const auto& [sequence, f] : trip.carried) {
                const Item* item = find(sequence);
                if (item != nullptr && f == frame && item->key.dest == src) deliver(sequence);
            }
        }
    }

    void settle(std::uint32_t number, bool sent) {
        for (Trip& trip : trips) {
            if (trip.number != number) continue;
            if (!sent) {
                give_back(trip, false);
                restore(trip);
                continue;
            }
            for (const auto& [sequence, f] : trip.carried) {
                const Item* item = find(sequence);
                if (item != nullptr && !item->ack) deliver(sequence);
            }
        }
    }

private:
    Item* find(std::uint64_t sequence) {
        for (Item& i : items)
            if (i.sequence == sequence) return &i;
        return nullptr;
    }
    void erase(std::uint64_t sequence) {
        std::erase_if(items, [&](const Item& i) { return i.sequence == sequence; });
    }
    void drop(const Item& item, const std::string& why) {
        drops.insert(item.data + " " + why + " " + std::to_string(item.sends) + " " +
                     std::to_string(t_s - item.born_s));
        ++dropped;
        erase(Item(item).sequence);
    }
    void deliver(std::uint64_t sequence) {
        ++delivered;
        erase(sequence);
    }
    void expire() {
        for (std::size_t k = 0; k < items.size();) {
            const int ttl_s = kind(items[k].key).ttl_s;
            if (ttl_s != 0 && items[k].flight == 0 && t_s > items[k].born_s + ttl_s)
                drop(items[k], "expired");
            else
                ++k;
        }
    }
    void give_back(Trip& trip, bool was_sent) {
        trip.over = true;
        for (Item& item : items) {
            if (item.flight != trip.number) continue;
            item.flight = 0;
            if (!was_sent) --item.sends;
        }
    }
    void restore(const Trip& trip) {
        for (const auto& [key, before] : trip.before) {
            if (served[key].by == trip.number) served[key] = before;
            for (Trip& other : trips) {
                const auto found = other.before.find(key);
                if (found != other.before.end() && found->second.by == trip.number)
                    found->second = before;
            }
        }
    }

    /// rank, then numerator and denominator; see compare() in priority.hpp.
    bool greater(QueueKey a, QueueKey b) {
        const auto rank = [&](QueueKey q) {
            if (kind(q).value == 0) return 0;
            const bool waited = t_s > served[q].s, finite = kind(q).ttl_s != 0;
            return waited ? (finite ? 4 : 3) : (finite ? 2 : 1);
        };
        if (rank(a) != rank(b)) return rank(a) > rank(b);
        const auto top = [&](QueueKey q) {
            return kind(q).value * std::max<std::int64_t>(1, t_s - served[q].s);
        };
        const auto bottom = [&](QueueKey q) { return std::max(1, kind(q).ttl_s); };
        const std::int64_t x = rank(a) == 0 ? 0 : top(a) * bottom(b);
        const std::int64_t y = rank(a) == 0 ? 0 : top(b) * bottom(a);
        return x != y ? x > y : a < b;
    }

    /// The message that goes next.
    Item* best(std::size_t room, std::optional<std::uint32_t> dest, bool acks,
               std::int64_t arrival_s) {
        Item* found = nullptr;
        for (Item& item : items) {
            const Kind& k = kind(item.key);
            const Served& last = served[item.key];
            if (item.flight != 0 || item.data.size() > room || (item.ack && !acks)) continue;
            if (last.ever && t_s < last.s + k.blackout_s) continue;
            if (dest && item.key.dest != 0 && item.key.dest != *dest) continue;
            if (k.ttl_s != 0 && arrival_s > item.born_s + k.ttl_s) continue;
            if (found == nullptr || precedes(item, *found)) found = &item;
        }
        return found;
    }
    bool precedes(const Item& a, const Item& b) {
        if (a.key != b.key) return greater(a.key, b.key);
        const bool older = std::pair(a.born_s, a.sequence) < std::pair(b.born_s, b.sequence);
        return kind(a.key).newest_first ? !older : older;
    }
};

/// The scheduler and the model, told the same.
class Pair {
public:
    Pair() {
        SchedulerOptions options;
        options.own_id = 1;
        options.ack_wait_ns = wait_s * s_ns;
        for (std::uint32_t id = 1; id <= 3; ++id) {
            const Kind k{*rc::gen::arbitrary<bool>(),
                         *rc::gen::arbitrary<bool>(),
                         *rc::gen::elementOf(std::vector{0, 0, 7}),
                         *rc::gen::inRange(1, 5),
                         *rc::gen::elementOf(std::vector{0, 15, 30, 60}),
                         *rc::gen::inRange(0, 4)};
            model.kinds[id] = k;
            const std::string section = std::to_string(id);
            const auto set = [&](const char* key, const std::string& value) {
                options.queues.set(section, key, value);
            };
            set("ack", k.ack ? "true" : "false");
            set("newest_first", k.newest_first ? "true" : "false");
            set("blackout_time_s", std::to_string(k.blackout_s));
            set("max_queue", std::to_string(k.max_queue));
            set("ttl_s", k.ttl_s == 0 ? "infinite" : std::to_string(k.ttl_s));
            set("value_base", std::to_string(k.value));
        }
        scheduler = std::make_unique<Scheduler>(std::move(options), now());
    }

    void step() {
        switch (*rc::gen::inRange(0, 8)) {
            case 0:
            case 1:
            case 2:
                return push();
            case 3:
            case 4:
                return fill();
            case 5:
                return acknowledge();
            case 6:
                return settle();
            default:
                model.t_s += *rc::gen::inRange(1, 12);
                model.advance();
                scheduler->advance(now());
        }
    }

    void compare() {
        std::multiset<std::string> drops;
        for (const Drop& d : scheduler->take_changes().drops) {
            drops.insert(d.message.data +
                         (d.reason == DropReason::expired ? " expired " : " overflow ") +
                         std::to_string(d.sends) + " " + std::to_string(d.age_ns / s_ns));
        }
        RC_ASSERT(drops == model.drops);
        model.drops.clear();
        std::uint64_t queued = 0, delivered = 0, dropped = 0, accepted = 0, under_way = 0;
        for (const QueueStats& s : scheduler->stats(now())) {
            RC_ASSERT(s.is_conserved());
            queued += s.queued;
            delivered += s.delivered;
            dropped += s.expired + s.overflowed;
            accepted += s.accepted;
            under_way += s.under_way;
        }
        RC_ASSERT(queued == model.items.size());
        RC_ASSERT(delivered == model.delivered);
        RC_ASSERT(dropped == model.dropped);
        RC_ASSERT(accepted == model.accepted);
        const auto moving = std::count_if(model.items.begin(), model.items.end(),
                                          [](const Item& i) { return i.flight != 0; });
        RC_ASSERT(under_way == static_cast<std::uint64_t>(moving));
    }

private:
    Now now() const { return {model.t_s * s_ns, model.t_s * 1'000'000}; }

    void push() {
        Item item;
        item.sequence = ++sequence_;
        item.key = {*rc::gen::inRange<std::uint32_t>(1, 4),
                    *rc::gen::elementOf(std::vector<std::uint32_t>{0, 2, 3})};
        item.born_s = model.t_s - *rc::gen::inRange(0, 20);
        item.data =
            std::to_string(sequence_) + std::string(*rc::gen::inRange<std::size_t>(0, 6), '.');
        const auto ack = *rc::gen::elementOf(std::vector<std::optional<bool>>{{}, {}, true, false});
        Message message{item.key, 0, ack, item.born_s * 1'000'000, item.data};
        RC_ASSERT(!scheduler->check(message, now()));
        scheduler->push(accept(message, sequence_, now()), now());
        model.push(item, ack);
    }

    void fill() {
        Turn turn;
        turn.frames = *rc::gen::inRange<std::uint32_t>(1, 4);
        turn.frame_bytes = *rc::gen::inRange<std::uint32_t>(1, 20);
        turn.acks = *rc::gen::inRange(0, 4) > 0;
        turn.dest =
            *rc::gen::elementOf(std::vector<std::optional<std::uint32_t>>{{}, {}, {}, 0, 2, 3});
        const std::int64_t arrival_s = model.t_s + *rc::gen::inRange(0, 12);
        turn.arrival_ns = arrival_s * s_ns;
        const std::uint32_t number = scheduler->next_transmission();
        const auto packet = scheduler->fill(turn, now());
        const auto expected = model.fill(number, static_cast<int>(turn.frames), turn.frame_bytes,
                                         turn.dest, turn.acks, arrival_s);
        RC_ASSERT((packet ? packet->frames : std::vector<std::string>{}) == expected);
        RC_ASSERT(scheduler->next_transmission() == number + (expected.empty() ? 0 : 1));
    }

    std::uint32_t some_number() const {
        return *rc::gen::inRange<std::uint32_t>(0, scheduler->next_transmission() + 1);
    }
    void acknowledge() {
        const std::uint32_t src = *rc::gen::inRange<std::uint32_t>(0, 4);
        const std::uint32_t number = some_number();
        const std::uint32_t frame = *rc::gen::inRange<std::uint32_t>(0, 3);
        scheduler->acknowledge(src, number, std::vector{frame}, now());
        model.acknowledge(src, number, frame);
    }
    void settle() {
        const std::uint32_t number = some_number();
        const auto outcome = *rc::gen::elementOf(std::vector{
            Outcome::sent, Outcome::sent, Outcome::late, Outcome::busy, Outcome::failed});
        scheduler->settle(number, outcome, now());
        model.settle(number, outcome == Outcome::sent);
        scheduler->advance(now());
        model.advance();
    }

    Model model;
    std::unique_ptr<Scheduler> scheduler;
    std::uint64_t sequence_ = 0;
};

TEST(SchedulerModel, DoesWhatAPlainSearchDoes) {
    EXPECT_TRUE(rc::check("the same packets, drops and counts", [] {
        Pair pair;
        const int steps = *rc::gen::inRange(1, 150);
        for (int k = 0; k < steps; ++k) {
            pair.step();
            pair.compare();
        }
    }));
}

}  // namespace
}  // namespace seautils::queue
