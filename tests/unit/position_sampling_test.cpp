// Fixes at any times to evenly spaced cells; the grid of cells.
#include "seautils/core/error.hpp"
#include "seautils/position/sampling.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <string>

namespace seautils::position {
namespace {

using Method = Sampler::Method;

std::vector<Sample> sampled(const std::vector<RawFix>& fixes, const Sampler::Options& options) {
    Sampler sampler(options);
    std::vector<Sample> all;
    for (const RawFix& fix : fixes) {
        const auto& some = sampler.add(fix);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

RawFix fix(double time_s, double x_m, double y_m = 0, double z_m = 0) {
    return {std::llround(time_s * 1e6), {x_m, y_m, z_m}};
}

Sampler::Options every(std::int64_t interval_ms, Method method = Method::linear) {
    Sampler::Options options;
    options.interval_ms = interval_ms;
    options.method = method;
    return options;
}

std::string refusal(Sampler& sampler, const RawFix& bad) {
    try {
        sampler.add(bad);
        return "taken";
    } catch (const DataError& e) {
        return e.what();
    }
}

TEST(Sampler, between_fixes_it_is_on_the_line_or_at_the_nearest) {
    const std::vector<RawFix> fixes{fix(100.5, 0), fix(101.5, 10, 1, -4), fix(103.5, 30, 2, -9)};
    const std::vector<Sample> line{{100'500, {0, 0, 0}, true},
                                   {101'500, {10, 1, -4}, false},
                                   {102'500, {20, 2, -7}, false},  // 1.5 and -6.5: away from 0
                                   {103'500, {30, 2, -9}, false}};
    auto options = every(1000);
    options.gap_ms = 2000;
    EXPECT_EQ(sampled(fixes, options), line);
    options.method = Method::nearest;
    EXPECT_EQ(sampled(fixes, options)[2], (Sample{102'500, {10, 1, -4}, false}));
}

TEST(Sampler, a_step_over_one_and_a_half_intervals_is_a_gap_and_begins_a_grid_of_its_own) {
    const std::vector<RawFix> fixes{fix(7, 1), fix(17, 2), fix(32, 3), fix(47.001, 4),
                                    fix(57.001, 5)};
    const std::vector<Sample> samples{{7'000, {1, 0, 0}, true},
                                      {17'000, {2, 0, 0}, false},
                                      {27'000, {3, 0, 0}, false},  // 2.67
                                      {47'001, {4, 0, 0}, true},
                                      {57'001, {5, 0, 0}, false}};
    EXPECT_EQ(sampled(fixes, every(10'000)), samples);
}

TEST(Sampler, a_sample_is_given_as_soon_as_it_is_complete) {
    Sampler sampler(every(1000));
    EXPECT_EQ(sampler.add(fix(0, 0)).size(), 1U);
    EXPECT_EQ(sampler.add(fix(0.9, 9)).size(), 0U);
    EXPECT_EQ(sampler.add(fix(1, 10)).size(), 1U);
    EXPECT_EQ(sampler.add(fix(2.4, 24)).size(), 1U);
}

TEST(Sampler, a_track_that_is_even_already_comes_through_as_it_is) {
    EXPECT_TRUE(rc::check("sampling a regular track is the identity", [] {
        const auto interval_ms = *rc::gen::inRange<std::int64_t>(1, 100'000);
        const auto phase_ms = *rc::gen::inRange<std::int64_t>(0, 1'000'000'000);
        const auto method = *rc::gen::element(Method::linear, Method::nearest);
        auto options = every(interval_ms, method);
        options.grid = make_grid(*rc::gen::inRange(1, 5000), *rc::gen::inRange(1, 5000));
        std::vector<RawFix> fixes;
        std::vector<Sample> expected;
        std::int64_t time_ms = phase_ms;
        for (const bool gap : *rc::gen::container<std::vector<bool>>(rc::gen::arbitrary<bool>())) {
            if (gap) time_ms += interval_ms + *rc::gen::inRange<std::int64_t>(1, 1'000'000);
            const Cell cell{*rc::gen::inRange(-5000, 5000), *rc::gen::inRange(-5000, 5000),
                            *rc::gen::inRange(-200, 200)};
            const bool starts =
                fixes.empty() || (time_ms - expected.back().time_ms) * 2 > interval_ms * 3;
            const bool even = starts || time_ms - expected.back().time_ms == interval_ms;
            RC_PRE(even);
            fixes.push_back({time_ms * 1000, place_of(options.grid, cell)});
            expected.push_back({time_ms, cell, starts});
            time_ms += interval_ms;
        }
        RC_ASSERT(sampled(fixes, options) == expected);
    }));
}

/// Where the fixes say that the vehicle was, in long arithmetic.
double truth(const std::vector<RawFix>& fixes, std::int64_t time_ms, double Place::*axis) {
    for (std::size_t k = 1; k < fixes.size(); ++k) {
        if (fixes[k].time_us < time_ms * 1000) continue;
        if (fixes[k - 1].time_us > time_ms * 1000) break;
        const long double part = static_cast<long double>(time_ms * 1000 - fixes[k - 1].time_us) /
                                 static_cast<long double>(fixes[k].time_us - fixes[k - 1].time_us);
        const long double a = fixes[k - 1].place.*axis, b = fixes[k].place.*axis;
        return static_cast<double>(a + (b - a) * part);
    }
    return fixes.front().place.*axis;
}

TEST(Sampler, each_cell_is_within_half_a_resolution_of_the_line) {
    EXPECT_TRUE(rc::check("|cell - truth| <= resolution / 2, evenly spaced", [] {
        auto options = every(*rc::gen::inRange<std::int64_t>(1, 20'000));
        options.grid = make_grid(*rc::gen::inRange(1, 5000), *rc::gen::inRange(1, 5000));
        std::vector<RawFix> fixes{{*rc::gen::inRange<std::int64_t>(0, 1'000'000'000), {}}};
        for (int k = *rc::gen::inRange(0, 30); k > 0; --k) {
            const std::int64_t most = options.interval_ms * 1500;
            const std::int64_t time_us =
                fixes.back().time_us + *rc::gen::inRange<std::int64_t>(1, most + 1);
            const auto metres = [] { return *rc::gen::inRange(-900'000, 900'000) / 1e3; };
            fixes.push_back({time_us, {metres(), metres(), metres()}});
        }
        const std::vector<Sample> samples = sampled(fixes, options);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const Sample& s = samples[k];
            RC_ASSERT(s.time_ms * 1000 <= fixes.back().time_us);
            RC_ASSERT(s.starts == (k == 0));
            RC_ASSERT((k == 0 || s.time_ms == samples[k - 1].time_ms + options.interval_ms));
            const Place at = place_of(options.grid, s.cell);
            const double xy = static_cast<double>(options.grid.resolution_mm) / 2000 + 1e-9;
            const double z = static_cast<double>(options.grid.resolution_z_mm) / 2000 + 1e-9;
            RC_ASSERT(std::fabs(at.x_m - truth(fixes, s.time_ms, &Place::x_m)) <= xy);
            RC_ASSERT(std::fabs(at.y_m - truth(fixes, s.time_ms, &Place::y_m)) <= xy);
            RC_ASSERT(std::fabs(at.z_m - truth(fixes, s.time_ms, &Place::z_m)) <= z);
        }
    }));
}

TEST(Sampler, what_is_absurd_is_refused_and_counts_as_not_there) {
    auto options = every(1000);
    set_area(options.grid, "x=-100:100,z=-50:1");
    Sampler sampler(options);
    sampler.add(fix(10, 0));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal(sampler, fix(11, 100.6)), "x 100.6 m is outside the area, -100 to 100 m");
    EXPECT_EQ(refusal(sampler, fix(11, 0, nan)),
              "y nan m is outside the area, -4194303 to 4194303 m");
    EXPECT_EQ(refusal(sampler, fix(11, 0, 0, -1e300)),
              "z -1e+300 m is outside the area, -50 to 1 m");
    EXPECT_EQ(refusal(sampler, fix(10, 0)), "time 10 s is not after that of the fix before, 10 s");
    EXPECT_EQ(refusal(sampler, fix(9, 0)), "time 9 s is not after that of the fix before, 10 s");
    EXPECT_EQ(refusal(sampler, {-1, {}}),
              "time -1e-06 s is outside 0 to 7258118400 s (the year 2200)");
    EXPECT_EQ(refusal(sampler, fix(7258118401, 0)),
              "time 7258118401 s is outside 0 to 7258118400 s (the year 2200)");
    EXPECT_EQ(sampler.add(fix(11, 7)), (std::vector<Sample>{{11'000, {7, 0, 0}, false}}));
}

TEST(Sampler, one_time_in_the_future_does_not_deafen_it) {
    Sampler sampler(every(1000));
    sampler.add(fix(10, 0));
    sampler.add(fix(1e9, 0));
    for (int k = 1; k < Sampler::back_before_belief; ++k)
        EXPECT_THROW(sampler.add(fix(10 + k, k)), DataError);
    EXPECT_EQ(sampler.add(fix(15, 5)), (std::vector<Sample>{{15'000, {5, 0, 0}, true}}));
    // But such as do not follow each other are no clock.
    for (const double t : {14, 13, 12, 11, 14, 7, 13, 4})
        EXPECT_THROW(sampler.add(fix(t, 0)), DataError);
    EXPECT_EQ(sampler.add(fix(16, 6)), (std::vector<Sample>{{16'000, {6, 0, 0}, false}}));
}

TEST(Sampler, options_out_of_range_are_named) {
    EXPECT_THROW(Sampler(every(0)), ConfigError);
    EXPECT_THROW(Sampler(every(86'400'001)), ConfigError);
    auto options = every(1000);
    options.gap_ms = 999;
    EXPECT_THROW(Sampler{options}, ConfigError);
    options.gap_ms = 1'000'001;
    EXPECT_THROW(Sampler{options}, ConfigError);
    EXPECT_THROW(make_grid(0, 1), ConfigError);
    EXPECT_THROW(make_grid(1, 1'000'001), ConfigError);
}

TEST(Grid, halves_go_away_from_0) {
    const Grid grid;
    EXPECT_EQ(cell_of(grid, {0.5, -0.5, -1.5}), (Cell{1, -1, -2}));
    EXPECT_EQ(cell_of(grid, {0.4999, -0.4999, -1.4999}), (Cell{0, 0, -1}));
}

TEST(Grid, a_full_fix_has_the_bits_that_its_area_takes) {
    Grid grid;
    EXPECT_EQ(full_bits(grid), 23U + 23U + 14U);
    set_area(grid, "x=0:1023,y=0:1024,z=-1:0");
    EXPECT_EQ(full_bits(grid), 10U + 11U + 1U);
    set_area(grid, "z=5:5");
    EXPECT_EQ(full_bits(grid), 10U + 11U);
    EXPECT_EQ(full_bits(make_grid(1000, 100)), 23U + 23U + 17U);
}

std::string area_refusal(const char* text) {
    Grid grid = make_grid(1000, 1000);
    try {
        set_area(grid, text);
        return "taken";
    } catch (const DataError& e) {
        EXPECT_EQ(grid, make_grid(1000, 1000));
        return e.what();
    }
}

TEST(Grid, an_area_that_is_none_is_refused) {
    EXPECT_EQ(area_refusal("x=1"), "'x=1' is not of the form x=-5000:5000");
    EXPECT_EQ(area_refusal("x=0:1,w=1:2"), "'w=1:2' is not of the form x=-5000:5000");
    EXPECT_EQ(area_refusal("x=0:1,"), "'' is not of the form x=-5000:5000");
    EXPECT_EQ(area_refusal("y=2:1"), "'y=2:1': the least is above the most");
    EXPECT_EQ(area_refusal("y=a:1"), "'a' is no number of metres");
    EXPECT_EQ(area_refusal("y=0:5e6"), "'5e6' is outside -4194303 to 4194303 m");
}

}  // namespace
}  // namespace seautils::position
