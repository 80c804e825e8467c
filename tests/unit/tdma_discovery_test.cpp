// Discovery by the clock: it does what the simulation shows, and its laws.
#include "seautils/core/error.hpp"
#include "seautils/tdma/discovery.hpp"
#include "seautils/tdma/network.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

namespace seautils::tdma {
namespace {

constexpr std::int64_t s = second_ns;
constexpr std::int64_t slot_ns = 15 * s;
constexpr Origin midnight{Origin::Kind::midnight, 0};

DiscoveryOptions options_of(int address, Rule rule = Rule::goby1, std::uint32_t coolness = 5) {
    DiscoveryOptions options;
    options.address = address;
    options.excitation = {rule, coolness};
    return options;
}

Rule any_rule() {
    return *rc::gen::element(Rule::hash, Rule::goby1, Rule::eq, Rule::eqn, Rule::rot);
}

std::vector<int> any_addresses() {
    const auto set = *rc::gen::container<std::set<int>>(rc::gen::inRange(1, max_modem_id + 1));
    RC_PRE(!set.empty() && set.size() <= 8);
    return {set.begin(), set.end()};
}

/// A vehicle that heard some others at some time before `now`.
struct Case {
    DiscoveryOptions options;
    Discovery discovery;
};

Case any_case(std::int64_t now) {
    DiscoveryOptions options =
        options_of(*rc::gen::inRange(1, 31), any_rule(), *rc::gen::inRange<std::uint32_t>(1, 12));
    if (*rc::gen::arbitrary<bool>()) options.origin = midnight;
    options.slot_ns = *rc::gen::inRange<std::int64_t>(1, 20'000) * 1'000'001;
    options.silence_ns = options.slot_ns * *rc::gen::inRange<std::int64_t>(1, 50);
    Discovery discovery(options, now - 40 * options.slot_ns);
    for (int k = 0; k < 8; ++k) {
        discovery.hear(*rc::gen::inRange(0, 33),
                       now - *rc::gen::inRange<std::int64_t>(0, 40 * options.slot_ns));
    }
    discovery.advance(now);
    return {options, discovery};
}

/// Within 200 s of some midnight.
std::int64_t any_night() {
    return *rc::gen::inRange<std::int64_t>(1, 40'000) * day_ns +
           *rc::gen::inRange<std::int64_t>(-200 * s, 200 * s);
}

}  // namespace

TEST(TdmaDiscovery, LawItDoesWhatTheSimulationShows) {
    EXPECT_TRUE(rc::check("slot by slot", [] {
        const std::vector<int> addresses = any_addresses();
        const Excitation excitation{any_rule(), *rc::gen::inRange<std::uint32_t>(2, 12)};
        const auto start = *rc::gen::inRange<std::uint64_t>(0, 10'000);
        Network network(addresses, start, {excitation, 1, 0});
        std::vector<Discovery> vehicles;
        for (const int a : addresses) {
            DiscoveryOptions options = options_of(a, excitation.rule, excitation.coolness);
            options.silence_ns = max_cycle_ns;
            vehicles.emplace_back(options, static_cast<std::int64_t>(start) * slot_ns);
        }
        for (int k = 0; k < 300; ++k) {
            const std::int64_t begin = static_cast<std::int64_t>(network.slot()) * slot_ns;
            network.step();
            for (std::size_t v = 0; v < vehicles.size(); ++v) {
                const Vehicle& simulated = network.vehicles()[v];
                const Turn turn = vehicles[v].next(begin);
                const bool speaks = turn.start_ns == begin && turn.slot.src == addresses[v];
                RC_ASSERT((turn.start_ns > begin) == (simulated.does == Does::wait));
                RC_ASSERT(speaks == (simulated.does == Does::send));
            }
            for (std::size_t v = 0; v < vehicles.size(); ++v)
                for (const int a : network.vehicles()[v].heard)
                    vehicles[v].hear(a, begin + slot_ns / 3);
        }
    }));
}

// Pitfall 3: whatever the origin, and on both sides of midnight.
TEST(TdmaDiscovery, Pitfall3LawARestartAgreesWithOneThatRanThrough) {
    EXPECT_TRUE(rc::check("one that is started with its memory", [] {
        const std::int64_t now = any_night();
        const auto [options, running] = any_case(now);
        const Memory memory = parse_memory(to_text(running.memory()));
        RC_ASSERT(memory == running.memory());
        const Discovery restarted(options, memory, now);
        std::int64_t time = now + *rc::gen::inRange<std::int64_t>(0, 400 * s);
        for (int k = 0; k < 50; ++k) {
            const Turn turn = running.next(time);
            RC_ASSERT(restarted.next(time) == turn);
            time = turn.start_ns + 1;
        }
    }));
}

TEST(TdmaDiscovery, LawAnyTwoEvaluationsAgree) {
    EXPECT_TRUE(rc::check("from any instant before it, the next turn is the same", [] {
        const std::int64_t now = any_night();
        Discovery discovery = any_case(now).discovery;
        const Turn turn = discovery.next(now);
        RC_ASSERT(turn.start_ns >= now);
        const auto between = *rc::gen::inRange<std::int64_t>(now, turn.start_ns + 1);
        RC_ASSERT(discovery.next(between) == turn);
        discovery.advance(between);
        RC_ASSERT(discovery.next(between) == turn);
    }));
}

TEST(TdmaDiscovery, LawTwoVehiclesWithTheSameWorldAgree) {
    EXPECT_TRUE(rc::check("on every turn", [] {
        const int coolness = *rc::gen::inRange(1, 12);
        const Rule rule = any_rule();
        const Origin origin = *rc::gen::arbitrary<bool>() ? midnight : Origin{};
        const auto make = [&](int address, int other) {
            DiscoveryOptions options =
                options_of(address, rule, static_cast<std::uint32_t>(coolness));
            options.origin = origin;
            Discovery discovery(options, 19'844 * day_ns - 900 * s);
            // Each hears the other, and both a third, at different instants of the same slots.
            discovery.hear(other, 19'844 * day_ns - 750 * s - address);
            discovery.hear(9, 19'844 * day_ns - 690 * s - address);
            return discovery;
        };
        const Discovery one = make(4, 5), other = make(5, 4);
        RC_ASSERT(one.resume_ns() == other.resume_ns());
        std::int64_t time = one.resume_ns();
        // Past midnight, and past the moment at which all three are forgotten.
        for (int k = 0; k < 200; ++k) {
            const Turn turn = one.next(time);
            const Turn same = other.next(time);
            if (turn.start_ns > 19'844 * day_ns + 1000 * s) break;
            RC_ASSERT(same == turn);
            time = turn.start_ns + 1;
        }
    }));
}

TEST(TdmaDiscovery, WhoIsNewMakesTheCycleLonger) {
    Discovery discovery(options_of(1), 0);
    EXPECT_FALSE(discovery.hear(0, 0));
    EXPECT_FALSE(discovery.hear(1, 0));
    EXPECT_FALSE(discovery.hear(31, 0));
    EXPECT_FALSE(discovery.hear(-1, 0));
    EXPECT_TRUE(discovery.hear(3, 40 * s));
    EXPECT_FALSE(discovery.hear(3, 41 * s));
    EXPECT_EQ(discovery.resume_ns(), 90 * s);  // table 2.7
    const Turn turn = discovery.next(46 * s);
    EXPECT_EQ(turn.start_ns, 90 * s);
    EXPECT_EQ(turn.cycle, 2);
    EXPECT_EQ(turn.slot.src, 1);
    EXPECT_EQ(turn.end_ns, 105 * s);
    EXPECT_EQ(discovery.next(105 * s).slot.src, 3);
    EXPECT_EQ(discovery.next(120 * s).slot.kind, Kind::blank);
}

TEST(TdmaDiscovery, WhoIsSilentIsForgottenByAllAtTheSameInstant) {
    DiscoveryOptions options = options_of(1);
    options.silence_ns = 100 * s;
    Discovery discovery(options, 0);
    discovery.hear(3, 31 * s);  // in the slot that ends at 45 s: forgotten at 145, so at 150 s
    EXPECT_FALSE(discovery.advance(149 * s));
    EXPECT_TRUE(discovery.world().knows(3));
    EXPECT_EQ(discovery.next(135 * s).start_ns, 135 * s);
    // Its own cycle of 30 s: 165 s is the end of the slot, 180 s the next boundary.
    EXPECT_EQ(discovery.next(136 * s).start_ns, 180 * s);
    EXPECT_TRUE(discovery.advance(150 * s));
    EXPECT_EQ(discovery.resume_ns(), 180 * s);
    EXPECT_EQ(discovery.world(), World(1));
}

TEST(TdmaDiscovery, WhoWouldHaveBeenForgottenByNowDoesNotCount) {
    Discovery discovery(options_of(1), 10'000 * s);
    EXPECT_FALSE(discovery.hear(3, 40 * s));
    EXPECT_EQ(discovery.world(), World(1));
    EXPECT_EQ(discovery.resume_ns(), 10'020 * s);
    EXPECT_TRUE(discovery.hear(3, 9'000 * s));
}

TEST(TdmaDiscovery, OneThatStartsWaitsForACycle) {
    EXPECT_EQ(Discovery(options_of(1), 0).next(0).start_ns, 0);
    EXPECT_EQ(Discovery(options_of(1), 1).next(1).start_ns, 30 * s);
    EXPECT_EQ(Discovery(options_of(1), 15 * s).next(15 * s).start_ns, 30 * s);
}

// Pitfall 23: the wall clock steps; nobody is forgotten or waited for by that alone.
TEST(TdmaDiscovery, Pitfall23AStepOfTheClock) {
    Discovery discovery(options_of(1), 0);
    discovery.hear(3, 40 * s);
    const std::int64_t now = 1'714'564'800 * s;
    discovery.clock_stepped(now - 200 * s, now);  // from 1970 to a GPS fix
    discovery.advance(now);
    EXPECT_TRUE(discovery.world().knows(3));
    EXPECT_LE(discovery.next(now).start_ns, now + 90 * s);
    discovery.clock_stepped(-now, 200 * s);  // and back
    EXPECT_TRUE(discovery.world().knows(3));
    EXPECT_LE(discovery.next(200 * s).start_ns, 300 * s);
    EXPECT_TRUE(discovery.advance(200 * s + default_silence_ns));
}

TEST(TdmaDiscovery, AStepWhileItWaitsLetsItWaitAnew) {
    Discovery discovery(options_of(1), 3600 * s);
    discovery.hear(3, 3610 * s);
    EXPECT_GT(discovery.resume_ns(), 3620 * s);
    discovery.clock_stepped(-3600 * s, 20 * s);
    EXPECT_EQ(discovery.resume_ns(), 45 * s);
}

TEST(TdmaDiscovery, AMemoryFromTheFutureCountsAsOfNow) {
    const std::int64_t now = 1000 * s;
    const Discovery discovery(options_of(1), {{{3, 5'000'000 * s}}, 5'000'000 * s}, now);
    EXPECT_LE(discovery.next(now).start_ns, now + 3 * 45 * s);
    EXPECT_EQ(discovery.memory().others[0].until_ns, 1005 * s);
}

TEST(TdmaDiscovery, AMemoryOfOneselfAndOfNobodyDoesNotCount) {
    const Memory memory{{{1, 0}, {3, 0}, {3, 5}, {31, 0}, {127, 0}}, 0};
    const Discovery discovery(options_of(1), memory, 0);
    EXPECT_EQ(discovery.world().addresses(), (std::vector<int>{1, 3}));
    EXPECT_EQ(discovery.memory().others.size(), 1U);
}

TEST(TdmaDiscovery, OptionsOutOfRangeAreRefused) {
    const auto refused = [](auto change) {
        DiscoveryOptions options;
        change(options);
        EXPECT_THROW(Discovery(options, 0), ConfigError);
        EXPECT_THROW(Discovery(options, Memory{}, 0), ConfigError);
    };
    refused([](auto& o) { o.address = 0; });
    refused([](auto& o) { o.address = 31; });
    refused([](auto& o) { o.excitation.coolness = 0; });
    refused([](auto& o) { o.excitation.coolness = max_coolness + 1; });
    refused([](auto& o) { o.slot_ns = 0; });
    refused([](auto& o) { o.slot_ns = day_ns + 1; });
    refused([](auto& o) { o.guard_ns = o.slot_ns; });
    refused([](auto& o) { o.guard_ns = -1; });
    refused([](auto& o) { o.silence_ns = o.slot_ns - 1; });
}

TEST(TdmaDiscovery, LawAMemoryThatWasAlteredIsRefused) {
    EXPECT_TRUE(rc::check("any byte, any cut", [] {
        Memory memory;
        memory.resume_ns = *rc::gen::inRange<std::int64_t>(0, last_ns);
        for (const int a : any_addresses())
            memory.others.push_back({a, *rc::gen::inRange<std::int64_t>(0, last_ns)});
        std::string text = to_text(memory);
        RC_ASSERT(parse_memory(text) == memory);
        const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
        RC_ASSERT_THROWS_AS(parse_memory(text.substr(0, at)), DataError);
        text[at] = static_cast<char>(text[at] ^ *rc::gen::inRange(1, 256));
        RC_ASSERT_THROWS_AS(parse_memory(text), DataError);
        RC_ASSERT_THROWS_AS(parse_memory(to_text(memory) + "x"), DataError);
    }));
    EXPECT_TRUE(rc::check("any text", [](const std::string& text) {
        RC_ASSERT_THROWS_AS(parse_memory(text), DataError);
        RC_ASSERT_THROWS_AS(parse_memory("seautils tdma-slot state 1\n" + text), DataError);
    }));
}

}  // namespace seautils::tdma
