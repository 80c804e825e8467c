// Environment files of the Acoustics Toolbox: the reference cases mean what their case.json says, and what Fortran's
// reading allows is allowed.
#include "seautils/core/error.hpp"
#include "seautils/propagation/case_file.hpp"
#include "seautils/toolbox/attenuation.hpp"
#include "seautils/toolbox/env_file.hpp"
#include "seautils/toolbox/env_writer.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace seautils::toolbox {

namespace {

namespace fs = std::filesystem;
namespace pg = propagation;

std::string content_of(const fs::path& path) {
    std::ostringstream all;
    all << std::ifstream(path).rdbuf();
    return all.str();
}

fs::path cases() {
    const char* shared = std::getenv("SEAUTILS_SHARED");
    return fs::path(shared != nullptr ? shared : SEAUTILS_SOURCE_DIR "/../shared") / "cases";
}

EnvFile read_path(const fs::path& path) {
    return read_env(content_of(path), [&](const std::string& extension) {
        fs::path other = path;
        other.replace_extension(extension);
        return fs::exists(other) ? std::optional(content_of(other)) : std::nullopt;
    });
}

EnvFile read(const std::string& text, const Files& files = {}) {
    return read_env(text, [&](const std::string& extension) {
        const auto at = files.find(extension);
        return at == files.end() ? std::nullopt : std::optional(at->second);
    });
}

std::string refusal(const std::string& text, const Files& files = {}) {
    try {
        read(text, files);
    } catch (const DataError& e) {
        return e.what();
    }
    return "accepted";
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-9 * (1 + std::abs(b[k])));
}

void expect_same_water(const pg::WaterColumn& a, const pg::WaterColumn& b) {
    EXPECT_EQ(a.interpolation, b.interpolation);
    ASSERT_EQ(a.profile.size(), b.profile.size());
    for (std::size_t k = 0; k < a.profile.size(); ++k) {
        EXPECT_EQ(a.profile[k].depth_m, b.profile[k].depth_m);
        EXPECT_EQ(a.profile[k].sound_speed_mps, b.profile[k].sound_speed_mps);
    }
    ASSERT_EQ(a.mesh.has_value(), b.mesh.has_value());
    if (a.mesh) {
        expect_near(a.mesh->range_m, b.mesh->range_m);
        EXPECT_EQ(a.mesh->depth_m, b.mesh->depth_m);
        EXPECT_EQ(a.mesh->sound_speed_mps, b.mesh->sound_speed_mps);
    }
    EXPECT_EQ(a.density_gcm3, b.density_gcm3);
    EXPECT_EQ(a.absorption.model, b.absorption.model);
    EXPECT_EQ(a.absorption.temperature_c, b.absorption.temperature_c);
    EXPECT_EQ(a.absorption.salinity, b.absorption.salinity);
    EXPECT_EQ(a.absorption.ph, b.absorption.ph);
    EXPECT_EQ(a.absorption.depth_m, b.absorption.depth_m);
}

void expect_same(const pg::Boundary& a, const pg::Boundary& b) {
    EXPECT_EQ(a.kind, b.kind);
    if (a.kind == pg::BoundaryKind::half_space) {
        EXPECT_EQ(a.sound_speed_mps, b.sound_speed_mps);
        EXPECT_EQ(a.shear_speed_mps, b.shear_speed_mps);
        EXPECT_EQ(a.density_gcm3, b.density_gcm3);
        EXPECT_EQ(a.attenuation_db_per_wavelength, b.attenuation_db_per_wavelength);
    }
    ASSERT_EQ(a.table.size(), b.table.size());
}

void expect_same(const std::optional<pg::Line>& a, const std::optional<pg::Line>& b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) return;
    EXPECT_EQ(a->curved, b->curved);
    expect_near(a->range_m, b->range_m);
    expect_near(a->depth_m, b->depth_m);
}

/// An environment for BELLHOP, each of whose lines can be another.
std::string env(const Files& lines) {
    std::string text;
    for (const auto& [key, value] : Files{{"1", "'Shelf'"},
                                          {"2", "1000.0"},
                                          {"3", "1"},
                                          {"4", "'CVW'"},
                                          {"5", "0 0.0 100.0"},
                                          {"6", "0 1500 /\n100 1510 /"},
                                          {"7", "'A' 0.0\n100 1700 0 1.8 0.5 /"},
                                          {"8", "1\n30 /\n3\n10 50 /\n4\n0.1 1.0 /"},
                                          {"9", "'IB'"},
                                          {"a", "0\n-80 80 /\n0 101 2"}})
        text += (lines.contains(key) ? lines.at(key) : value) + "\n";
    return text;
}

/// Sediment from 100 to 110 m.
Files layered(const std::string& rows) {
    return {{"3", "2"}, {"6", "0 1500 /\n100 1510 /\n0 0.3 110\n" + rows}};
}

}  // namespace

TEST(EnvFile, ReferenceCasesMeanWhatTheirCaseSays) {
    if (!fs::exists(cases())) GTEST_SKIP() << "no reference cases";
    int files = 0;
    for (const auto& folder : fs::directory_iterator(cases())) {
        if (!fs::exists(folder.path() / "case.json")) continue;
        const pg::Case c = pg::read_case(content_of(folder.path() / "case.json"));
        const pg::Environment& b = c.environment;
        for (const auto& entry : fs::directory_iterator(folder.path() / "env")) {
            if (entry.path().extension() != ".env") continue;
            SCOPED_TRACE(entry.path().string());
            const std::string name = entry.path().stem().string();
            const EnvFile file = read_path(entry.path());
            const pg::Environment& a = file.environment;
            EXPECT_EQ(a.frequency_hz, b.frequency_hz);
            expect_near(file.source_depth_m, {b.source.depth_m});
            expect_same_water(a.water, b.water);
            expect_same(a.surface, b.surface);
            expect_same(a.bottom, b.bottom);
            expect_same(a.surface_line, b.surface_line);
            expect_same(a.bottom_line, b.bottom_line);
            EXPECT_EQ(a.bottom_depth_m, b.bottom_depth_m);
            const pg::Receivers& wanted = name == "arrivals" ? *c.arrivals : b.receivers;
            expect_near(a.receivers.depth_m, wanted.depth_m);
            expect_near(a.receivers.range_m, wanted.range_m);
            EXPECT_EQ(file.arrivals, name == "arrivals");
            if (name.starts_with("bellhop")) {
                EXPECT_EQ(a.fan.least_deg, b.fan.least_deg);
                EXPECT_EQ(a.fan.most_deg, b.fan.most_deg);
                EXPECT_EQ(a.source.pattern.size(), b.source.pattern.size());
                EXPECT_EQ(file.options.beam,
                          name.find("hat") != name.npos ? pg::Beam::hat : pg::Beam::gaussian);
                EXPECT_EQ(file.options.sum, name.find("_inc") != name.npos ? pg::Sum::incoherent
                                            : name.find("_semi") != name.npos
                                                ? pg::Sum::semi_coherent
                                                : pg::Sum::coherent);
            }
            EXPECT_TRUE(file.remarks.empty());
            ++files;
        }
    }
    EXPECT_GT(files, 0);
}

TEST(EnvFile, ListDirectedReading) {
    const EnvFile file = read(
        "Shelf ! a comment\n"
        "  1.0D3, ignored\r\n"
        "1 ! NMEDIA\n"
        "'CVW' ! options\n"
        "2*0.0\n"  // NMESH and SIGMA, and the depth on the next line
        "100.0 and more\n"
        "0 1500 ,, 1.02 /\n"
        "50 , 1505 /\n"
        "100,1510,/\n"
        "\"A\" 0\n"
        "100 1700 0 1.8\n"
        "5.e-1 0\n"
        "1\n 30 /\n 3\n 50 10 30\n 4\n 0.57 /\n'IB'\n0\n2*-45+0 / \n0 0 0\n");
    const pg::Environment& e = file.environment;
    EXPECT_EQ(e.title, "Shelf");
    EXPECT_EQ(e.frequency_hz, 1000);
    EXPECT_EQ(e.bottom_depth_m, 100);
    ASSERT_EQ(e.water.profile.size(), 3U);
    EXPECT_EQ(e.water.density_gcm3, 1.02);
    EXPECT_EQ(e.water.profile[1].sound_speed_mps, 1505);
    EXPECT_EQ(e.bottom.attenuation_db_per_wavelength, 0.5);
    EXPECT_EQ(e.receivers.depth_m, (std::vector<double>{10, 30, 50}));
    EXPECT_EQ(e.receivers.range_m, (std::vector<double>{570}));
    EXPECT_EQ(e.fan.least_deg, -45);
    EXPECT_EQ(file.remarks.size(), 1U);  // four ranges were the same one
}

TEST(EnvFile, RowsInheritWhatTheyLeaveOut) {
    const EnvFile file = read(env({{"6", "0 1500 0 1.03 /\n40 /\n100 1510 /"},
                                   {"7", "'A' 0.2\n100 1700 300 1.8 0.5 1.5 /"}}));
    EXPECT_EQ(file.environment.water.density_gcm3, 1.03);
    EXPECT_EQ(file.environment.water.profile[1].sound_speed_mps, 1500);
    EXPECT_EQ(file.environment.bottom.shear_attenuation_db_per_wavelength, 1.5);
    EXPECT_EQ(file.environment.bottom.roughness_m, 0.2);
    const EnvFile bottom =
        read(env({{"6", "0 1500 0 1.03 /\n100 1510 /"}, {"7", "'A' 0\n100 1600 /"}}));
    EXPECT_EQ(bottom.environment.bottom.density_gcm3, 1.03);
}

TEST(EnvFile, MediaBelowTheWaterAreLayers) {
    const EnvFile file = read(env({{"3", "3"},
                                   {"4", "'CVM'"},
                                   {"6",
                                    "0 1500 /\n100 1510 /\n0 0.3 110\n100 1550 0 1.4 0.2 /\n"
                                    "104 1600 /\n110 /\n0 0 130\n110 1700 0 1.8 0.4 /\n130 /"},
                                   {"7", "'A' 0\n130 2000 900 2.1 0.1 0.3 /"}}));
    const pg::Boundary& b = file.environment.bottom;
    EXPECT_EQ(file.environment.bottom_depth_m, 100);
    EXPECT_EQ(b.sound_speed_mps, 2000);
    EXPECT_EQ(b.shear_speed_mps, 900);
    EXPECT_EQ(b.roughness_m, 0.3);  // where the water ends
    ASSERT_EQ(b.layers.size(), 3U);
    const std::vector<std::vector<double>> wanted{{4, 1550, 1600, 1.4, 0.2 * (1.55 + 1.6) / 2},
                                                  {6, 1600, 1600, 1.4, 0.2 * 1.6},
                                                  {20, 1700, 1700, 1.8, 0.4 * 1.7}};
    for (std::size_t k = 0; k < 3; ++k) {
        const pg::SedimentLayer& l = b.layers[k];
        expect_near({l.thickness_m, l.sound_speed_top_mps, l.sound_speed_bottom_mps, l.density_gcm3,
                     l.attenuation_db_per_wavelength},
                    wanted[k]);
    }
    EXPECT_TRUE(file.remarks.empty());
}

TEST(EnvFile, DensityThatChangesTakesSteps) {
    const EnvFile file = read(env(layered("100 1550 0 1.5 /\n110 1600 0 1.6 /")));
    const std::vector<pg::SedimentLayer>& layers = file.environment.bottom.layers;
    ASSERT_EQ(layers.size(), 2U);
    expect_near({layers[0].density_gcm3, layers[1].density_gcm3}, {1.525, 1.575});
    expect_near({layers[0].thickness_m, layers[0].sound_speed_bottom_mps}, {5, 1575});
}

TEST(EnvFile, RoughnessBelowLayersIsRemarked) {
    Files lines = layered("100 1550 /\n110 1600 /");
    lines["7"] = "'A' 0.1\n110 1700 0 1.8 0.5 /";
    EXPECT_EQ(read(env(lines)).remarks,
              (std::vector<std::string>{"the roughness below the first layer is left alone"}));
    std::string rows = "100 1550 /\n";
    for (int k = 1; k <= 1001; ++k) rows += std::to_string(100 + k * 0.009) + " /\n";
    EXPECT_EQ(refusal(env(layered(rows))), "line 1010: the bottom has more than 1000 layers");
}

TEST(EnvFile, Companions) {
    const EnvFile file = read(env({{"4", "'QFM ~'"},
                                   {"6", "0 1500 /\n50 1505 /\n100 1510 /"},
                                   {"7", "'F~' 0.0"},
                                   {"9", "'CG*X'"}}),
                              {{"trc", "2\n0 1 180\n90 0.5 170\n"},
                               {"ati", "'C'\n2\n0 0\n1 0.5\n"},
                               {"ssp", "2\n0 2.5\n1500 1501\n1505 1506\n1510 1511\n"},
                               {"brc", "3\n0 1 180 45 0.5 90\n20 0.9 100\n90 0.1 0\n"},
                               {"bty", "'LS'\n3\n-1 100\n0 90\n2.5 80\n"},
                               {"sbp", "2\n-90 -20\n90 0\n"}});
    const pg::Environment& e = file.environment;
    EXPECT_EQ(e.surface.table[1].magnitude, 0.5);
    EXPECT_TRUE(e.surface_line->curved);
    EXPECT_EQ(e.surface_line->range_m[1], 1000);
    EXPECT_EQ(e.water.mesh->range_m[1], 2500);
    EXPECT_EQ(e.water.mesh->sound_speed_mps,
              (std::vector<double>{1500, 1501, 1505, 1506, 1510, 1511}));
    EXPECT_EQ(e.bottom.table.size(), 3U);
    EXPECT_EQ(e.bottom.table[1].grazing_deg, 20);  // what is behind a row is ignored
    EXPECT_EQ(e.bottom_line->depth_m, (std::vector<double>{100, 90, 80}));
    EXPECT_EQ(e.source.pattern[0].level_db, -20);
    EXPECT_TRUE(e.source.line);
    EXPECT_EQ(file.options.beam, pg::Beam::hat);
    EXPECT_EQ(file.options.sum, pg::Sum::coherent);
}

TEST(EnvFile, OutsideOfTheWaterIsClampedAndSaid) {
    const EnvFile file = read(env({{"8", "2\n-3 30\n3\n10 500 /\n1\n1 /"}}));
    EXPECT_EQ(file.source_depth_m, (std::vector<double>{0, 30}));
    EXPECT_EQ(file.environment.receivers.depth_m, (std::vector<double>{10, 100}));
    ASSERT_EQ(file.remarks.size(), 1U);
}

TEST(EnvFile, ReceiversMayBePairs) {
    const EnvFile file =
        read(env({{"8", "1\n30 /\n3\n50 500 50 /\n3\n1.0 0.1 1.0 /"}, {"9", "'CB  I'"}}));
    const pg::Receivers wanted{{50, 100, 50}, {1000, 100, 1000}, true};  // as they come, clamped
    EXPECT_EQ(file.environment.receivers, wanted);
    const auto again = write_bellhop(file.environment, file.options, false);
    EXPECT_EQ(read(again.at("env"), again).environment.receivers, wanted);
    EXPECT_FALSE(read(env({{"9", "'CB  R'"}})).environment.receivers.pairs);
}

TEST(EnvFile, UnitsOfAttenuation) {
    // 0.1 neper a metre over a wavelength of 1.5 m is 0.15 * 20 lg e dB; a quality factor of 50 is pi / 50 nepers.
    EXPECT_NEAR(attenuation_db_per_wavelength('N', 0.1, 1500, 1000), 1.302883, 1e-6);
    EXPECT_NEAR(attenuation_db_per_wavelength('F', 0.2, 1500, 1000), 0.3, 1e-12);
    EXPECT_NEAR(attenuation_db_per_wavelength('M', 0.2, 1500, 1000), 0.3, 1e-12);
    EXPECT_NEAR(attenuation_db_per_wavelength('W', 0.8, 1500, 1000), 0.8, 1e-12);
    EXPECT_NEAR(attenuation_db_per_wavelength('Q', 50, 1500, 1000), 0.545751, 1e-6);
    EXPECT_NEAR(attenuation_db_per_wavelength('L', 0.01, 1500, 1000), 0.545751, 1e-6);
    EXPECT_EQ(read(env({{"4", "'CVM'"}})).environment.bottom.attenuation_db_per_wavelength,
              0.5 * 1.7);
}

TEST(EnvFile, RefusalsAreLocated) {
    const std::vector<std::pair<Files, std::string>> all = {
        {{{"2", "fast"}}, "line 2: frequency 'fast' is not a number"},
        {{{"3", "0"}}, "line 3: NMEDIA '0' is not a whole number of 1 to 1000000"},
        {{{"3", "2"}}, "line 8: NMESH 'A' is not a number"},
        {layered("100 1550 /\n101 1600 90 /"),
         "line 10: medium 2 has a shear speed of 90 m/s: only the lowest half-space may"},
        {layered("101 1550 /\n110 1600 /"),
         "line 9: depth 101 is not the 100 m where medium 2 begins"},
        {layered("100 1550 /\n100 1600 /"), "line 10: depth 100 is not below the 100 m before it"},
        {layered("100 1550 /\n111 1600 /"),
         "line 10: depth 111 is below the 110 m where medium 2 ends"},
        {{{"4", "'XVW'"}}, "line 4: TOPOPT 'XVW    ': letter 1 is none of C, N, P, S, Q"},
        {{{"4", "'CVWB'\n0"}}, "line 4: TOPOPT 'CVWB   ': letter 4 is none of blank, T, F"},
        {{{"4", "'CVW ~'"}}, "TOPOPT asks for a .ati file, which is not there"},
        {{{"6", "0 1500 /\n120 1510 /"}}, "line 7: depth 120 is below the bottom's 100 m"},
        {{{"6", "0 1500 100 /\n100 1510 /"}}, "line 6: the water has a shear speed of 100 m/s"},
        {{{"7", "'Z' 0"}}, "line 8: BOTOPT 'Z ': letter 1 is none of V, R, A, F, G"},
        {{{"8", "0\n/\n3\n10 50 /\n4\n0.1 1 /"}},
         "line 10: the number of source depth '0' is not a whole number of 1 to 1000000"},
        {{{"8", "1\n30 /\n3\n/\n4\n0.1 1 /"}}, "line 13: receiver depth: there are 0 of 3 values"},
        {{{"8", "1\n30 /\n5\n1 2 3 /\n4\n0.1 1 /"}},
         "line 13: receiver depth: there are 3 of 5 values"},
        {{{"8", "1\n30 /\n3\n1,,3 /\n4\n0.1 1 /"}}, "line 13: receiver depth: value 2 is left out"},
        {{{"9", "'RB'"}}, "line 16: RUNTYPE 'RB     ': rays are no result"},
        {{{"9", "'IB  I'"}},
         "line 16: RUNTYPE 'IB  I  ': NRZ 3 is not NRR 4, so that receivers are no pairs"},
        {{{"a", ""}}, "line 18: the file ends where NBEAMS is expected"},
        {{{"1", "'open"}}, "line 1: the quotes of the title are not closed"},
        {{{"2", "0*5"}}, "line 2: frequency cannot be there '0' times"},
    };
    for (const auto& [lines, what] : all) EXPECT_EQ(refusal(env(lines)), what);
    EXPECT_EQ(refusal(env({{"7", "'A~' 0\n100 1700 /"}}), {{"bty", "'L'\n2\n0 100\n"}}),
              "the .bty file: line 4: the file ends where range is expected");
}

}  // namespace seautils::toolbox
