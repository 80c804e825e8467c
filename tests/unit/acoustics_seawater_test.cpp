// Depth, pressure and salinity against published check values, and back again.
#include "seautils/acoustics/seawater.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace seautils::acoustics {
namespace {

double within(double least, double most) {
    return least + (most - least) * *rc::gen::inRange(0, 1001) / 1000;
}

}  // namespace

TEST(Seawater, DepthIsThatOfUnesco44) {
    EXPECT_NEAR(depth_at_pressure_m(10000, 30), 9712.653, 0.0005);
    EXPECT_EQ(depth_at_pressure_m(0, 30), 0);
    // The table of algorithm 4: pressure down, latitude across.
    EXPECT_NEAR(depth_at_pressure_m(500, 0), 496.65, 0.005);
}

TEST(Seawater, DepthAndPressureAreInverseAndGrow) {
    EXPECT_TRUE(rc::check("inverse", [] {
        const double latitude = within(-90, 90), p = within(-10, 12000);
        const double z = depth_at_pressure_m(p, latitude);
        RC_ASSERT(std::fabs(pressure_at_depth_dbar(z, latitude) - p) < 1e-9);
        RC_ASSERT(depth_at_pressure_m(p + 0.01, latitude) > z);
        RC_ASSERT(std::fabs(depth_at_pressure_m(p, -latitude) - z) < 1e-9);
    }));
}

TEST(Seawater, PressureIsThatOfLeroyAndParthiot) {
    EXPECT_NEAR(leroy_parthiot_open_ocean_dbar(5000, 45), 5096.951, 0.0005);
    EXPECT_NEAR(leroy_parthiot_standard_dbar(5000, 45), 5101.031, 0.0005);
    EXPECT_EQ(leroy_parthiot_open_ocean_dbar(0, 45), 0);
}

TEST(Seawater, PressureIsThatOfSaunders) {
    EXPECT_NEAR(saunders_pressure_dbar(7321.45, 30), 7500.007, 0.0005);
    EXPECT_TRUE(rc::check("inverse", [] {
        const double latitude = within(-90, 90), p = within(0, 11000);
        RC_ASSERT(std::fabs(saunders_pressure_dbar(saunders_depth_m(p, latitude), latitude) - p) <
                  1e-6);
    }));
}

// Three authors, one ocean: within 0.5 dbar, and 0.05 %.
TEST(Seawater, TheThreeAgree) {
    EXPECT_TRUE(rc::check("agree", [] {
        const double latitude = within(-90, 90), z = within(0, 8000);
        const double p = pressure_at_depth_dbar(z, latitude);
        RC_ASSERT(std::fabs(leroy_parthiot_standard_dbar(z, latitude) - p) < 0.5);
        RC_ASSERT(std::fabs(saunders_pressure_dbar(z, latitude) - p) <= 5e-4 * p);
    }));
}

TEST(Seawater, SalinityIsThatOfPss78) {
    EXPECT_NEAR(practical_salinity_of_ratio(1, 15, 0), 35, 5e-7);
    EXPECT_NEAR(practical_salinity_of_ratio(1.2, 20, 2000), 37.245628, 5e-7);
    EXPECT_NEAR(practical_salinity_of_ratio(0.65, 5, 1500), 27.995347, 5e-7);
    EXPECT_NEAR(practical_salinity(4.2914, to_its_90_c(15), 0), 35, 5e-7);
    EXPECT_EQ(practical_salinity(0, 15, 0), 0);
    EXPECT_EQ(practical_salinity(-1, 15, 0), 0);
    EXPECT_EQ(practical_salinity(std::nan(""), 15, 0), 0);
}

TEST(Seawater, SalinityAndConductivityAreInverseAndGrow) {
    EXPECT_TRUE(rc::check("inverse", [] {
        const double s = within(2, 42), t = within(-2, 35), p = within(0, 10000);
        const double c = conductivity_spm(s, t, p);
        RC_ASSERT(std::fabs(practical_salinity(c, t, p) - s) < 1e-8);
        RC_ASSERT(practical_salinity(c * 1.001, t, p) > s);
    }));
}

TEST(Seawater, ScalesOfTemperature) {
    EXPECT_DOUBLE_EQ(to_ipts_68_c(25), 25.006);
    EXPECT_DOUBLE_EQ(to_its_90_c(to_ipts_68_c(17.3)), 17.3);
}

}  // namespace seautils::acoustics
