// Modes and wavenumber integration: against closed forms, against each other, and at the edge of what they can do.
#include "seautils/propagation/modes.hpp"

#include "propagation_seas.hpp"
#include "seautils/propagation/hankel.hpp"
#include "seautils/propagation/mode_search.hpp"
#include "seautils/propagation/reflection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

constexpr double pi = std::numbers::pi;
using Complex = std::complex<double>;

/// The modes of a sea as they are searched for.
ModeSet modes_of(const Environment& e, double least_speed_mps, std::size_t steps) {
    const Column column(e);
    const Edge surface(e.surface, "surface", e.frequency_hz, e.water.density_gcm3);
    const Edge bottom(e.bottom, "bottom", e.frequency_hz, e.water.density_gcm3);
    const double omega = 2 * pi * e.frequency_hz;
    return find_modes({column, surface, bottom, omega, 0},
                      omega * omega / (least_speed_mps * least_speed_mps), steps, {10});
}

/// dB between two fields, where both have something: its median and 95th percentile.
struct Difference {
    double median = 0, p95 = 0;
};
Difference difference(const Environment& e, const Field& a, const Field& b, double least_range_m) {
    std::vector<double> d;
    for (std::size_t k = 0; k < a.loss_db.size(); ++k)
        if (e.receivers.range_m[k % a.ranges] >= least_range_m)
            d.push_back(std::abs(a.loss_db[k] - b.loss_db[k]));
    std::sort(d.begin(), d.end());
    return {d[d.size() / 2], d[d.size() * 95 / 100]};
}

void expect_engines_agree(const Environment& e, double least_range_m, const char* what) {
    const Difference d =
        difference(e, mode_field(e, coherent()), wavenumber_field(e, coherent()), least_range_m);
    EXPECT_LT(d.median, 0.02) << what;
    EXPECT_LT(d.p95, 0.2) << what;
}

TEST(PropagationModes, OfPekerisAreThoseOfItsEquation) {
    Environment e = pekeris();
    e.bottom.attenuation_db_per_wavelength = 0;
    const ModeSet set = modes_of(e, 1699.9, 300);
    ASSERT_EQ(set.modes.size(), 16U);
    // Roots of sin(γD) √(k² - k2²) / m + γ cos(γD), found independently.
    constexpr double printed[]{1.0467587796, 1.0454405660, 1.0432373099, 1.0401399685,
                               1.0361363991};
    for (std::size_t m = 0; m < 5; ++m)
        EXPECT_NEAR(std::sqrt(set.modes[m].xi).real(), printed[m], 1e-10);
    EXPECT_NEAR(std::sqrt(set.modes[15].xi).real(), 0.9266745618, 2e-9);
    EXPECT_NEAR(std::sqrt(set.modes[15].xi).imag(), 0, 1e-12);
}

TEST(PropagationModes, BetweenPerfectBoundariesAreSines) {
    for (const bool rigid : {false, true}) {
        Environment e = pekeris();
        e.bottom.kind = rigid ? BoundaryKind::rigid : BoundaryKind::vacuum;
        const ModeSet set = modes_of(e, 1e4, 200);
        const double k = 2 * pi * 250 / 1500;
        ASSERT_GT(set.modes.size(), 30U);
        for (std::size_t m = 0; m < 20; ++m) {
            const double across = (static_cast<double>(m) + (rigid ? 0.5 : 1)) * pi / 100;
            EXPECT_NEAR(set.modes[m].xi.real(), k * k - across * across, 1e-6) << m;
            EXPECT_NEAR(std::abs(set.modes[m].values[0]),
                        std::abs(std::sqrt(2.0 / 100) * std::sin(across * 10)), 1e-4)
                << m;
        }
    }
}

TEST(PropagationModes, AgreeWithWavenumbers) {
    expect_engines_agree(pekeris(), 100, "Pekeris");
    Environment e = pekeris();
    e.bottom.kind = BoundaryKind::rigid;
    e.water.absorption = {AbsorptionModel::fixed, 10, 35, 8, 0, 3};
    expect_engines_agree(e, 300, "rigid, absorbing");
    e = pekeris();
    e.bottom.shear_speed_mps = 500;
    e.bottom.shear_attenuation_db_per_wavelength = 0.5;
    expect_engines_agree(e, 300, "elastic");
    e = pekeris();
    e.surface.roughness_m = 0.5;
    expect_engines_agree(e, 300, "rough surface");
    e = pekeris();
    // Two ducts, and a slow bottom.
    e.water.profile = {{0, 1490}, {30, 1520}, {45, 1515}, {70, 1480}, {100, 1510}};
    expect_engines_agree(e, 300, "two ducts");
    e.water.interpolation = SpeedInterpolation::n2_linear;
    expect_engines_agree(e, 300, "n2-linear");
    e.bottom = half_space(1450, 1.6, 0.3);
    expect_engines_agree(e, 1000, "slow bottom");
}

/// Two ways to one field: they differ by no more than both say that they may be amiss by, twice, and
/// they do not say much more than that.
TEST(PropagationModes, EstimatedErrorsHold) {
    for (const double frequency_hz : {60., 250.}) {
        Environment e = pekeris();
        e.frequency_hz = frequency_hz;
        e.water.profile = {{0, 1515}, {40, 1500}, {100, 1490}};
        e.receivers.range_m = {};
        for (int k = 0; k < 200; ++k) e.receivers.range_m.push_back(1000 + 20 * k);
        const Field modes = mode_field(e, coherent()), waves = wavenumber_field(e, coherent());
        const double allowed_db =
            2 * (modes.basis.estimated_error_db + waves.basis.estimated_error_db);
        EXPECT_LT(difference(e, modes, waves, 0).p95, allowed_db);
        EXPECT_GT(waves.basis.estimated_error_db, 0);
        EXPECT_LT(allowed_db, 0.3);
    }
}

TEST(PropagationModes, DoNotDependOnHowAProfileIsWritten) {
    Environment e = pekeris();
    e.water.profile = {{0, 1520}, {37, 1480}, {100, 1500}};
    Environment same = e;
    same.water.profile.clear();
    for (int k = 0; k <= 3000; ++k) {
        const double z = k / 30.0;
        same.water.profile.push_back({z, z < 37 ? 1520 - 40 * z / 37 : 1480 + 20 * (z - 37) / 63});
    }
    const Difference d = difference(e, mode_field(e, coherent()), mode_field(same, coherent()), 0);
    EXPECT_LT(d.p95, 1e-3);
}

TEST(PropagationModes, AreReciprocal) {
    Environment e = pekeris();
    e.water.profile = {{0, 1520}, {37, 1480}, {100, 1500}};
    e.receivers.depth_m = {71};
    Environment back = e;
    back.source.depth_m = 71;
    back.receivers.depth_m = {36};
    const Field a = mode_field(e, coherent()), b = mode_field(back, coherent());
    for (std::size_t k = 0; k < a.loss_db.size(); ++k)
        EXPECT_NEAR(a.loss_db[k], b.loss_db[k], 2e-3);
}

TEST(PropagationWavenumber, OfTheLloydMirrorIsItsClosedForm) {
    Environment e = pekeris();
    e.frequency_hz = 100;
    e.source.depth_m = 25;
    e.bottom = half_space(1500, 1, 0);
    e.bottom_depth_m = 200;
    e.receivers.depth_m = {10, 60, 150};
    e.receivers.range_m = {100, 300, 700, 1500};
    const Field field = wavenumber_field(e, coherent());
    const double k = 2 * pi * 100 / 1500;
    for (std::size_t z = 0; z < 3; ++z)
        for (std::size_t r = 0; r < 4; ++r) {
            const double range = e.receivers.range_m[r], depth = e.receivers.depth_m[z];
            const double direct = std::hypot(range, depth - 25),
                         image = std::hypot(range, depth + 25);
            // exp(-i(ωτ - φ)): the Acoustics Toolbox's convention.
            const Complex exact =
                std::polar(1 / direct, -k * direct) - std::polar(1 / image, -k * image);
            const Complex got(field.pressure[z * 4 + r]);
            EXPECT_LT(std::abs(got - exact), 2e-2 * std::abs(exact) + 2e-5)
                << range << ' ' << depth;
        }
}

TEST(PropagationEdge, ReflectsAsThePlaneWaveCoefficient) {
    Boundary elastic = half_space(2400, 2, 0.3);
    elastic.shear_speed_mps = 900;
    elastic.shear_attenuation_db_per_wavelength = 0.6;
    Boundary rough = half_space(1600, 1.5, 0.4);
    rough.roughness_m = 0.8;
    for (const Boundary& b :
         {half_space(1700, 1.8, 0.5), half_space(1450, 1.4, 0.1), elastic, rough}) {
        const Edge edge(b, "bottom", 250, 1.03);
        const double k = 2 * pi * 250 / 1500;
        for (double deg = 1; deg < 90; deg += 4) {
            const double grazing = deg * pi / 180, across = k * std::sin(grazing);
            const double along = k * std::cos(grazing);
            const Complex g = edge.admittance(along * along, k * k), i(0, 1);
            const Complex r = (i * across + g) / (i * across - g);
            const Complex expected = reflection_coefficient(b, 250, grazing, 1500, 1.03);
            // They differ in the square of what is lost in a radian.
            EXPECT_LT(std::abs(std::conj(r) - expected), 3e-3) << deg;
        }
    }
}

TEST(PropagationHankel, IsAsTabulated) {
    const auto hankel = [](double x) { return hankel_over_exp(x) * std::exp(Complex(0, x)); };
    EXPECT_LT(std::abs(hankel(1) - Complex(0.765197687, 0.088256964)), 1e-8);
    EXPECT_LT(std::abs(hankel(0.1) - Complex(0.997501562, -1.534238651)), 1e-8);
    EXPECT_LT(std::abs(hankel(10) - Complex(-0.245935764, 0.055671167)), 1e-7);
    EXPECT_LT(std::abs(hankel(200) - Complex(-0.015437438, -0.054265775)), 1e-8);
    // K0(10) = π i/2 H(10 i)
    EXPECT_LT(std::abs(hankel_over_exp(Complex(0, 10)) * std::exp(-10.0) * Complex(0, pi / 2) -
                       1.7780062316e-5),
              1e-12);
    EXPECT_LT(std::abs(hankel(8.999) / hankel(9.001) - 1.0), 3e-3);
}

TEST(PropagationColumn, SamplesKeepTheIntegralOfAProfile) {
    Environment e = pekeris();
    e.water.profile = {{10, 1500}, {12, 1520}, {13, 1490}, {60, 1500}};
    const Column column(e);
    // Trapezoids over 1e5 spans of the profile itself, and the rule of Numerov's scheme over 50.
    const auto q = [&](double z) { return column.squared_slowness(z); };
    double exact = 0;
    for (int k = 0; k < 100000; ++k) exact += q((k + 0.5) / 1000) / 1000;
    const std::vector<double> sampled = column.sampled(50);
    double sum = 0;
    for (std::size_t k = 1; k < 50; ++k)
        sum += 2 * (sampled[k - 1] + 10 * sampled[k] + sampled[k + 1]) / 12;
    // The triangles leave half of the first and of the last span; it is constant there.
    sum += 2 * (q(0) + q(100)) / 2;
    EXPECT_NEAR(sum / exact, 1, 1e-8);
}

TEST(PropagationColumn, ASplineKeepsACubicAndMonotoneSlopesDoNotOvershoot) {
    Environment e = pekeris();
    const auto cubic = [](double z) { return 1500 + 0.3 * z - 0.01 * z * z + 6e-5 * z * z * z; };
    e.water.profile.clear();
    for (const double z : {0.0, 10.0, 35.0, 60.0, 100.0}) e.water.profile.push_back({z, cubic(z)});
    e.water.interpolation = SpeedInterpolation::spline;
    for (const double z : {1.0, 22.0, 50.0, 99.0})
        EXPECT_NEAR(1 / std::sqrt(Column(e).squared_slowness(z)), cubic(z), 1e-8) << z;
    e.water.profile = {{0, 1500}, {10, 1500}, {20, 1520}, {30, 1520}};
    e.water.interpolation = SpeedInterpolation::pchip;
    const Column column(e);
    for (double z = 0; z <= 30; z += 0.5) {
        const double c = 1 / std::sqrt(column.squared_slowness(z));
        EXPECT_GE(c, 1500 - 1e-9);
        EXPECT_LE(c, 1520 + 1e-9);
    }
}

std::string refusal(Field (*engine)(const Environment&, const FieldOptions&), const Environment& e,
                    const FieldOptions& o) {
    try {
        engine(e, o);
    } catch (const DataError& error) {
        return error.what();
    }
    return "";
}

TEST(PropagationModes, RefuseWhatTheyCannotByName) {
    const FieldOptions o = coherent();
    Environment e = pekeris();
    e.bottom_line = Line{false, {0, 1000}, {100, 120}};
    EXPECT_EQ(refusal(mode_field, e, o), "modes: the sea depends on range (rays can)");
    EXPECT_EQ(refusal(wavenumber_field, e, o), "wavenumber: the sea depends on range (rays can)");
    e = pekeris();
    e.source.pattern = {{0, 0}};
    EXPECT_EQ(refusal(mode_field, e, o), "modes: source.pattern is not empty (rays can)");
    e = pekeris();
    e.bottom.kind = BoundaryKind::table;
    e.bottom.table = {{0, 1, 180}, {90, 0.5, 0}};
    EXPECT_EQ(refusal(mode_field, e, o), "bottom.table: modes and wavenumbers need a half-space");
    e = pekeris();
    e.bottom = half_space(1500, 1, 0);
    EXPECT_NE(refusal(mode_field, e, o).find("reflects nothing"), std::string::npos);
    e = pekeris();
    e.frequency_hz = 1e6;
    EXPECT_NE(refusal(mode_field, e, o).find("more than"), std::string::npos);
    EXPECT_NE(refusal(wavenumber_field, e, o).find("more work than"), std::string::npos);
}

TEST(PropagationModes, AnswerAtTheEdge) {
    for (const double hz : {0.1, 1.0, 250.0})
        for (const double source : {0.0, 50.0, 100.0}) {
            Environment e = pekeris();
            e.frequency_hz = hz;
            e.source.depth_m = source;
            e.receivers.depth_m = {-5, 0, 50, 100, 101};
            e.receivers.range_m = {0, 10, 1000};
            for (const Field& f : {mode_field(e, coherent()), wavenumber_field(e, coherent())}) {
                for (const std::size_t none : {0U, 1U, 2U, 3U, 6U, 12U, 13U})
                    EXPECT_TRUE(std::isnan(f.loss_db[none])) << none;
                for (const std::size_t some : {4U, 7U, 8U, 10U, 11U})
                    EXPECT_FALSE(std::isnan(f.loss_db[some])) << hz << ' ' << source << ' ' << some;
            }
        }
    Environment e = pekeris();
    e.water.profile.clear();
    for (int k = 0; k < 200000; ++k)
        e.water.profile.push_back({k / 2000.0, 1500 + (k % 2 == 0 ? 20.0 : -20.0)});
    EXPECT_TRUE(std::isfinite(mode_field(e, coherent()).loss_db[10]));
}

TEST(PropagationEngine, IsChosenByHowManyModesThereAre) {
    Environment e = pekeris();
    EXPECT_EQ(choose_engine(e, coherent()).engine, Engine::modes);
    EXPECT_EQ(choose_engine(e, coherent()).why,
              "the water is 16.7 wavelengths deep, not more than 30");
    EXPECT_EQ(choose_engine(e, {}).engine, Engine::rays);
    EXPECT_EQ(choose_engine(e, {}).why, "intensities are summed");
    e.frequency_hz = 500;
    EXPECT_EQ(choose_engine(e, coherent()).engine, Engine::rays);
    e = pekeris();
    e.fan.beams = 1000;
    EXPECT_EQ(choose_engine(e, coherent()).engine, Engine::rays);
    e = pekeris();
    e.bottom = half_space(1500, 1, 0);
    EXPECT_EQ(choose_engine(e, coherent()).why, "the boundaries hold no modes");
    e = pekeris();
    const Field f = compute_field(e, Engine::automatic, coherent());
    EXPECT_EQ(f.basis.engine, Engine::modes);
    EXPECT_GT(f.basis.modes, 16U);
    EXPECT_EQ(name(f.basis.engine), "modes");
}

}  // namespace
}  // namespace seautils::propagation
