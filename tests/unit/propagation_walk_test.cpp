// Rays leg by leg: those that go back by the mirror images of the legs they came by.
#include "propagation_seas.hpp"

#include "seautils/propagation/ray_beam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace seautils::propagation {
namespace {

std::vector<BeamState> states(const RaySea& sea, double launch_rad, double stop_m) {
    std::vector<BeamState> out;
    BeamWalk walk(sea, 2000);
    walk.run<BeamState>(launch_rad, stop_m, 1e-6, [&](const Leg& leg, const BeamState& state) {
        EXPECT_NEAR(leg.part(leg.whole.along_m).down_m, leg.whole.down_m, 1e-6);
        EXPECT_NEAR(leg.part(leg.whole.along_m).sine, leg.whole.sine, 1e-9);
        out.push_back(state);
        return true;
    });
    return out;
}

/// Water of up to nine layers, and a source anywhere, also on a wall or an edge.
Environment water(std::mt19937& dice) {
    const auto real = [&](double from, double to) {
        return std::uniform_real_distribution(from, to)(dice);
    };
    Environment e = pekeris();
    e.water.profile = {{0, real(1480, 1520)}};
    const int edges = static_cast<int>(dice() % 9);
    for (int k = 1; k <= edges; ++k)
        e.water.profile.push_back({k * 100.0 / (edges + 1), real(1480, 1520)});
    e.water.profile.push_back({100, real(1480, 1520)});
    const double depths_m[]{0, 100, e.water.profile[1].depth_m, real(0, 100), real(0, 100)};
    e.source.depth_m = depths_m[dice() % 5];
    e.surface.roughness_m = 0.05;
    return e;
}

TEST(Walk, BackByTheSameLegsIsWhereTracingLeads) {
    std::mt19937 dice(20261201);
    std::size_t legs = 0;
    for (int k = 0; k < 300; ++k) {
        std::vector<std::string> remarks;
        const RaySea mirrored = make_ray_sea(water(dice), remarks);
        ASSERT_TRUE(mirrored.periodic);
        RaySea traced = mirrored;
        traced.periodic = false;
        const double launch_rad = std::uniform_real_distribution(-1.4, 1.4)(dice);
        const auto a = states(mirrored, launch_rad, 2000), b = states(traced, launch_rad, 2000);
        ASSERT_EQ(a.size(), b.size()) << k;
        legs += a.size();
        for (std::size_t n = 0; n < a.size(); ++n) {
            const BeamState &x = a[n], &y = b[n];
            ASSERT_NEAR(x.range_m, y.range_m, 1e-6) << k << ' ' << n;
            ASSERT_NEAR(x.delay_s, y.delay_s, 1e-9) << k << ' ' << n;
            ASSERT_NEAR(x.length_m, y.length_m, 1e-6) << k << ' ' << n;
            ASSERT_NEAR(x.q, y.q, 1e-7 * (1e3 + std::abs(y.q))) << k << ' ' << n;
            ASSERT_NEAR(x.amplitude, y.amplitude, 1e-9) << k << ' ' << n;
            ASSERT_NEAR(x.phase_rad, y.phase_rad, 1e-6) << k << ' ' << n;
            ASSERT_EQ(x.surface_bounces, y.surface_bounces);
            ASSERT_EQ(x.bottom_bounces, y.bottom_bounces);
            ASSERT_EQ(x.caustics, y.caustics) << k << ' ' << n;
        }
    }
    EXPECT_GT(legs, 10'000U);
}

}  // namespace
}  // namespace seautils::propagation
