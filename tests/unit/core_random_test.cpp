// The random numbers are those that everybody's SplitMix64 gives.
#include "seautils/core/random.hpp"

#include <gtest/gtest.h>

#include <array>

namespace seautils {

TEST(CoreRandom, PublishedNumbers) {
    SplitMix64 random(1);
    EXPECT_EQ(random(), 0x910a2dec89025cc1U);
    EXPECT_EQ(random(), 0xbeeb8da1658eec67U);
    EXPECT_EQ(random(), 0xf893a2eefb32555eU);
    EXPECT_EQ(splitmix64(1), 0x910a2dec89025cc1U);
    static_assert(splitmix64(0) == 0xe220a8397b1dcdafU);  // Vigna's first of seed 0
}

TEST(CoreRandom, UniformLiesBelowOne) {
    SplitMix64 random(3), same(3);
    double sum = 0;
    for (int k = 0; k < 100'000; ++k) {
        const double u = random.uniform();
        ASSERT_EQ(u, static_cast<double>(same() >> 11) / 9007199254740992.0);
        ASSERT_LT(u, 1);
        sum += u;
    }
    EXPECT_NEAR(sum / 100'000, 0.5, 0.005);  // five standard deviations
}

TEST(CoreRandom, BelowIsEven) {
    SplitMix64 random(4);
    std::array<int, 7> count{};
    for (int k = 0; k < 70'000; ++k) ++count.at(random.below(7));
    for (const int n : count) EXPECT_NEAR(n, 10'000, 500);
    EXPECT_EQ(random.below(1), 0U);
    // Three quarters of all numbers: one in four is thrown away.
    for (int k = 0; k < 1000; ++k) EXPECT_LT(random.below(3ULL << 62), 3ULL << 62);
}

}  // namespace seautils
