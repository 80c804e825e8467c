#ifndef SEAUTILS_POSITION_INTEGER_MATH_HPP
#define SEAUTILS_POSITION_INTEGER_MATH_HPP

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

/// The functions that the predictors need, in whole numbers: the same on any machine. Qn is a number
/// times 2^n.
namespace seautils::position {

/// The greatest number whose square is not above v.
constexpr std::uint32_t square_root(std::uint64_t v) {
    std::uint64_t root = 0;
    std::uint64_t step = std::uint64_t{1} << ((std::bit_width(v | 1) - 1) & ~1U);
    for (; step > 0; step /= 4) {
        if (v >= root + step) {
            v -= root + step;
            root = root / 2 + step;
        } else {
            root /= 2;
        }
    }
    return static_cast<std::uint32_t>(root);
}

/// v times 2^-n to the nearest, halves upwards.
constexpr std::int64_t round_shift(std::int64_t v, unsigned n) {
    return (v + (std::int64_t{1} << n >> 1)) >> n;
}

constexpr std::int64_t clamp(std::int64_t v, std::int64_t least, std::int64_t most) {
    return v < least ? least : v > most ? most : v;
}

namespace detail {

/// e^-x in Q30, x in Q30 and 0 to 1: the series to its 13th term.
constexpr std::uint64_t exp_minus_series_q30(std::uint64_t x) {
    std::int64_t sum = std::int64_t{1} << 30, term = sum;
    for (int k = 1; k < 14; ++k) {
        term = -(term * static_cast<std::int64_t>(x) >> 30) / k;
        sum += term;
    }
    return static_cast<std::uint64_t>(sum);
}

/// e^-x in Q30, x in Q24 from 0 on.
constexpr std::uint64_t exp_minus_q30(std::uint64_t x_q24) {
    std::uint64_t e = exp_minus_series_q30((x_q24 & 0xFFFFFF) << 6);
    for (std::uint64_t k = x_q24 >> 24; k > 0; --k)
        e = e * exp_minus_series_q30(std::uint64_t{1} << 30) >> 30;
    return e;
}

/// a * b in Q60, of numbers below 4.
constexpr std::uint64_t product_q60(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t a1 = a >> 32, a0 = a & 0xFFFFFFFF, b1 = b >> 32, b0 = b & 0xFFFFFFFF;
    const std::uint64_t middle = a1 * b0 + (a0 * b0 >> 32);
    const std::uint64_t other = a0 * b1 + (middle & 0xFFFFFFFF);
    return ((a1 * b1 + (middle >> 32) + (other >> 32)) << 4) + ((other & 0xFFFFFFFF) >> 28);
}

/// e^(-1/n) in Q60, by its series.
constexpr std::uint64_t exp_minus_1_by_q60(std::uint64_t n) {
    std::uint64_t sum = 0, term = std::uint64_t{1} << 60;
    for (std::uint64_t k = 1; term > 0; ++k) {
        sum = k % 2 == 1 ? sum + term : sum - term;
        term /= n * k;
    }
    return sum;
}

/// Standard normal distribution function in steps of 1/64 from -5.5 to 5.5, Q24; its ends are 0 and 1.
/// Right to the last bit: a tail's small mass is a difference of its values.
constexpr int phi_half = 352;
constexpr std::array<std::int32_t, 2 * phi_half + 2> make_phi() {
    constexpr std::uint64_t density_at_0_q60 = 459'949'134'171'706'403;  // 1 / sqrt(2 pi)
    // e^(-x^2 / 2) at each k/128 is the one before times a ratio that shrinks by e^(-1/128^2).
    std::uint64_t density = density_at_0_q60, ratio = exp_minus_1_by_q60(2 * 128 * 128);
    const std::uint64_t shrink = exp_minus_1_by_q60(128 * 128);
    const auto next = [&] {
        density = product_q60(density, ratio);
        ratio = product_q60(ratio, shrink);
        return density;
    };
    std::array<std::int32_t, 2 * phi_half + 2> phi{};
    std::uint64_t area_q60 = std::uint64_t{1} << 59;
    for (int k = 0; k <= phi_half; ++k) {
        const auto above = static_cast<std::int32_t>((area_q60 + (std::uint64_t{1} << 35)) >> 36);
        phi.at(static_cast<std::size_t>(phi_half + k)) = above;
        phi.at(static_cast<std::size_t>(phi_half - k)) = (1 << 24) - above;
        // Simpson's rule over the next step.
        const std::uint64_t from = density, middle = next(), to = next();
        area_q60 += (from + 4 * middle + to) / (3 * 128);
    }
    phi.front() = 0;
    phi.at(2 * phi_half) = phi.back() = 1 << 24;
    return phi;
}

/// log2(1 + k/256), Q16, by repeated squaring.
constexpr std::array<std::int32_t, 257> make_log2() {
    std::array<std::int32_t, 257> table{};
    for (std::size_t k = 0; k <= 256; ++k) {
        std::uint64_t x = (std::uint64_t{1} << 31) + (std::uint64_t{k} << 23);
        std::int32_t log = k == 256 ? 1 << 17 : 0;
        for (int bit = 0; k < 256 && bit < 17; ++bit) {
            x = x * x >> 31;
            log *= 2;
            if (x < std::uint64_t{1} << 32) continue;
            x /= 2;
            ++log;
        }
        table.at(k) = (log + 1) / 2;
    }
    return table;
}

/// 1 / (1 + e^-x), Q16, in steps of 1/16 from -12 to 12.
constexpr int squash_half = 192;
constexpr std::array<std::int32_t, 2 * squash_half + 2> make_squash() {
    std::array<std::int32_t, 2 * squash_half + 2> table{};
    for (int k = 0; k <= squash_half; ++k) {
        const std::uint64_t e = exp_minus_q30(static_cast<std::uint64_t>(k) << 20);
        const auto above =
            static_cast<std::int32_t>((std::uint64_t{1} << 46) / ((std::uint64_t{1} << 30) + e));
        table.at(static_cast<std::size_t>(squash_half + k)) = above;
        table.at(static_cast<std::size_t>(squash_half - k)) = 65536 - above;
    }
    table.back() = table.at(2 * squash_half);
    return table;
}

inline constexpr auto phi = make_phi();
inline constexpr auto log2 = make_log2();
inline constexpr auto squash = make_squash();

}  // namespace detail

/// Probability in Q24 that a standard normal value is below t, Q14 and within -5.5 to 5.5; 0 and 1 at
/// these ends. Check values: 0: 0.5; 1: 0.841345; -2: 0.0227501; within 8e-6.
inline std::int32_t normal_cdf_q24(std::int32_t t_q14) {
    const std::int32_t at = t_q14 + (detail::phi_half << 8);
    const auto index = static_cast<std::size_t>(at >> 8);
    const std::int32_t low = detail::phi[index];
    return low + ((detail::phi[index + 1] - low) * (at & 255) >> 8);
}

/// Logarithm to the base 2 in Q16 of a number from 1 on. Check values: 1: 0; 3: 1.58496.
inline std::int32_t log2_q16(std::uint64_t v) {
    const int exponent = static_cast<int>(std::bit_width(v)) - 1;
    const std::uint64_t mantissa = exponent >= 16 ? v >> (exponent - 16) : v << (16 - exponent);
    const auto index = static_cast<std::size_t>(mantissa >> 8 & 255);
    const std::int32_t low = detail::log2[index];
    const auto part = static_cast<std::int32_t>(mantissa & 255);
    return exponent * 65536 + low + ((detail::log2[index + 1] - low) * part >> 8);
}

/// A probability in Q16 from its logit in Q12, of any size. Check values: 0: 0.5; 1: 0.731059.
inline std::int32_t probability_q16(std::int32_t logit_q12) {
    constexpr std::int32_t most = detail::squash_half << 8;
    if (logit_q12 <= -most) return detail::squash.front();
    if (logit_q12 >= most) return detail::squash.back();
    const std::int32_t at = logit_q12 + most;
    const auto index = static_cast<std::size_t>(at >> 8);
    const std::int32_t low = detail::squash[index];
    return low + ((detail::squash[index + 1] - low) * (at & 255) >> 8);
}

/// A direction: a vector of length 1, Q14.
struct Direction {
    std::int32_t x = 1 << 14, y = 0;
};

/// What a vector has along and across (to the left of) a direction, in the vector's own unit.
struct Pair {
    std::int32_t x = 0, y = 0;

    friend bool operator==(const Pair&, const Pair&) = default;
};

inline Pair into_frame(Pair v, Direction d) {
    return {static_cast<std::int32_t>((std::int64_t{v.x} * d.x + std::int64_t{v.y} * d.y) >> 14),
            static_cast<std::int32_t>((std::int64_t{v.y} * d.x - std::int64_t{v.x} * d.y) >> 14)};
}
inline Pair out_of_frame(Pair v, Direction d) {
    return {static_cast<std::int32_t>((std::int64_t{v.x} * d.x - std::int64_t{v.y} * d.y) >> 14),
            static_cast<std::int32_t>((std::int64_t{v.y} * d.x + std::int64_t{v.x} * d.y) >> 14)};
}
inline std::uint32_t length(Pair v) {
    return square_root(static_cast<std::uint64_t>(std::int64_t{v.x} * v.x) +
                       static_cast<std::uint64_t>(std::int64_t{v.y} * v.y));
}
/// The direction of a vector; `otherwise` of one that is shorter than `least`.
inline Direction direction_of(Pair v, std::uint32_t least, Direction otherwise) {
    const std::int64_t size = length(v);
    if (size < least || size == 0) return otherwise;
    return {static_cast<std::int32_t>(v.x * std::int64_t{1 << 14} / size),
            static_cast<std::int32_t>(v.y * std::int64_t{1 << 14} / size)};
}

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_INTEGER_MATH_HPP
