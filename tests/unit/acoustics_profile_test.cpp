// Samples to profiles: what is left out, bins, legs, windows, and what is continued.
#include "seautils/acoustics/profile.hpp"

#include "seautils/acoustics/extend.hpp"
#include "seautils/acoustics/seawater.hpp"
#include "seautils/acoustics/window.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/random.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace seautils::acoustics {
namespace {

constexpr std::int64_t second = 1'000'000'000;

Sample at(double depth_m, double mps, std::int64_t time_ns = no_time) {
    Sample s;
    s.depth_m = depth_m;
    s.sound_speed_mps = mps;
    s.time_ns = time_ns;
    return s;
}

/// Down from 0 m by a metre a second, with some gradient.
std::vector<Sample> descent(std::size_t n) {
    std::vector<Sample> all;
    for (std::size_t k = 0; k < n; ++k)
        all.push_back(at(double(k), 1500 - 0.2 * double(k), std::int64_t(k) * second));
    return all;
}

std::size_t count(const std::vector<Drop>& why, Drop drop) {
    return static_cast<std::size_t>(std::count(why.begin(), why.end(), drop));
}

Reading reading(double depth_m, double temperature_c, double salinity) {
    Reading r;
    r[Quantity::depth_m] = depth_m;
    r[Quantity::temperature_c] = temperature_c;
    r[Quantity::salinity] = salinity;
    return r;
}

}  // namespace

TEST(Reduce, TakesWhatIsKnownAndSaysWhatIsNot) {
    Sample s;
    std::string why;
    EXPECT_EQ(reduce(reading(1000, 25, 35), {.formula = SpeedFormula::mackenzie}, s), Drop::none);
    EXPECT_NEAR(s.sound_speed_mps, 1550.744, 0.0005);
    EXPECT_FALSE(s.extrapolated || s.measured || s.latitude_assumed);
    EXPECT_EQ(reduce(reading(10, 99, 35), {}, s, &why), Drop::out_of_bounds);
    EXPECT_EQ(why, "temperature_c 99 is outside -4 to 45 °C");
    EXPECT_EQ(reduce(reading(10, 5, not_available), {}, s, &why), Drop::incomplete);
    EXPECT_EQ(reduce(reading(not_available, 5, 35), {}, s, &why), Drop::incomplete);
    EXPECT_EQ(why, "neither depth_m nor pressure_dbar");
    EXPECT_EQ(reduce(reading(-0.1, 5, 35), {}, s), Drop::above_surface);
    Reading flagged = reading(10, 5, 35);
    flagged.flagged = true;
    EXPECT_EQ(reduce(flagged, {}, s), Drop::flagged);
    // mackenzie: 2 to 30 °C
    EXPECT_EQ(reduce(reading(10, 1, 35), {.formula = SpeedFormula::mackenzie}, s), Drop::none);
    EXPECT_TRUE(s.extrapolated);
}

TEST(Reduce, SalinityOfConductivityAndDepthOfPressure) {
    Reading r;
    r[Quantity::pressure_dbar] = 1000;
    r[Quantity::temperature_c] = 4;
    r[Quantity::conductivity_spm] = conductivity_spm(35, 4, 1000);
    Sample s;
    ASSERT_EQ(reduce(r, {}, s), Drop::none);
    EXPECT_NEAR(s.salinity, 35, 1e-6);
    EXPECT_NEAR(s.sound_speed_mps, 1483.080, 0.0005);
    EXPECT_DOUBLE_EQ(s.depth_m, depth_at_pressure_m(1000, 45));
    EXPECT_TRUE(s.latitude_assumed);
    r[Quantity::latitude_deg] = 0;
    ASSERT_EQ(reduce(r, {}, s), Drop::none);
    EXPECT_DOUBLE_EQ(s.depth_m, depth_at_pressure_m(1000, 0));
    EXPECT_FALSE(s.latitude_assumed);
    r[Quantity::conductivity_spm] = conductivity_spm(1, 4, 1000);  // PSS-78 holds from 2 on
    ASSERT_EQ(reduce(r, {}, s), Drop::none);
    EXPECT_TRUE(s.extrapolated);
}

TEST(Reduce, TheSensorsOwnSpeedWhereNothingElseIsKnownOrItIsAskedFor) {
    Reading r = reading(10, 10, 35);
    r[Quantity::sound_speed_mps] = 1500;
    Sample s;
    reduce(r, {}, s);
    EXPECT_FALSE(s.measured);
    EXPECT_NE(s.sound_speed_mps, 1500);
    reduce(r, {.measured = true}, s);
    EXPECT_TRUE(s.measured);
    EXPECT_EQ(s.sound_speed_mps, 1500);
    r[Quantity::salinity] = not_available;
    reduce(r, {}, s);
    EXPECT_TRUE(s.measured);
    reduce(r, {.salinity = 35}, s);
    EXPECT_FALSE(s.measured);
    EXPECT_TRUE(s.salinity_assumed);
}

TEST(Clean, LeavesMonotoneCastsAlone) {
    EXPECT_TRUE(rc::check("no false alarm", [] {
        std::vector<Sample> cast;
        double depth = 0, mps = 1500;
        for (int k = 0; k < 50; ++k) {
            depth += *rc::gen::inRange(1, 2000) * 0.01;
            mps -= *rc::gen::inRange(0, 1000) * 0.01;
            cast.push_back(at(depth, mps));
        }
        const auto why = clean(cast, {});
        RC_ASSERT(count(why, Drop::none) == cast.size());
    }));
}

TEST(Clean, FindsASpikeWhereverItIsButAtTheEnds) {
    EXPECT_TRUE(rc::check("spikes", [] {
        std::vector<Sample> cast = descent(60);
        SplitMix64 noise(*rc::gen::arbitrary<std::uint64_t>());
        for (Sample& s : cast) s.sound_speed_mps += 0.02 * noise.uniform();
        const auto k = *rc::gen::inRange<std::size_t>(3, 57);
        const double off = *rc::gen::element(-1.0, 1.0) * *rc::gen::inRange(5, 80);
        cast[k].sound_speed_mps += off;
        const auto why = clean(cast, {});
        RC_ASSERT(why[k] == Drop::spike);
        RC_ASSERT(count(why, Drop::spike) == 1U);
        RC_ASSERT(clean(cast, {.spike_deviations = 0})[k] == Drop::none);
    }));
}

TEST(Clean, ADepthThatLeapsIsASpikeAtTheEndsToo) {
    for (const std::size_t k : {0U, 30U, 59U}) {
        std::vector<Sample> cast = descent(60);
        cast[k].depth_m += k == 59 ? -50 : 160;
        const auto why = clean(cast, {});
        EXPECT_EQ(why[k], Drop::spike) << k;
        EXPECT_EQ(count(why, Drop::none), 59U) << k;
    }
}

TEST(Clean, ALoopIsLeftOutAndAHoverIsNot) {
    std::vector<Sample> cast = descent(40);
    // heaved up by 2 m, and down again
    for (const double depth : {38.0, 37.5, 38.5, 39.5, 40.5, 41.0}) {
        cast.push_back(at(depth, 1492, std::int64_t(cast.size()) * second));
    }
    const auto why = clean(cast, {});
    EXPECT_EQ(count(why, Drop::loop), 3U);  // 38, 37.5 and 38.5 lie behind 39
    EXPECT_EQ(why[40], Drop::loop);
    EXPECT_EQ(why[39], Drop::none);
    EXPECT_EQ(why[43], Drop::none);
    EXPECT_EQ(count(clean(cast, {.loop_m = 0}), Drop::loop), 0U);
    // a vehicle that holds its depth above its deepest for minutes, and then goes on
    cast = descent(40);
    for (int k = 0; k < 100; ++k) cast.push_back(at(38, 1492, (40 + k) * second));
    for (int k = 0; k < 20; ++k) cast.push_back(at(39 + k, 1492, (140 + k) * second));
    EXPECT_EQ(count(clean(cast, {}), Drop::loop), 0U);
}

TEST(Clean, SlowScansAreLeftOutWhereAskedFor) {
    std::vector<Sample> cast;
    for (int k = 0; k < 20; ++k) cast.push_back(at(1, 1500, k * second));  // soaks
    for (int k = 0; k < 30; ++k) cast.push_back(at(1 + k, 1500, (20 + k) * second));
    EXPECT_EQ(count(clean(cast, {}), Drop::slow), 0U);
    EXPECT_EQ(count(clean(cast, {.least_speed_mps = 0.3}), Drop::slow), 20U);
}

TEST(Legs, EachDiveAndClimbOfAYoYo) {
    EXPECT_TRUE(rc::check("legs", [] {
        const int legs = *rc::gen::inRange(1, 8), size = *rc::gen::inRange(12, 60);
        std::vector<double> depths;
        double depth = 0;
        for (int leg = 0; leg < legs; ++leg)
            for (int k = 0; k < size; ++k) depths.push_back(depth += leg % 2 == 0 ? 1 : -1);
        LegFinder finder(10);
        std::vector<Leg> found;
        for (const double d : depths)
            if (const auto leg = finder.add(d)) found.push_back(*leg);
        for (const Leg& leg : finder.finish()) found.push_back(leg);
        RC_ASSERT(found.size() == static_cast<std::size_t>(legs));
        std::size_t next = 0;
        for (int k = 0; k < legs; ++k) {
            const Leg& leg = found[static_cast<std::size_t>(k)];
            RC_ASSERT(leg.first == next);
            RC_ASSERT(leg.direction == (k % 2 == 0 ? Direction::dive : Direction::climb));
            next = leg.end;
        }
        RC_ASSERT(next == depths.size());
    }));
}

TEST(Legs, OneWildDepthEndsNone) {
    LegFinder finder(10);
    for (int k = 0; k < 100; ++k) EXPECT_FALSE(finder.add(k == 50 ? 900.0 : k));
    EXPECT_EQ(finder.finish().size(), 1U);
    EXPECT_TRUE(LegFinder(10).finish().empty());
}

TEST(Profile, MeansAndDeviationsAreThoseOfTheBins) {
    EXPECT_TRUE(rc::check("bins", [] {
        const double bin = *rc::gen::element(0.25, 1.0, 7.5);
        std::vector<Sample> samples;
        SplitMix64 random(*rc::gen::arbitrary<std::uint64_t>());
        const int n = *rc::gen::inRange(1, 300);
        for (int k = 0; k < n; ++k) {
            samples.push_back(at(random.uniform() * 40, 1480 + random.uniform() * 40));
        }
        Binning how;
        how.bin_m = bin;
        how.cleaning = {.spike_deviations = 0, .loop_m = 0};
        const Profile p = bin_samples(samples, how);
        std::uint64_t used = 0;
        for (const Level& level : p.levels) {
            const double centre = std::floor(level.depth_m / bin + 0.5) * bin;
            double depth = 0, sum = 0, squares = 0, n_here = 0;
            for (const Sample& s : samples) {
                if (s.depth_m < centre - bin / 2 || s.depth_m >= centre + bin / 2) continue;
                depth += s.depth_m, sum += s.sound_speed_mps, ++n_here;
            }
            for (const Sample& s : samples)
                if (s.depth_m >= centre - bin / 2 && s.depth_m < centre + bin / 2)
                    squares += std::pow(s.sound_speed_mps - sum / n_here, 2);
            RC_ASSERT(level.count == static_cast<std::uint64_t>(n_here));
            RC_ASSERT(std::fabs(level.depth_m - depth / n_here) < 1e-9);
            RC_ASSERT(std::fabs(level.sound_speed_mps - sum / n_here) < 1e-9);
            const double deviation = n_here > 1 ? std::sqrt(squares / (n_here - 1)) : 0;
            RC_ASSERT(std::fabs(level.standard_deviation_mps - deviation) < 1e-8);
            used += level.count;
        }
        RC_ASSERT(used == samples.size());
        RC_ASSERT(
            std::is_sorted(p.levels.begin(), p.levels.end(),
                           [](const Level& a, const Level& b) { return a.depth_m < b.depth_m; }));
    }));
}

TEST(Profile, NothingMakesNoLevelAndTooMuchIsRefused) {
    EXPECT_TRUE(bin_samples({}, {}).levels.empty());
    std::vector<Sample> samples;
    for (std::size_t k = 0; k <= Binning::most_levels; ++k)
        samples.push_back(at(0.25 * double(k), 1500));
    Binning how;
    how.bin_m = 0.25;
    EXPECT_THROW(bin_samples(samples, how), DataError);
    samples.pop_back();
    EXPECT_EQ(bin_samples(samples, how).levels.size(), Binning::most_levels);
}

TEST(Profile, SpeedIsLinearBetweenLevels) {
    const Profile p = bin_samples(std::vector{at(10, 1500), at(20, 1520)}, {});
    EXPECT_DOUBLE_EQ(speed_at_mps(p, 12.5), 1505);
    EXPECT_DOUBLE_EQ(speed_at_mps(p, 10), 1500);
    EXPECT_DOUBLE_EQ(speed_at_mps(p, 0), 1500);
    EXPECT_DOUBLE_EQ(speed_at_mps(p, 500), 1520);
}

TEST(Extend, WaterOfOneTemperatureGoesOnAsTheFormulaSays) {
    Sample s;
    std::vector<Sample> cast;
    for (const double depth : {20.0, 30.0}) {
        ASSERT_EQ(reduce(reading(depth, 4, 35), {}, s), Drop::none);
        cast.push_back(s);
    }
    Profile p = bin_samples(cast, {});
    extend_isothermal(p, {.to_m = 5000});
    EXPECT_EQ(p.extension, Extension::isothermal);
    EXPECT_EQ(p.levels.front().depth_m, 0);
    EXPECT_EQ(p.levels.back().depth_m, 5000);
    EXPECT_EQ(p.measured_to_m, 30);
    for (const Level& level : p.levels) {
        const Water water{4, 35, pressure_at_depth_dbar(level.depth_m, 45), level.depth_m, 45};
        EXPECT_NEAR(level.sound_speed_mps, sound_speed(SpeedFormula::chen_millero, water).mps,
                    1e-9);
    }
    // Chords of the curve are as good as it is.
    for (double z = 31; z < 5000; z += 7) {
        const Water water{4, 35, pressure_at_depth_dbar(z, 45), z, 45};
        EXPECT_NEAR(speed_at_mps(p, z), sound_speed(SpeedFormula::chen_millero, water).mps, 0.001);
    }
}

TEST(Extend, ASpeedAloneGoesOnByTheGradientOfPressure) {
    Profile p = bin_samples(std::vector{at(10, 1500), at(50, 1490)}, {});
    extend_isothermal(p, {.to_m = 1050});
    EXPECT_NEAR(speed_at_mps(p, 50), 1490, 1e-9);
    const double gradient = (speed_at_mps(p, 1050) - 1490) / 1000;
    EXPECT_GT(gradient, 0.0160);  // Leroy and others: 0.016 to 0.017 a second
    EXPECT_LT(gradient, 0.0175);
    EXPECT_EQ(p.levels.back().count, 0U);
}

TEST(Extend, NothingToDoIsNothingDone) {
    Profile p = bin_samples(std::vector{at(0, 1500), at(50, 1490)}, {});
    extend_isothermal(p, {.to_m = 50});
    EXPECT_EQ(p.levels.size(), 2U);
    EXPECT_EQ(p.extension, Extension::none);
    Profile none;
    extend_isothermal(none, {.to_m = 50});
    extend_by(none, p, {.to_m = 50});
    EXPECT_TRUE(none.levels.empty());
}

TEST(Extend, TheDifferenceToAClimatologyFadesLinearly) {
    const Profile climatology =
        bin_samples(std::vector{at(0, 1510), at(50, 1500), at(150, 1490), at(1000, 1480)}, {});
    Profile p = bin_samples(std::vector{at(20, 1508), at(50, 1504)}, {});
    extend_by(p, climatology, {.to_m = 900, .blend_m = 200});
    EXPECT_EQ(p.extension, Extension::climatology);
    EXPECT_NEAR(speed_at_mps(p, 0), 1510 + 2 * 0.9, 1e-9);    // 2 above it at 20 m: 1506
    EXPECT_NEAR(speed_at_mps(p, 50), 1504, 1e-9);             // 4 above it
    EXPECT_NEAR(speed_at_mps(p, 150), 1490 + 4 * 0.5, 1e-9);  // half way
    EXPECT_NEAR(speed_at_mps(p, 250), speed_at_mps(climatology, 250), 1e-9);
    EXPECT_NEAR(speed_at_mps(p, 700), speed_at_mps(climatology, 700), 1e-9);
    EXPECT_EQ(p.levels.back().depth_m, 900);
    // beyond its end by pressure alone
    extend_by(p = bin_samples(std::vector{at(20, 1508)}, {}), climatology, {.to_m = 2000});
    EXPECT_EQ(p.levels.back().depth_m, 2000);
    EXPECT_NEAR(p.levels.back().sound_speed_mps, 1480 + 16.8, 1);
}

TEST(Extend, DepthsGrowStrictlyWhateverIsPutTogether) {
    EXPECT_TRUE(rc::check("grow", [] {
        const auto any = [] {
            std::vector<Sample> samples;
            const int n = *rc::gen::inRange(1, 20);
            for (int k = 0; k < n; ++k)
                samples.push_back(
                    at(*rc::gen::inRange(0, 300000) * 0.01, 1450 + *rc::gen::inRange(0, 100)));
            Binning how;
            how.cleaning = {.spike_deviations = 0, .loop_m = 0};
            return bin_samples(samples, how);
        };
        Profile p = any();
        const Profile other = any();
        const auto to = static_cast<double>(*rc::gen::inRange(0, 4000));
        extend_by(p, other, {.to_m = to, .blend_m = 0.1 * *rc::gen::inRange(1, 5000)});
        RC_ASSERT(p.levels.front().depth_m <= 0.001);
        RC_ASSERT(p.levels.back().depth_m >= to - 0.002);
        for (std::size_t k = 1; k < p.levels.size(); ++k) {
            RC_ASSERT(p.levels[k].depth_m > p.levels[k - 1].depth_m);
            RC_ASSERT(std::isfinite(p.levels[k].sound_speed_mps));
        }
    }));
}

namespace {

/// Runs samples through windows: the first and the last time, in seconds, of what was due.
std::vector<std::pair<std::int64_t, std::int64_t>> spans(const Windowing& how,
                                                         const std::vector<std::int64_t>& times) {
    std::vector<std::pair<std::int64_t, std::int64_t>> all;
    Windows windows(how, [&](std::span<const Sample> s, Direction) {
        all.emplace_back(s.front().time_ns / second, s.back().time_ns / second);
    });
    for (const std::int64_t t : times) windows.add(at(1, 1500, t * second));
    windows.end();
    return all;
}

using Spans = std::vector<std::pair<std::int64_t, std::int64_t>>;

}  // namespace

TEST(Windows, FollowEachOther) {
    const Windowing ten{.window_ns = 10 * second, .every_ns = 10 * second};
    EXPECT_EQ(spans(ten, {0, 4, 8, 12, 16, 20, 21}), (Spans{{0, 8}, {12, 16}, {20, 21}}));
    EXPECT_EQ(spans(ten, {0, 4, 50, 51}), (Spans{{0, 4}, {50, 51}}));          // a pause
    EXPECT_EQ(spans(ten, {100, 104, 50, 51}), (Spans{{100, 104}, {50, 51}}));  // time steps back
    EXPECT_EQ(spans(ten, {100, 104, 103, 105}), (Spans{{100, 105}}));
    EXPECT_EQ(spans(ten, {}), Spans{});
}

TEST(Windows, Overlap) {
    const Windowing sliding{.window_ns = 10 * second, .every_ns = 4 * second};
    EXPECT_EQ(spans(sliding, {0, 2, 4, 6, 8, 10, 12, 14}),
              (Spans{{0, 2}, {0, 6}, {2, 10}, {6, 14}}));
    const Windowing each{.window_ns = 3 * second, .every_ns = 0};
    EXPECT_EQ(spans(each, {0, 2, 4, 5}), (Spans{{0, 0}, {0, 2}, {2, 4}, {4, 5}}));
}

TEST(Windows, SamplesWithoutTimeAreOneCast) {
    std::size_t n = 0;
    Windows windows({}, [&](std::span<const Sample> s, Direction) { n += s.size() * 1000 + 1; });
    for (int k = 0; k < 5; ++k) windows.add(at(k, 1500));
    windows.end();
    windows.end();
    EXPECT_EQ(n, 5001U);
}

TEST(Windows, LegsAreDueWhenTheyEnd) {
    Spans all;
    std::vector<Direction> ways;
    Windows windows({.split = Split::leg}, [&](std::span<const Sample> s, Direction way) {
        all.emplace_back(s.front().depth_m, s.back().depth_m);
        ways.push_back(way);
    });
    for (int k = 0; k <= 300; ++k) windows.add(at(50 - std::abs(k % 100 - 50), 1500));
    EXPECT_EQ(all, (Spans{{0, 50}, {49, 0}, {1, 50}, {49, 0}, {1, 50}}));
    windows.end();
    EXPECT_EQ(all.back(), std::make_pair(std::int64_t{49}, std::int64_t{0}));
    EXPECT_EQ(ways, (std::vector{Direction::dive, Direction::climb, Direction::dive,
                                 Direction::climb, Direction::dive, Direction::climb}));
}

}  // namespace seautils::acoustics
