// The clock that the programs of a simulation share.
#include "seautils/core/error.hpp"
#include "seautils/core/time.hpp"
#include "seautils/core/warp.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace seautils {
namespace {

std::string fault(const std::string& text) {
    try {
        parse_warp(text);
    } catch (const DataError& e) {
        return e.what();
    }
    return "taken";
}

}  // namespace

TEST(CoreWarp, RunsFromItsStartAtItsPace) {
    const WarpedClock clock = parse_warp("warp:60,1000.5,2024-05-01T12:00:00Z");
    EXPECT_EQ(clock.boot_ns, 1'000'500'000'000);
    EXPECT_EQ(clock.sim_us, parse_utc("2024-05-01T12:00:00Z"));
    const std::int64_t second_ns = 1'000'000'000;
    EXPECT_EQ(clock.sim_ns_at(clock.boot_ns + second_ns), parse_utc("2024-05-01T12:01:00Z") * 1000);
    EXPECT_EQ(clock.sim_ns_at(clock.boot_ns - second_ns), parse_utc("2024-05-01T11:59:00Z") * 1000);
    EXPECT_EQ(clock.boot_ns_at(parse_utc("2024-05-01T12:01:00Z") * 1000),
              clock.boot_ns + second_ns);
}

TEST(CoreWarp, FaultsAreQuoted) {
    const std::string form = " is not of the form warp:N,BOOT,SIM";
    EXPECT_EQ(fault("60"), "clock '60'" + form);
    EXPECT_EQ(fault("warp:60"), "clock 'warp:60'" + form);
    EXPECT_EQ(fault("warp:1,2,3,@4"), "clock 'warp:1,2,3,@4'" + form);
    EXPECT_EQ(fault("warp:x,1,@1"), "factor 'x' of a clock is not a number");
    EXPECT_EQ(fault("warp:,1,@1"), "factor '' of a clock is not a number");
    EXPECT_EQ(fault("warp:1e1,1,@1"), "factor '1e1' of a clock is not a number");
    EXPECT_EQ(fault("warp:0,1,@1"), "factor '0' of a clock is outside 0.001 to 1000");
    EXPECT_EQ(fault("warp:1,-1,@1"), "start '-1' of a clock is not a number");
    EXPECT_EQ(fault("warp:1,1,noon"), "time 'noon' is not of the form 2024-05-01T12:00:25Z");
    EXPECT_EQ(fault("warp:1,1,9999-01-01T00:00:00Z"),
              "time '9999-01-01T00:00:00Z' of a clock is after the year 2200");
}

RC_GTEST_PROP(CoreWarp, ComesBackFromText, ()) {
    WarpedClock clock;
    clock.factor = *rc::gen::inRange(1, 100'000) / 100.0;
    clock.boot_ns = *rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000'000);
    clock.sim_us = *rc::gen::inRange<std::int64_t>(0, 7'258'118'400'000'000);
    const WarpedClock again = parse_warp(format_warp(clock));
    RC_ASSERT(again.factor == clock.factor);
    RC_ASSERT(std::abs(again.boot_ns - clock.boot_ns) <= 1);
    RC_ASSERT(again.sim_us == clock.sim_us);
}

RC_GTEST_PROP(CoreWarp, ATimerIsNeverEarly, ()) {
    WarpedClock clock{*rc::gen::inRange(1, 100'000) / 100.0, 5'000'000'000, 1'700'000'000'000'000};
    const auto after_ns = *rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000);
    const std::int64_t sim_ns = clock.sim_us * 1000 + after_ns;
    RC_ASSERT(clock.sim_ns_at(clock.boot_ns_at(sim_ns)) >= sim_ns - 1);
}

}  // namespace seautils
