// Modes against the reference fields of ../shared/cases, to the tolerances of specs/acoustics-accuracy.md.
#include "seautils/propagation/modes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace seautils::propagation {
namespace {

using nlohmann::json;

std::filesystem::path case_folder(const std::string& name) {
    const char* shared = std::getenv("SEAUTILS_SHARED");
    return std::filesystem::path(shared ? shared
                                        : std::string(SEAUTILS_SOURCE_DIR) + "/../shared") /
           "cases" / name;
}

/// The losses of a reference, line by line, without the ranges and depths.
std::vector<float> reference(const std::filesystem::path& file) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
        popen(("gzip -dc '" + file.string() + "'").c_str(), "r"), pclose);
    std::string text;
    char part[65536];
    for (std::size_t n; (n = std::fread(part, 1, sizeof part, pipe.get())) > 0;)
        text.append(part, n);
    std::istringstream lines(text);
    std::vector<float> losses;
    std::string line, cell;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        std::getline(cells, cell, ',');
        while (std::getline(cells, cell, ',')) losses.push_back(std::strtof(cell.c_str(), nullptr));
    }
    return losses;
}

std::vector<double> linspace(const json& range) {
    const double start = range["start"], stop = range["stop"];
    const int count = range["count"];
    std::vector<double> out;
    for (int k = 0; k < count; ++k) out.push_back(start + (stop - start) * k / (count - 1));
    return out;
}

Environment sea_of(const std::filesystem::path& folder) {
    const json about = json::parse(std::ifstream(folder / "case.json"));
    Environment e;
    e.frequency_hz = about["frequency_hz"];
    e.source.depth_m = about["source"]["depth_m"];
    e.receivers = {linspace(about["receivers"]["depth_m"]),
                   linspace(about["receivers"]["range_m"])};
    for (const auto& point : about["water"]["profile_z_c"])
        e.water.profile.push_back({point[0], point[1]});
    const json& bottom = about["bottom"];
    e.bottom_depth_m = bottom["depth_m"];
    e.bottom.kind = BoundaryKind::half_space;
    e.bottom.sound_speed_mps = bottom["sound_speed_m_s"];
    e.bottom.density_gcm3 = bottom["density_g_cm3"];
    e.bottom.attenuation_db_per_wavelength = bottom["attenuation_db_per_wavelength"];
    return e;
}

struct Score {
    double median = 0, p95 = 0;
    std::size_t missing = 0;
};

Score score(const Environment& e, const Field& field, const std::vector<float>& losses,
            double beyond_m) {
    Score s;
    std::vector<double> d;
    EXPECT_EQ(losses.size(), field.loss_db.size());
    for (std::size_t k = 0; k < losses.size(); ++k) {
        if (!(losses[k] < 110) || e.receivers.range_m[k % field.ranges] <= beyond_m) continue;
        if (std::isfinite(field.loss_db[k]))
            d.push_back(std::abs(field.loss_db[k] - losses[k]));
        else
            ++s.missing;
    }
    std::sort(d.begin(), d.end());
    s.median = d[d.size() / 2];
    s.p95 = d[d.size() * 95 / 100];
    return s;
}

struct Held {
    const char *name, *reference;
    Sum sum;
    double beyond_m, median, p95;
};
class PropagationModesCase : public testing::TestWithParam<Held> {};

TEST_P(PropagationModesCase, IsWithinItsTolerance) {
    const Held held = GetParam();
    const std::filesystem::path folder = case_folder(held.name);
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    const Environment e = sea_of(folder);
    FieldOptions options;
    options.sum = held.sum;
    const std::string file = std::string(held.reference) + ".csv.gz";
    const Score s =
        score(e, mode_field(e, options), reference(folder / "csv" / file), held.beyond_m);
    EXPECT_LE(s.median, held.median);
    EXPECT_LE(s.p95, held.p95);
    EXPECT_EQ(s.missing, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, PropagationModesCase,
    testing::Values(Held{"p2-pekeris-250", "analytic_coh", Sum::coherent, 300, 0.01, 0.06},  // C1
                    Held{"p2-pekeris-250", "krakenc_coh", Sum::coherent, 300, 0.04, 0.25},
                    Held{"p4-munk-50", "krakenc_coh", Sum::coherent, 15000, 0.04, 0.7},  // C2
                    Held{"p4-munk-50", "krakenc_inc", Sum::incoherent, 15000, 0.04, 0.25}));

TEST(PropagationWavenumberCase, PekerisIsAsByContourIntegration) {
    const std::filesystem::path folder = case_folder("p2-pekeris-250");
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    const Environment e = sea_of(folder);
    FieldOptions options;
    options.sum = Sum::coherent;
    const Score s = score(e, wavenumber_field(e, options),
                          reference(folder / "csv" / "analytic_coh.csv.gz"), 0);
    EXPECT_LE(s.median, 0.01);
    EXPECT_LE(s.p95, 0.06);
}

}  // namespace
}  // namespace seautils::propagation
