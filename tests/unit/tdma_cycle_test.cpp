// Cycles of slots that were declared: whose turn it is at an instant.
#include "seautils/core/error.hpp"
#include "seautils/tdma/cycle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <numeric>
#include <string>

namespace seautils::tdma {
namespace {

constexpr std::int64_t s = second_ns;

Slot slot(int src, std::int64_t length_ns) {
    Slot one;
    one.src = src;
    one.length_ns = length_ns;
    if (src == 0) one.kind = Kind::blank;
    return one;
}

std::string refusal(const std::string& text) {
    try {
        parse_slot(text);
        return "taken";
    } catch (const DataError& e) {
        return e.what();
    }
}

struct Case {
    std::vector<Slot> slots;
    Origin origin;
    Cycle cycle() const { return Cycle(slots, origin); }
};

Case any_case() {
    Case c;
    const int count = *rc::gen::inRange(1, 6);
    for (int k = 0; k < count; ++k)
        c.slots.push_back(slot(k, *rc::gen::inRange<std::int64_t>(1, 60'000) * 1'000'001));
    if (*rc::gen::arbitrary<bool>()) c.origin.kind = Origin::Kind::midnight;
    return c;
}

std::int64_t any_time() {
    const std::int64_t day = *rc::gen::inRange<std::int64_t>(0, 40'000);
    return *rc::gen::oneOf(
        rc::gen::inRange<std::int64_t>(day * day_ns, (day + 1) * day_ns),
        rc::gen::inRange<std::int64_t>((day + 1) * day_ns - 100 * s, (day + 1) * day_ns + 100 * s));
}

}  // namespace

TEST(TdmaCycle, TurnsComeInTheOrderOfTheirDeclaration) {
    const Cycle cycle({slot(3, 10 * s), slot(1, 20 * s), slot(0, 5 * s)}, {}, s);
    EXPECT_EQ(cycle.length_ns(), 35 * s);
    const Turn first = cycle.next(0);
    EXPECT_EQ(first.slot.src, 3);
    EXPECT_EQ(first.start_ns, 0);
    EXPECT_EQ(first.end_ns, 9 * s);
    const Turn second = cycle.next(1);
    EXPECT_EQ(second.slot.src, 1);
    EXPECT_EQ(second.index, 1U);
    EXPECT_EQ(second.start_ns, 10 * s);
    EXPECT_EQ(second.end_ns, 29 * s);
    EXPECT_EQ(cycle.next(30 * s).slot.src, 0);
    const Turn next = cycle.next(30 * s + 1);
    EXPECT_EQ(next.cycle, 1);
    EXPECT_EQ(next.index, 0U);
    EXPECT_EQ(next.start_ns, 35 * s);
}

// Pitfall 5: a slot that has begun is not used, and the only one of a cycle waits for the next.
TEST(TdmaCycle, Pitfall5ASlotThatHasBegunIsNotUsed) {
    const Cycle alone({slot(1, 10 * s)});
    EXPECT_EQ(alone.next(10 * s).start_ns, 10 * s);
    EXPECT_EQ(alone.next(10 * s + 1).start_ns, 20 * s);
    EXPECT_EQ(alone.next(19 * s).start_ns, 20 * s);
}

// Pitfall 5: a cycle without length would never end.
TEST(TdmaCycle, Pitfall5LengthsOfZeroAreRefused) {
    EXPECT_THROW(Cycle({}), ConfigError);
    EXPECT_THROW(Cycle({slot(1, 0)}), ConfigError);
    EXPECT_THROW(Cycle({slot(1, 0), slot(2, 10 * s)}), ConfigError);
    EXPECT_THROW(Cycle({slot(1, min_slot_ns - 1)}), ConfigError);
    EXPECT_THROW(Cycle({slot(1, day_ns + 1)}), ConfigError);
    EXPECT_THROW(Cycle(std::vector<Slot>(max_slots + 1, slot(1, s))), ConfigError);
    EXPECT_THROW(Cycle(std::vector<Slot>(31, slot(1, day_ns))), ConfigError);
    EXPECT_THROW(Cycle({slot(1, s)}, {}, s), ConfigError);
    EXPECT_THROW(Cycle({slot(1, s)}, {}, -1), ConfigError);
    const Origin midnight{Origin::Kind::midnight, 0};
    EXPECT_THROW(Cycle({slot(1, day_ns), slot(2, s)}, midnight), ConfigError);
    EXPECT_EQ(Cycle({slot(1, day_ns)}, midnight).next(1).start_ns, day_ns);
}

// Pitfall 3: 35 s do not divide a day. With an absolute origin midnight means nothing; with
// `midnight` all cut the cycle, those that ran through and those that were restarted.
TEST(TdmaCycle, Pitfall3MidnightIsTheSameForAll) {
    const std::vector<Slot> slots{slot(1, 15 * s), slot(2, 20 * s)};
    const std::int64_t night = 19'844 * day_ns;
    const Cycle daily(slots, {Origin::Kind::midnight, 0});
    const Turn last = daily.next(night - 20 * s);
    EXPECT_EQ(last.slot.src, 1);
    EXPECT_EQ(last.start_ns, night - 20 * s);  // 2468 whole cycles before
    // The slot of 20 s that would begin 5 s before midnight is cut, and so not used.
    const Turn first = daily.next(night - 20 * s + 1);
    EXPECT_EQ(first.start_ns, night);
    EXPECT_EQ(first.cycle, 0);
    EXPECT_EQ(first.slot.src, 1);
    const Cycle absolute(slots);
    EXPECT_EQ(absolute.next(night).start_ns % (35 * s) % (15 * s), 0);
    EXPECT_EQ(absolute.next(night).cycle, night / (35 * s) + (night % (35 * s) > 15 * s ? 1 : 0));
}

// Pitfall 4: tenths of a second stay tenths after fifty years.
TEST(TdmaCycle, Pitfall4TenthsDoNotDrift) {
    const Cycle cycle({slot(1, s / 10), slot(2, s / 10)});
    const std::int64_t time = 1'714'564'800 * s;
    EXPECT_EQ(cycle.next(time).start_ns, time);
    EXPECT_EQ(cycle.next(time).slot.src, 1);
    EXPECT_EQ(cycle.next(time + 1).start_ns, time + s / 10);
    EXPECT_EQ(cycle.next(time).cycle, 8'572'824'000);
}

TEST(TdmaCycle, LawAnyTwoEvaluationsAgree) {
    EXPECT_TRUE(rc::check("from any instant before it, the next turn is the same", [] {
        const Case c = any_case();
        const std::int64_t time = any_time();
        const Turn turn = c.cycle().next(time);
        RC_ASSERT(turn.start_ns >= time);
        const auto between = *rc::gen::inRange<std::int64_t>(time, turn.start_ns + 1);
        RC_ASSERT(c.cycle().next(between) == turn);
    }));
}

TEST(TdmaCycle, LawARestartAtAnyTimeAgreesWithOneThatRanThrough) {
    EXPECT_TRUE(rc::check("turn by turn over midnight", [] {
        const Case c = any_case();
        const Cycle running = c.cycle();
        const std::int64_t night = *rc::gen::inRange<std::int64_t>(1, 40'000) * day_ns;
        Turn turn = running.next(night - 150 * s);
        while (turn.start_ns < night + 150 * s) {
            const Turn after = running.next(turn.start_ns + 1);
            RC_ASSERT(after.start_ns >= turn.start_ns + turn.slot.length_ns);
            RC_ASSERT(after.start_ns <= turn.start_ns + turn.slot.length_ns + 60 * s + s);
            RC_ASSERT(c.cycle().next(turn.start_ns + turn.slot.length_ns) == after);
            turn = after;
        }
        if (c.origin.kind == Origin::Kind::midnight)
            RC_ASSERT(c.cycle().next(night) == running.next(night));
    }));
}

TEST(TdmaCycle, PollingCostsTheCycleInitiationAndTheWay) {
    // Eq. 2.5 with 1 s and 1500 m/s.
    EXPECT_EQ(poll_overhead_ns(1, 500, 1500), 1'333'333'334);
    EXPECT_EQ(poll_overhead_ns(1, 1000, 1500), 1'666'666'667);
    EXPECT_EQ(poll_overhead_ns(1, 1500, 1500), 2 * s);
    EXPECT_EQ(poll_overhead_ns(1, 2000, 1500), 2'333'333'334);
    EXPECT_EQ(poll_overhead_ns(1, 3000, 1500), 3 * s);
    EXPECT_EQ(poll_overhead_ns(1, 4000, 1500), 3'666'666'667);
    EXPECT_EQ(poll_overhead_ns(1, 5000, 1500), 4'333'333'334);
    EXPECT_EQ(poll_overhead_ns(0, 0, 1300), 0);
    EXPECT_THROW(poll_overhead_ns(61, 0, 1500), DataError);
    EXPECT_THROW(poll_overhead_ns(1, -1, 1500), DataError);
    EXPECT_THROW(poll_overhead_ns(1, 0, 150), DataError);
    std::vector<Slot> slots{slot(1, 10 * s), slot(0, 5 * s)};
    add_poll_overhead(slots, 2 * s);
    EXPECT_EQ(slots[0].length_ns, 12 * s);
    EXPECT_EQ(slots[1].length_ns, 5 * s);
}

TEST(TdmaSlotText, AllParts) {
    Slot wanted = slot(3, 12'500'000'000);
    wanted.dest = 5;
    wanted.rate = 2;
    wanted.kind = Kind::ping;
    EXPECT_EQ(parse_slot("src=3,dest=5,rate=2,length=12.5,kind=ping"), wanted);
    EXPECT_EQ(parse_slot("  kind=ping dest=5\tlength=12.5, src=3 rate=2 "), wanted);
    EXPECT_EQ(parse_slot("src=1"), slot(1, 10 * s));
    EXPECT_EQ(parse_slot("length=5"), slot(0, 5 * s));
    EXPECT_EQ(parse_slot("src=0 kind=blank"), slot(0, 10 * s));
    const Slot mini = parse_slot("src=2 kind=mini mini=8191 dest=0");
    EXPECT_EQ(mini.mini, 8191);
    EXPECT_EQ(mini.dest, 0);
}

TEST(TdmaSlotText, WhatIsNoSlotIsNamed) {
    EXPECT_EQ(refusal(""), "a slot says at least its length");
    EXPECT_EQ(refusal("3"), "'3' is not of the form key=value");
    EXPECT_EQ(refusal("src=31"), "src '31' is outside 0 to 30");
    EXPECT_EQ(refusal("src=-1"), "src '-1' is outside 0 to 30");
    EXPECT_EQ(refusal("src=1x"), "src '1x' is outside 0 to 30");
    EXPECT_EQ(refusal("src=1 src=2"), "'src' is given twice");
    EXPECT_EQ(refusal("src=1 rate=15"), "rate '15' is outside 0 to 14");
    EXPECT_EQ(refusal("src=1 length=0"), "length '0' is outside 0.001 to 86400 s");
    EXPECT_EQ(refusal("src=1 length=86400.1"), "length '86400.1' is outside 0.001 to 86400 s");
    EXPECT_EQ(refusal("src=1 length=soon"),
              "'soon' is not a number of seconds with at most 9 decimals");
    EXPECT_EQ(refusal("src=1 kind=data2"), "kind 'data2' is none of data, ping, lbl, mini, blank");
    EXPECT_EQ(refusal("src=1 colour=red"),
              "'colour' is none of src, dest, rate, length, kind, mini");
    EXPECT_EQ(refusal("kind=data"), "nobody speaks in a slot without src");
    EXPECT_EQ(refusal("src=1 kind=blank"), "a blank slot has no src");
    EXPECT_EQ(refusal("length=5 dest=1"), "a blank slot has no dest");
    EXPECT_EQ(refusal("src=1 kind=ping"), "a ping needs a dest, 1 to 30");
    EXPECT_EQ(refusal("src=1 dest=0 kind=ping"), "a ping needs a dest, 1 to 30");
    EXPECT_EQ(refusal("src=1 dest=1"), "src and dest are both 1");
    EXPECT_EQ(refusal("src=1 mini=5"), "mini is for slots of kind mini");
    EXPECT_EQ(refusal("src=1 kind=mini mini=8192"), "mini '8192' is outside 0 to 8191");
}

}  // namespace seautils::tdma
