// The study of policies in T. Schneider's thesis (MIT/WHOI 2013, §2.3, eq. 2.2-2.4, Fig. 2.6-2.8):
// three queues, an opportunity to send every 100 s, each queue empty with the same probability. The
// scheduler itself decides, with real messages: those that were not sent expire before the next
// opportunity, as they are born 1800 s ago less nothing.
#include "seautils/queue/scheduler.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace seautils::queue {
namespace {

constexpr std::int64_t s_ns = QueueConfig::ns_per_s;
constexpr int opportunities = 100;
constexpr std::array<int, 3> value{1, 2, 1};
constexpr std::array<std::int64_t, 3> ttl_s{1000, 2000, 3000};

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): the numbers are the same in any language.
class SplitMix {
public:
    std::uint64_t next() {
        std::uint64_t x = state_ += 0x9e3779b97f4a7c15;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
        x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
        return x ^ (x >> 31);
    }
    bool is_below(double p) { return static_cast<double>(next() >> 11) * 0x1p-53 < p; }

private:
    std::uint64_t state_ = 1;
};

/// How often each queue was served, and when last, counted in opportunities.
struct Tally {
    std::array<int, 3> served{}, last{};
    int idle = 0;
    std::string winners;  ///< 0: nobody

    Tally& operator+=(const Tally& other) {
        for (std::size_t j = 0; j < 3; ++j) {
            served[j] += other.served[j];
            last[j] += other.last[j];
        }
        idle += other.idle;
        return *this;
    }
    /// Sum over the sends of V + (t − t_last)/τ_s, whose second part telescopes; `ratio` is τ/τ_s.
    double score(double ratio) const {
        double sum = 0;
        for (std::size_t j = 0; j < 3; ++j) sum += value[j] * served[j] + ratio * last[j];
        return sum;
    }
};

SchedulerOptions market(Policy policy) {
    SchedulerOptions options;
    options.policy = policy;
    options.own_id = 1;
    for (std::size_t j = 0; j < 3; ++j) {
        const std::string id = std::to_string(j + 1);
        options.queues.set(id, "value_base", std::to_string(value[j]));
        options.queues.set(id, "ttl_s", std::to_string(ttl_s[j]));
        options.queues.set(id, "ack", "false");
    }
    return options;
}

/// A message for the queue that is alive now and never again.
Accepted fresh(std::size_t queue, std::uint64_t sequence, std::int64_t t_ns) {
    Message message;
    message.queue = {static_cast<std::uint32_t>(queue + 1), 2};
    message.data = "m";
    return {sequence, message, t_ns - ttl_s[queue] * s_ns, 0};
}

Tally run(Policy policy, const std::function<bool(std::size_t)>& is_empty) {
    Scheduler scheduler(market(policy), {});
    Tally tally;
    std::uint64_t sequence = 0;
    for (int k = 1; k <= opportunities; ++k) {
        const Now now{k * 100 * s_ns, 0};
        for (std::size_t j = 0; j < 3; ++j) {
            if (!is_empty(j)) scheduler.push(fresh(j, ++sequence, now.steady_ns), now);
        }
        const auto packet = scheduler.fill({1, 1, {}, true, now.steady_ns}, now);
        tally.winners += packet ? std::to_string(packet->carried.front().queue.id) : "0";
        tally.idle += packet ? 0 : 1;
        if (!packet) continue;
        const std::size_t winner = packet->carried.front().queue.id - 1;
        ++tally.served[winner];
        tally.last[winner] = k;
        scheduler.settle(packet->number, Outcome::sent, now);
    }
    return tally;
}

Tally full(Policy policy) {
    return run(policy, [](std::size_t) { return false; });
}

TEST(Market, Check0WinnersOfFigure26) {
    EXPECT_EQ(full(Policy::priority).winners.substr(0, 10), "1212123121");
}

TEST(Market, Check1NobodyIsEverEmpty) {
    using Served = std::array<int, 3>;
    const Tally priority = full(Policy::priority);
    EXPECT_EQ(priority.served, (Served{43, 43, 14}));
    EXPECT_EQ(priority.score(10), 3113);
    EXPECT_NEAR(priority.score(0.1), 172.7, 0.05);
    const Tally value_only = full(Policy::value);
    EXPECT_EQ(value_only.served, (Served{0, 100, 0}));
    EXPECT_EQ(value_only.score(10), 1200);
    EXPECT_NEAR(value_only.score(0.1), 210, 1e-9);
    const Tally ttl_only = full(Policy::ttl);
    EXPECT_EQ(ttl_only.served, (Served{100, 0, 0}));
    EXPECT_EQ(ttl_only.score(10), 1100);
    EXPECT_NEAR(ttl_only.score(0.1), 110, 1e-9);
    EXPECT_EQ(full(Policy::oldest).score(10), 3103);
}

/// 1000 runs in one stream of random numbers.
Tally thousand(Policy policy, double empty) {
    SplitMix random;
    Tally sum;
    for (int k = 0; k < 1000; ++k)
        sum += run(policy, [&](std::size_t) { return random.is_below(empty); });
    return sum;
}

/// E[S] of a policy that serves in a fixed order; rank[j]: how many queues come before j.
double closed_form(std::array<int, 3> rank, double empty, double ratio) {
    double sum = 0;
    for (std::size_t j = 0; j < 3; ++j) {
        const double p = std::pow(empty, rank[j]) * (1 - empty), q = 1 - p;
        sum += value[j] * opportunities * p;
        sum += ratio * (opportunities - q * (1 - std::pow(q, opportunities)) / (1 - q));
    }
    return sum;
}

struct Row {
    double empty, priority, value, ttl, priority_slow, value_slow, ttl_slow;
};

class MarketMeans : public testing::TestWithParam<Row> {};

// The closed forms are the published ones to their last digit; means of 1000 runs are within five
// standard errors of them (one: 5 / 0.35).
TEST_P(MarketMeans, Check2) {
    const Row& row = GetParam();
    EXPECT_NEAR(closed_form({1, 0, 2}, row.empty, 10), row.value, 0.005);
    EXPECT_NEAR(closed_form({0, 1, 2}, row.empty, 10), row.ttl, 0.005);
    EXPECT_NEAR(closed_form({1, 0, 2}, row.empty, 0.1), row.value_slow, 0.005);
    EXPECT_NEAR(closed_form({0, 1, 2}, row.empty, 0.1), row.ttl_slow, 0.005);
    const Tally priority = thousand(Policy::priority, row.empty);
    EXPECT_NEAR(priority.score(10) / 1000, row.priority, 25);
    EXPECT_NEAR(priority.score(0.1) / 1000, row.priority_slow, 1.75);
    const Tally value_only = thousand(Policy::value, row.empty);
    EXPECT_NEAR(value_only.score(10) / 1000, row.value, 45);
    EXPECT_NEAR(value_only.score(0.1) / 1000, row.value_slow, 1.75);
    const Tally ttl_only = thousand(Policy::ttl, row.empty);
    EXPECT_NEAR(ttl_only.score(10) / 1000, row.ttl, 45);
    EXPECT_NEAR(ttl_only.score(0.1) / 1000, row.ttl_slow, 1.75);
}

INSTANTIATE_TEST_SUITE_P(
    Table, MarketMeans,
    testing::Values(Row{0.1, 3098.11, 2432.43, 2351.43, 171.69, 212.33, 131.33},
                    Row{0.2, 3095.64, 2833.40, 2769.40, 169.94, 205.74, 141.74},
                    Row{0.3, 3090.05, 2976.89, 2927.89, 166.38, 195.40, 146.40},
                    Row{0.4, 3079.88, 3021.10, 2985.10, 160.23, 182.28, 146.28},
                    Row{0.5, 3063.29, 3027.50, 3002.50, 150.70, 166.40, 141.40},
                    Row{0.6, 3037.44, 3012.29, 2996.29, 137.10, 147.34, 131.34},
                    Row{0.7, 2996.61, 2976.72, 2967.72, 118.68, 124.51, 115.51},
                    Row{0.8, 2925.08, 2908.18, 2904.18, 94.61, 97.19, 93.19},
                    Row{0.9, 2747.60, 2732.57, 2731.57, 63.49, 64.05, 63.05}));

struct Exact {
    double empty;
    Policy policy;
    std::array<int, 3> served, last;
    int idle;
    double score_fast, score_slow;
};

class MarketExact : public testing::TestWithParam<Exact> {};

TEST_P(MarketExact, Check3) {
    const Exact& row = GetParam();
    const Tally tally = thousand(row.policy, row.empty);
    EXPECT_EQ(tally.served, row.served);
    EXPECT_EQ(tally.last, row.last);
    EXPECT_EQ(tally.idle, row.idle);
    EXPECT_NEAR(tally.score(10) / 1000, row.score_fast, 0.0005);
    EXPECT_NEAR(tally.score(0.1) / 1000, row.score_slow, 0.00006);
}

INSTANTIATE_TEST_SUITE_P(Table, MarketExact,
                         testing::Values(Exact{0.3,
                                               Policy::priority,
                                               {39903, 39569, 17905},
                                               {99001, 99027, 97330},
                                               2623,
                                               3090.526,
                                               166.4818},
                                         Exact{0.3,
                                               Policy::value,
                                               {20847, 70151, 6379},
                                               {96068, 99582, 85428},
                                               2623,
                                               2978.308,
                                               195.6358},
                                         Exact{0.3,
                                               Policy::ttl,
                                               {70035, 20963, 6379},
                                               {99557, 96444, 85428},
                                               2623,
                                               2932.630,
                                               146.4829},
                                         Exact{0.6,
                                               Policy::priority,
                                               {29455, 29670, 19437},
                                               {98141, 98145, 96777},
                                               21438,
                                               3038.862,
                                               137.5383},
                                         Exact{0.6,
                                               Policy::value,
                                               {23703, 40428, 14431},
                                               {96797, 98541, 94364},
                                               21438,
                                               3016.010,
                                               147.9602},
                                         Exact{0.6,
                                               Policy::ttl,
                                               {39932, 24199, 14431},
                                               {98566, 96779, 94364},
                                               21438,
                                               2999.851,
                                               131.7319}));

TEST(Market, RandomNumbersAreThePublishedOnes) {
    SplitMix random;
    EXPECT_EQ(random.next(), 0x910a2dec89025cc1U);
    EXPECT_EQ(random.next(), 0xbeeb8da1658eec67U);
    EXPECT_EQ(random.next(), 0xf893a2eefb32555eU);
}

}  // namespace
}  // namespace seautils::queue
