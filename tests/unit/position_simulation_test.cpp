#include "position_link.hpp"

#include "seautils/position/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace seautils::position {
namespace {

constexpr std::size_t slots = 200'000;

// The cost of sending a packet until it is acknowledged is that of one over the chance that both
// come through; specs give 19.6, 27.5, 39.3, 68.8 and 137 bits for packets of 55, 15.9 … 111 for 256.
TEST(PositionSimulation, TheThesissArqCostsWhatItDoes) {
    for (const double p : {0.3, 0.5, 0.65, 0.8, 0.9}) {
        EXPECT_NEAR(simulate_arq(11.1, 55, {p, 0, 1}, slots).bits * (1 - p), 55 / 4.0, 0.2);
        EXPECT_NEAR(simulate_arq(11.1, 256, {p, 0, 1}, slots).bits * (1 - p), 256 / 23.0, 0.2);
    }
    EXPECT_NEAR(simulate_arq(11.1, 55, {0.5, 0.5, 1}, slots).bits * 0.25, 55 / 4.0, 0.2);
}

TEST(PositionSimulation, FullPositionsAreAsOldAsLossesAreLong) {
    for (const double p : {0.3, 0.5, 0.65, 0.8, 0.9}) {
        const LinkCost cost = simulate_full(55, {p, 0, 1}, slots);
        EXPECT_NEAR(cost.age, p / (1 - p), 0.03 / (1 - p));
        EXPECT_EQ(cost.bits, 55);
    }
}

TEST(PositionSimulation, FourDifferencesAPacketAreTooFewFromThreeQuartersOn) {
    EXPECT_TRUE(simulate_arq(11.1, 55, {0.65, 0, 1}, slots).is_stable);
    EXPECT_NEAR(simulate_arq(11.1, 55, {0.65, 0, 1}, slots).age, 3.6, 0.36);
    EXPECT_FALSE(simulate_arq(11.1, 55, {0.8, 0, 1}, slots).is_stable);
}

/// The newest position is as old as if full positions were sent; and nothing is ever wrong.
TEST(PositionSimulation, OursIsNoOlderThanFullPositions) {
    Walk walk(3);
    std::vector<Fix> track;
    for (int n = 0; n < 1500; ++n) track.push_back({1'714'521'600'000 + n * 10'000, walk.next()});
    for (const LinkMode mode : {LinkMode::history, LinkMode::newest, LinkMode::automatic}) {
        for (const double p : {0.0, 0.3, 0.65, 0.8}) {
            LinkOptions options;
            options.mode = mode;
            const Losses losses{p, 0, 5};
            const LinkReport report =
                simulate_link(track, options, LinearCodec(), LinearHorizon(), 64, losses);
            EXPECT_EQ(report.wrong, 0U);
            if (p == 0) {
                EXPECT_EQ(report.arrived, track.size());
            }
            // The same chances in the same order: no acknowledgement is lost where none can be.
            EXPECT_NEAR(report.cost.age, p / (1 - p), 0.25 * (p / (1 - p)) + 0.01);
        }
    }
}

TEST(PositionSimulation, LossesAreBelowOne) {
    EXPECT_THROW(simulate_full(55, {1, 0, 1}, 10), ConfigError);
    EXPECT_THROW(simulate_full(55, {std::nan(""), 0, 1}, 10), ConfigError);
    EXPECT_THROW(simulate_arq(60, 55, {0, 0, 1}, 10), ConfigError);
}

}  // namespace
}  // namespace seautils::position
