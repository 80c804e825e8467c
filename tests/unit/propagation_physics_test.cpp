// What the sea does to sound: absorption and reflection; and what an environment may say.
#include "propagation_seas.hpp"
#include "seautils/propagation/absorption.hpp"
#include "seautils/propagation/reflection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace seautils::propagation {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct AbsorptionRow {
    double khz, thorp67, thorp, fg[3], am[3];
};

/// Computed independently of the same papers.
constexpr AbsorptionRow rows[] = {
    {0.05, 0.00030, 0.00360, {0.00025, 0.00025, 0.00029}, {0.00025, 0.00025, 0.00030}},
    {0.3, 0.00999, 0.01338, {0.00857, 0.00856, 0.00960}, {0.00858, 0.00855, 0.00998}},
    {1, 0.06535, 0.06933, {0.06013, 0.06671, 0.05580}, {0.06132, 0.06809, 0.05859}},
    {3.5, 0.23142, 0.23974, {0.21046, 0.24049, 0.15640}, {0.21743, 0.25079, 0.16140}},
    {10, 1.14982, 1.18983, {0.96264, 0.94760, 0.66002}, {0.98657, 0.96936, 0.65937}},
    {25.12, 5.94376, 6.17107, {5.04061, 4.85972, 3.17637}, {5.15074, 4.93778, 3.13922}},
    {100, 31.13384, 34.31896, {33.63032, 39.12829, 15.87906}, {34.34102, 40.15823, 15.52827}},
};

TEST(PropagationAbsorption, IsAsItWasPrinted) {
    constexpr AbsorbingWater waters[] = {{10, 35, 8, 0}, {14, 38, 8.1, 50}, {4, 35, 8, 4000}};
    constexpr double digits = 0.5e-5 + 1e-9;
    for (const AbsorptionRow& row : rows) {
        const double hz = row.khz * 1000;
        EXPECT_NEAR(thorp_1967_db_per_km(hz), row.thorp67, digits);
        EXPECT_NEAR(thorp_db_per_km(hz), row.thorp, digits);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(francois_garrison_db_per_km(hz, waters[k]), row.fg[k], digits) << row.khz;
            EXPECT_NEAR(ainslie_mccolm_db_per_km(hz, waters[k]), row.am[k], digits) << row.khz;
        }
    }
}

TEST(PropagationAbsorption, SaysWhereItIsExtrapolated) {
    Absorption a;
    a.model = AbsorptionModel::francois_garrison;
    EXPECT_FALSE(absorption_rate(a, 25000).extrapolated);
    EXPECT_TRUE(absorption_rate(a, 100).extrapolated);
    a.depth_m = 4000;
    EXPECT_TRUE(absorption_rate(a, 25000).extrapolated);
    a.model = AbsorptionModel::ainslie_mccolm;
    EXPECT_FALSE(absorption_rate(a, 25000).extrapolated);
    a.model = AbsorptionModel::fixed;
    a.db_per_km = 2.5;
    EXPECT_EQ(absorption_db_per_km(a, 25000), 2.5);
    a.model = AbsorptionModel::none;
    EXPECT_EQ(absorption_db_per_km(a, 25000), 0);
}

std::complex<double> reflected(const Boundary& boundary, double grazing_deg) {
    return reflection_coefficient(boundary, 1000, grazing_deg * degree, 1500, 1);
}

TEST(PropagationReflection, OfAFluidIsAsComputedIndependently) {
    // These were computed with a complex wavenumber, ω/c (1 - i loss). Ours is the speed that is complex, as in the
    // Acoustics Toolbox, c (1 + i loss): the same medium where c is less by 1 + loss².
    const double loss = 0.5 / (2 * std::numbers::pi * db_per_neper);
    const Boundary bottom = half_space(1700 / (1 + loss * loss), 1.8, 0.5);
    const double values[][3] = {
        {1, .995732, 172.369}, {5, .979967, 142.581}, {10, .965424, 108.995}, {20, .945548, 55.573},
        {28, .826352, 11.975}, {30, .677049, 5.426},  {45, .413737, 1.469}};
    for (const auto& [deg, magnitude, phase_deg] : values) {
        EXPECT_NEAR(std::abs(reflected(bottom, deg)), magnitude, 1e-6) << deg;
        EXPECT_NEAR(std::arg(reflected(bottom, deg)) / degree, phase_deg, 1e-3) << deg;
    }
    EXPECT_NEAR(std::abs(reflected(bottom, 60)), .363914, 1e-6);
    EXPECT_NEAR(std::abs(reflected(bottom, 90)), .342117, 1e-6);
}

TEST(PropagationReflection, OfWaterIsNoneAndOfTheRestIsWhole) {
    EXPECT_NEAR(std::abs(reflected(half_space(1500, 1, 0), 20)), 0, 1e-12);
    EXPECT_EQ(reflected(Boundary(), 20), -1.0);
    Boundary rigid;
    rigid.kind = BoundaryKind::rigid;
    EXPECT_EQ(reflected(rigid, 20), 1.0);
    // Without loss all comes back below the critical angle, acos(1500/1700) = 28.07 degrees.
    EXPECT_NEAR(std::abs(reflected(half_space(1700, 1.8, 0), 28)), 1, 1e-12);
    EXPECT_LT(std::abs(reflected(half_space(1700, 1.8, 0), 29)), 0.9);
}

TEST(PropagationReflection, OfASolidTendsToThatOfAFluid) {
    Boundary solid = half_space(1700, 1.8, 0.5);
    const auto fluid = reflected(solid, 35);
    solid.shear_speed_mps = 0.5;
    EXPECT_NEAR(std::abs(reflected(solid, 35) - fluid), 0, 2e-3);
    // Straight down no shear is excited: the impedances alone count.
    solid = half_space(3000, 2.2, 0);
    solid.shear_speed_mps = 1400;
    EXPECT_NEAR(reflected(solid, 90).real(), (3000 * 2.2 - 1500) / (3000 * 2.2 + 1500), 1e-9);
    // Shear carries energy away below the critical angle of compression, 60 degrees.
    EXPECT_LT(std::abs(reflected(solid, 45)), 1 - 1e-3);
    EXPECT_NEAR(std::abs(reflected(half_space(3000, 2.2, 0), 45)), 1, 1e-12);
    solid.shear_speed_mps = 1800;
    EXPECT_LT(std::abs(reflected(solid, 40)), 0.99);
}

TEST(PropagationReflection, OfATableIsLinearInAngleAndPhase) {
    Boundary b;
    b.kind = BoundaryKind::table;
    b.table = {{10, 0.5, 350}, {20, 0.7, 370}, {40, 0.1, 370}};
    EXPECT_NEAR(std::abs(reflected(b, 15) - std::polar(0.6, 0.0)), 0, 1e-12);
    EXPECT_NEAR(std::abs(reflected(b, 10) - std::polar(0.5, -10 * degree)), 0, 1e-9);
    EXPECT_NEAR(std::abs(reflected(b, 39.999)), 0.1, 1e-3);
    EXPECT_EQ(reflected(b, 9), 0.0);
    EXPECT_EQ(reflected(b, 41), 0.0);
}

TEST(PropagationReflection, OfARoughBoundaryIsLess) {
    Boundary rough;
    rough.roughness_m = 0.1;
    // 2 (k sigma sin)^2, k = 2 pi 1000 / 1500.
    const double rayleigh = 2 * std::numbers::pi * 1000 / 1500 * 0.1 * 0.5;
    EXPECT_NEAR(reflected(rough, 30).real(), -std::exp(-2 * rayleigh * rayleigh), 1e-12);
}

TEST(PropagationReflection, GrainSizesAreThoseOfTheRegressions) {
    // By hand: 0.002709 - 0.056452 + 1.2778 has its neighbour's value at 1 within a thousandth.
    EXPECT_NEAR(grain_half_space(0.999999, 1500, 1).sound_speed_mps / 1500,
                grain_half_space(1, 1500, 1).sound_speed_mps / 1500, 2e-3);
    const Boundary sand = grain_half_space(0, 1500, 1.025);
    EXPECT_NEAR(sand.sound_speed_mps, 1.2778 * 1500, 1e-9);
    EXPECT_NEAR(sand.density_gcm3, 2.3139 * 1.025, 1e-9);
    EXPECT_NEAR(sand.attenuation_db_per_wavelength, 0.4556 * 1.2778 * 1.5, 1e-9);
    EXPECT_NEAR(grain_half_space(9, 1500, 1).sound_speed_mps, (1.0019 - 9 * 0.0024324) * 1500,
                1e-9);
    EXPECT_THROW(grain_half_space(9.5, 1500, 1), DataError);
    EXPECT_THROW(grain_half_space(std::nan(""), 1500, 1), DataError);
}

Environment shelf() {
    Environment e;
    e.frequency_hz = 25000;
    e.source.depth_m = 30;
    e.receivers = {{10, 20}, {100, 200}};
    e.water.profile = {{0, 1500}, {100, 1490}};
    e.bottom.kind = BoundaryKind::half_space;
    e.bottom_depth_m = 100;
    return e;
}

TEST(PropagationEnvironment, WhatMeansSomethingIsAccepted) {
    EXPECT_EQ(refusal(shelf(), [](Environment&) {}), "accepted");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.source.depth_m = 100; }), "accepted");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.water.profile.resize(1); }), "accepted");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.receivers.range_m = {0}; }), "accepted");
}

TEST(PropagationEnvironment, NonsenseIsRefusedByName) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.frequency_hz = 0; }),
              "frequency_hz 0 is outside 0.1 to 10000000 Hz");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.source.depth_m = 101; }),
              "source.depth_m 101 is outside 0 to 100 m");
    EXPECT_EQ(refusal(shelf(), [&](Environment& e) { e.water.profile[1].sound_speed_mps = nan; }),
              "water.profile[1].sound_speed_mps nan is outside 100 to 10000 m/s");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.water.profile[1].depth_m = 0; }),
              "water.profile[1].depth_m 0 is not more than the 0 before it");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.water.profile.clear(); }),
              "water.profile has 0 values, less than 1");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.receivers.range_m.clear(); }),
              "receivers.range_m has 0 values, less than 1");
    EXPECT_EQ(refusal(shelf(),
                      [](Environment& e) {
                          e.receivers.range_m = {5, 5};
                      }),
              "receivers.range_m[1] 5 is not more than the 5 before it");
    EXPECT_EQ(refusal(shelf(),
                      [](Environment& e) {
                          e.bottom_line = Line{false, {0, 1000}, {100}};
                      }),
              "bottom_line.depth_m has 1 values, not the 2 of bottom_line.range_m");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.bottom_depth_m = 0; }),
              "bottom_depth_m 0 leaves no water at the source");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.bottom.density_gcm3 = 0; }),
              "bottom.density_gcm3 0 is outside 0.001 to 20 g/cm3");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.fan.most_deg = -80; }),
              "fan.most_deg -80 is not more than fan.least_deg -80");
    EXPECT_EQ(refusal(shelf(),
                      [](Environment& e) {
                          e.water.mesh = SpeedMesh{{0, 10}, {0}, {1500}};
                      }),
              "water.mesh.sound_speed_mps has 1 values, not the 2 of 1 depths and 2 ranges");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.bottom.kind = BoundaryKind::table; }),
              "bottom.table has 0 values, less than 1");
    EXPECT_EQ(refusal(shelf(),
                      [](Environment& e) {
                          e.receivers.depth_m.resize(10000);
                          e.receivers.range_m.resize(10000);
                      }),
              "10000 depths at 10000 ranges are more than 20000000 receivers");
}

TEST(PropagationEnvironment, ALineIsStraightBetweenItsPointsAndFlatBeyond) {
    Environment e = shelf();
    EXPECT_TRUE(is_range_independent(e));
    e.bottom_line = Line{false, {0, 1000}, {100, 20}};
    EXPECT_EQ(bottom_depth_m(e, -5), 100);
    EXPECT_EQ(bottom_depth_m(e, 250), 80);
    EXPECT_EQ(bottom_depth_m(e, 1000), 20);
    EXPECT_EQ(bottom_depth_m(e, 1e6), 20);
    EXPECT_FALSE(is_range_independent(e));
    e.bottom_line->depth_m = {100, 100};
    EXPECT_TRUE(is_range_independent(e));
}

}  // namespace
}  // namespace seautils::propagation
