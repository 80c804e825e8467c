// Rays against the reference fields and arrivals of ../shared/cases, to the tolerances of
// specs/acoustics-accuracy.md.
#include "propagation_cases.hpp"
#include "sanitized.hpp"

#include "seautils/propagation/rays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace seautils::propagation {
namespace {

/// Intensity averaged over 5 depths and 9 ranges; edges are mirrored. Only cells in the water
/// count.
std::vector<double> smoothed(const std::vector<double>& loss, const std::vector<double>& water,
                             int depths, int ranges) {
    const auto mirrored = [](int k, int n) { return k < 0 ? -k - 1 : k >= n ? 2 * n - 1 - k : k; };
    std::vector<double> out(loss.size());
    for (int i = 0; i < depths; ++i)
        for (int j = 0; j < ranges; ++j) {
            double sum = 0, weight = 0;
            for (int di = -2; di <= 2; ++di)
                for (int dj = -4; dj <= 4; ++dj) {
                    const auto at = static_cast<std::size_t>(mirrored(i + di, depths) * ranges +
                                                             mirrored(j + dj, ranges));
                    if (water[at] <= 0) continue;
                    ++weight;
                    if (std::isfinite(loss[at])) sum += std::pow(10, -loss[at] / 10);
                }
            out[static_cast<std::size_t>(i * ranges + j)] = -10 * std::log10(sum / weight);
        }
    return out;
}

struct Tolerance {
    double median, p95, p99 = 1e9, bias = 1e9;
};

double quantile(std::vector<double> sorted, double part) {
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

/// Cells in the water whose reference is below 110 dB, from `least_range_m` on.
void expect_near(const ReferenceCase& world, const Field& field, const std::string& key,
                 const Tolerance& tolerance, bool smooth = false, double least_range_m = 0) {
    SCOPED_TRACE(world.folder.filename().string() + " " + key);
    const auto water = world.grid("in_water");
    auto reference = world.grid(key);
    std::vector<double> loss(field.loss_db.begin(), field.loss_db.end());
    ASSERT_EQ(loss.size(), reference.size());
    if (smooth) {
        const int depths = static_cast<int>(field.depths), ranges = static_cast<int>(field.ranges);
        reference = smoothed(reference, water, depths, ranges);
        loss = smoothed(loss, water, depths, ranges);
    }
    std::vector<double> off;
    double bias = 0, missing = 0;
    for (std::size_t k = 0; k < loss.size(); ++k) {
        if (water[k] <= 0 || !(reference[k] < 110) ||
            world.sea.receivers.range_m[k % field.ranges] < least_range_m)
            continue;
        if (!std::isfinite(loss[k])) {
            ++missing;
            continue;
        }
        off.push_back(std::abs(loss[k] - reference[k]));
        bias += loss[k] - reference[k];
    }
    const auto n = static_cast<double>(off.size());
    ASSERT_GT(n, 10000);
    EXPECT_LE(quantile(off, 0.5), tolerance.median);
    EXPECT_LE(quantile(off, 0.95), tolerance.p95);
    EXPECT_LE(quantile(off, 0.99), tolerance.p99);
    EXPECT_LE(std::abs(bias / n), tolerance.bias);
    EXPECT_LE(missing / n, 0.002);
}

FieldOptions options_of(Sum sum, Beam beam = Beam::gaussian) {
    FieldOptions options;
    options.sum = sum;
    options.beam = beam;
    options.threads = 2;
    return options;
}

const std::vector<std::string> level{"p1-glint10-25k", "p2-pekeris-250", "p3-lloyd-400",
                                     "p4-munk-50",     "p6-beam-10k",    "p7-pacific-300"};

#define NEEDS_CASES() \
    if (!std::filesystem::exists(cases())) GTEST_SKIP() << "no reference cases"

TEST(RaysOfCases, IncoherentAndSemiCoherentWithTheAutomaticFan) {  // A1, A5
    NEEDS_CASES();
    for (const auto& name : level) {
        const ReferenceCase world(name);
        expect_near(world, ray_field(world.sea, {}), "bellhop_gauss_inc", {0.05, 0.5, 1.5, 0.08});
        expect_near(world, ray_field(world.sea, options_of(Sum::semi_coherent)),
                    "bellhop_gauss_semi", {0.075, 0.75, 2.25, 0.12});
    }
}

TEST(RaysOfCases, OverABeach) {  // A2
    NEEDS_CASES();
    const ReferenceCase world("p5-beach-3k5");
    expect_near(world, ray_field(world.sea, {}), "bellhop_gauss_inc", {0.10, 1.2, 3.2});
}

TEST(RaysOfCases, HatsWithTheAutomaticFan) {  // A4
    NEEDS_CASES();
    for (const auto& name : level) {
        const ReferenceCase world(name);
        expect_near(world, ray_field(world.sea, options_of(Sum::incoherent, Beam::hat)),
                    "bellhop_hat_inc", {0.05, 0.6, 2.0});
    }
}

TEST(RaysOfCases, CoherentWithTheReferencesFan) {  // B1, B2
    NEEDS_CASES();
    if (is_sanitized) GTEST_SKIP() << "sanitizers: shorter tests walk the same code";
    for (const auto& name : level) {
        ReferenceCase world(name);
        world.sea.fan.beams = world.about["reference_run"]["beams"];
        const bool short_waves = name[1] == '1' || name[1] == '6' || name[1] == '7';
        expect_near(world, ray_field(world.sea, options_of(Sum::coherent)), "bellhop_gauss_coh",
                    short_waves ? Tolerance{0.45, 2.0} : Tolerance{0.15, 1.4}, true);
    }
}

TEST(RaysOfCases, LloydsMirror) {  // B3
    NEEDS_CASES();
    const ReferenceCase world("p3-lloyd-400");
    const auto field = [&](Sum sum) { return ray_field(world.sea, options_of(sum, Beam::hat)); };
    expect_near(world, field(Sum::incoherent), "analytic_inc", {0.01, 0.05});
    expect_near(world, field(Sum::semi_coherent), "analytic_semi", {0.01, 0.05});
    expect_near(world, field(Sum::coherent), "analytic_coh", {0.01, 0.1});
}

TEST(RaysOfCases, Pekeris) {  // B4
    NEEDS_CASES();
    ReferenceCase world("p2-pekeris-250");
    world.sea.fan.beams = world.about["reference_run"]["beams"];
    expect_near(world, ray_field(world.sea, options_of(Sum::coherent, Beam::hat)), "analytic_coh",
                {0.6, 3.0}, false, 300);
}

/// What of a list is louder than 30 dB below its loudest, with absorption.
std::vector<Arrival> loud(std::vector<Arrival> all) {
    double most = 0;
    for (auto& path : all) {
        path.amplitude *= std::pow(10, -path.absorption_db / 20);
        path.absorption_db = 0;
        most = std::max(most, path.amplitude);
    }
    std::erase_if(all, [&](const Arrival& path) { return path.amplitude < most * 0.0316227766; });
    return all;
}

/// Spec (4.5).
double delay_spread_s(const std::vector<Arrival>& all) {
    double sum = 0, mean = 0, square = 0;
    for (const auto& a : all) sum += a.amplitude * a.amplitude;
    for (const auto& a : all) mean += a.amplitude * a.amplitude * a.delay_s / sum;
    for (const auto& a : all)
        square += a.amplitude * a.amplitude * std::pow(a.delay_s - mean, 2) / sum;
    return std::sqrt(square);
}

std::vector<Arrival> listed(const json& receiver) {
    std::vector<Arrival> out;
    for (const auto& row : receiver["arrivals"]) {
        Arrival path;
        path.amplitude = row[0];
        path.phase_deg = row[1];
        path.delay_s = row[2];
        path.launch_deg = row[4];
        path.arrival_deg = row[5];
        path.surface_bounces = row[6];
        path.bottom_bounces = row[7];
        path.caustics = row[8];
        out.push_back(path);
    }
    return out;
}

TEST(RaysOfCases, ExactArrivals) {  // D1 and D2, as proud as they may be; D3
    NEEDS_CASES();
    for (const auto& name : level) {
        SCOPED_TRACE(name);
        ReferenceCase world(name);
        world.sea.receivers = {world.about["arrivals"]["depth_m"].get<std::vector<double>>(),
                               world.about["arrivals"]["range_m"].get<std::vector<double>>()};
        const auto found = ray_arrivals(world.sea, {});
        std::istringstream lines(unpacked(world.folder / "arrivals_exact.ndjson.gz"));
        std::size_t at = 0;
        for (std::string line; std::getline(lines, line); ++at) {
            const json receiver = json::parse(line);
            ASSERT_NEAR(found[at].depth_m, receiver["depth_m"].get<double>(), 1e-9);
            ASSERT_NEAR(found[at].range_m, receiver["range_m"].get<double>(), 1e-9);
            const auto exact = loud(listed(receiver)), ours = loud(found[at].arrivals);
            EXPECT_EQ(exact.size(), ours.size());
            EXPECT_NEAR(delay_spread_s(ours) / delay_spread_s(exact), 1, 1e-3);
            for (const auto& path : exact)
                EXPECT_TRUE(std::any_of(ours.begin(), ours.end(), [&](const Arrival& a) {
                    const double turns = (a.phase_deg - path.phase_deg) / 360;
                    return std::abs(a.delay_s - path.delay_s) < 5e-8 &&
                           std::abs(a.launch_deg - path.launch_deg) < 1e-4 &&
                           std::abs(a.arrival_deg - path.arrival_deg) < 1e-4 &&
                           std::abs(a.amplitude / path.amplitude - 1) < 0.03 &&
                           std::abs(turns - std::round(turns)) < 1e-2 &&
                           a.surface_bounces == path.surface_bounces &&
                           a.bottom_bounces == path.bottom_bounces && a.caustics == path.caustics;
                })) << path.delay_s;
        }
        EXPECT_EQ(at, found.size());
    }
}

TEST(RaysOfCases, ArrivalsOverABeach) {  // D1, against beams: those come in pairs, or not at all
    NEEDS_CASES();
    ReferenceCase world("p5-beach-3k5");
    world.sea.receivers = {world.about["arrivals"]["depth_m"].get<std::vector<double>>(),
                           world.about["arrivals"]["range_m"].get<std::vector<double>>()};
    const auto found = ray_arrivals(world.sea, {});
    std::istringstream lines(unpacked(world.folder / "arrivals.ndjson.gz"));
    std::size_t at = 0, listed_paths = 0, recalled = 0;
    for (std::string line; std::getline(lines, line); ++at) {
        const json receiver = json::parse(line);
        const auto ours = found[at].arrivals;
        double most = 0;
        for (const auto& row : receiver["arrivals"]) most = std::max<double>(most, row[0]);
        for (const auto& row : receiver["arrivals"]) {
            if (row[0].get<double>() < 0.1 * most) continue;
            ++listed_paths;
            recalled += std::any_of(ours.begin(), ours.end(), [&](const Arrival& a) {
                return std::abs(a.delay_s - row[2].get<double>()) < 5e-6 &&
                       a.surface_bounces == row[6] && a.bottom_bounces == row[7];
            });
        }
    }
    ASSERT_GT(listed_paths, 50U);
    EXPECT_GE(static_cast<double>(recalled), 0.95 * static_cast<double>(listed_paths));
}

}  // namespace
}  // namespace seautils::propagation
