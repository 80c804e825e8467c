#include "seautils/queue/scheduler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace seautils::queue {
namespace {

constexpr std::int64_t s_ns = QueueConfig::ns_per_s;

/// A scheduler of vehicle 1, a clock, and what an application and a modem would do.
class Bench {
public:
    explicit Bench(const std::vector<std::vector<std::string>>& settings = {})
        : scheduler(options(settings), {}) {}

    static SchedulerOptions options(const std::vector<std::vector<std::string>>& settings) {
        SchedulerOptions o;
        o.own_id = 1;
        for (const auto& words : settings) o.queues.set(words[0], words[1], words[2]);
        return o;
    }

    Now now() const { return {t_ns, 1'700'000'000'000'000 + t_ns / 1000 + step_us}; }
    void at(double t_s) {
        t_ns = static_cast<std::int64_t>(t_s * 1e9);
        scheduler.advance(now());
    }

    static Message message(QueueKey queue, std::string data) {
        Message m;
        m.queue = queue;
        m.data = std::move(data);
        return m;
    }
    void push(Message m) { scheduler.push(accept(std::move(m), ++sequence, now()), now()); }
    void push(QueueKey queue, const std::string& data) { push(message(queue, data)); }

    Turn turn(std::uint32_t frames, std::uint32_t frame_bytes, double lasts_s = 0) const {
        Turn t;
        t.frames = frames;
        t.frame_bytes = frame_bytes;
        t.arrival_ns = t_ns + static_cast<std::int64_t>(lasts_s * 1e9);
        return t;
    }
    std::optional<Packet> fill(const Turn& t) { return scheduler.fill(t, now()); }
    /// The frames of a packet, with '|' between them; "-": nothing to send.
    std::string frames(const Turn& t) {
        last = fill(t);
        std::string text;
        if (!last) return "-";
        for (const std::string& frame : last->frames) text += (text.empty() ? "" : "|") + frame;
        return text;
    }
    void acknowledge(std::uint32_t src, std::uint32_t number, std::vector<std::uint32_t> which) {
        scheduler.acknowledge(src, number, which, now());
    }
    void settle(Outcome outcome) { scheduler.settle(last->number, outcome, now()); }

    /// What was dropped: `data:reason` and blanks between.
    std::string drops() {
        std::string text;
        for (const Drop& drop : scheduler.take_changes().drops) {
            text += (text.empty() ? "" : " ") + drop.message.data + ":" +
                    std::to_string(static_cast<int>(drop.reason));
        }
        return text;
    }
    QueueStats stats(QueueKey key) const {
        for (const QueueStats& s : scheduler.stats(now())) {
            if (s.queue == key) return s;
        }
        return {};
    }

    std::int64_t t_ns = 0;
    std::int64_t step_us = 0;
    std::uint64_t sequence = 0;
    std::optional<Packet> last;
    Scheduler scheduler;
};

const std::string expired = ":0", overflow = ":1";

TEST(Contest, TheGreatestClaimIsServed) {
    Bench b({{"1", "value_base", "1"}, {"2", "value_base", "3"}});
    b.at(10);
    b.push({1, 2}, "a");
    b.push({2, 2}, "b");
    EXPECT_EQ(b.frames(b.turn(1, 1)), "b");
    b.at(11);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "a");
}

// Pitfall 7: queues that are alike are told apart by their names, whatever came first.
TEST(Contest, TiesGoToTheLowestIdThenTheLowestDestination) {
    Bench b;
    b.at(10);
    b.push({9, 0}, "d");
    b.push({3, 4}, "c");
    b.push({3, 2}, "b");
    b.push({2, 2}, "a");
    for (const char* const expected : {"a", "b", "c", "d"})
        EXPECT_EQ(b.frames(b.turn(1, 1)), expected);
}

// Pitfall 6: a queue that was never served is not in its blackout.
TEST(Contest, BlackoutBeginsWithTheFirstMessage) {
    Bench b({{"1", "blackout_time_s", "10"}});
    b.push({1, 2}, "a");
    b.push({1, 2}, "b");
    EXPECT_EQ(b.frames(b.turn(2, 4)), "b");  // one of them only, whatever room there is
    b.acknowledge(2, b.last->number, {0});
    b.at(9.999);
    EXPECT_EQ(b.frames(b.turn(1, 4)), "-");
    b.at(10);
    EXPECT_EQ(b.frames(b.turn(1, 4)), "a");
}

// Pitfall 6: what counts is when a message was handed over, not when it was acknowledged.
TEST(Contest, AQueueIsServedAtHandOver) {
    Bench b;
    b.push({1, 2}, "a");
    b.push({1, 2}, "A");
    b.at(10);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "A");
    b.at(20);
    b.push({2, 2}, "b");
    b.acknowledge(2, b.last->number, {0});
    b.at(21);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "b");  // waited since 0 s; the other since 10 s, not 20 s
}

// Pitfall 9: no message, and no queue, stands in the way of a smaller one.
TEST(Packet, WhatDoesNotFitBlocksNobody) {
    Bench b({{"1", "value_base", "100"}});
    b.at(1);
    b.push({1, 2}, "small");
    b.push({1, 2}, "too large for it");
    b.push({2, 2}, "other");
    EXPECT_EQ(b.frames(b.turn(1, 11)), "smallother");
    EXPECT_EQ(b.frames(b.turn(1, 16)), "too large for it");
}

TEST(Packet, EveryFrameIsFilledAndNoMessageSplit) {
    Bench b({{"", "newest_first", "false"}});
    for (const char* const data : {"aaa", "bbb", "cc", "dd", "e"}) b.push({1, 2}, data);
    EXPECT_EQ(b.frames(b.turn(8, 4)), "aaae|bbb|ccdd");
    EXPECT_EQ(b.last->carried.size(), 5U);
    EXPECT_EQ(b.frames(b.turn(8, 4)), "-");  // all are under way
}

TEST(Packet, NewestOrOldestFirst) {
    Bench b({{"2", "newest_first", "false"}, {"2", "value_base", "0"}});
    for (const char* const data : {"a", "b", "c"}) {
        b.push({1, 2}, data);
        b.push({2, 2}, data);
        b.t_ns += s_ns;
    }
    EXPECT_EQ(b.frames(b.turn(2, 3)), "cba|abc");
}

TEST(Packet, OrderIsThatOfCreation) {
    Bench b;
    Message old = Bench::message({1, 2}, "old"), young = Bench::message({1, 2}, "new");
    b.at(100);
    old.created_us = b.now().utc_us - 50'000'000;
    young.created_us = b.now().utc_us - 10'000'000;
    b.push(young);
    b.push(old);
    EXPECT_EQ(b.frames(b.turn(2, 3)), "new|old");
}

// Pitfall 12: what is for everybody rides along, but takes nobody with it, and is not acknowledged.
TEST(Packet, OneDestinationOrEverybody) {
    Bench b({{"1", "value_base", "9"}});
    b.at(1);
    b.push({1, 3}, "c");
    b.push({2, 2}, "b");
    b.push({3, 0}, "*");
    EXPECT_EQ(b.frames(b.turn(1, 9)), "c*");
    EXPECT_EQ(b.last->dest, 3U);
    EXPECT_TRUE(b.last->ack_requested);
    b.push({9, 0}, "*");
    b.at(2);
    EXPECT_EQ(b.frames(b.turn(1, 9)), "b*");
    EXPECT_EQ(b.last->dest, 2U);
    b.push({1, 0}, "!");
    b.push({2, 2}, "b");
    b.at(3);
    EXPECT_EQ(b.frames(b.turn(2, 9)), "!");
    EXPECT_EQ(b.last->dest, 0U);
    EXPECT_FALSE(b.last->ack_requested);
}

TEST(Packet, ATurnMayNameTheDestination) {
    Bench b;
    b.push({1, 3}, "c");
    b.push({2, 2}, "b");
    b.push({3, 0}, "*");
    Turn turn = b.turn(1, 9);
    turn.dest = 2;
    EXPECT_EQ(b.frames(turn), "b*");
    turn.dest = 0;
    EXPECT_EQ(b.frames(turn), "-");
    turn.dest = 4;
    EXPECT_EQ(b.frames(turn), "-");
}

TEST(Packet, ATurnWithoutAcknowledgement) {
    Bench b({{"2", "ack", "false"}});
    b.push({1, 2}, "a");
    b.push({2, 2}, "b");
    Message asks = Bench::message({2, 2}, "B");
    asks.ack_requested = true;
    b.push(asks);
    Turn turn = b.turn(1, 9);
    turn.acks = false;
    EXPECT_EQ(b.frames(turn), "b");
    EXPECT_FALSE(b.last->ack_requested);
    EXPECT_EQ(b.frames(b.turn(1, 9)), "aB");
    EXPECT_TRUE(b.last->ack_requested);
}

TEST(Packet, WhatWouldExpireOnItsWayStays) {
    Bench b({{"1", "ttl_s", "10"}, {"1", "newest_first", "false"}});
    b.push({1, 2}, "a");
    b.at(1);
    b.push({1, 2}, "b");
    b.at(8);
    EXPECT_EQ(b.frames(b.turn(1, 9, 3)), "b");  // arrives at 11 s: just in time
    EXPECT_EQ(b.frames(b.turn(1, 9, 2)), "a");
    EXPECT_EQ(b.drops(), "");
}

TEST(Expiry, AtItsAgeNotBeforeAndOnce) {
    Bench b({{"1", "ttl_s", "10"}, {"2", "ttl_s", "infinite"}});
    b.push({1, 2}, "a");
    b.push({2, 2}, "b");
    b.at(10);
    EXPECT_EQ(b.drops(), "");
    EXPECT_EQ(b.scheduler.next_event_ns(), 10 * s_ns + 1);
    ++b.t_ns;
    b.scheduler.advance(b.now());
    EXPECT_EQ(b.drops(), "a" + expired);
    b.at(1e9);
    EXPECT_EQ(b.drops(), "");
    EXPECT_EQ(b.frames(b.turn(1, 9)), "b");
}

TEST(Expiry, AnOldMessageIsNotHiddenBehindALiveOne) {
    Bench b({{"1", "ttl_s", "100"}});
    b.at(1000);
    Message late = Bench::message({1, 2}, "late");
    late.created_us = b.now().utc_us - 90'000'000;
    b.push({1, 2}, "new");
    b.push(late);
    b.at(1011);
    EXPECT_EQ(b.drops(), "late" + expired);
    late.created_us = b.now().utc_us - 101'000'000;
    b.push(late);
    EXPECT_EQ(b.drops(), "late" + expired);
}

// Pitfall 23: a clock that is set makes nothing old, blacks nothing out, and wins nothing.
TEST(Expiry, StepsOfTheWallClockChangeNothing) {
    Bench b({{"1", "ttl_s", "10"}, {"1", "blackout_time_s", "5"}});
    b.push({1, 2}, "a");
    b.push({1, 2}, "b");
    b.step_us = 50LL * 365 * 86400 * 1'000'000;
    b.at(1);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "b");
    b.step_us = -b.step_us / 2;
    b.at(2);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "-");
    b.at(6);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "a");
    EXPECT_EQ(b.drops(), "");
}

TEST(Expiry, AMessageFromTheFutureIsNew) {
    Bench b({{"1", "ttl_s", "10"}});
    Message m = Bench::message({1, 2}, "a");
    m.created_us = b.now().utc_us + 3600'000'000;
    b.push(m);
    b.at(11);
    EXPECT_EQ(b.drops(), "a" + expired);
}

// Pitfall 10: which one goes depends on the order; one that is under way may.
TEST(Overflow, TheOldestGoesOrTheNewOne) {
    Bench b({{"", "max_queue", "2"}, {"2", "newest_first", "false"}});
    for (const char* const data : {"a", "b", "c"}) {
        b.push({1, 2}, data);
        b.push({2, 2}, data);
        b.t_ns += s_ns;
    }
    EXPECT_EQ(b.drops(), "a" + overflow + " c" + overflow);
    EXPECT_TRUE(b.stats({1, 2}).is_conserved());
    EXPECT_TRUE(b.stats({2, 2}).is_conserved());
}

TEST(Overflow, OfWhatIsUnderWayAndItsLateAcknowledgement) {
    Bench b({{"", "max_queue", "1"}});
    b.push({1, 2}, "a");
    EXPECT_EQ(b.frames(b.turn(1, 9)), "a");
    const std::uint32_t number = b.last->number;
    b.at(1);
    b.push({1, 2}, "b");
    EXPECT_EQ(b.drops(), "a" + overflow);
    b.acknowledge(2, number, {0});
    EXPECT_EQ(b.stats({1, 2}).delivered, 0U);
    EXPECT_EQ(b.frames(b.turn(1, 9)), "b");
    EXPECT_TRUE(b.stats({1, 2}).is_conserved());
}

// Pitfall 11: an acknowledgement is for a destination, a transmission and a frame.
TEST(Acknowledgement, OnlyOfWhatItNames) {
    Bench b;
    b.push({1, 2}, "a");
    b.push({1, 2}, "b");
    EXPECT_EQ(b.frames(b.turn(2, 1)), "b|a");
    const std::uint32_t number = b.last->number;
    b.acknowledge(3, number, {0, 1});        // somebody else's
    b.acknowledge(2, number + 1, {0, 1});    // of another transmission
    b.acknowledge(0, number, {0, 1});        // nobody's
    b.acknowledge(2, number, {2, 7, 4711});  // of other frames
    EXPECT_EQ(b.stats({1, 2}).under_way, 2U);
    b.acknowledge(2, number, {1, 1});
    b.acknowledge(2, number, {1});
    EXPECT_EQ(b.stats({1, 2}).delivered, 1U);
    b.at(11);
    EXPECT_EQ(b.frames(b.turn(2, 1)), "b");
}

TEST(Acknowledgement, AnOldOneDoesNotTouchWhatIsInThatFrameNow) {
    Bench b;
    b.push({1, 2}, "a");
    b.frames(b.turn(1, 1));
    const std::uint32_t number = b.last->number;
    b.acknowledge(2, number, {0});
    b.push({1, 2}, "b");
    EXPECT_EQ(b.frames(b.turn(1, 1)), "b");
    b.acknowledge(2, number, {0});
    EXPECT_EQ(b.stats({1, 2}).under_way, 1U);
}

TEST(Acknowledgement, NoneForSoLongAndItMayGoAgain) {
    Bench b;
    b.push({1, 2}, "a");
    EXPECT_EQ(b.frames(b.turn(1, 1, 5)), "a");
    const std::uint32_t first = b.last->number;
    b.settle(Outcome::sent);
    b.at(14.9);  // 5 s on its way, 10 s of patience
    EXPECT_EQ(b.frames(b.turn(1, 1)), "-");
    b.at(15);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "a");
    EXPECT_EQ(b.last->carried[0].sends, 2U);
    EXPECT_EQ(b.stats({1, 2}).returned, 1U);
    b.acknowledge(2, first, {0});  // late, but true
    EXPECT_EQ(b.stats({1, 2}).delivered, 1U);
    b.acknowledge(2, b.last->number, {0});
    EXPECT_EQ(b.stats({1, 2}).delivered, 1U);
    EXPECT_TRUE(b.stats({1, 2}).is_conserved());
}

// Pitfall 13: what is not acknowledged is gone when it was sent, not when it was handed over.
TEST(Result, SentRemovesWhatWantsNoAcknowledgement) {
    Bench b({{"2", "ack", "false"}});
    b.push({1, 2}, "a");
    b.push({2, 2}, "b");
    b.push({3, 0}, "*");
    EXPECT_EQ(b.frames(b.turn(1, 9)), "ab*");
    EXPECT_EQ(b.stats({2, 2}).queued, 1U);
    b.settle(Outcome::sent);
    EXPECT_EQ(b.stats({2, 2}).delivered, 1U);
    EXPECT_EQ(b.stats({3, 0}).delivered, 1U);
    EXPECT_EQ(b.stats({1, 2}).under_way, 1U);
    b.at(10);
    EXPECT_EQ(b.frames(b.turn(1, 9)), "a");
}

TEST(Result, AnAcknowledgementSaysNothingOfWhatIsForEverybody) {
    Bench b;
    b.push({1, 2}, "a");
    b.push({3, 0}, "*");
    EXPECT_EQ(b.frames(b.turn(1, 9)), "a*");
    b.acknowledge(2, b.last->number, {0});
    EXPECT_EQ(b.stats({3, 0}).under_way, 1U);
}

TEST(Result, AFailureGivesBackMessagesAndClaims) {
    for (const Outcome outcome :
         {Outcome::late, Outcome::busy, Outcome::failed, Outcome::refused}) {
        Bench b({{"1", "blackout_time_s", "100"}, {"2", "ack", "false"}});
        b.at(10);
        b.push({1, 2}, "a");
        b.push({2, 2}, "b");
        EXPECT_EQ(b.frames(b.turn(1, 9)), "ab");
        b.settle(outcome);
        EXPECT_EQ(b.stats({1, 2}).returned, 1U);
        b.at(11);  // no blackout: nothing was sent
        EXPECT_EQ(b.frames(b.turn(1, 9)), "ab");
        EXPECT_EQ(b.last->carried[0].sends, 1U);
        b.settle(outcome);
        b.settle(outcome);  // twice told
        EXPECT_EQ(b.stats({1, 2}).returned, 2U);
    }
}

TEST(Result, FailuresOfSeveralInAnyOrder) {
    Bench b({{"1", "blackout_time_s", "100"}});
    b.push({1, 2}, "a");
    b.push({1, 2}, "b");
    EXPECT_EQ(b.frames(b.turn(1, 1)), "b");
    const std::uint32_t first = b.last->number;
    b.at(100);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "b");  // the wait of the first is long over
    const std::uint32_t second = b.last->number;
    b.scheduler.settle(first, Outcome::failed, b.now());
    b.at(101);
    EXPECT_EQ(b.frames(b.turn(1, 1)), "-");  // the second was at 100 s
    b.scheduler.settle(second, Outcome::failed, b.now());
    EXPECT_EQ(b.frames(b.turn(1, 1)), "b");  // as if it had never been served
}

TEST(Result, OfAnUnknownTransmissionIsNothing) {
    Bench b;
    b.push({1, 2}, "a");
    b.scheduler.settle(77, Outcome::sent, b.now());
    b.scheduler.settle(0, Outcome::failed, b.now());
    EXPECT_EQ(b.stats({1, 2}).queued, 1U);
}

TEST(UnderWay, DoesNotExpireBeforeItsWaitIsOver) {
    Bench b({{"1", "ttl_s", "10"}});
    b.push({1, 2}, "a");
    b.at(9);
    EXPECT_EQ(b.frames(b.turn(1, 1, 1)), "a");
    b.at(19.9);
    EXPECT_EQ(b.drops(), "");
    b.at(20);
    EXPECT_EQ(b.drops(), "a" + expired);
}

TEST(Check, WhatCanNeverBeQueued) {
    Bench b;
    const auto fault = [&](Message m) {
        const auto drop = b.scheduler.check(m, b.now());
        return drop ? std::to_string(static_cast<int>(drop->reason)) + " " + drop->why : "";
    };
    EXPECT_EQ(fault(Bench::message({1, 2}, "a")), "");
    EXPECT_EQ(fault(Bench::message({1, 2}, std::string(256, 'x'))), "");
    EXPECT_EQ(fault(Bench::message({1, 2}, std::string(257, 'x'))),
              "2 257 bytes where the largest frame holds 256");
    EXPECT_EQ(fault(Bench::message({1, 2}, "")), "3 a message without data");
    EXPECT_EQ(fault(Bench::message({32768, 2}, "a")), "3 id 32768 is outside 0 to 32767");
    EXPECT_EQ(fault(Bench::message({1, 31}, "a")), "3 dest 31 is outside 0 to 30");
    EXPECT_EQ(fault(Bench::message({1, 1}, "a")), "3 dest 1 is this vehicle");
    Message foreign = Bench::message({1, 2}, "a");
    foreign.src = 4;
    EXPECT_EQ(fault(foreign), "3 src 4 is not this vehicle, 1");
    EXPECT_EQ(b.stats({1, 2}).refused, 3U);
}

TEST(Explain, EachContestAndWhyOthersWereSkipped) {
    Bench b({{"2", "blackout_time_s", "1000"},
             {"3", "value_base", "2"},
             {"4", "ack", "false"},
             {"5", "ttl_s", "100"}});
    b.push({1, 2}, "a");
    b.push({2, 2}, "b");
    EXPECT_EQ(b.frames(b.turn(1, 2)), "ab");
    b.acknowledge(2, b.last->number, {0});
    b.push({2, 2}, "B");
    b.push({3, 2}, "too large");
    b.push({4, 3}, "c");
    b.push({5, 2}, "e");
    b.push({6, 2}, "s");
    b.at(90);
    Turn turn = b.turn(1, 1, 20);
    turn.dest = 2;
    std::vector<Contest> contests;
    b.last = b.scheduler.fill(turn, b.now(), [&](const Contest& c) { contests.push_back(c); });
    ASSERT_EQ(contests.size(), 2U);  // the second one finds no room
    const Contest& first = contests[0];
    EXPECT_EQ(first.winner, (QueueKey{6, 2}));
    EXPECT_EQ(first.free_bytes, 1U);
    EXPECT_EQ(first.age_ns, 90 * s_ns);
    ASSERT_EQ(first.candidates.size(), 6U);
    EXPECT_EQ(first.candidates[0].queue, (QueueKey{6, 2}));
    EXPECT_DOUBLE_EQ(first.candidates[0].priority, 90.0 / 1800);
    std::vector<Skip> skips(7);
    for (const Candidate& c : first.candidates) skips[c.queue.id] = c.skip;
    EXPECT_EQ(skips[1], Skip::empty);
    EXPECT_EQ(skips[2], Skip::blackout);
    EXPECT_EQ(skips[3], Skip::size);
    EXPECT_EQ(skips[4], Skip::dest);
    EXPECT_EQ(skips[5], Skip::expiring);
    EXPECT_EQ(contests[1].winner, std::nullopt);
}

TEST(Explain, ATurnWithoutAcknowledgements) {
    Bench b;
    b.push({1, 2}, "a");
    Turn turn = b.turn(1, 1);
    turn.acks = false;
    std::vector<Contest> contests;
    b.scheduler.fill(turn, b.now(), [&](const Contest& c) { contests.push_back(c); });
    ASSERT_EQ(contests.size(), 1U);
    EXPECT_EQ(contests[0].candidates[0].skip, Skip::ack);
    EXPECT_EQ(contests[0].candidates[0].bytes, 1U);
}

TEST(Stats, AgesAndBytes) {
    Bench b({{"1", "newest_first", "false"}});
    b.push({1, 2}, "four");
    b.at(10);
    b.push({1, 2}, "sixsix");
    b.at(30);
    EXPECT_EQ(b.stats({1, 2}).bytes, 10U);
    EXPECT_EQ(b.stats({1, 2}).oldest_age_ns, 30 * s_ns);
    EXPECT_EQ(b.frames(b.turn(2, 6)), "four|sixsix");
    b.acknowledge(2, b.last->number, {0, 1});
    EXPECT_EQ(b.stats({1, 2}).mean_age_ns, 25 * s_ns);
    EXPECT_EQ(b.stats({1, 2}).bytes, 0U);
}

TEST(Restart, QueuesKeepWhenTheyWereServed) {
    SchedulerOptions options = Bench::options({{"1", "blackout_time_s", "100"}});
    options.first_transmission = 500;
    Scheduler scheduler(options, {1000 * s_ns, 0});
    scheduler.set_last({1, 2}, 950 * s_ns);
    scheduler.push({1, Bench::message({1, 2}, "a"), 990 * s_ns, 3}, {1000 * s_ns, 0});
    Turn turn;
    turn.arrival_ns = 1050 * s_ns;
    EXPECT_FALSE(scheduler.fill(turn, {1049 * s_ns, 0}));
    const auto packet = scheduler.fill(turn, {1050 * s_ns, 0});
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->number, 500U);
    EXPECT_EQ(packet->carried[0].sends, 4U);
    EXPECT_EQ(scheduler.next_transmission(), 501U);
}

}  // namespace
}  // namespace seautils::queue
