// Layers of sediment: against closed forms, against water that has the same speeds, and engines against each other.
#include "propagation_seas.hpp"
#include "seautils/propagation/edge.hpp"
#include "seautils/propagation/mode_search.hpp"
#include "seautils/propagation/modes.hpp"
#include "seautils/propagation/reflection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace seautils::propagation {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi, hz = 250, water_mps = 1500, water_gcm3 = 1.03;

SedimentLayer layer(double thickness_m, double mps, double gcm3, double db) {
    return {thickness_m, mps, mps, gcm3, db};
}

Complex reflected(const Boundary& b, double deg) {
    return reflection_coefficient(b, hz, deg * pi / 180, water_mps, water_gcm3);
}

Boundary with(Boundary b, std::vector<SedimentLayer> layers) {
    b.layers = std::move(layers);
    return b;
}

TEST(Sediment, LikeTheHalfSpaceOrTheWaterChangesNothing) {
    const Boundary bare = half_space(1700, 1.8, 0.5);
    for (double deg = 1; deg < 90; deg += 2) {
        // Of any thickness: what decays must not become infinite.
        for (const double thickness_m : {1e-4, 3.0, 20000.0})
            EXPECT_LT(std::abs(reflected(with(bare, {layer(thickness_m, 1700, 1.8, 0.5)}), deg) -
                               reflected(bare, deg)),
                      1e-12)
                << deg << ' ' << thickness_m;
        const double phase = 2 * 2 * pi * hz / water_mps * std::sin(deg * pi / 180) * 7;
        EXPECT_LT(std::abs(reflected(with(bare, {layer(7, water_mps, water_gcm3, 0)}), deg) -
                           reflected(bare, deg) * std::polar(1.0, -phase)),
                  1e-12)
            << deg;
    }
}

/// Of one fluid layer, from the coefficients of its two boundaries (Brekhovskikh); time as exp(+iωt).
Complex of_one_layer(const SedimentLayer& l, const Boundary& below, double deg) {
    const auto wavenumber = [](double mps, double db) {
        return 2 * pi * hz / (mps * Complex(1, db / (40 * pi * std::log10(std::exp(1.0)))));
    };
    const double along = 2 * pi * hz / water_mps * std::cos(deg * pi / 180);
    const auto vertical = [&](Complex k) {
        Complex z = std::sqrt(k * k - along * along);
        return z.imag() > 0 ? -z : z;
    };
    const Complex z0 = water_gcm3 / vertical(2 * pi * hz / water_mps),
                  k1 = vertical(wavenumber(l.sound_speed_top_mps, l.attenuation_db_per_wavelength)),
                  z1 = l.density_gcm3 / k1,
                  z2 = below.density_gcm3 /
                       vertical(
                           wavenumber(below.sound_speed_mps, below.attenuation_db_per_wavelength));
    const Complex r01 = (z1 - z0) / (z1 + z0), r12 = (z2 - z1) / (z2 + z1),
                  turned = std::exp(Complex(0, -2) * k1 * l.thickness_m);
    return (r01 + r12 * turned) / (1.0 + r01 * r12 * turned);
}

TEST(Sediment, OfOneLayerIsItsClosedForm) {
    for (const SedimentLayer& l :
         {layer(4, 1480, 1.4, 0.1), layer(2.3, 1650, 1.9, 0.8), layer(40, 1800, 2, 0.3)})
        for (double deg = 0.5; deg < 90; deg += 1.5) {
            const Boundary below = half_space(2000, 2.1, 0.4);
            EXPECT_LT(std::abs(reflected(with(below, {l}), deg) - of_one_layer(l, below, deg)),
                      1e-12)
                << deg;
        }
}

TEST(Sediment, HalfAWaveIsNotThereAndAQuarterMatches) {
    const Boundary below = half_space(2000, 2.1, 0);
    // c / 2f thick: as if it were not there.
    EXPECT_LT(std::abs(reflected(with(below, {layer(1600 / (2 * hz), 1600, 1.7, 0)}), 90) -
                       reflected(below, 90)),
              1e-12);
    // A quarter: Z1² stands for Z2, R = (Z1² - Z0 Z2) / (Z1² + Z0 Z2).
    const double z0 = water_mps * water_gcm3, z1 = 1600 * 1.7, z2 = 2000 * 2.1;
    const Complex quarter = reflected(with(below, {layer(1600 / (4 * hz), 1600, 1.7, 0)}), 90);
    EXPECT_LT(std::abs(quarter - (z1 * z1 - z0 * z2) / (z1 * z1 + z0 * z2)), 1e-12);
    // Z1² = Z0 Z2: nothing comes back.
    const double matching = std::sqrt(z0 * z2) / 1600;
    EXPECT_LT(std::abs(reflected(with(below, {layer(1600 / (4 * hz), 1600, matching, 0)}), 90)),
              1e-12);
}

TEST(Sediment, WithoutLossGivesBackNoMoreThanItGets) {
    const std::vector<SedimentLayer> layers{{3, 1450, 1550, 1.4, 0}, {200, 1900, 1700, 2, 0}};
    Boundary rigid, open;
    rigid.kind = BoundaryKind::rigid;
    for (double deg = 0.5; deg <= 90; deg += 0.5) {
        EXPECT_LE(std::abs(reflected(with(half_space(1480, 1.6, 0), layers), deg)), 1 + 1e-12);
        EXPECT_NEAR(std::abs(reflected(with(rigid, layers), deg)), 1, 1e-12);
        EXPECT_NEAR(std::abs(reflected(with(open, layers), deg)), 1, 1e-12);
    }
    // Pressure release under a layer is not pressure release at it.
    EXPECT_FALSE(with(open, layers).is_free());
    EXPECT_GT(std::abs(reflected(with(open, layers), 40) + 1.0), 0.01);
}

TEST(Sediment, OfManySpeedsTendsToThatOfFineSteps) {
    // 64 times as many steps as it takes by itself, by layers of one speed.
    const Boundary below = half_space(1900, 2, 0.2);
    const SedimentLayer sloping{30, 1500, 1700, 1.6, 0.1};
    std::vector<SedimentLayer> steps;
    for (int k = 0; k < 1000; ++k) steps.push_back(layer(0.03, 1500 + 0.2 * (k + 0.5), 1.6, 0.1));
    const std::vector<Slice> coarse = slices_of({sloping}, 2 * pi * hz, slices_of_rays);
    for (double deg = 1; deg < 90; deg += 1) {
        const Complex wanted = reflected(with(below, steps), deg);
        EXPECT_LT(std::abs(reflected(with(below, {sloping}), deg) - wanted), 1e-3) << deg;
        EXPECT_LT(std::abs(reflection_coefficient(below, coarse, hz, deg * pi / 180, water_mps,
                                                  water_gcm3) -
                           wanted),
                  1e-2)
            << deg;
    }
}

TEST(Sediment, MayLieOnASolid) {
    Boundary solid = half_space(3000, 2.4, 0.1);
    solid.shear_speed_mps = 1500;
    solid.shear_attenuation_db_per_wavelength = 0.2;
    EXPECT_LT(std::abs(reflected(with(solid, {layer(5, water_mps, water_gcm3, 0)}), 90) -
                       reflected(solid, 90) * std::polar(1.0, -4 * pi * hz / water_mps * 5)),
              1e-12);
}

TEST(Sediment, AdmitsAsItReflects) {
    Boundary solid = half_space(2400, 2, 0);
    solid.shear_speed_mps = 900;
    Boundary rough = half_space(1700, 1.8, 0);
    rough.roughness_m = 0.5;
    for (const Boundary& below : {half_space(1700, 1.8, 0), solid, rough, Boundary{}}) {
        const Boundary b = with(below, {{4, 1470, 1530, 1.4, 0}, layer(9, 1600, 1.7, 0)});
        const Edge edge(b, "bottom", hz, water_gcm3);
        const double k = 2 * pi * hz / water_mps;
        for (double deg = 1; deg < 90; deg += 4) {
            const double across = k * std::sin(deg * pi / 180),
                         along = k * std::cos(deg * pi / 180);
            const Complex g = edge.admittance(along * along, k * k), i(0, 1);
            EXPECT_LT(std::abs(std::conj((i * across + g) / (i * across - g)) - reflected(b, deg)),
                      1e-9)
                << deg;
        }
    }
}

/// 100 m of water over 30 m that are nearly as light, and sand.
Environment shelf() {
    Environment e = pekeris();
    e.water.profile = {{0, 1500}, {60, 1490}, {100, 1495}};
    e.bottom.layers = {{20, 1495, 1540, 1, 0}, {10, 1540, 1600, 1, 0}};
    return e;
}

/// Mean |a - b|² over mean |b|²: of complex pressures.
double apart(const Field& a, const Field& b) {
    double difference = 0, sum = 0;
    for (std::size_t k = 0; k < a.pressure.size(); ++k) {
        difference += std::norm(a.pressure[k] - b.pressure[k]);
        sum += std::norm(b.pressure[k]);
    }
    return difference / sum;
}

TEST(Sediment, AsDenseAsWaterIsWater) {
    const Environment e = shelf();
    Environment water = e;
    water.bottom.layers.clear();
    water.bottom_depth_m = 130;
    water.water.profile.insert(water.water.profile.end(), {{120, 1540}, {130, 1600}});
    const Field layered = wavenumber_field(e, coherent());
    EXPECT_LT(apart(layered, wavenumber_field(water, coherent())), 1e-4);
    water.bottom_depth_m = 100;  // and it counts
    EXPECT_GT(apart(layered, wavenumber_field(water, coherent())), 0.1);
}

/// Of the lossless sea, of phase speeds below that of the half-space.
struct Trapped {
    std::size_t count;
    std::vector<double> xi;
};
Trapped trapped(const Environment& e) {
    const Column column(e);
    const Edge surface(e.surface, "surface", e.frequency_hz, e.water.density_gcm3);
    const Edge bottom(e.bottom, "bottom", e.frequency_hz, e.water.density_gcm3);
    const double omega = 2 * pi * e.frequency_hz, least_xi = std::pow(omega / 1699, 2);
    const Waveguide guide{column, surface, bottom, omega, 0};
    Trapped t{count_modes(Mesh(guide, 1200), least_xi), {}};
    for (const Mode& m : find_modes(guide, least_xi, 600, {10}).modes) t.xi.push_back(m.xi.real());
    return t;
}

TEST(Sediment, HoldsTheModesOfWaterThatIsTheSame) {
    Environment e = shelf();
    e.bottom.attenuation_db_per_wavelength = 0;
    for (const double middle_mps : {1540.0, 1460.0, 1400.0}) {
        e.bottom.layers = {{20, 1495, middle_mps, 1, 0}, {10, middle_mps, 1600, 1, 0}};
        Environment water = e;
        water.bottom.layers.clear();
        water.bottom_depth_m = 130;
        water.water.profile.insert(water.water.profile.end(), {{120, middle_mps}, {130, 1600}});
        const Trapped layered = trapped(e), wanted = trapped(water);
        EXPECT_EQ(layered.count, wanted.count);
        ASSERT_EQ(wanted.xi.size(), wanted.count);
        // The lowest of a deep channel is nothing in the water, and not found there.
        const std::size_t buried = middle_mps == 1400 ? 1 : 0;
        ASSERT_EQ(layered.xi.size(), wanted.count - buried);
        for (std::size_t m = 0; m < layered.xi.size(); ++m)
            EXPECT_NEAR(layered.xi[m] / wanted.xi[m + buried], 1, 3e-6) << m;
    }
}

TEST(Sediment, ModesAddUpToTheWavenumbers) {
    Environment e = shelf();
    const std::vector<std::vector<SedimentLayer>> bottoms{
        {layer(6, 1460, 1.4, 0.1)},
        {{20, 1495, 1540, 1.3, 0.4}, {10, 1540, 1600, 1.6, 0.6}},
        {layer(12, 1650, 1.7, 0), {20, 1500, 1420, 1.5, 0.2}, layer(3, 1800, 2, 0.5)}};
    for (const auto& layers : bottoms) {
        e.bottom.layers = layers;
        const Field modes = mode_field(e, coherent()), exact = wavenumber_field(e, coherent());
        EXPECT_LT(apart(modes, exact), 1e-3);
        EXPECT_EQ(compute_field(e, Engine::automatic, coherent()).basis.engine, Engine::modes);
    }
    e.bottom.layers[0].thickness_m = 100;
    EXPECT_EQ(choose_engine(e, coherent()).why,
              "the water and the layers below are 35.8 wavelengths deep, more than 30");
}

/// Mean loss over blocks of 10 depths by 20 ranges, dB.
std::vector<double> blocks(const Field& f) {
    std::vector<double> means;
    for (std::size_t z = 0; z + 10 <= f.depths; z += 10)
        for (std::size_t r = 0; r + 20 <= f.ranges; r += 20) {
            double sum = 0;
            for (std::size_t k = 0; k < 200; ++k)
                sum += std::pow(10, -f.loss_db[(z + k / 20) * f.ranges + r + k % 20] / 10);
            means.push_back(-10 * std::log10(sum / 200));
        }
    return means;
}

TEST(Sediment, ReflectsRaysAsItDoesWaves) {
    Environment e = shelf();
    e.frequency_hz = 200;
    e.bottom_depth_m = 500;
    e.source.depth_m = 180;
    e.water.profile = {{0, 1500}};
    e.bottom =
        with(half_space(1900, 2, 0.5), {{4, 1480, 1520, 1.5, 0.3}, layer(6, 1650, 1.8, 0.6)});
    e.receivers = {};
    for (int k = 0; k < 30; ++k) e.receivers.depth_m.push_back(40 + 14 * k);
    for (int k = 0; k < 100; ++k) e.receivers.range_m.push_back(2000 + 40 * k);
    const std::vector<double> waves = blocks(wavenumber_field(e, coherent())),
                              rays = blocks(ray_field(e, {}));
    double mean = 0, most = 0;
    for (std::size_t k = 0; k < waves.size(); ++k) {
        mean += (rays[k] - waves[k]) / static_cast<double>(waves.size());
        most = std::max(most, std::abs(rays[k] - waves[k]));
    }
    EXPECT_LT(std::abs(mean), 0.3);
    EXPECT_LT(most, 2);
    e.bottom.layers.clear();
    const std::vector<double> bare = blocks(ray_field(e, {}));
    double changed = 0;
    for (std::size_t k = 0; k < waves.size(); ++k)
        changed += std::abs(bare[k] - rays[k]) / static_cast<double>(waves.size());
    EXPECT_GT(changed, 1);
}

TEST(Sediment, IsReciprocal) {
    Environment e = shelf();
    e.bottom.layers[0].density_gcm3 = 1.5;
    e.bottom.layers[0].attenuation_db_per_wavelength = 0.3;
    e.receivers.depth_m = {71};
    Environment back = e;
    back.source.depth_m = 71;
    back.receivers.depth_m = {36};
    EXPECT_LT(apart(wavenumber_field(e, coherent()), wavenumber_field(back, coherent())), 1e-6);
}

TEST(Sediment, RefusalsAreNamed) {
    EXPECT_EQ(refusal(shelf(), [](Environment&) {}), "accepted");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.bottom.layers[1].thickness_m = 0; }),
              "bottom.layers[1].thickness_m 0 is outside 0.0001 to 20000 m");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.bottom.layers[0].sound_speed_top_mps = 0; }),
              "bottom.layers[0].sound_speed_top_mps 0 is outside 100 to 10000 m/s");
    EXPECT_EQ(
        refusal(shelf(), [](Environment& e) { e.bottom.layers[0].sound_speed_bottom_mps = NAN; }),
        "bottom.layers[0].sound_speed_bottom_mps nan is outside 100 to 10000 m/s");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.bottom.layers[0].density_gcm3 = 21; }),
              "bottom.layers[0].density_gcm3 21 is outside 0.001 to 20 g/cm3");
    EXPECT_EQ(
        refusal(shelf(),
                [](Environment& e) { e.bottom.layers[0].attenuation_db_per_wavelength = -1; }),
        "bottom.layers[0].attenuation_db_per_wavelength -1 is outside 0 to 50 dB");
    EXPECT_EQ(
        refusal(shelf(), [](Environment& e) { e.bottom.layers.resize(1001, e.bottom.layers[0]); }),
        "bottom.layers has 1001 values, more than 1000");
    EXPECT_EQ(refusal(shelf(), [](Environment& e) { e.surface.layers = e.bottom.layers; }),
              "surface.layers: only a bottom has layers");
    EXPECT_EQ(refusal(shelf(),
                      [](Environment& e) {
                          e.bottom.kind = BoundaryKind::table;
                          e.bottom.table = {{0, 1, 180}};
                      }),
              "bottom.layers: a table of reflection coefficients has no layers above it");
}

TEST(Sediment, IsBoundedHoweverThickAndMany) {
    Environment e = shelf();
    e.frequency_hz = 1e7;
    const SedimentLayer steep{20000, 100, 10000, 1.5, 0.1};
    e.bottom.layers.assign(1000, steep);
    const Complex r = reflection_coefficient(e.bottom, 1e7, 0.3, 1500, 1);
    EXPECT_LE(std::abs(r), 1);
    EXPECT_LE(slices_of(e.bottom.layers, 6e7, fine_slices).size(), 5096U);
}

}  // namespace
}  // namespace seautils::propagation
