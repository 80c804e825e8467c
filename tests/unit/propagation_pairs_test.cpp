// Receivers that are pairs: the values of grids, in the order asked for.
#include "propagation_seas.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/case_file.hpp"
#include "seautils/propagation/engine.hpp"
#include "seautils/propagation/pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace seautils::propagation {
namespace {

Environment waveguide() {
    Environment sea;
    sea.frequency_hz = 100;
    sea.source.depth_m = 36;
    sea.receivers = {evenly(2, 98, 25), evenly(100, 3000, 25)};
    sea.water.profile = {{0, 1500}, {100, 1500}};
    sea.bottom = {BoundaryKind::half_space, 1700, 0, 1.8, 0.5, 0, 0, {}};
    sea.bottom_depth_m = 100;
    return sea;
}

/// All receivers of a grid as pairs, shuffled, and the cell of each.
std::pair<Receivers, std::vector<std::size_t>> shuffled(const Receivers& grid) {
    std::vector<std::size_t> cells(grid.count());
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = k;
    std::shuffle(cells.begin(), cells.end(), std::mt19937(3));
    Receivers pairs{{}, {}, true};
    for (const std::size_t k : cells) {
        pairs.depth_m.push_back(grid.depth_at_m(k));
        pairs.range_m.push_back(grid.range_at_m(k));
    }
    return {pairs, cells};
}

/// A diagonal, from far to near, and its last receiver twice.
Receivers diagonal(const Receivers& grid) {
    Receivers pairs{grid.depth_m, grid.range_m, true};
    std::reverse(pairs.depth_m.begin(), pairs.depth_m.end());
    std::reverse(pairs.range_m.begin(), pairs.range_m.end());
    pairs.depth_m.push_back(pairs.depth_m.back());
    pairs.range_m.push_back(pairs.range_m.back());
    return pairs;
}

std::string refusal(const Environment& sea, Engine engine = Engine::rays) {
    try {
        compute_field(sea, engine, {});
    } catch (const DataError& e) {
        return e.what();
    }
    return "accepted";
}

TEST(Pairs, HaveTheValuesOfTheirGrid) {
    const Environment sea = waveguide();
    for (const auto& [engine, sum] : {std::pair{Engine::rays, Sum::incoherent},
                                      {Engine::rays, Sum::coherent},
                                      {Engine::modes, Sum::coherent},
                                      {Engine::wavenumber, Sum::coherent}}) {
        SCOPED_TRACE(name(engine));
        FieldOptions options;
        options.sum = sum;
        const Field grid = compute_field(sea, engine, options);
        Environment there = sea;
        std::vector<std::size_t> cells;
        std::tie(there.receivers, cells) = shuffled(sea.receivers);
        const Field field = compute_field(there, engine, options);
        ASSERT_EQ(field.loss_db.size(), cells.size());
        EXPECT_EQ(field.depths, 1U);
        EXPECT_EQ(field.ranges, cells.size());
        EXPECT_EQ(field.basis.engine, engine);
        EXPECT_EQ(field.basis.beams, grid.basis.beams);
        EXPECT_EQ(field.basis.modes, grid.basis.modes);
        EXPECT_EQ(field.pressure.size(), grid.pressure.empty() ? 0 : cells.size());
        for (std::size_t k = 0; k < cells.size(); ++k) {
            ASSERT_EQ(field.loss_db[k], grid.loss_db[cells[k]]) << k;
            if (grid.pressure.empty()) continue;
            ASSERT_EQ(field.pressure[k], grid.pressure[cells[k]]) << k;
        }
    }
}

TEST(Pairs, OfADiagonalComeInTheirOrder) {
    const Environment sea = waveguide();
    const Field grid = compute_field(sea, Engine::rays, {});
    Environment there = sea;
    there.receivers = diagonal(sea.receivers);
    const Field field = compute_field(there, Engine::rays, {});
    ASSERT_EQ(field.loss_db.size(), 26U);
    for (std::size_t k = 0; k < 25; ++k) EXPECT_EQ(field.loss_db[k], grid.loss_db[(24 - k) * 26]);
    EXPECT_EQ(field.loss_db[25], field.loss_db[24]);
}

TEST(Pairs, InSeveralBlocksHaveTheRaysOfAll) {
    Environment sea = waveguide();
    sea.receivers.range_m = evenly(100, 3000, 30);
    Environment there = sea;
    std::vector<std::size_t> cells;
    std::tie(there.receivers, cells) = shuffled(sea.receivers);
    for (const Sum sum : {Sum::incoherent, Sum::coherent}) {
        FieldOptions options;
        options.sum = sum;
        const Field grid = compute_field(sea, Engine::rays, options);
        std::size_t runs = 0;
        const Field field = field_at_pairs(there, {100, 100}, [&](const Environment& block) {
            ++runs;
            return compute_field(block, Engine::rays, options);
        });
        EXPECT_GE(runs, 8U);
        EXPECT_EQ(field.basis.beams, grid.basis.beams);
        for (std::size_t k = 0; k < cells.size(); ++k)
            ASSERT_EQ(field.loss_db[k], grid.loss_db[cells[k]]) << k;
    }
}

TEST(Pairs, InSeveralBlocksHaveTheFanAndTheModesOfAll) {
    const Environment sea = waveguide();
    Environment there = sea;
    there.receivers = diagonal(sea.receivers);
    FieldOptions options;
    options.sum = Sum::coherent;
    const Field grid = compute_field(sea, Engine::modes, options);
    std::size_t runs = 0;
    const Field field = field_at_pairs(there, {30, 100}, [&](const Environment& block) {
        ++runs;
        EXPECT_LE(block.receivers.depth_m.size(), 5U);
        EXPECT_EQ(block.receivers.range_m.back(), 3000);
        return compute_field(block, Engine::modes, options);
    });
    EXPECT_EQ(runs, 5U);  // of five by five and the two ends
    EXPECT_EQ(field.basis.modes, grid.basis.modes);
    for (std::size_t k = 0; k < 25; ++k)
        EXPECT_NEAR(field.loss_db[k], grid.loss_db[(24 - k) * 26], 1e-3) << k;
    EXPECT_THROW(field_at_pairs(there, {30, 4},
                                [&](const Environment& block) {
                                    return compute_field(block, Engine::modes, options);
                                }),
                 DataError);
}

TEST(Pairs, BlocksHoldEachPairOnceAndAreNoSquare) {
    Receivers all{{}, {}, true};
    std::mt19937 random(5);
    for (int k = 0; k < 100'000; ++k) {
        all.range_m.push_back(static_cast<double>(random() % 2'000'000) / 100);
        all.depth_m.push_back(static_cast<double>(random() % 100'000) / 100);
    }
    std::vector<bool> seen(all.count());
    std::size_t cells = 0;
    for (const PairBlock& block : blocks_of_pairs(all, 40'000, true)) {
        const Receivers& grid = block.receivers;
        EXPECT_FALSE(grid.pairs);
        EXPECT_LE(grid.count(), 40'000U + 2 * grid.depth_m.size());
        cells += grid.count();
        for (std::size_t k = 0; k < block.pairs.size(); ++k) {
            ASSERT_FALSE(seen[block.pairs[k]]);
            seen[block.pairs[k]] = true;
            ASSERT_EQ(grid.depth_at_m(block.cells[k]), all.depth_m[block.pairs[k]]);
            ASSERT_EQ(grid.range_at_m(block.cells[k]), all.range_m[block.pairs[k]]);
        }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 100'000);
    EXPECT_LT(cells, std::size_t{100'000} * 220);  // √40000 a pair, not 100000
}

TEST(Pairs, HaveTheArrivalsOfTheirReceivers) {
    Environment sea = waveguide();
    sea.frequency_hz = 1000;
    sea.receivers = {{10, 40, 80}, {300, 1000, 1900}};
    const auto grid = ray_arrivals(sea, {});
    Environment there = sea;
    there.receivers = {{80, 10, 80}, {300, 1900, 1000}, true};
    const auto all =
        arrivals_at_pairs(there, [](const Environment& block) { return ray_arrivals(block, {}); });
    ASSERT_EQ(all.size(), 3U);
    const std::size_t cells[] = {6, 2, 7};
    for (std::size_t k = 0; k < 3; ++k) {
        const ReceiverArrivals &a = all[k], &b = grid[cells[k]];
        EXPECT_EQ(a.depth_m, b.depth_m);
        EXPECT_EQ(a.range_m, b.range_m);
        ASSERT_EQ(a.arrivals.size(), b.arrivals.size());
        for (std::size_t i = 0; i < a.arrivals.size(); ++i)
            EXPECT_EQ(a.arrivals[i].delay_s, b.arrivals[i].delay_s);
    }
}

TEST(Pairs, AreCheckedWithTheirBounds) {
    Environment sea = waveguide();
    sea.receivers = {{10, 20}, {300, 200}, true};
    EXPECT_EQ(refusal(sea), "accepted");
    sea.receivers.range_m.push_back(100);
    EXPECT_EQ(refusal(sea),
              "receivers.depth_m has 2 values, receivers.range_m 3, which are no pairs");
    sea.receivers = {{10, 20}, {300, -1}, true};
    EXPECT_EQ(refusal(sea), "receivers.range_m[1] -1 is outside 0 to 21000000 m");
    sea.receivers = {evenly(1, 99, 100'001), evenly(1, 99, 100'001), true};
    EXPECT_EQ(refusal(sea), "receivers of 100001 pairs are outside 1 to 100000");
}

TEST(Pairs, AreALayoutOfCaseFiles) {
    const std::string text =
        R"({"frequency_hz":400,"source":{"depth_m":25},"receivers":{"depth_m":[30,10,30],)"
        R"("range_m":[900,500,900],"layout":"irregular"},"water":{"profile_z_c":[[0,1500]]},)"
        R"("bottom":{"type":"rigid","depth_m":100},)"
        R"("arrivals":{"depth_m":[1,2],"range_m":[3,4],"layout":"irregular"}})";
    const Case c = read_case(text);
    EXPECT_EQ(c.environment.receivers, (Receivers{{30, 10, 30}, {900, 500, 900}, true}));
    EXPECT_EQ(*c.arrivals, (Receivers{{1, 2}, {3, 4}, true}));
}

}  // namespace
}  // namespace seautils::propagation
