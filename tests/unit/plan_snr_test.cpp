// MaxSNRDepth: noise, gain, the forecast, its low-pass, and the two rules.
#include "seautils/plan/max_snr_depth.hpp"

#include "plan_grids.hpp"

#include "seautils/core/error.hpp"
#include "seautils/plan/motion.hpp"
#include "seautils/plan/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace seautils::plan {
namespace {

const auto nothing = [](double) { return 0.0; };

TEST(Noise, FallsBelowTheCriticalDepth) {
    const NoiseProfile noise{.level_db = 60, .critical_depth_m = 4000};
    EXPECT_EQ(noise.at_db(0), 60);
    EXPECT_EQ(noise.at_db(4000), 60);
    EXPECT_DOUBLE_EQ(noise.at_db(5500), 55.5);
    EXPECT_EQ(NoiseProfile{.level_db = 50}.at_db(6000), 50);
}

TEST(Noise, ArrayGainIsWhatThePatternLeavesOfEach) {
    ArrayInput in{.intensity = {1, 0.5},
                  .signal_pattern = {1, 1},
                  .noise_deg = {},
                  .noise_intensity = {},
                  .noise_pattern = {}};
    for (int k = -90; k <= 90; ++k) {
        in.noise_deg.push_back(k);
        in.noise_intensity.push_back(1);
        in.noise_pattern.push_back(1);
    }
    EXPECT_NEAR(array_gain_db(in), 0, 1e-12) << "an omnidirectional one gains nothing";
    // b = 1 within 30 degrees: ∫ cos over it is half of that over all
    for (std::size_t k = 0; k < in.noise_deg.size(); ++k)
        in.noise_pattern[k] = std::abs(in.noise_deg[k]) <= 30 ? 1 : 0;
    EXPECT_NEAR(array_gain_db(in), 10 * std::log10(2), 0.08);
    in.signal_pattern = {1, 0};
    EXPECT_NEAR(array_gain_db(in), 10 * std::log10(2) + 10 * std::log10(1 / 1.5), 0.08);
}

TEST(LowPass, IsTwoPolesFromTheSurfaceDown) {
    const std::vector<double> z{0, 50, 100};
    std::vector<double> x{0, 1, 1};
    low_pass_down(z, x, 50);
    EXPECT_DOUBLE_EQ(x[1], 0.5);
    EXPECT_DOUBLE_EQ(x[2], 0.75);
    std::vector<double> constant{3, not_known, 3};
    low_pass_down(z, constant, 50);
    EXPECT_EQ(constant[2], 3);
    EXPECT_TRUE(std::isnan(constant[1]));
}

/// A field in which the best depth lies on a slope: depth = 1000 + range / 10.
LossField ridge() {
    LossField f;
    for (int z = 0; z <= 5000; z += 50) f.depth_m.push_back(z);
    for (int r = 1000; r <= 40000; r += 500) f.range_m.push_back(r);
    for (const double z : f.depth_m)
        for (const double r : f.range_m)
            f.loss_db.push_back(static_cast<float>(80 + std::abs(z - 1000 - r / 10) / 100));
    return f;
}

SnrForecast forecast_snr(const LossField& field, double range_m, double range_rate_mps,
                         const std::function<double(double)>& noise_db,
                         const std::function<double(double)>& gain_db, const SnrOptions& options) {
    return plan::forecast_snr({&field, 1}, range_m, range_rate_mps, noise_db, gain_db, options);
}

SnrOptions plain() { return {.smoothing_m = 0}; }

TEST(Forecast, HasTheRangesAhead) {
    const SnrForecast f = forecast_snr(ridge(), 1000, 5, nothing, nothing, plain());
    ASSERT_EQ(f.time_s.size(), 61U);
    EXPECT_EQ(f.time_s.back(), 7200);
    EXPECT_EQ(f.range_m.back(), 37000);
    EXPECT_EQ(forecast_snr(ridge(), 38000, 5, nothing, nothing, plain()).time_s.back(), 360)
        << "as far as the field goes";
    const SnrForecast closing = forecast_snr(ridge(), 6000, -5, nothing, nothing, plain());
    EXPECT_EQ(closing.range_m.back(), 0);
    EXPECT_EQ(closing.time_s.size(), 61U);
}

TEST(Forecast, WeighsSignalNoiseAndGain) {
    SnrOptions o = plain();
    o.signal_weight = 2;
    o.noise_weight = 3;
    o.gain_weight = 4;
    const SnrForecast f = forecast_snr(
        ridge(), 10000, 0, [](double z) { return z / 100; }, [](double) { return 1.5; }, o);
    EXPECT_DOUBLE_EQ(f.snr_db[0][0], -2 * (80 + 20) - 0 + 6);
    EXPECT_DOUBLE_EQ(f.snr_db[0][40], -2 * 80 - 3 * 20 + 6);
    const Objective all = f.objective(0, {{0, 5000}});
    const Objective some = f.objective(0, {{0, 500}});
    EXPECT_EQ(*std::max_element(all.utility.begin(), all.utility.end()), 1);
    EXPECT_EQ(*std::min_element(all.utility.begin(), all.utility.end()), 0);
    EXPECT_EQ(some.utility[0], 1) << "the best of what is allowed";
    EXPECT_EQ(some.utility[10], 0);
}

TEST(Decide, FollowsWhereItIsGood) {
    const SnrOptions o = plain();
    const SnrForecast f = forecast_snr(ridge(), 10000, 5, nothing, nothing, o);
    const SnrDecision d = decide(f, {}, {.depth_m = 2000, .water_depth_m = {}}, 1.5, o);
    EXPECT_EQ(d.rule, SnrRule::follow);
    // three steps of 120 s hold 300 s: 1800 m on, the ridge is 180 m deeper, the grid's best is 2200
    EXPECT_NEAR(*d.depth_m, 2180, 50);
    EXPECT_GT(d.pitch_deg, 0);
}

TEST(Decide, MeetsTheRidgeWithTheLeastPitch) {
    // The ridge sinks by 0.5 m/s; a vehicle at 4000 m meets it after 4000 s at 4000 m without any pitch.
    const SnrOptions o = plain();
    const SnrForecast f = forecast_snr(ridge(), 10000, 5, nothing, nothing, o);
    const SnrDecision d = decide(f, {}, {.depth_m = 4000, .water_depth_m = {}}, 1.5, o);
    EXPECT_EQ(d.rule, SnrRule::approach);
    EXPECT_NEAR(f.time_s[d.time], 4000, 120);
    EXPECT_NEAR(*d.depth_m, 4000, 50);
    EXPECT_NEAR(d.pitch_deg, 0, 0.5);
}

TEST(Decide, ComesUpAsSteeplyAsIsAllowed) {
    SnrOptions o = plain();
    o.horizon_s = 600;
    const SnrForecast f = forecast_snr(ridge(), 10000, 5, nothing, nothing, o);
    const SnrDecision d = decide(f, {}, {.depth_m = 4000, .water_depth_m = {}}, 1.5, o);
    EXPECT_EQ(d.rule, SnrRule::steepest);
    EXPECT_EQ(d.pitch_deg, -20);
    // at the end of the horizon the way is the least steep, though too steep
    EXPECT_EQ(d.time, f.time_s.size() - 1);
}

TEST(Decide, PitchIsTheAngleOfTheWay) {
    SnrOptions o = plain();
    o.near_m = 1;
    o.near_best = 0;
    const SnrForecast f = forecast_snr(ridge(), 10000, 0, nothing, nothing, o);
    // the ridge stays at 2000 m: all of the horizon is there to climb 1000 m at 1.5 m/s
    const SnrDecision d = decide(f, {}, {.depth_m = 3000, .water_depth_m = {}}, 1.5, o);
    EXPECT_EQ(d.rule, SnrRule::approach);
    EXPECT_NEAR(d.pitch_deg, -std::asin(1000 / (1.5 * 7200)) * 180 / std::numbers::pi, 1e-9);
    EXPECT_EQ(*d.depth_m, 2000);
}

TEST(Decide, ObeysLimits) {
    const SnrOptions o = plain();
    const SnrForecast f = forecast_snr(ridge(), 10000, 5, nothing, nothing, o);
    const Limits limits{.most_depth_m = 1500};
    const SnrDecision d = decide(f, limits, {.depth_m = 1000, .water_depth_m = {}}, 1.5, o);
    EXPECT_EQ(d.depth_m, 1500);
    EXPECT_EQ(d.choice.bound_by, std::vector<Limit>{Limit::most_depth});
    const SnrDecision back = decide(f, limits, {.depth_m = 1800, .water_depth_m = {}}, 1.5, o);
    EXPECT_EQ(back.depth_m, 1500);
    EXPECT_LT(back.pitch_deg, 0);
}

TEST(Decide, NothingIsDecidedOfNothing) {
    const SnrOptions o = plain();
    LossField f = ridge();
    for (float& h : f.loss_db) h = no_value;
    const SnrForecast none = forecast_snr(f, 10000, 5, nothing, nothing, o);
    EXPECT_EQ(decide(none, {}, {.depth_m = 1000, .water_depth_m = {}}, 1.5, o).rule, SnrRule::none);
    EXPECT_FALSE(decide(none, {}, {.depth_m = 1000, .water_depth_m = {}}, 1.5, o).depth_m);
    const SnrForecast good = forecast_snr(ridge(), 10000, 5, nothing, nothing, o);
    const SnrDecision still = decide(good, {}, {.depth_m = 4990, .water_depth_m = {}}, 0, o);
    EXPECT_FALSE(still.depth_m) << "no speed takes it anywhere";
    const SnrForecast beyond = forecast_snr(ridge(), 50000, 5, nothing, nothing, o);
    EXPECT_EQ(decide(beyond, {}, {.depth_m = 1000, .water_depth_m = {}}, 1.5, o).rule,
              SnrRule::none);
}

TEST(Decide, WeighsOtherObjectives) {
    const SnrOptions o = plain();
    const SnrForecast f = forecast_snr(ridge(), 10000, 0, nothing, nothing, o);
    const std::vector<Objective> others{
        {.name = "sample", .weight = 100, .depth_m = {0, 500, 1000}, .utility = {0, 1, 0}}};
    EXPECT_EQ(decide(f, {}, {.depth_m = 500, .water_depth_m = {}}, 1.5, o, others).depth_m, 500);
    EXPECT_EQ(decide(f, {}, {.depth_m = 2000, .water_depth_m = {}}, 1.5, o).depth_m, 2000);
}

// --- several profiles ---

/// The ridge as another profile has it, so much deeper.
LossField deeper_ridge(double by_m) {
    LossField f = ridge();
    for (std::size_t k = 0; k < f.depth_m.size(); ++k)
        for (std::size_t i = 0; i < f.range_m.size(); ++i)
            f.loss_db[k * f.range_m.size() + i] = static_cast<float>(
                80 + std::abs(f.depth_m[k] - 1000 - by_m - f.range_m[i] / 10) / 100);
    return f;
}

SnrForecast forecast_of(const std::vector<LossField>& fields, const SnrOptions& o) {
    return plan::forecast_snr(fields, 10000, 5, nothing, nothing, o);
}

TEST(Instances, AreAveragedInIntensity) {
    const SnrForecast f = forecast_of({ridge(), deeper_ridge(1000)}, plain());
    // 2000 m at 10 km: 80 dB by the one, 90 by the other; 2500 m: 85 by both
    EXPECT_NEAR(f.snr_db[0][40], 10 * std::log10((1e-8 + 1e-9) / 2), 1e-5);
    EXPECT_NEAR(f.deviation_db[0][40], std::sqrt(50.0), 1e-5);
    EXPECT_NEAR(f.snr_db[0][50], -85, 1e-5);
    EXPECT_NEAR(f.deviation_db[0][50], 0, 1e-5);
    LossField other = ridge();
    other.depth_m.back() += 1;
    EXPECT_THROW(forecast_of({ridge(), other}, plain()), DataError);
}

TEST(Instances, ThatAgreeChangeNothing) {
    const SnrOptions o;
    const SnrForecast one = forecast_of({ridge()}, o),
                      three = forecast_of({ridge(), ridge(), ridge()}, o);
    const std::vector<DepthBand> all{{0, 5000}};
    for (std::size_t k = 0; k < one.time_s.size(); ++k) {
        const Objective a = one.objective(k, all), b = three.objective(k, all);
        for (std::size_t z = 0; z < a.utility.size(); ++z)
            ASSERT_NEAR(a.utility[z], b.utility[z], 1e-9);
    }
}

TEST(Instances, TheMoreTheyDifferTheFlatterIsUtility) {
    const auto contrast = [](double by_m) {
        const Objective o = forecast_of({deeper_ridge(-by_m), deeper_ridge(by_m)}, plain())
                                .objective(0, {{0, 5000}});
        return *std::max_element(o.utility.begin(), o.utility.end()) -
               *std::min_element(o.utility.begin(), o.utility.end());
    };
    double last = 1.0001;
    for (const double by_m : {0.0, 200.0, 500.0, 1000.0}) {
        EXPECT_LT(contrast(by_m), last) << by_m;
        last = contrast(by_m);
    }
    EXPECT_LT(last, 0.4);
    EXPECT_GT(last, 0.001);
}

TEST(Instances, DepthsThatAreNotAllowedDoNotMakeOthersBetter) {
    // only what is shallower than 200 m is allowed, and there utility grows with depth; below it goes up to 8
    const std::vector<DepthBand> allowed{{0, 200}};
    const Objective o =
        forecast_of({deeper_ridge(-300), deeper_ridge(300)}, plain()).objective(0, allowed);
    for (std::size_t k = 0; o.depth_m[k] <= 200; ++k) EXPECT_LE(o.utility[k], 1 + 1e-9);
}

TEST(Instances, AProfileThatDoesNotReachDoesNotCount) {
    LossField near = deeper_ridge(1000);
    near.range_m.resize(10);
    near.loss_db.assign(near.depth_m.size() * 10, 70.0F);
    const SnrForecast f = forecast_of({ridge(), near}, plain());
    EXPECT_EQ(f.time_s.size(), 51U) << "as far as the farther of them goes";
    EXPECT_NEAR(f.snr_db[0][40], -80, 1e-5);
    EXPECT_EQ(f.deviation_db[0][40], 0);
}

// --- the low-pass ---

/// S(z) = -80 dB down to 1000 m, -60 dB from 1100 m on, straight between, at some step.
SnrForecast step_of(double step_m, double length_m) {
    LossField f;
    for (double z = 0; z <= 2000; z += step_m) {
        f.depth_m.push_back(z);
        f.loss_db.push_back(static_cast<float>(80 - std::clamp((z - 1000) / 100, 0.0, 1.0) * 20));
    }
    f.range_m = {1000};
    return forecast_snr(f, 1000, 0, nothing, nothing, {.horizon_s = 0, .smoothing_m = length_m});
}

TEST(ForecastLowPass, IsTheTwoSectionsOfTheSpecificationInDecibels) {
    // y += dz / (dz + 50) (x - y), twice, in steps of 0.1 m
    const SnrForecast f = step_of(50, 50);
    double first = -80, second = -80;
    std::size_t k = 0;
    for (int n = 0; n <= 20000; ++n) {
        const double z = n * 0.1;
        const double x = -80 + std::clamp((z - 1000) / 100, 0.0, 1.0) * 20;
        first += 0.1 / 50.1 * (x - first);
        second += 0.1 / 50.1 * (first - second);
        if (n % 500 != 0) continue;
        EXPECT_NEAR(f.snr_db[0][k], second, 0.05) << z;
        ++k;
    }
    EXPECT_EQ(k, f.depth_m.size());
    EXPECT_NEAR(f.snr_db[0].back(), -60, 1e-3) << "what does not change passes";
}

TEST(ForecastLowPass, DoesNotDependOnTheGrid) {
    const SnrForecast coarse = step_of(100, 50), fine = step_of(5, 50);
    for (std::size_t k = 0; k < coarse.depth_m.size(); ++k)
        EXPECT_NEAR(coarse.snr_db[0][k], fine.snr_db[0][20 * k], 1e-5);
}

TEST(ForecastLowPass, DepthsThatNearlyCoincideDoNoHarm) {
    LossField f;
    f.depth_m = {0, 1e-300, 2e-300, 10, 20};
    f.range_m = {1000};
    f.loss_db = {80, 90, 70, 75, no_value};
    const SnrForecast s =
        forecast_snr(f, 1000, 0, nothing, nothing, {.horizon_s = 0, .smoothing_m = 50});
    for (std::size_t k = 0; k < 4; ++k) EXPECT_TRUE(std::abs(s.snr_db[0][k] + 80) < 1) << k;
}

/// Where a column is largest: between depths by a parabola through the three about it.
double best_depth_m(const SnrForecast& f) {
    const auto& s = f.snr_db[0];
    const auto k = static_cast<std::size_t>(std::max_element(s.begin(), s.end()) - s.begin());
    if (k == 0 || k + 1 == s.size()) return f.depth_m[k];
    const double bend = s[k - 1] - 2 * s[k] + s[k + 1];
    return f.depth_m[k] + (s[k - 1] - s[k + 1]) / 2 / bend * (f.depth_m[k + 1] - f.depth_m[k]);
}

/// Case p7: how far two sections from the surface down move the best depth, range by range. The specification has 70 to
/// 190 m; the grid's step is 60 m, half of which it may be off.
TEST(SnrCases, TheLowPassMovesDownwards) {
    const auto grid = case_grid("p7-pacific-300", "bellhop_gauss_inc");
    if (!grid) GTEST_SKIP() << "the shared cases are not there";
    double sum = 0, n = 0;
    for (double r = 15000; r <= 45000; r += 300) {
        const auto best = [&](double length_m) {
            return best_depth_m(forecast_snr(*grid, r, 0, nothing, nothing,
                                             {.horizon_s = 0, .smoothing_m = length_m}));
        };
        const double shift = best(50) - best(0);
        EXPECT_GE(shift, 70 - 30) << r;
        EXPECT_LE(shift, 190 + 30) << r;
        sum += shift;
        ++n;
    }
    EXPECT_GE(sum / n, 70);
    EXPECT_LE(sum / n, 190);
}

}  // namespace
}  // namespace seautils::plan
