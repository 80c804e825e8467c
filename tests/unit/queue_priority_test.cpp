#include "seautils/queue/priority.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace seautils::queue {
namespace {

using std::strong_ordering;

constexpr std::int64_t s_ns = 1'000'000'000;

Claim any_claim() {
    const auto small = *rc::gen::inRange(0, 3);
    if (small == 0) {  // ties and zeros
        return {*rc::gen::inRange<std::uint64_t>(0, 3) * 1'000'000,
                *rc::gen::inRange<std::int64_t>(0, 4) * s_ns,
                *rc::gen::inRange<std::int64_t>(0, 4) * s_ns};
    }
    return {*rc::gen::inRange<std::uint64_t>(0, 1'000'000'000'001),
            *rc::gen::inRange<std::int64_t>(0, 1'000'000'000 * s_ns),
            *rc::gen::inRange<std::int64_t>(0, 4'000'000'000 * s_ns)};
}

/// V·Δt/ttl of two claims against each other, in floating point; 0: too near to tell.
int rough(const Claim& a, const Claim& b) {
    const long double p = static_cast<long double>(a.value_e6) * a.waited_ns / a.ttl_ns;
    const long double q = static_cast<long double>(b.value_e6) * b.waited_ns / b.ttl_ns;
    if (std::abs(p - q) <= 1e-12L * (p + q)) return 0;
    return p < q ? -1 : 1;
}

TEST(ComparePriority, AgreesWithTheFormula) {
    EXPECT_TRUE(rc::check("V·Δt/ttl", [] {
        Claim a = any_claim(), b = any_claim();
        for (Claim* c : {&a, &b}) *c = {c->value_e6 + 1, c->ttl_ns + 1, c->waited_ns + 1};
        const int order = rough(a, b);
        RC_ASSERT(order == 0 || (compare(Policy::priority, a, b) < 0) == (order < 0));
    }));
}

TEST(ComparePriority, IsAnOrder) {
    for (const Policy policy : {Policy::priority, Policy::value, Policy::ttl, Policy::oldest}) {
        EXPECT_TRUE(rc::check("reflexive, opposite, transitive", [policy] {
            const Claim a = any_claim(), b = any_claim(), c = any_claim();
            const auto order = [policy](const Claim& x, const Claim& y) {
                const auto found = compare(policy, x, y);
                return found < 0 ? -1 : found > 0 ? 1 : 0;
            };
            RC_ASSERT(order(a, a) == 0);
            RC_ASSERT(order(a, b) == -order(b, a));
            if (order(a, b) <= 0 && order(b, c) <= 0) RC_ASSERT(order(a, c) <= 0);
        }));
    }
}

// Pitfall 7: V/ttl is often equal, and then so are claims, at every time.
TEST(ComparePriority, EqualSlopesAreEqualClaims) {
    EXPECT_TRUE(rc::check("scaled alike", [] {
        const auto value = *rc::gen::inRange<std::uint64_t>(1, 1'000'000);
        const auto ttl_ns = *rc::gen::inRange<std::int64_t>(1, 1'000'000'000'000);
        const auto factor = *rc::gen::inRange<std::int64_t>(1, 1'000'000);
        const auto waited_ns = *rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000'000'000);
        const Claim a{value, ttl_ns, waited_ns};
        const Claim b{value * static_cast<std::uint64_t>(factor), ttl_ns * factor, waited_ns};
        RC_ASSERT((compare(Policy::priority, a, b) == 0));
    }));
}

TEST(ComparePriority, IsExactWhereFloatingPointIsNot) {
    // 10^12 · 4·10^18 / 10^18: the numbers have 100 bits, and differ in the last.
    const Claim a{1'000'000'000'000, 1'000'000'000 * s_ns, 4'000'000'000 * s_ns};
    Claim b = a;
    ++b.waited_ns;
    EXPECT_EQ(compare(Policy::priority, a, b), strong_ordering::less);
    EXPECT_EQ(priority(a), priority(b));
    // 0.1 thrice is 0.3.
    EXPECT_EQ(compare(Policy::priority, {100'000, s_ns, 3 * s_ns}, {300'000, s_ns, s_ns}),
              strong_ordering::equal);
}

// Pitfall 8: nothing divides by a ttl of infinity or multiplies one.
TEST(ComparePriority, WithoutAPriorityWhatIsLeftDecides) {
    const std::int64_t forever = 0;
    const Claim worthless{0, s_ns, 100 * s_ns};
    const Claim served_forever{2'000'000, forever, 0}, served{1'000'000, 100 * s_ns, 0};
    const Claim waited_forever{1'000'000, forever, s_ns}, waited{1, 1'000'000 * s_ns, 1};
    const Claim order[] = {worthless, served_forever, served, waited_forever, waited};
    for (std::size_t k = 1; k < std::size(order); ++k)
        EXPECT_EQ(compare(Policy::priority, order[k - 1], order[k]), strong_ordering::less) << k;
    EXPECT_EQ(compare(Policy::priority, waited_forever, {3'000'000, forever, s_ns}),
              strong_ordering::less);
    EXPECT_EQ(compare(Policy::priority, served, {1'000'000, 99 * s_ns, 0}), strong_ordering::less);
    EXPECT_EQ(compare(Policy::priority, worthless, {0, forever, 0}), strong_ordering::equal);
    EXPECT_EQ(priority(waited_forever), 0);
}

TEST(ComparePolicies, LookAtOneThing) {
    const Claim a{2'000'000, 100, 7}, b{1'000'000, 0, 9};
    EXPECT_EQ(compare(Policy::value, a, b), strong_ordering::greater);
    EXPECT_EQ(compare(Policy::ttl, a, b), strong_ordering::greater);  // b's is infinite
    EXPECT_EQ(compare(Policy::ttl, a, {1, 99, 0}), strong_ordering::less);
    EXPECT_EQ(compare(Policy::oldest, a, b), strong_ordering::less);
    EXPECT_EQ(parse_policy("oldest"), Policy::oldest);
    EXPECT_EQ(parse_policy("Oldest"), std::nullopt);
}

}  // namespace
}  // namespace seautils::queue
