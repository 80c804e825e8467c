// Turns are handed out once, in time, and not at all when it is too late.
#include "seautils/tdma/ticker.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <stdexcept>

namespace seautils::tdma {
namespace {

constexpr std::int64_t s = second_ns;

/// Vehicles 1, 2, 3 with slots of 10 s.
Ticker ticker(std::int64_t lead_ns, std::int64_t now_ns) {
    std::vector<Slot> slots(3);
    for (int k = 0; k < 3; ++k) slots[static_cast<std::size_t>(k)].src = k + 1;
    return {[cycle = Cycle(slots)](std::int64_t t) { return cycle.next(t); }, lead_ns, now_ns};
}

}  // namespace

TEST(TdmaTicker, TurnsComeOnceAndInOrder) {
    Ticker one = ticker(0, 5 * s);
    EXPECT_EQ(one.due_ns(), 10 * s);
    EXPECT_FALSE(one.take(10 * s - 1));
    const auto first = one.take(10 * s + 50'000);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->turn.slot.src, 2);
    EXPECT_EQ(first->late_ns, 50'000);
    EXPECT_FALSE(first->is_missed);
    EXPECT_FALSE(one.take(10 * s + 60'000));
    EXPECT_EQ(one.due_ns(), 20 * s);
}

TEST(TdmaTicker, TheLeadIsBeforeTheBeginning) {
    Ticker one = ticker(2 * s, 0);
    EXPECT_EQ(one.take(0)->turn.start_ns, 0);
    EXPECT_EQ(one.due_ns(), 8 * s);
    EXPECT_FALSE(one.take(7 * s));
    EXPECT_EQ(one.take(8 * s)->turn.start_ns, 10 * s);
    EXPECT_EQ(one.due_ns(), 18 * s);
    // In between, what was handed out does not come again.
    one.plan(9 * s);
    EXPECT_EQ(one.due_ns(), 18 * s);
    // Within the lead, but not begun: at once.
    EXPECT_EQ(ticker(2 * s, 9 * s).take(9 * s)->turn.start_ns, 10 * s);
    EXPECT_THROW(ticker(-1, 0), std::out_of_range);
}

// Pitfall 5: after a long sleep a slot that is half over is not used.
TEST(TdmaTicker, Pitfall5ASleepMissesTurns) {
    Ticker one = ticker(0, 5 * s);
    const auto missed = one.take(47 * s);
    ASSERT_TRUE(missed);
    EXPECT_TRUE(missed->is_missed);
    EXPECT_EQ(missed->late_ns, 37 * s);
    EXPECT_EQ(one.due_ns(), 50 * s);
    // A tenth of the slot, here 1 s, is no sleep.
    EXPECT_FALSE(one.take(51 * s)->is_missed);
    EXPECT_TRUE(one.take(61 * s + 1)->is_missed);
}

// Pitfall 23: the clock steps in both directions.
TEST(TdmaTicker, Pitfall23TheClockSteps) {
    Ticker one = ticker(0, 5 * s);
    ASSERT_TRUE(one.take(10 * s));
    one.plan(1'714'564'801 * s);
    EXPECT_EQ(one.due_ns(), 1'714'564'810 * s);
    one.plan(10 * s - 1000);  // back by a little: the slot at 10 s was used
    EXPECT_EQ(one.due_ns(), 20 * s);
    one.plan(3 * s);  // back by more: that it comes again is the clock's doing
    EXPECT_EQ(one.due_ns(), 20 * s);
    one.plan(0);
    EXPECT_EQ(one.due_ns(), 0);
}

TEST(TdmaTicker, LawNoTurnComesTwiceOrEarly) {
    EXPECT_TRUE(rc::check("whenever the clock is read", [] {
        std::int64_t now = *rc::gen::inRange<std::int64_t>(0, 100 * s);
        const auto lead = *rc::gen::inRange<std::int64_t>(0, 9 * s);
        Ticker one = ticker(lead, now);
        std::int64_t last = -1;
        for (const auto wait : *rc::gen::container<std::vector<std::int64_t>>(
                 rc::gen::inRange<std::int64_t>(0, 15 * s))) {
            now += wait;
            if (*rc::gen::arbitrary<bool>()) one.plan(now);
            while (const auto handed = one.take(now)) {
                RC_ASSERT(handed->turn.start_ns > last);
                RC_ASSERT(handed->turn.start_ns - lead <= now);
                RC_ASSERT(handed->is_missed == (now > handed->turn.start_ns + s));
                last = handed->turn.start_ns;
            }
            RC_ASSERT(one.due_ns() > now);
        }
    }));
}

}  // namespace seautils::tdma
