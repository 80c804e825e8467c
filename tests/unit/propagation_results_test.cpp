// What is made of losses and arrivals: smoothing, and the spread of delays.
#include "seautils/propagation/smooth.hpp"
#include "seautils/propagation/spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace seautils::propagation {

namespace {

Field field_of(std::size_t depths, std::size_t ranges, std::vector<float> loss_db) {
    Field f;
    f.depths = depths;
    f.ranges = ranges;
    f.loss_db = std::move(loss_db);
    return f;
}

Arrival path(double intensity, double delay_s) {
    Arrival a;
    a.amplitude = std::sqrt(intensity);
    a.delay_s = delay_s;
    return a;
}

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr float silent = std::numeric_limits<float>::infinity();

}  // namespace

TEST(Smooth, MeanOfIntensities) {
    Field f = field_of(1, 4, {60, 70, 80, 90});
    smooth(f, 1, 3);
    // -10 lg of (1e-6 + 1e-7) / 2, (1e-6 + 1e-7 + 1e-8) / 3, …
    EXPECT_NEAR(f.loss_db[0], 62.5964, 1e-4);
    EXPECT_NEAR(f.loss_db[1], 64.3180, 1e-4);
    EXPECT_NEAR(f.loss_db[2], 74.3180, 1e-4);
    EXPECT_NEAR(f.loss_db[3], 82.5964, 1e-4);
}

TEST(Smooth, CellsWithoutValueKeepNoneAndDoNotCount) {
    Field f = field_of(2, 2, {60, none, silent, silent});
    smooth(f, 3, 1);
    EXPECT_NEAR(f.loss_db[0], 60 + 3.0103, 1e-4);
    EXPECT_TRUE(std::isnan(f.loss_db[1]));
    EXPECT_NEAR(f.loss_db[2], 60 + 3.0103, 1e-4);
    EXPECT_EQ(f.loss_db[3], silent);
}

TEST(Smooth, AnEvenFieldStays) {
    Field f = field_of(7, 12, std::vector<float>(84, 77.25F));
    smooth(f, 5, 9);
    for (const float loss : f.loss_db) EXPECT_NEAR(loss, 77.25F, 1e-4);
}

TEST(Spread, CheckValues) {
    const std::vector<Arrival> paths{path(1, 10), path(0.5, 10.005), path(0.1, 10.020)};
    const Spread s = spread_of(paths);
    EXPECT_NEAR(s.mean_delay_s, 2.8125e-3, 1e-9);
    EXPECT_NEAR(s.rms_delay_s, 4.990225e-3, 1e-9);
    EXPECT_NEAR(s.peak_to_mean_db, 10 * std::log10(3 / 1.6), 1e-9);
    EXPECT_EQ(s.within_20db, 3U);
    EXPECT_NEAR(s.span_20db_s, 0.020, 1e-12);
}

TEST(Spread, AbsorptionCountsAndOrderDoesNot) {
    std::vector<Arrival> paths{path(1, 2), path(1, 1), path(1, 4)};
    paths[2].absorption_db = 15;
    const Spread s = spread_of(paths);
    EXPECT_NEAR(s.span_10db_s, 1, 1e-12);
    EXPECT_NEAR(s.span_20db_s, 3, 1e-12);
    EXPECT_NEAR(s.mean_delay_s, (1 + 3 * std::pow(10, -1.5)) / (2 + std::pow(10, -1.5)), 1e-12);
}

TEST(Spread, OnePathHasNone) {
    const Spread s = spread_of(std::vector<Arrival>{path(1e-8, 3)});
    EXPECT_EQ(s.rms_delay_s, 0);
    EXPECT_EQ(s.mean_delay_s, 0);
    EXPECT_EQ(s.peak_to_mean_db, 0);
    EXPECT_EQ(s.within_20db, 1U);
    EXPECT_EQ(s.span_20db_s, 0);
}

}  // namespace seautils::propagation
