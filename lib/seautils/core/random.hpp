#ifndef SEAUTILS_CORE_RANDOM_HPP
#define SEAUTILS_CORE_RANDOM_HPP

#include <cstdint>

namespace seautils {

/// The first number of a SplitMix64 whose state is `x`: a bijection of 64 bits that scatters them.
constexpr std::uint64_t splitmix64(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15U;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
    return x ^ (x >> 31);
}

/// Random numbers that are the same on every machine.
///
/// Source: G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014, doi:10.1145/2660193.2660195, as in S. Vigna's splitmix64.c.
/// Check values: seed 1 gives 910a2dec89025cc1, beeb8da1658eec67, f893a2eefb32555e.
class SplitMix64 {
public:
    explicit constexpr SplitMix64(std::uint64_t seed = 0) : state_(seed) {}

    constexpr std::uint64_t operator()() {
        const std::uint64_t number = splitmix64(state_);
        state_ += 0x9E3779B97F4A7C15U;
        return number;
    }

    /// 0 <= u < 1, in steps of 2^-53.
    constexpr double uniform() { return static_cast<double>((*this)() >> 11) * 0x1p-53; }

    /// 0 to n - 1, each as likely; n is at least 1.
    constexpr std::uint64_t below(std::uint64_t n) {
        const std::uint64_t uneven = (0 - n) % n;  // 2^64 mod n
        std::uint64_t number = (*this)();
        while (number < uneven) number = (*this)();
        return number % n;
    }

private:
    std::uint64_t state_;
};

}  // namespace seautils

#endif  // SEAUTILS_CORE_RANDOM_HPP
