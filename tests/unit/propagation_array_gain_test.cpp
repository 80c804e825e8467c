// What an array gains, against what is known of simple ones.
#include "seautils/propagation/array_gain.hpp"

#include "seautils/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace seautils::propagation {
namespace {

VerticalArray line(int n, double spacing_m) {
    VerticalArray array;
    for (int k = 0; k < n; ++k) array.depth_m.push_back(50 + k * spacing_m);
    return array;
}

Arrival from(double elevation_deg) {
    Arrival a;
    a.amplitude = 1e-3;
    a.arrival_deg = elevation_deg;
    return a;
}

TEST(PropagationArrayGain, IsItsNumberHalfAWavelengthApartInNoiseFromEverywhere) {
    // 1500 Hz in 1500 m/s: a wavelength of 1 m. The pairs' sums over sin(elevation) vanish.
    for (const int n : {1, 2, 8, 32})
        for (const double steered_deg : {0.0, 20.0, -60.0}) {
            VerticalArray array = line(n, 0.5);
            array.steered_deg = steered_deg;
            const Arrival one[]{from(steered_deg)};
            EXPECT_NEAR(array_gain_db(array, 1500, 1500, one, {}), 10 * std::log10(n), 1e-3)
                << n << ' ' << steered_deg;
        }
}

TEST(PropagationArrayGain, IsNoneWhereNoiseComesAsTheSignalDoes) {
    const NoiseRow narrow[]{{9.5, 0}, {10, 1}, {10.5, 0}};
    const Arrival one[]{from(10)};
    EXPECT_NEAR(array_gain_db(line(8, 0.5), 1500, 1500, one, narrow), 0, 0.05);
}

TEST(PropagationArrayGain, ListensWhereItIsSteered) {
    const VerticalArray array = line(10, 0.5);
    EXPECT_DOUBLE_EQ(array_response(array, 1500, 1500, 0), 1);
    // The first zero of ten: sin = 1 / (10 * 0.5).
    EXPECT_NEAR(array_response(array, 1500, 1500, std::asin(0.2) * 180 / 3.14159265358979), 0,
                1e-20);
    const Arrival both[]{from(0), from(std::asin(0.2) * 180 / 3.14159265358979)};
    EXPECT_NEAR(array_gain_db(array, 1500, 1500, both, {}), 10 - 10 * std::log10(2), 1e-3);
}

TEST(PropagationArrayGain, NeedsSomethingToHear) {
    const Arrival one[]{from(0)};
    Arrival silent[]{from(0)};
    silent[0].amplitude = 0;
    const NoiseRow quiet[]{{0, 0}};
    EXPECT_THROW(array_gain_db({}, 1500, 1500, one, {}), DataError);
    EXPECT_THROW(array_gain_db(line(2, 0.5), 1500, 1500, {}, {}), DataError);
    EXPECT_THROW(array_gain_db(line(2, 0.5), 1500, 1500, silent, {}), DataError);
    EXPECT_THROW(array_gain_db(line(2, 0.5), 1500, 1500, one, quiet), DataError);
    EXPECT_THROW(array_gain_db(line(2, 0.5), 0, 1500, one, {}), DataError);
}

}  // namespace
}  // namespace seautils::propagation
