// Ambient noise, critical depth, and the sonar equation.
#include "seautils/propagation/noise.hpp"

#include <gtest/gtest.h>

namespace seautils::propagation {

TEST(Noise, CheckValues) {
    EXPECT_NEAR(ambient_noise_db(100, 0.5, 5), 67.79, 0.005);
    EXPECT_NEAR(ambient_noise_db(1000, 0.5, 5), 60.95, 0.005);
    EXPECT_NEAR(ambient_noise_db(25120, 0.5, 5), 38.51, 0.005);
    EXPECT_NEAR(ambient_noise_db(25120, 0.5, 10), 45.44, 0.005);
    EXPECT_NEAR(ambient_noise_db(100e3, 0.5, 5), 28.94, 0.005);
    EXPECT_NEAR(wind_of_beaufort_mps(2), 2.36, 0.005);
    EXPECT_NEAR(wind_of_beaufort_mps(3), 4.34, 0.005);
}

TEST(Noise, CriticalDepth) {
    // the surface layer's 1524.4 m/s again: 0.6 of 8.6 m/s above 4000 m
    const std::vector<SpeedPoint> pacific{
        {0, 1524}, {40, 1524.4}, {800, 1480.5}, {4000, 1523.8}, {4500, 1532.4}};
    EXPECT_NEAR(critical_depth_m(pacific).value(), 4000 + 500 * 0.6 / 8.6, 1e-9);
    EXPECT_FALSE(critical_depth_m({{0, 1530}, {50, 1500}, {100, 1510}}).has_value());
    EXPECT_FALSE(critical_depth_m({{0, 1500}}).has_value());
    EXPECT_FALSE(critical_depth_m({{0, 1530}, {100, 1500}}).has_value());
}

TEST(Noise, OverDepthAndInABand) {
    SonarLevels levels;
    levels.noise_db = 50;
    levels.bandwidth_hz = 1000;
    EXPECT_DOUBLE_EQ(noise_in_band_db(levels, 5000), 80);
    levels.fades_below_m = 4000;
    EXPECT_DOUBLE_EQ(noise_in_band_db(levels, 3000), 80);
    EXPECT_DOUBLE_EQ(noise_in_band_db(levels, 5000), 77);
    levels.fades_below_m.reset();
    levels.noise_depth_m = {10, 20};
    levels.noise_at_depth_db = {60, 40};
    EXPECT_DOUBLE_EQ(noise_in_band_db(levels, 0), 90);
    EXPECT_DOUBLE_EQ(noise_in_band_db(levels, 15), 80);
    EXPECT_DOUBLE_EQ(noise_in_band_db(levels, 99), 70);
}

TEST(Noise, SonarEquation) {
    const SonarLevels levels{.source_level_db = 190,
                             .bandwidth_hz = 100,
                             .noise_db = 40,
                             .array_gain_db = 3,
                             .fades_below_m = {},
                             .noise_depth_m = {},
                             .noise_at_depth_db = {}};
    EXPECT_DOUBLE_EQ(signal_to_noise_db(levels, 90, 50), 190 - 90 - 60 + 3);
}

}  // namespace seautils::propagation
