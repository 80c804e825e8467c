// Discovery slot by slot: the rules, table 2.7 and figure 2.10 of T. Schneider's thesis.
#include "seautils/core/error.hpp"
#include "seautils/core/random.hpp"
#include "seautils/tdma/network.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <string>
#include <utility>

namespace seautils::tdma {
namespace {

constexpr std::uint64_t limit = 100'000;

World world_of(const std::vector<int>& addresses) {
    World world(addresses.front());
    for (const int address : addresses) world.add(address);
    return world;
}

Network network_of(const std::vector<int>& addresses, Rule rule, std::uint32_t coolness) {
    return {addresses, 0, {{rule, coolness}, 1, 0}};
}

/// One letter a vehicle, slot by slot.
std::string time_line(Network& network, int slots) {
    std::string text;
    for (int k = 0; k < slots; ++k) {
        network.step();
        if (k > 0) text += ' ';
        for (const Vehicle& vehicle : network.vehicles()) text += static_cast<char>(vehicle.does);
    }
    return text;
}

/// (all known, all settled) in slots.
using Times = std::pair<std::uint64_t, std::uint64_t>;
Times times(const std::vector<int>& addresses, Rule rule, std::uint32_t coolness) {
    Network network = network_of(addresses, rule, coolness);
    const Outcome outcome = run(network, limit);
    return {outcome.known_slots, outcome.settled_slots};
}

}  // namespace

TEST(TdmaRule, Names) {
    EXPECT_EQ(parse_rule("hash"), Rule::hash);
    EXPECT_EQ(parse_rule("goby1"), Rule::goby1);
    EXPECT_EQ(parse_rule("eq"), Rule::eq);
    EXPECT_EQ(parse_rule("eqn"), Rule::eqn);
    EXPECT_EQ(parse_rule("rot"), Rule::rot);
    EXPECT_THROW(parse_rule("eqN"), DataError);
}

TEST(TdmaRule, PlacesOfTheBlankSlot) {
    const World world = world_of({1, 3, 6});  // S = 10, K = 3, N = 4
    const auto place = [&](Rule rule, std::uint64_t n) { return blank_place({rule, 5}, n, world); };
    // 10 mod 5 is 0: cycles 0, 5, 10 are excited.
    EXPECT_EQ(place(Rule::goby1, 10), 2U);
    EXPECT_EQ(place(Rule::goby1, 11), 3U);
    EXPECT_EQ(place(Rule::eq, 10), 3U);
    EXPECT_EQ(place(Rule::eq, 11), 2U - 11 % 3);
    EXPECT_EQ(place(Rule::eqn, 10), 3U);
    EXPECT_EQ(place(Rule::eqn, 11), 3U - 11 % 4);
    EXPECT_EQ(place(Rule::rot, 10), 2U - 10 % 3);
    EXPECT_EQ(place(Rule::rot, 11), 3U);
    const std::uint64_t w =
        splitmix64(0x1000193) ^ splitmix64(3 * 0x1000193ULL) ^ splitmix64(6 * 0x1000193ULL);
    EXPECT_EQ(world.hash(), w);
    for (std::uint64_t n = 0; n < 100; ++n) {
        const std::uint64_t h = splitmix64(splitmix64(n) ^ w);
        EXPECT_EQ(place(Rule::hash, n), h % 5 == 0 ? (h >> 32) % 3 : 3);
    }
}

TEST(TdmaRule, SpeakersAreInOrderAroundTheBlankSlot) {
    const World world = world_of({6, 1, 3});
    const auto whose = [&](std::size_t at) { return speaker({Rule::goby1, 5}, 10, at, world); };
    EXPECT_EQ(whose(0), 1);
    EXPECT_EQ(whose(1), 3);
    EXPECT_EQ(whose(2), 0);
    EXPECT_EQ(whose(3), 6);
}

TEST(TdmaRule, WorldsGrowAndShrink) {
    World world(4);
    EXPECT_TRUE(world.add(127));
    EXPECT_FALSE(world.add(127));
    EXPECT_EQ(world.sum(), 131U);
    EXPECT_EQ(world.slots(), 3U);
    EXPECT_FALSE(world.remove(5));
    EXPECT_TRUE(world.remove(127));
    EXPECT_EQ(world.hash(), World(4).hash());
    EXPECT_EQ(world.sum(), 4U);
    EXPECT_TRUE(world.knows(4));
    EXPECT_FALSE(world.knows(127));
}

TEST(TdmaRule, LawAWorldHasOneBlankSlotAndEachVehicleOnce) {
    EXPECT_TRUE(rc::check("cycles are permutations, and repeat after their period", [] {
        World world(*rc::gen::inRange(1, 128));
        for (const int a : *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 128)))
            world.add(a);
        const Excitation excitation{
            *rc::gen::element(Rule::hash, Rule::goby1, Rule::eq, Rule::eqn, Rule::rot),
            *rc::gen::inRange<std::uint32_t>(1, 20)};
        const auto n = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
        std::vector<int> spoken;
        int blanks = 0;
        for (std::size_t k = 0; k < world.slots(); ++k) {
            const int whose = speaker(excitation, n, k, world);
            if (whose == 0)
                ++blanks;
            else
                spoken.push_back(whose);
        }
        RC_ASSERT(blanks == 1);
        RC_ASSERT(spoken == world.addresses());
        const std::uint64_t period = period_slots(excitation, world.slots());
        RC_ASSERT(period % world.slots() == 0);
        RC_ASSERT(blank_place(excitation, n + period / world.slots(), world) ==
                  blank_place(excitation, n, world));
    }));
}

TEST(TdmaRule, LawTwoVehiclesWithTheSameWorldAgree) {
    EXPECT_TRUE(rc::check("whatever the order in which they learned", [] {
        auto addresses =
            *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 128)));
        const World one = world_of(addresses);
        std::reverse(addresses.begin(), addresses.end());
        const World other = world_of(addresses);
        RC_ASSERT(one == other);
        RC_ASSERT(one.hash() == other.hash());
        RC_ASSERT(one.sum() == other.sum());
    }));
}

// Pitfall 1: table 2.7 is of addresses 1 and 3, and of the rule of Goby 1 rather than eq. 2.6.
TEST(TdmaNetwork, Pitfall1Table27) {
    const std::string table = "SS BB BS WB WS WB SB LW BW SL LS BB SL BB LS";
    for (const std::uint32_t c : {4U, 5U, 9U}) {
        Network goby1 = network_of({1, 3}, Rule::goby1, c);
        EXPECT_EQ(time_line(goby1, 15), table);
        Network rot = network_of({1, 3}, Rule::rot, c);
        EXPECT_EQ(time_line(rot, 15), table);
    }
    Network labels = network_of({1, 2}, Rule::goby1, 5);
    EXPECT_NE(time_line(labels, 15), table);
    Network equation = network_of({1, 3}, Rule::eq, 5);
    EXPECT_NE(time_line(equation, 15), table);
}

// Pitfall 2: heard at 45 s, on a boundary of the new cycle, the first turn is at 90 s.
TEST(TdmaNetwork, Pitfall2WaitsForABoundaryStrictlyAfterTheEndOfTheSlot) {
    Network network = network_of({1, 3}, Rule::goby1, 5);
    for (int k = 0; k < 3; ++k) network.step();
    EXPECT_EQ(network.vehicles()[0].heard, std::vector<int>{3});
    EXPECT_EQ(network.vehicles()[0].resume, 6U);  // slots of 15 s
    while (network.slot() < 7) network.step();
    EXPECT_EQ(network.vehicles()[1].heard, std::vector<int>{1});
    EXPECT_EQ(network.vehicles()[1].resume, 9U);
}

TEST(TdmaNetwork, Figure210) {
    for (const Rule rule : {Rule::goby1, Rule::rot}) {
        Network network = network_of({1, 2, 3}, rule, 4);
        std::map<std::uint64_t, std::vector<int>> learned;  // in which slot whom
        while (!network.all_known()) {
            std::vector<std::size_t> before;
            for (const Vehicle& v : network.vehicles()) before.push_back(v.world.size());
            network.step();
            for (std::size_t k = 0; k < before.size(); ++k)
                if (network.vehicles()[k].world.size() > before[k])
                    learned[network.slot() - 1] = network.vehicles()[k].heard;
        }
        EXPECT_EQ(learned,
                  (std::map<std::uint64_t, std::vector<int>>{{3, {1}}, {10, {3}}, {13, {2}}}));
        EXPECT_EQ(times({1, 2, 3}, rule, 4), Times(14, 16));
    }
}

TEST(TdmaNetwork, PublishedTimes) {
    EXPECT_EQ(times({1, 2, 3}, Rule::rot, 5), Times(39, 40));
    EXPECT_EQ(times({1, 2, 3}, Rule::rot, 6), Times(28, 32));
    EXPECT_EQ(times({1, 2, 3}, Rule::goby1, 5), Times(39, 40));
    EXPECT_EQ(times({1, 2, 3}, Rule::goby1, 6), Times(39, 40));
    EXPECT_EQ(times({1, 2, 3}, Rule::eq, 4), Times(58, 60));
    EXPECT_EQ(times({1, 2, 3}, Rule::eq, 5), Times(16, 20));
    EXPECT_EQ(times({1, 2, 3}, Rule::eq, 6), Times(16, 20));
    for (const std::uint32_t c : {4U, 5U, 6U}) EXPECT_EQ(times({1, 3}, Rule::rot, c), Times(7, 9));
    EXPECT_EQ(times({1, 2}, Rule::rot, 4), Times(13, 15));
    EXPECT_EQ(times({1, 2}, Rule::rot, 5), Times(22, 24));
    EXPECT_EQ(times({1, 2}, Rule::rot, 6), Times(16, 18));
}

TEST(TdmaNetwork, AFailureIsProvenAndTrue) {
    Network network = network_of({1, 5}, Rule::goby1, 4);  // 1 and 5 are 1 modulo 4
    const Outcome outcome = run(network, limit);
    EXPECT_FALSE(outcome.succeeded);
    EXPECT_TRUE(outcome.is_proven);
    while (network.slot() < 20'000) network.step();
    EXPECT_FALSE(network.all_known());
}

TEST(TdmaNetwork, ALimitIsNoProof) {
    Network network = network_of({1, 5}, Rule::goby1, 4);
    const Outcome outcome = run(network, 3);
    EXPECT_FALSE(outcome.succeeded);
    EXPECT_FALSE(outcome.is_proven);
    EXPECT_EQ(network.slot(), 3U);
}

TEST(TdmaNetwork, OneThatComesLateIsFoundWithHash) {
    for (std::uint64_t start = 0; start < 300; ++start) {
        Network network({2, 5, 9}, start, {{Rule::hash, 2}, 1, 0});
        ASSERT_TRUE(run(network, limit).succeeded);
        while (network.slot() < network.settled()) network.step();
        network.join(7);
        ASSERT_TRUE(run(network, 5760).succeeded) << start;
    }
}

TEST(TdmaNetwork, ChanceDecidesWhatCollides) {
    int through = 0;
    for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
        Network network({1, 5}, 0, {{Rule::goby1, 4}, 0.25, seed});  // both speak in slot 0
        network.step();
        EXPECT_TRUE(network.vehicles()[0].heard.empty());  // who speaks hears nothing
        if (network.got_through()) ++through;
    }
    EXPECT_NEAR(through, 7500, 220);  // five standard deviations
}

}  // namespace seautils::tdma
