// Where cycles begin: divided from the origin, to the nanosecond.
#include "seautils/core/error.hpp"
#include "seautils/tdma/grid.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace seautils::tdma {
namespace {

constexpr Origin midnight{Origin::Kind::midnight, 0};

Origin any_origin() {
    if (*rc::gen::arbitrary<bool>()) return midnight;
    return {Origin::Kind::instant, *rc::gen::inRange<std::int64_t>(0, 3'000'000'000) * second_ns};
}

}  // namespace

TEST(TdmaGrid, Origins) {
    EXPECT_EQ(parse_origin("epoch").instant_ns, 0);
    EXPECT_EQ(parse_origin("midnight").kind, Origin::Kind::midnight);
    EXPECT_EQ(parse_origin("2001-09-09T01:46:40.5Z").instant_ns, 1'000'000'000'500'000'000);
    EXPECT_EQ(parse_origin("@9200000000").instant_ns, last_ns);
    EXPECT_THROW(parse_origin("noon"), DataError);
    EXPECT_THROW(parse_origin("@9200000001"), DataError);
    EXPECT_THROW(parse_origin("2001-09-09T01:46:40"), DataError);
}

TEST(TdmaGrid, SecondsAreExact) {
    EXPECT_EQ(parse_seconds_ns("0.1"), 100'000'000);
    EXPECT_EQ(parse_seconds_ns("15"), 15 * second_ns);
    EXPECT_EQ(parse_seconds_ns("0.000000001"), 1);
    EXPECT_EQ(parse_seconds_ns("1000000000"), second_ns * second_ns);
    for (const char* wrong : {"", ".", "1.", ".5", "-1", "1e3", "0x1", "1 ", "1.0000000001", "inf",
                              "1000000000.1", "9999999999", "99999999999"})
        EXPECT_THROW(parse_seconds_ns(wrong), DataError) << wrong;
}

// Pitfalls 2 and 4: the next boundary is later, also from a boundary, and tenths do not drift.
TEST(TdmaGrid, Pitfall2And4TheNextBoundaryIsStrictlyLater) {
    EXPECT_EQ(boundary_after({}, 45, 45), 90);
    EXPECT_EQ(boundary_after({}, 45, 89), 90);
    EXPECT_EQ(boundary_after({}, 45, 0), 45);
    EXPECT_EQ(boundary_from({}, 45, 45), 45);
    EXPECT_EQ(boundary_from({}, 45, 46), 90);
    EXPECT_EQ(boundary_from({}, 45, 0), 0);
    const std::int64_t tenth = parse_seconds_ns("0.1");
    EXPECT_EQ(boundary_after({}, tenth, 1'714'564'800 * second_ns),
              1'714'564'800 * second_ns + tenth);
}

TEST(TdmaGrid, NothingBeginsBeforeTheOrigin) {
    const Origin later{Origin::Kind::instant, 1000};
    EXPECT_EQ(boundary_after(later, 7, 3), 1000);
    EXPECT_EQ(boundary_after(later, 7, 999), 1000);
    EXPECT_EQ(boundary_after(later, 7, 1000), 1007);
    EXPECT_EQ(boundary_from(later, 7, 0), 1000);
    EXPECT_EQ(boundary_from(later, 7, 1000), 1000);
}

TEST(TdmaGrid, MidnightCutsTheCycle) {
    constexpr std::int64_t step = 35 * second_ns;  // 86400 is 2468 of them and 20 s
    EXPECT_EQ(boundary_after(midnight, step, day_ns - 21 * second_ns), day_ns - 20 * second_ns);
    EXPECT_EQ(boundary_after(midnight, step, day_ns - 20 * second_ns), day_ns);
    EXPECT_EQ(boundary_after(midnight, step, day_ns), day_ns + step);
}

TEST(TdmaGrid, LawBoundariesFollowEachOther) {
    EXPECT_TRUE(rc::check("boundaries are later, and none lies between", [] {
        const Origin origin = any_origin();
        const auto step = *rc::gen::inRange<std::int64_t>(1, 100'000) * 1'000'003;
        const auto time = *rc::gen::inRange<std::int64_t>(0, 4'000'000'000) * second_ns +
                          *rc::gen::inRange<std::int64_t>(0, second_ns);
        const std::int64_t next = boundary_after(origin, step, time);
        RC_ASSERT(next > time);
        const Era era = era_of(origin, next);
        RC_ASSERT(next >= era.begin_ns);
        RC_ASSERT((next - era.begin_ns) % step == 0);
        const auto between = *rc::gen::inRange<std::int64_t>(time, next);
        RC_ASSERT(boundary_after(origin, step, between) == next);
        RC_ASSERT(boundary_from(origin, step, next) == next);
        RC_ASSERT(boundary_from(origin, step, time + 1) == next);
    }));
}

}  // namespace seautils::tdma
