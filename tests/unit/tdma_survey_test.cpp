// The simulation of discovery against the tables of an analysis that was made twice, in Python and
// in C++, by others (figures 2.11 and 2.12 of T. Schneider's thesis, and the hashed rule).
#include "sanitized.hpp"
#include "seautils/core/error.hpp"
#include "seautils/tdma/survey.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace seautils::tdma {
namespace {

SurveyOptions options_of(Rule rule, std::uint32_t coolness) {
    SurveyOptions options;
    options.network.excitation = {rule, coolness};
    return options;
}

Summary subsets(std::size_t size, int last, const SurveyOptions& options) {
    Summary summary;
    for_each_subset(size, 1, last, [&](const std::vector<int>& s) { survey(s, options, summary); });
    return summary;
}

/// `failures in percent / mean`, as the tables print it; the mean is missing where all failed.
std::string cell(const Summary& summary, int decimals) {
    const double failures =
        100.0 * static_cast<double>(summary.failed) / static_cast<double>(summary.runs);
    std::string text = fmt::format("{:.{}f}", failures, decimals);
    if (const auto mean = summary.mean_slots()) text += fmt::format("/{:.3f}", *mean);
    return text;
}

struct SmallRow {
    std::uint32_t coolness;
    Rule rule;
    const char* cells[4];  ///< networks of 2, 3, 4 and 5
};

constexpr SmallRow small_rows[] = {
    {2, Rule::eqn, {"40/14.000", "50/27.000", "100", "100"}},
    {3, Rule::eqn, {"20/10.625", "30/24.143", "20/45.750", "0/73.000"}},
    {4, Rule::eqn, {"20/11.875", "0/30.000", "40/52.667", "0/73.000"}},
    {5, Rule::eqn, {"0/14.100", "0/39.200", "0/53.800", "0/167.000"}},
    {6, Rule::eqn, {"10/12.667", "20/37.375", "0/54.800", "0/138.000"}},
    {7, Rule::eqn, {"0/14.100", "0/38.300", "0/59.400", "0/71.000"}},
    {8, Rule::eqn, {"10/12.667", "0/40.300", "0/68.400", "0/84.000"}},
    {2, Rule::goby1, {"40/6.500", "50/13.800", "100", "100"}},
    {3, Rule::goby1, {"30/7.571", "30/23.714", "60/34.000", "100"}},
    {4, Rule::goby1, {"10/8.889", "40/18.167", "80/48.000", "100"}},
    {5, Rule::goby1, {"0/10.300", "60/33.750", "80/64.000", "100"}},
    {6, Rule::goby1, {"0/11.800", "0/29.700", "20/47.000", "100"}},
    {7, Rule::goby1, {"0/11.800", "0/29.400", "0/63.200", "0/75.000"}},
    {8, Rule::goby1, {"0/11.800", "0/27.400", "0/43.000", "0/125.000"}},
    {2, Rule::rot, {"40/6.500", "50/13.800", "100", "100"}},
    {3, Rule::rot, {"30/8.000", "20/29.125", "20/43.750", "0/70.000"}},
    {4, Rule::rot, {"10/9.222", "10/20.222", "20/52.500", "100"}},
    {5, Rule::rot, {"0/11.800", "0/25.100", "20/47.000", "0/110.000"}},
    {6, Rule::rot, {"0/13.600", "0/27.800", "0/53.000", "0/70.000"}},
    {7, Rule::rot, {"0/13.000", "0/29.400", "0/60.200", "0/75.000"}},
    {8, Rule::rot, {"0/13.000", "0/27.800", "0/49.800", "0/125.000"}},
    {2, Rule::eq, {"40/9.000", "50/21.600", "100", "100"}},
    {3, Rule::eq, {"20/8.625", "20/21.250", "20/31.000", "0/92.000"}},
    {4, Rule::eq, {"10/7.000", "20/26.250", "20/43.500", "100"}},
    {5, Rule::eq, {"0/8.200", "0/21.200", "20/58.500", "0/148.000"}},
    {6, Rule::eq, {"0/10.800", "0/24.000", "0/48.000", "100"}},
    {7, Rule::eq, {"0/10.800", "0/23.800", "0/53.400", "100"}},
    {8, Rule::eq, {"0/10.800", "0/24.800", "0/50.400", "100"}},
};

struct LargeRow {
    Rule rule;
    const char* cells[10];  ///< coolness 3 to 12
};

constexpr LargeRow large_rows[] = {
    {Rule::eqn,
     {"69.44/69.636", "52.78/93.403", "31.35/99.827", "20.24/118.532", "0.79/150.400",
      "9.52/147.018", "11.90/161.815", "12.70/132.927", "0.00/151.548", "7.14/153.137"}},
    {Rule::rot,
     {"72.62/77.841", "51.98/70.777", "31.35/90.919", "33.73/78.521", "27.38/103.536",
      "62.70/99.117", "56.75/112.431", "44.84/118.302", "4.37/116.842", "33.33/115.411"}},
    {Rule::goby1,
     {"93.25/49.529", "87.30/64.406", "82.14/73.333", "84.52/68.513", "87.30/82.969",
      "86.11/106.857", "79.37/94.423", "71.43/109.403", "26.59/102.773", "49.21/106.805"}},
    {Rule::eq,
     {"67.46/63.744", "59.52/60.716", "34.52/99.830", "53.17/79.297", "30.95/132.425",
      "66.67/110.333", "66.67/105.440", "70.63/145.500", "53.57/111.932", "73.02/100.471"}},
};

struct CollisionRow {
    std::uint32_t coolness;
    double quiet[3][4];  ///< p_collide 1, 0.75, 0.5; networks of 3 to 6
};

constexpr CollisionRow collision_rows[] = {
    {2,
     {{.24409, .50009, .69260, .82006},
      {.18307, .30364, .40039, .46647},
      {.12205, .15480, .18756, .21193}}},
    {3,
     {{.32808, .50386, .62968, .72219},
      {.24606, .32168, .37856, .42192},
      {.16404, .17698, .18992, .20147}}},
    {4,
     {{.43307, .52678, .58515, .63580},
      {.32480, .35533, .37261, .38972},
      {.21654, .21039, .20424, .20172}}},
    {5,
     {{.51624, .55930, .57683, .59781},
      {.38718, .39074, .38473, .38397},
      {.25812, .24134, .22456, .21305}}},
    {6,
     {{.58005, .59284, .58652, .58800},
      {.43504, .42314, .40409, .39204},
      {.29003, .26777, .24552, .22873}}},
    {7,
     {{.62976, .62415, .60381, .59259},
      {.47232, .45154, .42525, .40621},
      {.31488, .28999, .26509, .24531}}},
    {8,
     {{.66929, .65228, .62362, .60415},
      {.50197, .47610, .44587, .42254},
      {.33465, .30866, .28268, .26131}}},
    {10,
     {{.72790, .69931, .66296, .63467},
      {.54592, .51575, .48266, .45533},
      {.36395, .33801, .31207, .28977}}},
};

}  // namespace

TEST(TdmaSurvey, AllSubsetsOfFiveVehicles) {
    for (const SmallRow& row : small_rows) {
        for (std::size_t size = 2; size <= 5; ++size) {
            SCOPED_TRACE(fmt::format("rule {}, C {}, N {}", int(row.rule), row.coolness, size));
            const Summary summary = subsets(size, 5, options_of(row.rule, row.coolness));
            EXPECT_EQ(cell(summary, 0), row.cells[size - 2]);
            EXPECT_EQ(summary.failed, summary.proven);
        }
    }
}

TEST(TdmaSurvey, WithoutCoolnessAllFail) {
    for (const Rule rule : {Rule::hash, Rule::goby1, Rule::eq, Rule::eqn, Rule::rot}) {
        for (std::size_t size = 2; size <= 5; ++size)
            EXPECT_EQ(cell(subsets(size, 5, options_of(rule, 1)), 0), "100");
    }
}

TEST(TdmaSurvey, AllFiveSubsetsOfTenVehicles) {
    for (const LargeRow& row : large_rows) {
        for (std::uint32_t c = 3; c <= 12; ++c) {
            SCOPED_TRACE(fmt::format("rule {}, C {}", int(row.rule), c));
            const Summary summary = subsets(5, 10, options_of(row.rule, c));
            EXPECT_EQ(summary.runs, 252U);
            EXPECT_EQ(cell(summary, 2), row.cells[c - 3]);
        }
    }
}

TEST(TdmaSurvey, AveragesOverStartSlots) {
    const auto averaged = [](Rule rule, std::size_t size) {
        SurveyOptions options = options_of(rule, 7);
        options.runs = 5040;
        return cell(subsets(size, 5, options), 2);
    };
    EXPECT_EQ(averaged(Rule::eqn, 2), "0.00/14.873");
    EXPECT_EQ(averaged(Rule::eqn, 3), "0.00/33.287");
    EXPECT_EQ(averaged(Rule::eqn, 4), "0.00/62.814");
    EXPECT_EQ(averaged(Rule::eqn, 5), "0.00/122.818");
    EXPECT_EQ(averaged(Rule::rot, 2), "0.00/11.467");
    EXPECT_EQ(averaged(Rule::rot, 3), "0.00/27.136");
    EXPECT_EQ(averaged(Rule::rot, 4), "14.29/47.713");
    EXPECT_EQ(averaged(Rule::rot, 5), "14.29/85.411");
}

TEST(TdmaSurvey, HashNeverFailsWithinADay) {
    for (std::size_t size = 3; size <= 6; ++size) {
        for (std::uint32_t c = 2; c <= 10; ++c) {
            SurveyOptions options = options_of(Rule::hash, c);
            options.runs = 20;
            options.limit = 5760;  // slots of 15 s
            EXPECT_EQ(subsets(size, 10, options).failed, 0U) << size << " vehicles, C " << c;
        }
    }
}

TEST(TdmaSurvey, HashTakesAsLongAsPublished) {
    const double published[] = {23.5, 45.2, 83.6, 144.8};  // 3 to 6 vehicles, C = 2
    for (std::size_t size = 3; size <= 6; ++size) {
        SurveyOptions options = options_of(Rule::hash, 2);
        options.runs = 20;
        const auto mean = subsets(size, 10, options).mean_slots();
        ASSERT_TRUE(mean);
        EXPECT_NEAR(*mean, published[size - 3], 0.02 * published[size - 3]);
    }
}

TEST(TdmaSurvey, HashNeverFailsInSmallNetworks) {
    for (std::size_t size = 2; size <= 5; ++size) {
        SurveyOptions options = options_of(Rule::hash, 2);
        options.runs = 500;
        options.limit = 5760;
        EXPECT_EQ(subsets(size, 5, options).failed, 0U);
    }
}

// Pitfall 24: even C locks to the cycle of two slots; the hashed rule has nothing to lock to.
TEST(TdmaSurvey, Pitfall24CoolnessLocksToTheCycleButNotWithHash) {
    for (const Rule rule : {Rule::goby1, Rule::eq, Rule::eqn, Rule::rot}) {
        EXPECT_EQ(subsets(2, 5, options_of(rule, 2)).proven, 4U);
        EXPECT_EQ(subsets(2, 5, options_of(rule, 7)).failed, 0U);
    }
    EXPECT_EQ(subsets(2, 5, options_of(Rule::hash, 2)).failed, 0U);
}

TEST(TdmaSurvey, CollisionProbability) {
    const double p_collide[] = {1, 0.75, 0.5};
    for (const CollisionRow& row : collision_rows) {
        for (int p = 0; p < 3; ++p) {
            for (std::size_t size = 3; size <= 6; ++size) {
                SurveyOptions options = options_of(Rule::goby1, row.coolness);
                options.network.p_collide = p_collide[p];
                options.network.seed = 1;
                options.limit = 2;
                constexpr std::uint64_t runs = is_sanitized ? 4'000 : 40'000;
                const Summary summary = survey_drawn(runs, size, 1, 127, options);
                const double deviations = 5 * 0.5 / std::sqrt(double(runs));  // at most
                EXPECT_NEAR(double(summary.quiet) / runs, row.quiet[p][size - 3], deviations)
                    << "C " << row.coolness << ", p " << p_collide[p] << ", N " << size;
            }
        }
    }
}

TEST(TdmaSurvey, FiveOfTenVehiclesInLessThanTwoSeconds) {
    const auto before = std::chrono::steady_clock::now();
    EXPECT_EQ(subsets(5, 10, options_of(Rule::hash, 2)).runs, 252U);
    EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(2));
}

TEST(TdmaSurvey, SubsetsComeInOrderAndAreCounted) {
    std::vector<std::vector<int>> sets;
    for_each_subset(2, 4, 6, [&](const std::vector<int>& set) { sets.push_back(set); });
    EXPECT_EQ(sets, (std::vector<std::vector<int>>{{4, 5}, {4, 6}, {5, 6}}));
    EXPECT_EQ(count_subsets(2, 4, 6), 3U);
    EXPECT_EQ(count_subsets(5, 1, 10), 252U);
    EXPECT_EQ(count_subsets(5, 1, 127), 254'231'775U);
    EXPECT_EQ(count_subsets(60, 1, 127), ~std::uint64_t{0});
    EXPECT_EQ(count_subsets(3, 1, 3), 1U);
    EXPECT_THROW(count_subsets(4, 1, 3), DataError);
    EXPECT_THROW(count_subsets(0, 1, 3), DataError);
    EXPECT_THROW(count_subsets(1, 3, 2), DataError);
}

TEST(TdmaSurvey, TheSeedDecides) {
    SurveyOptions options = options_of(Rule::goby1, 4);
    options.network.p_collide = 0.3;
    options.runs = 50;
    const auto total = [&](std::uint64_t seed) {
        options.network.seed = seed;
        Summary summary;
        survey({1, 2, 3}, options, summary);
        return summary.total_slots;
    };
    EXPECT_EQ(total(1), total(1));
    EXPECT_NE(total(1), total(2));
}

}  // namespace seautils::tdma
