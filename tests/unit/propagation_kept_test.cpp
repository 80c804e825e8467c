// What is kept from one field to the next changes no answer: not by a bit, whatever came before.
#include "propagation_seas.hpp"

#include "seautils/propagation/beam_intensity.hpp"
#include "seautils/propagation/column_store.hpp"
#include "seautils/propagation/engine.hpp"
#include "seautils/propagation/ray_energy.hpp"
#include "seautils/propagation/ray_fan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace seautils::propagation {
namespace {

Environment shelf() {
    Environment sea;
    sea.frequency_hz = 25120;
    sea.source.depth_m = 30;
    sea.receivers = {evenly(1, 109, 55), evenly(10, 2000, 20)};
    sea.water.profile = {{0, 1535},    {10, 1534},   {14, 1529.5}, {20, 1520.5},
                         {30, 1511.6}, {45, 1509.6}, {60, 1509.2}, {110, 1509.9}};
    sea.water.absorption.model = AbsorptionModel::thorp;
    sea.bottom = {BoundaryKind::half_space, 1650, 0, 1.77, 1.1, 0, 0, {}};
    sea.bottom_depth_m = 110;
    return sea;
}

/// Low, so that the fan hangs on the last range.
Environment channel() {
    Environment sea = shelf();
    sea.frequency_hz = 250;
    sea.source.depth_m = 0;  // on the surface: half of the fan begins as its reflection
    return sea;
}

Environment slope() {
    Environment sea = shelf();
    sea.frequency_hz = 3500;
    sea.bottom_line = Line{false, {0, 500, 1500, 2500}, {110, 100, 60, 90}};
    return sea;
}

Environment front() {
    Environment sea = slope();
    sea.water.mesh = SpeedMesh{
        {0, 1500, 3000}, {0, 40, 120}, {1522, 1519, 1523, 1515, 1518, 1512, 1510, 1511, 1513}};
    return sea;
}

/// A request of a random kind: mostly another window, now and then another sea or sum.
class Requests {
public:
    explicit Requests(std::uint32_t seed) : random_(seed) {}

    void next() {
        const int kind = below(12);
        if (kind == 0) environment = seas_[static_cast<std::size_t>(below(4))];
        if (kind == 1) environment.water.profile[1].sound_speed_mps += 0.25 * (below(3) - 1);
        if (kind == 2) options.sum = static_cast<Sum>(below(3));
        if (kind == 3) options.beam = static_cast<Beam>(below(2));
        if (kind == 4) options.least_amplitude = std::pow(10, -1 - below(4));
        if (kind == 5) environment.source.depth_m = below(3) * 15;
        const double from_m = 10 + 3 * below(900);
        const int count = 1 + below(20);
        environment.receivers.range_m = evenly(from_m, from_m + 10 * (1 + below(20)), count);
        if (kind > 5) return;
        const double first_m = 10 * below(200);  // columns come again
        environment.receivers.range_m = evenly(first_m, first_m + 10 * (count - 1), count);
    }

    Environment environment = shelf();
    FieldOptions options;

private:
    int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

    std::mt19937 random_;
    const std::vector<Environment> seas_{shelf(), channel(), slope(), front()};
};

/// The same bits, where there is no value too.
void expect_same(const Field& a, const Field& b) {
    ASSERT_EQ(a.loss_db.size(), b.loss_db.size());
    EXPECT_EQ(a.basis.beams, b.basis.beams);
    EXPECT_EQ(a.basis.remarks, b.basis.remarks);
    EXPECT_EQ(a.basis.estimated_error_db, b.basis.estimated_error_db);
    for (std::size_t k = 0; k < a.loss_db.size(); ++k) {
        if (std::isnan(a.loss_db[k]) && std::isnan(b.loss_db[k])) continue;
        ASSERT_EQ(a.loss_db[k], b.loss_db[k]) << "cell " << k;
    }
}

TEST(Kept, FieldsAreThoseOfAFreshStart) {
    // one that keeps all, one that has room for short rays alone, one for less than a fan
    FieldComputer all, some(9'000), none(500);
    Requests requests(7);
    for (int k = 0; k < 300; ++k) {
        requests.next();
        SCOPED_TRACE(k);
        const auto& sea = requests.environment;
        const Field fresh = ray_field(sea, requests.options);
        expect_same(all.compute(sea, Engine::rays, requests.options), fresh);
        expect_same(some.compute(sea, Engine::rays, requests.options), fresh);
        expect_same(none.compute(sea, Engine::rays, requests.options), fresh);
        if (HasFatalFailure()) return;
    }
}

/// More columns than are kept, back and forth.
TEST(Kept, ColumnsOfAWindowThatSlides) {
    FieldComputer kept;
    Environment sea = shelf();
    std::mt19937 random(3);
    for (int k = 0; k < 200; ++k) {
        const double from_m = 10 * static_cast<double>(random() % 3000U);
        sea.receivers.range_m = evenly(from_m, from_m + 100, 11);
        expect_same(kept.compute(sea, Engine::rays, {}), ray_field(sea, {}));
        if (HasFatalFailure()) return;
    }
}

TEST(Kept, WhateverTheThreads) {
    FieldComputer kept;
    FieldOptions options;
    Environment sea = shelf();
    for (const std::uint32_t threads : {1U, 3U, 2U, 8U}) {
        sea.receivers.range_m = evenly(400 * threads, 400 * threads + 170, 18);
        options.threads = 1;
        const Field fresh = ray_field(sea, options);
        options.threads = threads;
        expect_same(kept.compute(sea, Engine::rays, options), fresh);
    }
}

/// A window that begins in a far cycle is that part of a grid that begins at the source: there rays
/// are walked leg by leg. A beam on the edge between a hat and a Gaussian may fall to either side.
TEST(Kept, ClosedFormOfCyclesIsTheWalk) {
    for (Environment sea : {shelf(), channel()}) {
        sea.receivers.range_m = evenly(10, 8000, 800);
        const Field grid = ray_field(sea, {});
        sea.receivers.range_m = evenly(7610, 8000, 40);
        const Field window = ray_field(sea, {});
        for (std::size_t depth = 0; depth < grid.depths; ++depth)
            for (std::size_t k = 0; k < 40; ++k)
                EXPECT_NEAR(window.loss_db[depth * 40 + k], grid.loss_db[depth * 800 + 760 + k],
                            0.01);
    }
}

TEST(ColumnStore, KeepsTheLastAndForgetsOtherDepths) {
    const std::vector<double> depth_m = evenly(0, 99, 100);
    const std::size_t most = ColumnStore::most_cells / 100;
    ColumnStore store;
    store.open(depth_m);
    EXPECT_EQ(store.find(1), nullptr);
    for (std::size_t k = 0; k < most + 5; ++k)
        store.put(static_cast<double>(k), std::vector<float>(100, static_cast<float>(k)).data());
    for (std::size_t k = 0; k < most + 5; ++k) {
        const float* found = store.find(static_cast<double>(k));
        ASSERT_EQ(found == nullptr, k < 5) << k;
        if (k >= 5) {
            EXPECT_EQ(found[99], static_cast<float>(k));
        }
    }
    store.open(depth_m);
    EXPECT_NE(store.find(7), nullptr);
    store.open(evenly(0, 98, 99));
    EXPECT_EQ(store.find(7), nullptr);
}

/// Of vectors of eight and of four; where the processor has none of eight there is one way only.
TEST(IntensitySum, IsTheSameForVectorsOfAnyWidth) {
    for (const Environment& environment : {shelf(), channel(), front()})
        for (const Beam beam : {Beam::gaussian, Beam::hat}) {
            FieldOptions options;
            options.beam = beam;
            std::vector<std::string> remarks;
            const RaySea sea = make_ray_sea(environment, remarks);
            const Columns columns(sea, environment.receivers, options, {});
            BeamKind kind = beam_kind(environment, options);
            kind.legs = most_legs;
            IntensitySum wide(sea, columns, kind);
            kind.wide = false;
            IntensitySum narrow(sea, columns, kind);
            for (const Launch& launch : make_fan(environment, sea, options)) {
                wide.add(launch, true);
                narrow.add(launch, true);
            }
            wide.finish();
            narrow.finish();
            for (std::size_t cell = 0; cell < columns.cells(); ++cell)
                ASSERT_EQ(wide.column(0)[cell], narrow.column(0)[cell]) << cell;
        }
}

TEST(Kept, CyclesTimesACountAreOneAfterAnother) {
    const EnergyCycle one{.range_m = 120,
                          .length_m = 130,
                          .amplitude = 0.9,
                          .qq = 1.5,
                          .qp = 4,
                          .pq = -0.0625,
                          .pp = 0.5};
    EnergyCycle walked;
    for (std::uint64_t n = 0; n < 40; ++n) {
        const EnergyCycle at_once = one.times(n);
        EXPECT_NEAR(at_once.range_m, walked.range_m, 1e-9);
        EXPECT_NEAR(at_once.amplitude, walked.amplitude, 1e-12);
        EXPECT_NEAR(at_once.length_m, walked.length_m, 1e-9);
        EXPECT_NEAR(at_once.qq, walked.qq, 1e-9);
        EXPECT_NEAR(at_once.qp, walked.qp, 1e-9);
        EXPECT_NEAR(at_once.pq, walked.pq, 1e-9);
        EXPECT_NEAR(at_once.pp, walked.pp, 1e-9);
        walked = walked.then(one);
    }
}

}  // namespace
}  // namespace seautils::propagation
