// Rays against closed forms: straight ones and their images, arcs, cycles; and worlds at the edge
// of sense.
#include "propagation_seas.hpp"

#include "seautils/propagation/rays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace seautils::propagation {
namespace {

using std::numbers::pi;

/// Isovelocity water over a bottom like water: only the surface reflects.
Environment lloyd() {
    Environment sea;
    sea.frequency_hz = 400;
    sea.source.depth_m = 25;
    sea.receivers = {{10, 100}, {500, 1500}};
    sea.water.profile = {{0, 1500}, {600, 1500}};
    sea.bottom = {BoundaryKind::half_space, 1500, 0, 1, 0, 0, 0, {}};
    sea.bottom_depth_m = 600;
    sea.fan = {-89, 89, 0};
    return sea;
}

/// A source and a receiver in c = 1500 + 0.05 z, between walls that are far away.
Environment gradient() {
    Environment sea = lloyd();
    sea.source.depth_m = 20;
    sea.receivers = {{120}, {8000}};
    sea.water.profile = {{0, 1500}, {600, 1530}};
    return sea;
}

Environment munk() {
    Environment sea = lloyd();
    sea.frequency_hz = 50;
    sea.source.depth_m = 1300;
    sea.water.profile.clear();
    sea.water.interpolation = SpeedInterpolation::spline;
    for (int k = 0; k <= 500; ++k) {
        const double depth_m = 10.0 * k, x = 2 * (depth_m - 1300) / 1300;
        sea.water.profile.push_back({depth_m, 1500 * (1 + 0.00737 * (x - 1 + std::exp(-x)))});
    }
    sea.bottom_depth_m = 5000;
    return sea;
}

/// A channel of 100 m with a bottom that reflects.
Environment channel() {
    Environment sea = lloyd();
    sea.frequency_hz = 3000;
    sea.receivers = {evenly(1, 99, 50), evenly(50, 3000, 60)};
    sea.water.profile = {{0, 1520}, {30, 1505}, {100, 1510}};
    sea.bottom = {BoundaryKind::half_space, 1650, 0, 1.8, 0.8, 0, 0, {}};
    sea.bottom_depth_m = 100;
    sea.fan = {-80, 80, 0};
    return sea;
}

FieldOptions hat(Sum sum) {
    FieldOptions options;
    options.sum = sum;
    options.beam = Beam::hat;
    return options;
}

/// To the first receiver.
std::vector<Arrival> paths(const Environment& sea) {
    return std::move(ray_arrivals(sea, {}).front().arrivals);
}

TEST(Rays, LloydMirrorCoherentIncoherentAndSemiCoherent) {
    // Spec §9: the exact field of a source and its image.
    const double coherent[] = {50.559, 68.697, 48.686, 66.685};
    const double incoherent[] = {50.982, 60.513, 51.148, 60.532};
    const double semi[] = {51.195, 61.207, 54.660, 61.172};
    const auto environment = lloyd();
    const auto c = ray_field(environment, hat(Sum::coherent));
    const auto i = ray_field(environment, hat(Sum::incoherent));
    const auto s = ray_field(environment, hat(Sum::semi_coherent));
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(c.loss_db[k], coherent[k], 0.05) << k;
        EXPECT_NEAR(i.loss_db[k], incoherent[k], 0.02) << k;
        EXPECT_NEAR(s.loss_db[k], semi[k], 0.05) << k;
        EXPECT_NEAR(-20 * std::log10(std::abs(c.pressure[k])), c.loss_db[k], 1e-3);
    }
    EXPECT_TRUE(i.pressure.empty());
}

TEST(Rays, PressureHasThePhaseOfTheDirectPathAndItsImage) {
    const auto environment = lloyd();
    const auto field = ray_field(environment, hat(Sum::coherent));
    const double k = 2 * pi * 400 / 1500;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            const double r = environment.receivers.range_m[j], z = environment.receivers.depth_m[i];
            const double direct = std::hypot(r, z - 25), image = std::hypot(r, z + 25);
            const auto exact =
                std::polar(1 / direct, -k * direct) - std::polar(1 / image, -k * image);
            const auto p = std::complex<double>(field.pressure[i * 2 + j]);
            EXPECT_NEAR(std::arg(p / exact), 0, 0.05) << i << j;
        }
}

TEST(Rays, ArcInALinearGradient) {
    // Spec §9: time, launch and arrival angles in closed form.
    const auto all = ray_arrivals(gradient(), {});
    ASSERT_EQ(all.size(), 1U);
    const auto direct =
        std::find_if(all[0].arrivals.begin(), all[0].arrivals.end(),
                     [](const Arrival& a) { return a.surface_bounces + a.bottom_bounces == 0; });
    ASSERT_NE(direct, all[0].arrivals.end());
    EXPECT_NEAR(direct->delay_s, 5.305768490, 1e-9);
    EXPECT_NEAR(direct->launch_deg, 8.293329, 1e-5);
    EXPECT_NEAR(direct->arrival_deg, -6.861009, 1e-5);
    EXPECT_EQ(direct->caustics, 0U);
}

TEST(Rays, SlownessSquaredLinearIsAParabola) {
    // With 1/c² = N0 + b z a ray is a parabola: a = cosθ/c0, p = sinθ/c0: r = aσ, z = z0 + pσ +
    // bσ²/4.
    auto environment = gradient();
    environment.water.interpolation = SpeedInterpolation::n2_linear;
    const double n0 = 1 / (1500. * 1500), b = (1 / (1530. * 1530) - n0) / 600;
    const double z0 = 20, n = n0 + b * z0, launch = 8 * pi / 180;
    const double a = std::sqrt(n) * std::cos(launch), p = std::sqrt(n) * std::sin(launch);
    const double sigma = 6000 / a, depth_m = z0 + p * sigma + b * sigma * sigma / 4;
    ASSERT_GT(depth_m, 0);
    const double end = p + b * sigma / 2;
    const double delay_s = sigma * (a * a + (p * p + p * end + end * end) / 3);
    environment.receivers = {{depth_m}, {6000}};
    double nearest_deg = 1, off_s = 1;
    for (const auto& path : paths(environment))
        if (std::abs(path.launch_deg - 8) < nearest_deg) {
            nearest_deg = std::abs(path.launch_deg - 8);
            off_s = std::abs(path.delay_s - delay_s);
        }
    EXPECT_LT(nearest_deg, 1e-3);
    EXPECT_LT(off_s, 1e-6);
}

TEST(Rays, CyclesOfMunksProfile) {
    // Spec §9: a ray from the axis is back on it after a cycle, at its launch angle.
    const double launch[] = {2, 5, 10, 12};
    const double range_m[] = {47905.005, 49672.020, 56173.720, 60007.937};
    const double time_s[] = {31.936603, 33.112005, 37.405169, 39.913978};
    for (int k = 0; k < 4; ++k) {
        auto environment = munk();
        environment.receivers = {{1300}, {range_m[k]}};
        environment.fan = {launch[k] - 0.5, launch[k] + 0.5, 0};
        double off_deg = 1, off_s = 1;
        for (const auto& path : paths(environment))
            if (std::abs(path.launch_deg - launch[k]) < off_deg) {
                off_deg = std::abs(path.launch_deg - launch[k]);
                off_s = std::abs(path.delay_s - time_s[k]);
            }
        EXPECT_LT(off_deg, 0.02) << launch[k];
        EXPECT_LT(off_s, 2e-4) << launch[k];
    }
}

TEST(Rays, ImagesOfAnIsovelocityChannel) {
    auto environment = channel();
    environment.water.profile = {{0, 1500}};
    environment.receivers = {{60}, {500, 2000}};
    for (const auto& receiver : ray_arrivals(environment, {})) {
        std::vector<double> delays_s;
        for (int n = 0; n <= 2; ++n)
            for (const double image : {25., -25.}) {
                delays_s.push_back(std::hypot(receiver.range_m, 200. * n + image - 60) / 1500);
                delays_s.push_back(std::hypot(receiver.range_m, -200. * n + image - 60) / 1500);
            }
        for (const double delay_s : delays_s)
            EXPECT_TRUE(std::any_of(
                receiver.arrivals.begin(), receiver.arrivals.end(),
                [&](const Arrival& path) { return std::abs(path.delay_s - delay_s) < 1e-9; }))
                << delay_s;
        for (const auto& path : receiver.arrivals) {
            if (path.bottom_bounces > 0) continue;
            EXPECT_NEAR(path.amplitude * path.delay_s * 1500, 1, 1e-6);
        }
    }
}

/// Paths between rays that have met a wall and rays that have not yet are found in the mirror: the
/// same as between those of a fan so dense that hardly any two differ.
TEST(Rays, ArrivalsAreThoseOfADenseFan) {
    std::mt19937 random(11);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 10007U) / 10007;
    };
    std::size_t paths = 0, missed = 0;
    for (int k = 0; k < 12; ++k) {
        Environment sea = channel();
        sea.water.profile = {{0, between(1490, 1520)},
                             {between(20, 45), between(1490, 1520)},
                             {between(50, 80), between(1490, 1520)},
                             {100, between(1490, 1520)}};
        sea.source.depth_m = between(1, 99);
        sea.receivers = {{between(0, 40), between(50, 100)},
                         {between(300, 900), between(1000, 3000)}};
        const auto found = ray_arrivals(sea, {});
        sea.fan.beams = 20000;
        const auto dense = ray_arrivals(sea, {});
        for (std::size_t r = 0; r < dense.size(); ++r) {
            double most = 0;
            for (const Arrival& path : dense[r].arrivals) most = std::max(most, path.amplitude);
            for (const Arrival& path : dense[r].arrivals) {
                if (path.amplitude < 0.03 * most) continue;
                ++paths;
                missed += std::none_of(found[r].arrivals.begin(), found[r].arrivals.end(),
                                       [&](const Arrival& other) {
                                           return std::abs(other.delay_s - path.delay_s) < 1e-8 &&
                                                  other.surface_bounces == path.surface_bounces;
                                       })
                              ? 1
                              : 0;
            }
        }
    }
    EXPECT_GT(paths, 500U);
    EXPECT_LE(missed, paths / 200);
}

/// Of a plane wave-slope the reflected path is the straight one from the source's image in it.
TEST(Rays, ImageInASlopingSurface) {
    for (const double slope : {0.02, -0.015}) {
        Environment sea = lloyd();
        sea.surface_line = Line{false, {-3000, 3000}, {-3000 * slope, 3000 * slope}};
        sea.source.depth_m = 60;
        sea.receivers = {{80}, {700, 1500}};
        // the mirror image of (0, 60) in the line z = slope·r
        const double per = 2 / (1 + slope * slope);
        const double image_r = slope * 60 * per, image_z = 60 - 60 * per;
        for (const auto& receiver : ray_arrivals(sea, {})) {
            int reflected = 0;
            for (const auto& arrival : receiver.arrivals) {
                if (arrival.surface_bounces != 1 || arrival.bottom_bounces != 0) continue;
                ++reflected;
                const double along_m = receiver.range_m - image_r, down_m = 80 - image_z;
                const double path_m = std::hypot(along_m, down_m);
                EXPECT_NEAR(arrival.delay_s, path_m / 1500, 1e-9);
                EXPECT_NEAR(arrival.arrival_deg, std::atan2(down_m, along_m) * 180 / pi, 1e-6);
                // the plane's spreading is that of the image; around the axis it stays the range's
                EXPECT_NEAR(arrival.amplitude,
                            std::sqrt(std::cos(arrival.launch_deg * pi / 180) /
                                      (path_m * receiver.range_m)),
                            1e-9);
                EXPECT_NEAR(arrival.phase_deg, 180, 1e-9);
            }
            EXPECT_EQ(reflected, 1);
        }
    }
}

TEST(Rays, ReciprocalUnderASlope) {
    // Time from here to there is time from there to here, also by way of a sloping bottom.
    auto there = channel();
    there.bottom_line = Line{false, {-1000, 0, 1000, 4000}, {100, 100, 80, 90}};
    there.receivers = {{40}, {1000}};
    auto back = there;
    back.source.depth_m = 40;
    back.bottom_line = Line{false, {-3000, 0, 1000, 2000}, {90, 80, 100, 100}};
    back.receivers = {{25}, {1000}};
    const auto a = paths(there), b = paths(back);
    ASSERT_GT(a.size(), 8U);
    int compared = 0;
    for (const auto& path : a) {
        if (path.bottom_bounces > 3) continue;
        ++compared;
        EXPECT_TRUE(std::any_of(b.begin(), b.end(),
                                [&](const Arrival& other) {
                                    return std::abs(other.delay_s - path.delay_s) < 1e-8 &&
                                           std::abs(other.arrival_deg + path.launch_deg) < 1e-4 &&
                                           other.bottom_bounces == path.bottom_bounces;
                                }))
            << path.delay_s << ' ' << path.bottom_bounces;
    }
    EXPECT_GT(compared, 6);
}

TEST(Rays, MeshOfAProfileIsTheProfile) {
    const auto level = channel();
    auto mesh = level;
    mesh.water.mesh = SpeedMesh{
        {-1000, 1000, 5000}, {0, 30, 100}, {1520, 1520, 1520, 1505, 1505, 1505, 1510, 1510, 1510}};
    const auto a = ray_field(level, {}), b = ray_field(mesh, {});
    for (std::size_t k = 0; k < a.loss_db.size(); ++k)
        ASSERT_NEAR(a.loss_db[k], b.loss_db[k], 0.02) << k;
}

TEST(Rays, LevelLinesAreLevel) {
    const auto level = channel();
    auto lines = level;
    lines.bottom_line = Line{false, {0, 1000, 2000}, {100, 100 + 1e-7, 100}};
    lines.surface_line = Line{false, {0, 1500, 2000}, {0, 1e-7, 0}};
    const auto a = ray_field(level, {}), b = ray_field(lines, {});
    for (std::size_t k = 0; k < a.loss_db.size(); ++k)
        ASSERT_NEAR(a.loss_db[k], b.loss_db[k], 0.02) << k;
}

TEST(Rays, UpsideDownIsTheSame) {
    // Waves above and a level bottom, against their mirror image: a level lid and waves below.
    for (const bool curved : {false, true}) {
        auto waves = channel();
        waves.water.profile = {{0, 1520}, {40, 1505}, {100, 1510}};
        waves.fan.beams = 1000;
        waves.surface_line =
            Line{curved, {0, 100, 300, 450, 700, 1500, 3000}, {0, 2, -1, 1.5, 0, -2, 1}};
        auto below = waves;
        below.source.depth_m = 75;
        below.water.profile = {{0, 1510}, {60, 1505}, {100, 1520}};
        below.surface = waves.bottom;
        below.surface_line.reset();
        below.bottom = waves.surface;
        below.bottom_line = waves.surface_line;
        for (double& depth_m : below.bottom_line->depth_m) depth_m = 100 - depth_m;
        waves.receivers.depth_m = below.receivers.depth_m = evenly(2, 98, 49);
        const auto a = ray_field(waves, {}), b = ray_field(below, {});
        double most_db = 0;
        for (std::size_t i = 0; i < a.depths; ++i)
            for (std::size_t j = 0; j < a.ranges; ++j) {
                const float here = a.loss_db[i * a.ranges + j];
                const float there = b.loss_db[(a.depths - 1 - i) * a.ranges + j];
                ASSERT_EQ(std::isnan(here), std::isnan(there));
                if (std::isfinite(here))
                    most_db = std::max<double>(most_db, std::abs(here - there));
            }
        EXPECT_LT(most_db, 0.05);
    }
}

TEST(Rays, CurvedBottomFocuses) {
    // A bowl of 400 m radius, a source at half of it: rays that fall steeply rise all but parallel.
    auto level = channel();
    level.water.profile = {{0, 1500}};
    level.source.depth_m = 1;
    level.bottom_depth_m = 200;
    level.bottom.kind = BoundaryKind::rigid;
    level.receivers = {{1}, {10}};
    level.fan = {80, 90, 0};
    auto bowl = level;
    bowl.bottom_line = Line{true, {}, {}};
    for (int k = -40; k <= 40; ++k) {
        bowl.bottom_line->range_m.push_back(k);
        bowl.bottom_line->depth_m.push_back(200 - 400 + std::sqrt(400. * 400 - k * k));
    }
    const auto once = [](const Environment& sea) {
        for (const auto& path : paths(sea))
            if (path.bottom_bounces == 1 && path.surface_bounces == 0) return path;
        return Arrival{};
    };
    const auto plain = once(level), focused = once(bowl);
    EXPECT_NEAR(plain.amplitude, 1 / std::hypot(398, 10), 1e-6);
    // The front, 199 m from its source, leaves the mirror with 1/v = 2/400 - 1/199; the bowl is one of
    // revolution.
    const double v = 1 / (2 / 400. - 1 / 199.), spread_m = std::abs((v - 199) / v) * 199;
    EXPECT_NEAR(focused.amplitude / plain.amplitude, 398 / spread_m, 0.01);
}

TEST(Rays, EnergyOfAChannelWithPerfectWalls) {
    // Nothing is lost: of a launch interval dα, cosα dα / r goes through a column, at the angle α
    // to its normal: over depth its intensities add up to dα / r.
    auto environment = channel();
    environment.bottom = {};
    environment.bottom.kind = BoundaryKind::rigid;
    environment.water.profile = {{0, 1500}};
    environment.receivers = {evenly(0.5, 99.5, 100), {400, 1700, 2900}};
    environment.fan = {-60, 60, 0};
    const auto field = ray_field(environment, {});
    for (std::size_t j = 0; j < 3; ++j) {
        double flux = 0;
        for (std::size_t i = 0; i < 100; ++i) flux += std::pow(10, -field.loss_db[i * 3 + j] / 10);
        const double expected = 120 * pi / 180;
        EXPECT_NEAR(flux * environment.receivers.range_m[j] / expected, 1, 0.02);
    }
}

TEST(Rays, SameWhateverTheThreads) {
    const auto environment = channel();
    for (const Sum sum : {Sum::incoherent, Sum::coherent}) {
        FieldOptions options;
        options.sum = sum;
        const auto one = ray_field(environment, options);
        for (const std::uint32_t threads : {2U, 5U, 64U}) {
            options.threads = threads;
            EXPECT_EQ(ray_field(environment, options).loss_db, one.loss_db) << threads;
        }
    }
}

/// The estimate is for 95 % of the cells, of what a fan 16 times as dense has otherwise.
TEST(Rays, EstimatedErrorIsThatOfTheFan) {
    Environment deep = channel();
    deep.water.profile = {{0, 1548}, {200, 1530}, {1300, 1500}, {5000, 1551}};
    deep.bottom_depth_m = 5000;
    deep.source.depth_m = 1000;
    deep.receivers = {evenly(50, 4950, 99), evenly(1000, 80000, 80)};
    for (Environment sea : {channel(), deep})
        for (const Sum sum : {Sum::incoherent, Sum::coherent}) {
            FieldOptions options;
            options.sum = sum;
            const Field field = ray_field(sea, options);
            sea.fan.beams = static_cast<std::uint32_t>(16 * field.basis.beams);
            const Field dense = ray_field(sea, options);
            sea.fan.beams = 0;
            std::vector<double> error_db;
            for (std::size_t k = 0; k < field.loss_db.size(); ++k)
                if (dense.loss_db[k] < 110)
                    error_db.push_back(
                        std::abs(double{field.loss_db[k]} - double{dense.loss_db[k]}));
            std::sort(error_db.begin(), error_db.end());
            const double true_db = error_db[error_db.size() * 19 / 20];
            const double estimate_db = field.basis.estimated_error_db;
            EXPECT_GT(estimate_db, 0.7 * true_db);
            EXPECT_LT(estimate_db, std::max(5 * true_db, 1.)) << "where it is " << true_db;
            EXPECT_LT(dense.basis.estimated_error_db, 0.5 * estimate_db);
        }
}

TEST(Rays, PatternAndBaffleTakeTheirShare) {
    auto environment = lloyd();
    environment.receivers = {{100}, {500}};  // direct path 8.53° down, image 14.04°
    const auto all = paths(environment);
    ASSERT_EQ(all.size(), 2U);
    FieldOptions options;
    options.baffle_from_deg = 10;
    options.baffle_to_deg = 90;
    const auto some = ray_arrivals(environment, options)[0].arrivals;
    ASSERT_EQ(some.size(), 1U);
    EXPECT_EQ(some[0].surface_bounces, 0U);
    environment.source.pattern = {{-90, -20}, {-5, -20}, {5, 0}, {90, 0}};
    const auto shaded = paths(environment);
    EXPECT_NEAR(shaded[1].amplitude / all[1].amplitude, 0.1, 1e-6);  // launched upwards
    EXPECT_NEAR(shaded[0].amplitude / all[0].amplitude, 1, 1e-6);
    options.beam = Beam::hat;
    environment.source.pattern.clear();
    const double direct_m = std::hypot(500, 75);
    EXPECT_NEAR(ray_field(environment, options).loss_db[0], 20 * std::log10(direct_m), 0.02);
}

TEST(Rays, NoValueWhereThereIsNoWaterAndAtRangeZero) {
    auto environment = channel();
    environment.receivers = {{10, 90, 150}, {0, 100, 3000}};
    environment.bottom_line = Line{false, {0, 3000}, {100, 50}};
    const auto field = ray_field(environment, {});
    const bool none[] = {true, false, false, true, false, true, true, true, true};
    for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(std::isnan(field.loss_db[k]), none[k]) << k;
    const auto arrivals = ray_arrivals(environment, {});
    for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(arrivals[k].arrivals.empty(), none[k]) << k;
}

/// In c = 1500 + 0.05 z a ray is an arc of a circle about the depth where c would be 0.
TEST(RayPaths, AreArcsWhereTheGradientIsConstant) {
    Environment sea;
    sea.frequency_hz = 1000;
    sea.water.profile = {{0, 1500}, {3000, 1650}};
    sea.bottom_depth_m = 3000;
    sea.source.depth_m = 1000;
    sea.receivers = {{10}, {4000}};
    sea.fan = {-5, 5, 0};
    const auto paths = ray_paths(sea, {}, 3);
    ASSERT_EQ(paths.size(), 3);
    for (const auto& path : paths) {
        ASSERT_GT(path.range_m.size(), 300);
        ASSERT_EQ(path.range_m.size(), path.depth_m.size());
        const double launch_rad = path.launch_deg * std::numbers::pi / 180;
        const double radius_m = 1550 / (0.05 * std::cos(launch_rad));
        const double centre_z_m = -1500 / 0.05;
        const double centre_r_m = radius_m * std::sin(launch_rad);
        for (std::size_t k = 0; k < path.range_m.size(); ++k)
            EXPECT_NEAR(std::hypot(path.range_m[k] - centre_r_m, path.depth_m[k] - centre_z_m),
                        radius_m, 1e-3);
        EXPECT_NEAR(path.range_m.back(), 4000, 1e-6);
    }
    EXPECT_DOUBLE_EQ(paths[0].launch_deg, -5);
    EXPECT_DOUBLE_EQ(paths[1].launch_deg, 0);
    EXPECT_DOUBLE_EQ(paths[2].launch_deg, 5);
}

TEST(RayPaths, EndWhereTheyLeaveTheWaterOrAreWeak) {
    Environment sea;
    sea.frequency_hz = 1000;
    sea.water.profile = {{0, 1500}};
    sea.bottom_depth_m = 100;
    sea.bottom.kind = BoundaryKind::half_space;
    sea.bottom.sound_speed_mps = 1500;
    sea.bottom.density_gcm3 = 1;
    sea.source.depth_m = 50;
    sea.receivers = {{10}, {1000}};
    sea.fan = {-80, 80, 0};
    // Nothing comes back from a bottom that is water: up, and then down once.
    const auto paths = ray_paths(sea, {}, 2);
    EXPECT_NEAR(paths[1].depth_m.back(), 100, 1e-6);
    EXPECT_NEAR(paths[1].range_m.back(), 50 / std::tan(80 * std::numbers::pi / 180), 1e-6);
    EXPECT_NEAR(paths[0].range_m.back(), 150 / std::tan(80 * std::numbers::pi / 180), 1e-6);
}

}  // namespace
}  // namespace seautils::propagation
