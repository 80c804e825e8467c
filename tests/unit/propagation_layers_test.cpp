// Profiles as rays see them: straight between points.
#include "seautils/propagation/ray_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace seautils::propagation;

namespace {

using Profile = std::vector<SpeedPoint>;

double straight_mps(const Profile& profile, double depth_m) {
    std::size_t k = 1;
    while (k + 1 < profile.size() && profile[k].depth_m < depth_m) ++k;
    const SpeedPoint &a = profile[k - 1], &b = profile[k];
    const double part = (depth_m - a.depth_m) / (b.depth_m - a.depth_m);
    return a.sound_speed_mps + part * (b.sound_speed_mps - a.sound_speed_mps);
}

double n2_linear_mps(const Profile& profile, double depth_m) {
    Profile slow = profile;
    for (auto& p : slow) p.sound_speed_mps = 1 / (p.sound_speed_mps * p.sound_speed_mps);
    return 1 / std::sqrt(straight_mps(slow, depth_m));
}

const Profile shelf{{0, 1535}, {8, 1534.8}, {17, 1525}, {30, 1511.6}, {60, 1509.2}, {110, 1509.9}};
const Profile deep{{0, 1524},     {100, 1516.5}, {300, 1494},
                   {800, 1480.5}, {3000, 1507},  {6000, 1559}};

/// What a mean over many depths of a layer is off, and the most that one of them is.
struct Off {
    double mean_mps = 0, most_mps = 0;
};
Off off(const Profile& profile, const Profile& layers, std::size_t k) {
    Off out;
    constexpr int steps = 2000;
    const double top_m = profile[k].depth_m, height_m = profile[k + 1].depth_m - top_m;
    for (int j = 0; j < steps; ++j) {
        const double depth_m = top_m + height_m * (j + 0.5) / steps;
        const double d = straight_mps(layers, depth_m) - n2_linear_mps(profile, depth_m);
        out.mean_mps += d / steps;
        out.most_mps = std::max(out.most_mps, std::abs(d));
    }
    return out;
}

TEST(RayLayers, AreAsFastOnAverageAsTheCurve) {
    for (const auto& [profile, most_mps] : {std::pair(shelf, 0.5e-3), std::pair(deep, 2.5e-3)}) {
        std::vector<std::string> remarks;
        const Profile layers = linear_profile(profile, SpeedInterpolation::n2_linear, remarks);
        EXPECT_TRUE(remarks.empty());
        for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
            const Off o = off(profile, layers, k);
            EXPECT_LE(o.most_mps, most_mps) << profile[k].depth_m;
            EXPECT_LE(std::abs(o.mean_mps), most_mps / 5) << profile[k].depth_m;
        }
    }
}

TEST(RayLayers, AreNoMoreThanTheCurveNeeds) {
    std::vector<std::string> remarks;
    for (const auto interpolation :
         {SpeedInterpolation::n2_linear, SpeedInterpolation::pchip, SpeedInterpolation::spline})
        EXPECT_LT(linear_profile(deep, interpolation, remarks).size(), 400U);
    const Profile even{{0, 1500}, {100, 1500}, {5000, 1500}};
    EXPECT_EQ(linear_profile(even, SpeedInterpolation::spline, remarks).size(), 3U);
    EXPECT_EQ(linear_profile(shelf, SpeedInterpolation::c_linear, remarks).size(), shelf.size());
}

}  // namespace
