// Receipt probability over depth, its bands, and thresholds of loss.
#include "seautils/plan/receipt.hpp"

#include "seautils/core/error.hpp"
#include "seautils/plan/link_csv.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>

namespace seautils::plan {
namespace {

/// The data of section 10 of the specification.
std::vector<LinkSample> published() {
    const std::array<double, 12> depth{10, 12, 18, 20, 25, 26, 31, 33, 40, 41, 47, 52};
    const std::array<int, 12> good{0, 0, 1, 0, 1, 0, 1, 1, 1, 0, 1, 1};
    std::vector<LinkSample> all;
    for (std::size_t k = 0; k < depth.size(); ++k)
        all.push_back({.depth_m = depth[k], .received = good[k] == 1});
    return all;
}

LinkSample heard(double loss_db, bool received) {
    return {.depth_m = 10, .loss_db = loss_db, .received = received};
}

TEST(Receipt, IsThePublishedProbability) {
    const std::array<double, 4> where{15, 25, 35, 45};
    const std::array<double, 4> expected{0.274096, 0.590588, 0.754438, 0.725490};
    const auto curve = receipt_curve(published(), where, {.bandwidth_m = 10});
    for (std::size_t k = 0; k < where.size(); ++k)
        EXPECT_NEAR(curve[k].probability, expected[k], 5e-7) << where[k];
}

TEST(Receipt, ShareAndBandRestOnTheKernel) {
    const std::array<double, 2> where{15, 80};
    const auto curve = receipt_curve(published(), where, {.bandwidth_m = 10});
    // at 15 m: u = .5 .3 .3 .5, and 25 is on the edge: K/K(0) = .75 .91 .91 .75
    const double sum = 0.75 + 0.91 + 0.91 + 0.75;
    EXPECT_NEAR(curve[0].share, sum / 12, 1e-12);
    EXPECT_NEAR(curve[0].samples, sum * sum / (2 * (0.75 * 0.75 + 0.91 * 0.91)), 1e-12);
    EXPECT_FALSE(curve[0].suppressed);
    EXPECT_TRUE(curve[1].suppressed);
    EXPECT_TRUE(std::isnan(curve[1].probability));
    EXPECT_TRUE(
        receipt_curve(published(), where, {.bandwidth_m = 10, .least_share = 0.5})[0].suppressed);
}

TEST(Receipt, WilsonsIntervalIsThePublishedOne) {
    // Wilson's interval for 81 of 263 at 95 %: 0.2553 to 0.3662 (Newcombe, Stat. Med. 17, 857-872, 1998, table I)
    const Interval i = wilson_interval(81.0 / 263, 263, 1.959964);
    EXPECT_NEAR(i.low, 0.2553, 5e-5);
    EXPECT_NEAR(i.high, 0.3662, 5e-5);
    const Interval none = wilson_interval(0, 20, 1.959964);  // ibid.: 0 of 20: 0 to 0.1611
    EXPECT_NEAR(none.low, 0, 1e-12);
    EXPECT_NEAR(none.high, 0.1611, 5e-5);
}

TEST(Receipt, DefaultBandwidthIsEpanechnikovs) {
    const std::vector<LinkSample> two{{.depth_m = 10}, {.depth_m = 20}};
    EXPECT_NEAR(default_bandwidth_m(two), 2.345 * std::sqrt(50.0) * std::pow(2.0, -0.2), 1e-12);
    EXPECT_EQ(default_bandwidth_m({}), 0);
    const std::vector<LinkSample> same{{.depth_m = 10, .received = true}, {.depth_m = 10}};
    EXPECT_EQ(default_bandwidth_m(same), 0);
    const std::array<double, 2> where{10, 11};
    const auto curve = receipt_curve(same, where, {});
    EXPECT_EQ(curve[0].probability, 0.5) << "all at one depth";
    EXPECT_TRUE(curve[1].suppressed);
}

TEST(Receipt, ProbabilityLiesInItsBand) {
    rc::check([](const std::vector<std::pair<std::uint8_t, bool>>& data) {
        std::vector<LinkSample> samples;
        for (const auto& [depth, good] : data)
            samples.push_back({.depth_m = static_cast<double>(depth), .received = good});
        std::vector<double> where;
        for (int z = 0; z < 256; z += 8) where.push_back(z);
        for (const ReceiptPoint& p : receipt_curve(samples, where, {})) {
            if (p.suppressed) continue;
            RC_ASSERT(p.low >= 0 && p.high <= 1);
            RC_ASSERT(p.low <= p.probability + 1e-12 && p.probability <= p.high + 1e-12);
            RC_ASSERT(p.samples <= static_cast<double>(samples.size()) + 1e-9);
        }
    });
}

TEST(Losses, LimitLeavesOneInAHundredAbove) {
    std::vector<LinkSample> all;
    for (int k = 1; k <= 200; ++k) all.push_back(heard(k, true));
    EXPECT_EQ(loss_statistics(all).loss_limit_db, 198) << "two of 200 lie above";
    all.pop_back();
    EXPECT_EQ(loss_statistics(all).loss_limit_db, 198) << "one of 199 lies above";
    EXPECT_EQ(loss_statistics(all, 0).loss_limit_db, 199);
    EXPECT_TRUE(std::isnan(loss_statistics({}).loss_limit_db));
}

TEST(Losses, ThresholdMakesTheFewestErrors) {
    const std::vector<LinkSample> all{heard(80, true), heard(90, true),  heard(92, false),
                                      heard(94, true), heard(98, false), heard(100, false)};
    const LossStatistics s = loss_statistics(all);
    EXPECT_EQ(s.threshold_errors, 1U);
    EXPECT_EQ(s.threshold_db, 91) << "with 96 as few, and this is the least";
    EXPECT_EQ(s.received, 3U);
    EXPECT_EQ(s.received_median_db, 90);
    EXPECT_EQ(s.lost_median_db, 98);
}

TEST(Losses, NoThresholdIsBetter) {
    rc::check([](const std::vector<std::pair<std::uint8_t, bool>>& data) {
        std::vector<LinkSample> all;
        for (const auto& [loss, good] : data) all.push_back(heard(loss, good));
        const LossStatistics s = loss_statistics(all);
        if (all.empty()) return;
        const auto errors = [&](double threshold) {
            std::size_t n = 0;
            for (const LinkSample& x : all)
                n += x.received ? x.loss_db > threshold : x.loss_db <= threshold;
            return n;
        };
        for (double t = -0.5; t < 257; t += 0.5) RC_ASSERT(errors(t) >= s.threshold_errors);
        std::size_t above = 0;
        for (const LinkSample& x : all) above += x.received && x.loss_db > s.loss_limit_db;
        RC_ASSERT(s.received == 0 ||
                  static_cast<double>(above) <= 0.01 * static_cast<double>(s.received));
    });
}

TEST(LinkLog, IsReadByItsHeader) {
    LinkCsv csv;
    EXPECT_FALSE(csv.read("time,depth_m,received,rate,tl_db,range_m\r"));
    const auto s = csv.read("x, 12.5 ,yes,1,,500");
    ASSERT_TRUE(s);
    EXPECT_EQ(s->depth_m, 12.5);
    EXPECT_TRUE(s->received);
    EXPECT_EQ(s->rate, 1);
    EXPECT_EQ(s->range_m, 500);
    EXPECT_TRUE(std::isnan(s->loss_db));
    const auto fault = [&](const char* line) -> std::string {
        try {
            csv.read(line);
        } catch (const DataError& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(fault("x,12,maybe,1,,500"), "received 'maybe' is none of 1, 0, true, false, yes, no");
    EXPECT_EQ(fault("x,,1,1,,500"), "depth_m '' is no number");
    EXPECT_EQ(fault("x,-1,1,1,,500"), "depth_m -1 is outside 0 to 12000 m");
    EXPECT_EQ(fault("x,1,1,1.5,,500"), "rate '1.5' is no whole number");
    EXPECT_EQ(fault("x,1,1"), "3 cells where the header has 6");
    EXPECT_EQ(fault("# a comment"), "");
    LinkCsv poor;
    EXPECT_THROW(poor.read("a,b"), DataError);
    EXPECT_THROW(poor.read("1,2"), DataError);
}

}  // namespace
}  // namespace seautils::plan
