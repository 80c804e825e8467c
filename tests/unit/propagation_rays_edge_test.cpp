// Worlds at the edge of sense: rays answer, or refuse by name, and soon.
#include "seautils/core/error.hpp"
#include "seautils/propagation/rays.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace seautils::propagation {
namespace {

Environment shelf() {
    Environment sea;
    sea.frequency_hz = 3000;
    sea.source.depth_m = 25;
    sea.receivers = {{1, 40, 99}, {10, 500, 2000}};
    sea.water.profile = {{0, 1520}, {30, 1505}, {100, 1510}};
    sea.bottom = {BoundaryKind::half_space, 1650, 0, 1.8, 0.8, 0, 0, {}};
    sea.bottom_depth_m = 100;
    return sea;
}

/// A field and arrivals within the time; loss is no less than in free space, but for foci.
void expect_sense(const Environment& sea, double most_s = 30) {
    const auto start = std::chrono::steady_clock::now();
    for (const Sum sum : {Sum::incoherent, Sum::semi_coherent, Sum::coherent}) {
        FieldOptions options;
        options.sum = sum;
        options.beam = sum == Sum::semi_coherent ? Beam::hat : Beam::gaussian;
        const auto field = ray_field(sea, options);
        ASSERT_EQ(field.loss_db.size(),
                  sea.receivers.depth_m.size() * sea.receivers.range_m.size());
        for (const float loss_db : field.loss_db)
            EXPECT_TRUE(std::isnan(loss_db) || loss_db > -20) << loss_db;
    }
    Environment near = sea;
    near.receivers.range_m.resize(1);
    for (const auto& receiver : ray_arrivals(near, {}))
        for (const auto& path : receiver.arrivals) {
            EXPECT_TRUE(std::isfinite(path.amplitude) && path.amplitude > 0);
            EXPECT_TRUE(std::isfinite(path.delay_s) && path.delay_s > 0);
        }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_LT(took.count(), most_s);
}

/// How many cells have a finite loss.
std::size_t heard(const Environment& sea) {
    std::size_t n = 0;
    for (const float loss_db : ray_field(sea, {}).loss_db) n += std::isfinite(loss_db);
    return n;
}

TEST(RaysAtTheEdge, SourceOnTheBottomAndOnTheSurface) {
    auto sea = shelf();
    for (const double depth_m : {0., 100.}) {
        sea.source.depth_m = depth_m;
        expect_sense(sea);
        EXPECT_EQ(heard(sea), 9U);
    }
    sea.bottom_line = Line{false, {-100, 0, 1000}, {100, 100, 90}};
    expect_sense(sea);
    EXPECT_GT(heard(sea), 5U);
}

TEST(RaysAtTheEdge, SinglePointAndIsovelocity) {
    auto sea = shelf();
    for (const auto interpolation : {SpeedInterpolation::c_linear, SpeedInterpolation::n2_linear,
                                     SpeedInterpolation::pchip, SpeedInterpolation::spline})
        for (const auto& profile : {std::vector<SpeedPoint>{{50, 1500}},
                                    std::vector<SpeedPoint>{{0, 1500}, {100, 1500}}}) {
            sea.water.interpolation = interpolation;
            sea.water.profile = profile;
            expect_sense(sea);
            EXPECT_EQ(heard(sea), 9U);
        }
}

TEST(RaysAtTheEdge, GradientChangesSignAtEachMetre) {
    auto sea = shelf();
    sea.water.profile.clear();
    for (int k = 0; k <= 100; ++k) sea.water.profile.push_back({1. * k, k % 2 ? 1499. : 1501.});
    expect_sense(sea);
    EXPECT_EQ(heard(sea), 9U);
}

TEST(RaysAtTheEdge, SourceInTheAxisOfASharpDuct) {
    auto sea = shelf();
    sea.source.depth_m = 50;
    sea.water.profile = {{0, 1550}, {50, 1450}, {100, 1550}};
    sea.fan = {-30, 30, 101};  // one ray is quite flat
    expect_sense(sea);
    EXPECT_GT(heard(sea), 6U);
}

TEST(RaysAtTheEdge, ProfileOfAMillionPoints) {
    auto sea = shelf();
    sea.water.profile.clear();
    for (int k = 0; k <= 1'000'000; ++k)
        sea.water.profile.push_back({1e-4 * k, 1500 + 5e-5 * (k % 1000)});
    sea.receivers = {{40}, {1000}};
    sea.fan.beams = 100;
    expect_sense(sea);
    const auto field = ray_field(sea, {});
    ASSERT_EQ(field.basis.remarks.size(), 1U);
    EXPECT_NE(field.basis.remarks[0].find("averaged"), std::string::npos);
}

TEST(RaysAtTheEdge, BathymetryThatSurfaces) {
    auto sea = shelf();
    sea.bottom_line = Line{false, {0, 1000, 1500, 3000}, {100, -5, -5, 100}};
    expect_sense(sea);
    const auto field = ray_field(sea, {});
    EXPECT_TRUE(std::isfinite(field.loss_db[3]));  // 10 m off, 40 m deep
    EXPECT_EQ(heard(sea), 4U);                     // nothing behind the island
    sea.bottom.kind = BoundaryKind::rigid;         // and nothing lost in the wedge
    expect_sense(sea);
}

TEST(RaysAtTheEdge, SawtoothSeamountAndWaves) {
    auto sea = shelf();
    sea.bottom_line.emplace();
    for (int k = 0; k < 400; ++k) {
        sea.bottom_line->range_m.push_back(10. * k);
        sea.bottom_line->depth_m.push_back(k % 2 ? 60 : 100);
    }
    sea.surface_line = Line{true, {0, 20, 45, 60, 90, 2000}, {0.5, -1, 2, -2, 1, 0}};
    expect_sense(sea);
    EXPECT_GT(heard(sea), 5U);
}

TEST(RaysAtTheEdge, LongWavesAndShortOnes) {
    auto sea = shelf();
    for (const double frequency_hz : {0.1, 1., 1e6, 1e7}) {
        sea.frequency_hz = frequency_hz;
        sea.receivers.range_m = {10, 50};
        expect_sense(sea);
    }
}

TEST(RaysAtTheEdge, LongRangeOverLittleWater) {
    auto sea = shelf();
    sea.bottom.kind = BoundaryKind::rigid;  // nothing is lost, however often it bounces
    sea.receivers.range_m = {10, 1e6};
    sea.fan = {-80, 80, 100};
    EXPECT_EQ(heard(sea), 6U);
    EXPECT_THROW(ray_arrivals(sea, {}), DataError);
    sea.water.profile.clear();
    for (int k = 0; k <= 100; ++k) sea.water.profile.push_back({1. * k, 1500 - 0.1 * k});
    const auto field = ray_field(sea, {});
    ASSERT_EQ(field.basis.remarks.size(), 1U);
    EXPECT_NE(field.basis.remarks[0].find("rays ended after 200000 legs"), std::string::npos);
}

TEST(RaysAtTheEdge, FanBehindAndSteeperThanUp) {
    auto sea = shelf();
    sea.fan = {-180, 180, 361};
    expect_sense(sea);
    sea.fan = {-90, 90, 0};
    expect_sense(sea);
    sea.fan = {3, 3.001, 1};
    expect_sense(sea);
}

TEST(RaysAtTheEdge, MeshThatTwists) {
    auto sea = shelf();
    sea.water.mesh = SpeedMesh{
        {0, 500, 1000}, {0, 20, 60}, {1480, 1540, 1480, 1540, 1480, 1540, 1480, 1540, 1480}};
    expect_sense(sea);
    EXPECT_GT(heard(sea), 6U);
}

TEST(RaysAtTheEdge, ReceiversOutOfTheWaterOrAtRangeZeroAlone) {
    auto sea = shelf();
    sea.receivers = {{-5, 200}, {0}};
    expect_sense(sea);
    EXPECT_EQ(heard(sea), 0U);
}

TEST(RaysAtTheEdge, NonsenseIsRefusedByName) {
    const auto refused = [](const char* name, const std::function<void(Environment&)>& change) {
        auto sea = shelf();
        change(sea);
        try {
            ray_field(sea, {});
            ADD_FAILURE() << name;
        } catch (const DataError& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
        EXPECT_THROW(ray_arrivals(sea, {}), DataError);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refused("frequency_hz", [&](Environment& sea) { sea.frequency_hz = nan; });
    refused("source.depth_m", [](Environment& sea) { sea.source.depth_m = 101; });
    refused("water.profile[1]", [](Environment& sea) { sea.water.profile[1].depth_m = 0; });
    refused("bottom_line", [](Environment& sea) { sea.bottom_line = Line{false, {0, 1}, {9}}; });
}

}  // namespace
}  // namespace seautils::propagation
