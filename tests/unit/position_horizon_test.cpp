#include "position_link.hpp"
#include "position_tracks.hpp"

#include "seautils/position/codec.hpp"
#include "seautils/position/simulation.hpp"

#include <gtest/gtest.h>

namespace seautils::position {
namespace {

/// Bits of a position so far ahead, and that it comes back.
std::size_t bits_ahead(const Horizon& horizon, std::uint32_t ahead, const Cell& cell) {
    entropy::BitString bits;
    entropy::Encoder out(bits);
    horizon.encode(ahead, cell, out);
    out.finish();
    entropy::BitReader reader(bits.bytes(), bits.size());
    entropy::Decoder in(reader);
    EXPECT_EQ(horizon.clone()->decode(ahead, in), cell);
    EXPECT_EQ(reader.left(), 0U);
    return bits.size();
}

TEST(PositionHorizon, AnyPositionComesBackAfterAnyHistory) {
    Walk walk(5);
    SplitMix64& random = walk.random();
    const auto horizon = make_horizon();
    horizon->restart(walk.next());
    for (int n = 0; n < 300; ++n) {
        const auto ahead = static_cast<std::uint32_t>(1 + random.below(5) * random.below(5));
        Cell cell{};
        for (std::uint32_t k = 0; k < ahead; ++k) cell = walk.next();
        const std::uint64_t chance = random.below(30);
        if (chance == 0) cell = {-cell_limit, cell_limit, 0};
        if (ahead > 1) bits_ahead(*horizon, ahead, cell);
        if (chance == 1)
            horizon->restart(cell);
        else if (ahead == 1)
            horizon->learn(cell);
        else
            horizon->learn_ahead(ahead, cell);
        if (n % 50 == 0) bits_ahead(*horizon, most_ahead, {cell_limit, 0, -cell_limit});
    }
}

TEST(PositionHorizon, AStateSaysTheSameAgain) {
    Walk walk(6);
    const auto horizon = make_horizon(), loaded = make_horizon();
    horizon->restart(walk.next());
    for (int n = 0; n < 700; ++n) horizon->learn_ahead(1 + n % 3, walk.next());
    loaded->load(horizon->save());
    EXPECT_EQ(loaded->save(), horizon->save());
    const Cell next = walk.next();
    EXPECT_EQ(bits_ahead(*loaded, 4, next), bits_ahead(*horizon, 4, next));
    const std::string state = horizon->save();
    for (std::size_t cut = 0; cut < state.size(); cut += 37)
        EXPECT_THROW(loaded->load(state.substr(0, cut)), DataError);
    EXPECT_EQ(loaded->save(), state);
}

TEST(PositionHorizon, OfNothingThereIsNothingAhead) {
    entropy::BitString bits;
    bits.put(0, 64);
    entropy::BitReader reader(bits.bytes());
    entropy::Decoder in(reader);
    EXPECT_THROW(make_horizon()->decode(3, in), DataError);
}

/// A straight way at an even speed has no surprise: to say which of the 11³ cells within 5 of what is
/// expected it is would take 10.4 bits; knowing every fifth position only, 13.2 are those of 9,261 (21³).
TEST(PositionHorizon, AStraightWayIsKnownAhead) {
    const auto at = [](int n) { return Cell{15 * n, -4 * n, -n / 2}; };
    const auto all = make_horizon(), some = make_horizon();
    all->restart(at(0));
    some->restart(at(0));
    for (int n = 1; n <= 60; ++n) all->learn(at(n));
    for (int n = 5; n <= 60; n += 5) some->learn_ahead(5, at(n));
    for (const std::uint32_t ahead : {2U, 4U, 5U, 8U}) {
        EXPECT_LT(bits_ahead(*all, ahead, at(60 + static_cast<int>(ahead))), 11U) << ahead;
        EXPECT_LT(bits_ahead(*some, ahead, at(60 + static_cast<int>(ahead))), 14U) << ahead;
    }
}

// gcc says so by a macro, clang by a feature.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(undefined_behavior_sanitizer)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif
#else
constexpr bool is_sanitized = false;
#endif

/// Our codec and horizon at both ends, acknowledgements lost too.
TEST(PositionLoss, WhatArrivesIsRight) {
    Walk walk(9);
    std::vector<Fix> track;
    for (int n = 0; n < 120; ++n) track.push_back({1'714'521'600'000 + n * 10'000, walk.next()});
    for (const LinkMode mode : {LinkMode::history, LinkMode::newest, LinkMode::automatic}) {
        LinkOptions options;
        options.mode = mode;
        const LinkReport report =
            simulate_link(track, options, *make_codec({}), *make_horizon(), 34, {0.6, 0.3, 2});
        EXPECT_EQ(report.wrong, 0U);
        EXPECT_GT(report.arrived, 20U);
    }
}

struct Figure {
    double loss, most_bits;  ///< per packet, header included
    std::size_t runs;
};

void expect_figures(LinkMode mode, std::initializer_list<Figure> figures) {
    std::vector<Fix> track;
    for (const TimedCell& at : track_of("sim_mbat12_s1.csv"))
        track.push_back({static_cast<std::int64_t>(at.time_s * 1000), at.cell});
    LinkOptions options;
    options.interval_ms = 5000;
    options.mode = mode;
    for (const Figure& figure : figures) {
        const LinkReport report = simulate_link(track, options, *make_codec({}), *make_horizon(),
                                                34, {figure.loss, 0, 1}, figure.runs);
        EXPECT_EQ(report.wrong, 0U);
        EXPECT_LE(report.cost.bits, figure.most_bits) << "at loss " << figure.loss;
    }
}

// What the reference figures say of "window" and of "newest vs acked", and a tenth more. The mean of so
// many runs, for one of 66 packets that arrive may be a fifth off.
TEST(PositionLoss, HistoryCostsWhatTheReferenceDoes) {
    if (!shared_tracks()) GTEST_SKIP() << "no shared vectors";
    if (is_sanitized) GTEST_SKIP() << "takes minutes";
    expect_figures(LinkMode::history, {{0.3, 1.1 * 11.4, 2},
                                       {0.5, 1.1 * 13.9, 4},
                                       {0.65, 1.1 * 17.7, 6},
                                       {0.8, 1.1 * 27.4, 10},
                                       {0.9, 1.1 * 48.8, 16}});
}

TEST(PositionLoss, TheNewestCostsWhatTheReferenceDoes) {
    if (!shared_tracks()) GTEST_SKIP() << "no shared vectors";
    if (is_sanitized) GTEST_SKIP() << "takes minutes";
    expect_figures(LinkMode::newest, {{0.3, 1.1 * 11.0, 1},
                                      {0.5, 1.1 * 12.7, 1},
                                      {0.65, 1.1 * 14.7, 1},
                                      {0.8, 1.1 * 18.3, 2},
                                      {0.9, 1.1 * 22.8, 6}});
}

}  // namespace
}  // namespace seautils::position
