// What OAST of OASES is fed, and what it leaves, after its user guide (version 3.1).
#include "seautils/core/error.hpp"
#include "seautils/toolbox/oast_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace seautils::toolbox {
namespace {

namespace pg = propagation;

/// The layout of the guide's section on mplot, with a second plot: one over range, one over depth.
const std::string parameters =
    "     1024                                 MODULO\n"
    " FIPP  STLRAN,CPX,IYA\n"
    " TRANSMISSION LOSS\n"
    " SAFARI-FIP case 3.\n"
    "        2                                 NUMBER OF LABELS\n"
    " Freq:   30.0 Hz$\n"
    " SD:     50.0 m$\n"
    "      20.000000                          XLEN\n"
    "      12.000000                          YLEN\n"
    "        0                                 GRID TYPE\n"
    "     0.000000                             XLEFT\n"
    "      5.00000                             XRIGHT\n"
    "      1.00000                             XINC\n"
    "      1.00000                             XDIV\n"
    " Range (km)$\n"
    " LIN\n"
    "      80.0000                             YDOWN\n"
    "      20.0000                             YUP\n"
    "      10.0000                             YINC\n"
    "      1.00000                             YDIV\n"
    " Normal stress (dB//1Pa)$\n"
    " LIN\n"
    "         1                                NC\n"
    "         3                                N\n"
    "         0.044957                         XMIN\n"
    "     0.449567-001                         DX\n"
    "     0.000000                             YMIN\n"
    "         0.000000                         DY\n";
const std::string end = " FIP   PLTEND\n";

/// The same over depth: the first plot with another axis.
std::string over_depth() {
    std::string other = parameters.substr(parameters.find('\n') + 1);
    other.replace(other.find("Range (km)"), 10, "Depth (m) ");
    return other;
}

TEST(OastFile, PlotsOverRangeAreRead) {
    const auto plots =
        read_plots(parameters + over_depth() + end, "  0.402800E+02   4.5D1  \n 50.5\n 1 2 3\n");
    ASSERT_EQ(plots.size(), 1U);
    EXPECT_DOUBLE_EQ(plots[0].first, 0.044957);
    EXPECT_DOUBLE_EQ(plots[0].step, 0.0449567);
    EXPECT_EQ(plots[0].y, (std::vector<double>{40.28, 45, 50.5}));
    EXPECT_DOUBLE_EQ(value_at(plots[0], 0.044957), 40.28);
    EXPECT_NEAR(value_at(plots[0], 0.044957 + 1.5 * 0.0449567), 47.75, 1e-12);
    EXPECT_TRUE(std::isnan(value_at(plots[0], 0.04)));
    EXPECT_THROW(value_at(plots[0], 0.2), DataError);
}

TEST(OastFile, RefusalsAreLocated) {
    const auto refusal = [](const std::string& plp, const std::string& plt) -> std::string {
        try {
            read_plots(plp, plt);
        } catch (const DataError& e) {
            return e.what();
        }
        return "accepted";
    };
    const auto changed = [](const char* from, const char* to) {
        std::string text = parameters + end;
        return text.replace(text.find(from), std::string(from).size(), to);
    };
    EXPECT_EQ(refusal(parameters + end, "1 2"), "the .plt file: it ends before value 3");
    EXPECT_EQ(refusal(parameters + end, "1 2 NaN"),
              "the .plt file: value 3: 'NaN' is not a number");
    EXPECT_EQ(refusal(parameters + end, "1 2 ****"),
              "the .plt file: value 3: '****' is not a number");
    EXPECT_EQ(refusal(parameters + end, "1 2 3 4"), "the .plt file: there are more than 3 values");
    EXPECT_EQ(refusal(parameters, "1 2 3"),
              "the .plp file: line 29: it ends where a plot, or PLTEND, is expected");
    EXPECT_EQ(refusal(changed("         3   ", "1e99"), "1 2 3"),
              "the .plp file: line 24: N 1e+99 is not a whole number of 0 to 20000000");
    EXPECT_EQ(refusal(changed("0.449567-001", "0"), "1 2 3"),
              "the .plp file: line 28: a curve is not over equal steps of its x axis");
    EXPECT_EQ(refusal(changed("1024", "many"), ""),
              "the .plp file: line 1: MODULO 'many' is not a number");
    EXPECT_EQ(refusal("", ""), "the .plp file: line 1: it ends where MODULO is expected");
}

pg::Environment sea() {
    pg::Environment e;
    e.title = "A sea\nof two lines";
    e.frequency_hz = 100;
    e.source.depth_m = 30;
    e.receivers = {{10, 20}, {1000, 5000}};
    e.water.profile = {{0, 1500}, {50, 1488}, {100, 1488}};
    e.bottom.kind = pg::BoundaryKind::half_space;
    e.bottom.sound_speed_mps = 1800;
    e.bottom.shear_speed_mps = 600;
    e.bottom.density_gcm3 = 2;
    e.bottom.attenuation_db_per_wavelength = 0.1;
    e.bottom.shear_attenuation_db_per_wavelength = 0.2;
    e.bottom.layers = {{20, 1600, 1620, 1.8, 0.5}};
    e.bottom_depth_m = 100;
    return e;
}

/// Block by block as the guide has them; layers of the water change by no more than 5 m/s, 1/c² linear.
TEST(OastFile, IsFedInBlocks) {
    std::istringstream text(write_oast(sea(), {10, 20, 2}));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 17U);
    EXPECT_EQ(lines[0], "A sea of two lines");
    EXPECT_EQ(lines[1], "N T J");
    EXPECT_EQ(lines[2], "100 100 1 0");
    EXPECT_EQ(lines[3], "7");
    EXPECT_EQ(lines[4], "0 0 0 0 0 0 0");
    EXPECT_EQ(lines[5], "0 1500 -1496 0 0 1 0");
    EXPECT_EQ(lines[8], "50 1488 0 0 0 1 0");
    EXPECT_EQ(lines[9], "100 1600 -1620 0.5 0 1.8 0");
    EXPECT_EQ(lines[10], "120 1800 600 0.1 0.2 2 0");
    EXPECT_EQ(lines[11], "30");
    EXPECT_EQ(lines[12], "10 20 2 1");
    EXPECT_EQ(lines[13], "540 1E8");  // below the slowest, which is the shear wave
    EXPECT_EQ(lines[14], "-1 1 1");
    EXPECT_EQ(lines[15], "0 5 20 1");
}

TEST(OastFile, WhatCannotBeSaidIsRefusedByName) {
    const auto refusal = [](auto change) -> std::string {
        pg::Environment e = sea();
        change(e);
        try {
            write_oast(e, {10, 20, 2});
        } catch (const DataError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(refusal([](pg::Environment& e) { e.source.line = true; }),
              "oases: source.line is true");
    EXPECT_EQ(refusal([](pg::Environment& e) {
                  e.bottom_line = pg::Line{false, {0, 1000}, {100, 90}};
              }),
              "oases: the sea depends on range");
    EXPECT_EQ(refusal([](pg::Environment& e) { e.bottom.kind = pg::BoundaryKind::rigid; }),
              "oases: the bottom is no half-space");
    EXPECT_EQ(refusal([](pg::Environment& e) { e.bottom.roughness_m = 1; }),
              "oases: a boundary is rough");
    EXPECT_EQ(refusal([](pg::Environment& e) {
                  e.water.profile.clear();
                  for (int k = 0; k <= 500; ++k)
                      e.water.profile.push_back({0.2 * k, 1500. + k % 2});
              }),
              "oases: the water has more than 400 layers");
}

}  // namespace
}  // namespace seautils::toolbox
