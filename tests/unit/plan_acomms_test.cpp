// AcommsDepth: windows, mean losses, utility, what the spread of profiles does, and limits.
#include "seautils/plan/acomms_depth.hpp"

#include "plan_grids.hpp"

#include "seautils/core/error.hpp"
#include "seautils/plan/limits.hpp"
#include "seautils/plan/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace seautils::plan {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(Motion, TheWindowIsWhatIsMetWithinTheTime) {
    // section 10 of the specification
    EXPECT_NEAR(range_window(500, range_rate_mps(1.47, 0), 120).to_m, 676.4, 1e-9);
    EXPECT_NEAR(range_window(500, range_rate_mps(1.47, 60), 120).to_m, 588.2, 1e-9);
    const RangeWindow closing = range_window(500, range_rate_mps(1.47, 180), 120);
    EXPECT_NEAR(closing.from_m, 323.6, 1e-9);
    EXPECT_EQ(closing.to_m, 500);
    EXPECT_EQ(range_window(100, -2, 120).from_m, 0) << "no range is negative";
    EXPECT_NEAR(range_window(100, range_rate_mps(2, 90), 120).to_m, 100, 1e-9);
}

TEST(Motion, DepthRateIsSpeedTimesTheSineOfThePitch) {
    EXPECT_NEAR(depth_rate_mps(1.5, 20), 0.513, 5e-4);
    EXPECT_NEAR(1000 / depth_rate_mps(1.5, 20) / 60, 32.5, 0.05) << "minutes; not 20";
    EXPECT_NEAR(depth_rate_mps(1.5, 30), 0.75, 1e-12)
        << "the thesis's figure is that of 30 degrees";
}

TEST(Motion, RangeAndItsRateFollowFromBothTracks) {
    const Mover own{.x_m = 300, .y_m = 400, .speed_mps = 2, .heading_deg = 90};
    const Separation s = separation(own, {});
    EXPECT_DOUBLE_EQ(s.range_m, 500);
    EXPECT_NEAR(s.range_rate_mps, 2 * 0.6, 1e-9);
    const Separation along =
        separation(own, {.x_m = 0, .y_m = 0, .speed_mps = 2, .heading_deg = 90});
    EXPECT_NEAR(along.range_rate_mps, 0, 1e-9) << "both move alike";
    EXPECT_NEAR(separation(own, own.after(10)).range_m, 20, 1e-9);
    EXPECT_NEAR(separation(own, {.x_m = 300, .y_m = 400}).range_rate_mps, 2, 1e-9) << "at range 0";
}

TEST(Motion, DegreesBecomeMetres) {
    // a minute of latitude at 45° is 1852.2 m, one of longitude 1314.2 m (tables of the ellipsoid)
    const PlanePoint p = on_plane(45 + 1.0 / 120, 10 + 1.0 / 60, 45 - 1.0 / 120, 10);
    EXPECT_NEAR(p.y_m, 1852.2, 0.1);
    EXPECT_NEAR(p.x_m, 1314.2, 0.1);
    EXPECT_NEAR(on_plane(0, -179.99, 0, 179.99).x_m, 0.02 * 111319.49, 0.1)
        << "across the date line";
}

TEST(MeanLoss, IsThatOfTheMeanIntensity) {
    const LossField f = field_of({10}, {100, 200, 300, 400}, {90, 92, 88, 100});
    EXPECT_NEAR(mean_loss_db(f, 0, {100, 400}), 90.81465, 5e-6);
    EXPECT_DOUBLE_EQ(mean_loss_db(f, 0, {190, 210}), 92);
    EXPECT_DOUBLE_EQ(mean_loss_db(f, 0, {240, 250}), 92) << "no range in it: the nearest one";
    EXPECT_DOUBLE_EQ(mean_loss_db(f, 0, {0, 0}), 90) << "nearer than the field: its first range";
    EXPECT_DOUBLE_EQ(mean_loss_db(f, 0, {440, 440}), 100) << "within half a step of its last";
    EXPECT_TRUE(std::isnan(mean_loss_db(f, 0, {460, 500}))) << "beyond";
    EXPECT_EQ(cover(f, {300, 460}), Cover::part);
    EXPECT_EQ(cover(f, {300, 450}), Cover::full);
}

TEST(MeanLoss, WhatHasNoValueDoesNotCountAndNoEnergyDoes) {
    const LossField f = field_of(
        {10, 20, 30}, {0, 100, 200},
        {no_value, 80, no_energy, no_value, no_value, no_value, no_energy, no_energy, no_energy});
    EXPECT_NEAR(mean_loss_db(f, 0, {0, 200}), 80 + 10 * std::log10(2), 1e-6);
    EXPECT_TRUE(std::isnan(mean_loss_db(f, 1, {0, 200})));
    EXPECT_EQ(mean_loss_db(f, 2, {0, 200}), infinite);
}

TEST(LossAt, IsLinearInIntensity) {
    const LossField f = field_of({10, 20}, {100, 200}, {80, 90, no_value, 70});
    EXPECT_DOUBLE_EQ(loss_at_db(f, std::size_t{0}, 100), 80);
    EXPECT_NEAR(loss_at_db(f, std::size_t{0}, 150), -10 * std::log10((1e-8 + 1e-9) / 2), 1e-9);
    EXPECT_DOUBLE_EQ(loss_at_db(f, 20.0, 110), 70) << "the neighbour that has a value";
    EXPECT_TRUE(std::isnan(loss_at_db(f, 20.0, 100)));
    EXPECT_TRUE(std::isnan(loss_at_db(f, 25.0, 150)));
    EXPECT_TRUE(std::isnan(loss_at_db(f, 15.0, 250)));
}

TEST(AcommsCurve, UtilityIsWhatTheLossLeaves) {
    const std::vector<LossField> f{field_of({10}, {100, 200, 300, 400}, {90, 92, 88, 100})};
    const AcommsCurve c = acomms_curve(f, {100, 400}, {});
    EXPECT_NEAR(c.objective.utility[0], 0.159124, 5e-7);
    EXPECT_EQ(c.loss_limit_db, 108);
    const AcommsCurve local = acomms_curve(f, {100, 400}, {.loss_limit_db = std::nullopt});
    EXPECT_EQ(local.loss_limit_db, 100) << "the largest in the window";
    EXPECT_NEAR(local.objective.utility[0], 1 - 90.81465 / 100, 1e-6);
    EXPECT_EQ(acomms_curve(f, {100, 400}, {.loss_limit_db = 80}).objective.utility[0], 0);
}

TEST(AcommsCurve, InstancesAreAveragedInIntensity) {
    const std::vector<LossField> f{field_of({10, 20}, {100}, {80, 70}),
                                   field_of({10, 20}, {100}, {90, 70})};
    const AcommsCurve c = acomms_curve(f, {100, 100}, {});
    EXPECT_NEAR(c.loss_db[0], -10 * std::log10((1e-8 + 1e-9) / 2), 1e-9);
    EXPECT_NEAR(c.deviation_db[0], std::sqrt(50.0), 1e-9);
    EXPECT_EQ(c.deviation_db[1], 0);
    const std::vector<LossField> other{f[0], field_of({10, 21}, {100}, {90, 70})};
    EXPECT_THROW(acomms_curve(other, {100, 100}, {}), DataError);
}

TEST(AcommsCurve, UncertainUtilityGoesToItsMean) {
    const std::vector<LossField> f{field_of({10, 20}, {100}, {80, 70}),
                                   field_of({10, 20}, {100}, {90, 70})};
    const AcommsCurve plain =
        acomms_curve(f, {100, 100}, {.uncertainty_db = 1e9, .smoothing_m = 0});
    // σ² = 50 at 10 m: with σ0² = 50 half of the way to the mean; nothing at 20 m, where all agree
    const AcommsCurve c =
        acomms_curve(f, {100, 100}, {.uncertainty_db = std::sqrt(50.0), .smoothing_m = 0});
    const double mean = (plain.objective.utility[0] + plain.objective.utility[1]) / 2;
    EXPECT_NEAR(c.objective.utility[0], (plain.objective.utility[0] + mean) / 2, 1e-9);
    EXPECT_NEAR(c.objective.utility[1], plain.objective.utility[1], 1e-12);
}

/// Fields of a sharp peak at 50 m, whose losses elsewhere differ by some dB.
std::vector<LossField> uncertain_peak(float spread_db) {
    std::vector<LossField> fields(2);
    for (int k = 0; k < 2; ++k) {
        fields[k].range_m = {100};
        for (int z = 0; z <= 100; ++z) {
            fields[k].depth_m.push_back(z);
            const float wanders = k == 0 ? spread_db : -spread_db;
            fields[k].loss_db.push_back((z == 50 ? 60.0F : 90.0F) + wanders);
        }
    }
    return fields;
}

double contrast(const AcommsCurve& c) { return c.objective.utility[50] - c.objective.utility[40]; }

TEST(AcommsCurve, TheMoreTheProfilesDifferTheFlatterItIs) {
    double last = 1;
    for (const float spread : {0.0F, 0.5F, 1.0F, 2.0F, 4.0F, 8.0F}) {
        const double now = contrast(acomms_curve(uncertain_peak(spread), {100, 100}, {}));
        EXPECT_LT(now, last);
        EXPECT_GT(now, 0);
        last = now;
    }
    EXPECT_NEAR(contrast(acomms_curve(uncertain_peak(0), {100, 100}, {})), 30.0 / 108, 1e-9);
    EXPECT_LT(last, 0.003);
}

TEST(AcommsCurve, HoldsWithoutAnyLoss) {
    const std::vector<LossField> f{field_of({10, 20}, {100}, {no_value, no_energy})};
    const AcommsCurve c = acomms_curve(f, {100, 100}, {});
    EXPECT_TRUE(std::isnan(c.objective.utility[0]));
    EXPECT_EQ(c.objective.utility[1], 0);
    const AcommsCurve local = acomms_curve(f, {100, 100}, {.loss_limit_db = std::nullopt});
    EXPECT_TRUE(std::isnan(local.objective.utility[1])) << "no limit follows from it";
}

TEST(CheckField, NamesWhatIsWrong) {
    const auto fault = [](const LossField& f) -> std::string {
        try {
            check(f);
        } catch (const DataError& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(fault(field_of({1}, {1}, {50})), "");
    EXPECT_EQ(fault(field_of({1, 1}, {1}, {50, 50})), "depth_m 1 does not grow after 1");
    EXPECT_EQ(fault(field_of({1}, {-1}, {50})), "range_m -1 is outside 0 to 1e8 m");
    EXPECT_EQ(fault(field_of({1}, {1, 2}, {50})),
              "tl_db has 1 values where 1 depths and 2 ranges need 2");
    EXPECT_EQ(fault(field_of({1}, {1}, {-no_energy})), "tl_db -inf is outside -100 to 1000 dB");
    EXPECT_EQ(fault(field_of({}, {1}, {})), "depth_m has no values");
    EXPECT_EQ(fault(field_of({std::nan("")}, {1}, {50})), "depth_m nan is outside 0 to 1e8 m");
}

TEST(LossCsv, IsReadInTheLayoutOfTheCases) {
    const LossField f = read_loss_csv("depth_m\\range_m,10,20\r\n# c\n1,27.5,\n2,inf,nan\n");
    EXPECT_EQ(f.depth_m, (std::vector<double>{1, 2}));
    EXPECT_EQ(f.range_m, (std::vector<double>{10, 20}));
    EXPECT_EQ(f.at(0, 0), 27.5F);
    EXPECT_TRUE(std::isnan(f.at(0, 1)));
    EXPECT_EQ(f.at(1, 0), no_energy);
    const auto fault = [](const char* text) -> std::string {
        try {
            read_loss_csv(text);
        } catch (const DataError& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(fault("z,10,20\n1,5\n"), "2: 2 cells where the first row has 3");
    EXPECT_EQ(fault("z,10,20\n1,5,x\n"), "2: loss 'x' is no number");
    EXPECT_EQ(fault("z,10,10\n"), "1: range_m '10' does not grow");
    EXPECT_EQ(fault("z,10\n1,5000\n"), "2: loss '5000' is outside -100 to 1000 dB");
    EXPECT_EQ(fault("z,10\n"), "depth_m has no values");
    EXPECT_EQ(fault(""), "depth_m has no values");
}

// --- limits ---

Objective ramp() {
    return {.name = "", .weight = 1, .depth_m = {0, 50, 100}, .utility = {0, 0.5, 1}};
}

TEST(Limits, AlwaysWinAndSaySo) {
    const Situation there{.depth_m = 20, .water_depth_m = 100};
    Choice c = choose_depth(ramp(), {}, there);
    EXPECT_EQ(c.depth_m, 100);
    EXPECT_TRUE(c.bound_by.empty());
    c = choose_depth(ramp(), {.least_altitude_m = 15}, there);
    EXPECT_EQ(c.depth_m, 85);
    EXPECT_NEAR(c.utility, 0.85, 1e-12);
    EXPECT_EQ(c.bound_by, std::vector<Limit>{Limit::least_altitude});
    EXPECT_EQ(c.free_depth_m, 100);
    c = choose_depth(ramp(), {.most_depth_m = 60, .least_altitude_m = 15, .excluded = {{40, 70}}},
                     there);
    EXPECT_EQ(c.depth_m, 40);
    EXPECT_EQ(c.bound_by, (std::vector<Limit>{Limit::most_depth, Limit::least_altitude}));
}

TEST(Limits, WithoutTheWatersDepthNothingDeeperThanNow) {
    const Situation there{.depth_m = 20, .water_depth_m = std::nullopt};
    const Choice c = choose_depth(ramp(), {.least_altitude_m = 15}, there);
    EXPECT_EQ(c.depth_m, 20);
    EXPECT_EQ(c.bound_by, std::vector<Limit>{Limit::water_depth_unknown});
    EXPECT_EQ(choose_depth(ramp(), {}, there).depth_m, 100) << "no altitude was asked for";
}

TEST(Limits, CountWhereNothingIsKnownToo) {
    Objective nothing = ramp();
    for (double& u : nothing.utility) u = not_known;
    EXPECT_FALSE(
        choose_depth(nothing, {.most_depth_m = 60}, {.depth_m = 20, .water_depth_m = {}}).depth_m);
    const Choice c =
        choose_depth(nothing, {.most_depth_m = 60}, {.depth_m = 80, .water_depth_m = {}});
    EXPECT_EQ(c.depth_m, 60);
    EXPECT_EQ(c.bound_by, std::vector<Limit>{Limit::most_depth});
    const Choice none = choose_depth(ramp(), {.least_depth_m = 70, .most_depth_m = 60},
                                     {.depth_m = 80, .water_depth_m = {}});
    EXPECT_FALSE(none.depth_m);
    EXPECT_FALSE(none.bound_by.empty());
}

TEST(Limits, BandsPartWhatIsAllowed) {
    const auto allowed =
        allowed_depths({.most_depth_m = 100, .excluded = {{20, 30}, {25, 40}, {90, 200}}},
                       {.depth_m = 0, .water_depth_m = {}});
    ASSERT_EQ(allowed.size(), 2U);
    EXPECT_EQ(allowed[0].to_m, 20);
    EXPECT_EQ(allowed[1].from_m, 40);
    EXPECT_EQ(allowed[1].to_m, 90);
    EXPECT_EQ(nearest_allowed(allowed, 31), 40);
    EXPECT_EQ(nearest_allowed(allowed, 29), 20);
    EXPECT_FALSE(nearest_allowed({}, 29));
}

TEST(Limits, OfEqualDepthsTheNearestIsTaken) {
    const Objective flat{.name = "", .weight = 1, .depth_m = {0, 50, 100}, .utility = {1, 1, 1}};
    EXPECT_EQ(choose_depth(flat, {}, {.depth_m = 60, .water_depth_m = {}}).depth_m, 50);
    EXPECT_EQ(choose_depth(flat, {}, {.depth_m = 75, .water_depth_m = {}}).depth_m, 50);
    EXPECT_EQ(choose_depth(flat, {}, {.depth_m = 76, .water_depth_m = {}}).depth_m, 100);
}

// --- objectives ---

TEST(Objectives, AreCombinedByWeight) {
    const Objective shallow{.name = "s", .weight = 3, .depth_m = {0, 100}, .utility = {1, 0}};
    const Objective sum = combined(ramp(), std::vector<Objective>{shallow});
    EXPECT_DOUBLE_EQ(sum.weight, 4);
    EXPECT_DOUBLE_EQ(sum.utility[0], 0.75);
    EXPECT_DOUBLE_EQ(sum.utility[1], 0.5);
    EXPECT_DOUBLE_EQ(sum.utility[2], 0.25);
    EXPECT_EQ(combined(ramp(), {}).utility, ramp().utility);
}

TEST(Objectives, KeepTheirEndsAndSteps) {
    const Objective step{
        .name = "", .weight = 1, .depth_m = {10, 20, 20, 30}, .utility = {0, 0, 1, 1}};
    check(step);
    EXPECT_EQ(utility_at(step, 5), 0);
    EXPECT_EQ(utility_at(step, 19.999), 0);
    EXPECT_EQ(utility_at(step, 20), 1);
    EXPECT_EQ(utility_at(step, 1000), 1);
    EXPECT_EQ(utility_at({"", 1, {10, 20, 20, 30}, {1, 1, 0, 0}}, 20), 1) << "the larger of both";
    EXPECT_THROW(check({.name = "", .weight = 1, .depth_m = {1, 1, 1}, .utility = {0, 0, 0}}),
                 DataError);
    EXPECT_THROW(check({.name = "", .weight = 1, .depth_m = {1}, .utility = {1.5}}), DataError);
    EXPECT_THROW(check({.name = "", .weight = -1, .depth_m = {1}, .utility = {1}}), DataError);
    EXPECT_THROW(check({.name = "", .weight = 1, .depth_m = {1}, .utility = {not_known}}),
                 DataError);
}

TEST(Objectives, FewPointsSayTheSame) {
    Objective wave{.name = "", .weight = 1, .depth_m = {}, .utility = {}};
    for (int z = 0; z <= 1000; ++z) {
        wave.depth_m.push_back(z);
        wave.utility.push_back(0.5 + 0.4 * std::sin(z / 80.0));
    }
    for (const double tolerance : {0.0, 0.001, 0.01, 0.1}) {
        const Objective few = simplified(wave, tolerance);
        check(few);
        for (std::size_t k = 0; k < wave.depth_m.size(); ++k)
            EXPECT_NEAR(utility_at(few, wave.depth_m[k]), wave.utility[k], tolerance + 1e-9);
        EXPECT_LT(few.depth_m.size(), tolerance < 0.01 ? 1002U : 80U);
        EXPECT_EQ(few.depth_m.front(), 0);
        EXPECT_EQ(few.depth_m.back(), 1000);
    }
    EXPECT_EQ(simplified(ramp(), 0).depth_m, (std::vector<double>{0, 100})) << "one straight piece";
}

// --- the shared cases: accuracy, row F ---

/// The best depth of the reference by a plain reading of the equations, cell by cell.
std::size_t plain_best(const LossField& f, std::size_t first, std::size_t end) {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t k = 0; k < f.depth_m.size(); ++k) {
        double sum = 0;
        for (std::size_t i = first; i < end; ++i) sum += std::pow(10, -f.at(k, i) / 10);
        const double h = -10 * std::log10(sum / static_cast<double>(end - first));
        const double o = std::max(1 - h / 108, 0.0);
        if (o > most) best = k;
        most = std::max(most, o);
    }
    return best;
}

void compare(const std::string& name, const std::string& other, std::size_t width) {
    const auto grid = case_grid(name, "bellhop_gauss_inc");
    const auto typical = case_grid(name, other);
    if (!grid || !typical) GTEST_SKIP() << "the shared cases are not there";
    const Situation there{.depth_m = grid->depth_m.front(), .water_depth_m = std::nullopt};
    std::size_t windows = 0, near = 0;
    for (std::size_t i = 0; i + width <= grid->range_m.size(); i += width, ++windows) {
        const RangeWindow window{grid->range_m[i], grid->range_m[i + width - 1]};
        const AcommsCurve c = acomms_curve({&*grid, 1}, window, {});
        const Choice choice = choose_depth(c.objective, {}, there);
        const std::size_t best = plain_best(*grid, i, i + width);
        ASSERT_EQ(choice.depth_m, grid->depth_m[best]) << window.from_m;
        // the depth that a user's settings choose is as good by the reference
        const AcommsCurve coarse = acomms_curve({&*typical, 1}, window, {});
        const Choice by_coarse = choose_depth(coarse.objective, {}, there);
        const double step = grid->depth_m[1] - grid->depth_m[0];
        near += std::abs(*by_coarse.depth_m - *choice.depth_m) <= step * 1.001 ||
                utility_at(c.objective, *by_coarse.depth_m) >= choice.utility - 0.005;
    }
    EXPECT_GE(windows, 10U);
    EXPECT_EQ(near, windows);
}

TEST(AcommsCases, GlintShelf) { compare("p1-glint10-25k", "bellhop_gauss_inc_typ", 18); }
TEST(AcommsCases, DeepPacific) { compare("p7-pacific-300", "bellhop_gauss_inc_typ", 10); }

}  // namespace
}  // namespace seautils::plan
