// Formulas of the speed of sound against printed values, and against each other.
#include "seautils/acoustics/sound_speed.hpp"

#include "seautils/acoustics/seawater.hpp"
#include "seautils/core/error.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace seautils::acoustics {
namespace {

constexpr double printed = 0.0005;  ///< half of the last digit of a table of mm/s

/// A row of a table that was computed by other programs: water, and the speed by each formula in the
/// order of all_formulas. Depths are of the pressures, at 45 degrees.
struct Row {
    double salinity, temperature_c, pressure_dbar, mps[6];
};
constexpr Row table[]{
    {35, 0, 0, {1449.139, 1449.083, 1448.960, 1449.050, 1449.200, 1449.050}},
    {35, 10, 0, {1489.832, 1489.789, 1489.803, 1489.819, 1489.990, 1489.770}},
    {35, 20, 0, {1521.478, 1521.480, 1521.463, 1521.578, 1521.520, 1521.450}},
    {38, 14, 50, {1507.836, 1507.831, 1507.888, 1507.862, 1508.009, 1507.798}},
    {35, 4, 1000, {1483.080, 1482.764, 1482.781, 1482.695, 1482.571, 1482.840}},
    {34.6, 1.5, 6000, {1557.534, 1556.849, 1556.425, 1556.758, 1549.359, 1557.563}},
    {35, 25, 100, {1536.089, 1535.978, 1535.912, 1536.090, 1535.943, 1536.003}},
};

Water water_of(const Row& row) {
    return {row.temperature_c, row.salinity, row.pressure_dbar,
            depth_at_pressure_m(row.pressure_dbar, 45), 45};
}

/// Thousandths of a range, as a number of it.
double within(double least, double most) {
    return least + (most - least) * *rc::gen::inRange(0, 1001) / 1000;
}

/// Water for which a formula holds.
Water any_water(SpeedFormula formula) {
    const SpeedRange& r = range_of(formula);
    Water water;
    water.temperature_c = within(r.least_temperature_c, r.most_temperature_c);
    water.salinity = within(r.least_salinity, r.most_salinity);
    water.latitude_deg = within(-90, 90);
    const double vertical = within(0, r.most_vertical);
    water.pressure_dbar =
        r.by_pressure ? vertical : pressure_at_depth_dbar(vertical, water.latitude_deg);
    water.depth_m = r.by_pressure ? depth_at_pressure_m(vertical, water.latitude_deg) : vertical;
    return water;
}

}  // namespace

TEST(SoundSpeed, IsThatOfTheTable) {
    for (const Row& row : table)
        for (const SpeedFormula formula : all_formulas)
            EXPECT_NEAR(sound_speed(formula, water_of(row)).mps,
                        row.mps[static_cast<std::size_t>(formula)], printed)
                << name(formula) << " at " << row.temperature_c;
}

// UNESCO Technical Papers in Marine Science 44, algorithm 9; Mackenzie's own.
TEST(SoundSpeed, IsThatOfThePapers) {
    EXPECT_NEAR(chen_millero_68_mps(40, 40, 10000), 1731.995, printed);
    EXPECT_NEAR(mackenzie_mps(25, 35, 1000), 1550.744, printed);
}

// The coefficients for ITS-90 were fitted so that the speed stays the same, to some mm/s, when the scale
// changes.
TEST(SoundSpeed, TheTwoFormsOfChenAndMilleroAgree) {
    for (const Row& row : table)
        EXPECT_NEAR(
            chen_millero_mps(row.temperature_c, row.salinity, row.pressure_dbar),
            chen_millero_68_mps(to_ipts_68_c(row.temperature_c), row.salinity, row.pressure_dbar),
            0.005);
}

TEST(SoundSpeed, FormulasAgreeWhereAllHold) {
    EXPECT_TRUE(rc::check("formulas agree", [] {
        Water water;
        water.temperature_c = within(2, 25);
        water.salinity = within(33, 37);
        water.depth_m = within(0, 900);
        water.pressure_dbar = pressure_at_depth_dbar(water.depth_m, 45);
        const double best = sound_speed(SpeedFormula::del_grosso, water).mps;
        for (const SpeedFormula formula : all_formulas) {
            const SoundSpeed speed = sound_speed(formula, water);
            RC_ASSERT(!speed.extrapolated);
            RC_ASSERT(std::fabs(speed.mps - best) < 0.7);
        }
    }));
}

TEST(SoundSpeed, OutsideItsRangeItIsFlagged) {
    EXPECT_TRUE(rc::check("flagged", [] {
        const auto formula = all_formulas[*rc::gen::inRange<std::size_t>(0, all_formulas.size())];
        const SpeedRange& r = range_of(formula);
        Water water = any_water(formula);
        RC_ASSERT(!sound_speed(formula, water).extrapolated);
        double& vertical = r.by_pressure ? water.pressure_dbar : water.depth_m;
        const auto flagged = [&](double& value, double other) {
            const double before = value;
            value = other;
            RC_ASSERT(sound_speed(formula, water).extrapolated);
            value = before;
        };
        flagged(water.temperature_c, r.most_temperature_c + 0.01);
        flagged(water.temperature_c, r.least_temperature_c - 0.01);
        flagged(water.salinity, r.most_salinity + 0.01);
        flagged(water.salinity, r.least_salinity - 0.01);
        flagged(water.temperature_c, std::nan(""));
        flagged(vertical, r.most_vertical + 1);
        flagged(vertical, -1);
    }));
    EXPECT_TRUE(sound_speed(SpeedFormula::medwin, water_of(table[5])).extrapolated);
}

TEST(SoundSpeed, TemperatureIsFoundAgain) {
    EXPECT_TRUE(rc::check("inverse", [] {
        const auto formula = all_formulas[*rc::gen::inRange<std::size_t>(0, all_formulas.size())];
        const Water water = any_water(formula);
        const double mps = sound_speed(formula, water).mps;
        RC_ASSERT(std::fabs(temperature_at_speed_c(formula, mps, water) - water.temperature_c) <
                  1e-7);
    }));
    EXPECT_DOUBLE_EQ(temperature_at_speed_c(SpeedFormula::leroy, 1800, {}), 40);
    EXPECT_DOUBLE_EQ(temperature_at_speed_c(SpeedFormula::leroy, 1300, {}), -4);
}

TEST(SoundSpeed, NamesAreReadAgain) {
    for (const SpeedFormula formula : all_formulas)
        EXPECT_EQ(parse_formula(name(formula)), formula);
    EXPECT_THROW(parse_formula("wilson"), DataError);
    EXPECT_THROW(parse_formula(""), DataError);
}

}  // namespace seautils::acoustics
