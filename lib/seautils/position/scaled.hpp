#ifndef SEAUTILS_POSITION_SCALED_HPP
#define SEAUTILS_POSITION_SCALED_HPP

#include "seautils/position/integer_math.hpp"

#include <bit>
#include <cstdint>

namespace seautils::position {

/// A number of 31 significant bits and a wide exponent, for what spans more than 64 bits do. All by
/// integers, so that it is the same on any machine; what has no place is cut off.
/// Exponents are not checked: those of observers stay within a few hundred.
class Scaled {
public:
    constexpr Scaled() = default;
    constexpr explicit Scaled(std::int64_t value) : Scaled(value, 0) {}
    /// mantissa * 2^exponent
    constexpr Scaled(std::int64_t mantissa, int exponent) {
        if (mantissa == 0) return;
        const std::uint64_t size = mantissa < 0 ? ~static_cast<std::uint64_t>(mantissa)
                                                : static_cast<std::uint64_t>(mantissa);
        const int shift = static_cast<int>(std::bit_width(size)) - digits;
        mantissa_ = shifted(mantissa, -shift);
        exponent_ = exponent + shift;
    }

    /// value * 2^bits rounded down; at most 2^62 away from zero.
    constexpr std::int64_t fixed(int bits) const {
        const int shift = exponent_ + bits;
        if (shift > 62 - digits && mantissa_ != 0) {
            return mantissa_ < 0 ? -(std::int64_t{1} << 62) : std::int64_t{1} << 62;
        }
        return shifted(mantissa_, shift);
    }
    /// The root; of what is below zero, zero.
    constexpr Scaled root() const {
        if (mantissa_ <= 0) return {};
        const int odd = exponent_ & 1;
        const auto radicand = static_cast<std::uint64_t>(mantissa_) << (30 + odd);
        return {std::int64_t{square_root(radicand)}, (exponent_ - 30 - odd) / 2};
    }

    friend constexpr Scaled operator+(Scaled a, Scaled b) {
        if (a.mantissa_ == 0) return b;
        if (b.mantissa_ == 0) return a;
        if (a.exponent_ < b.exponent_) return b + a;
        const int apart = a.exponent_ - b.exponent_;
        if (apart > digits) return a;
        return {shifted(a.mantissa_, apart) + b.mantissa_, b.exponent_};
    }
    friend constexpr Scaled operator-(Scaled a, Scaled b) { return a + b * Scaled(-1); }
    friend constexpr Scaled operator*(Scaled a, Scaled b) {
        return {a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_};
    }
    /// @param b  not zero
    friend constexpr Scaled operator/(Scaled a, Scaled b) {
        return {shifted(a.mantissa_, digits) / b.mantissa_, a.exponent_ - b.exponent_ - digits};
    }
    friend constexpr bool operator<(Scaled a, Scaled b) { return (a - b).mantissa_ < 0; }

private:
    static constexpr int digits = 31;

    /// value * 2^shift rounded down; no overflow is the caller's care.
    static constexpr std::int64_t shifted(std::int64_t value, int shift) {
        if (shift >= 0) return value * (std::int64_t{1} << shift);
        return shift < -63 ? (value < 0 ? -1 : 0) : value >> -shift;
    }

    std::int64_t mantissa_ = 0;  ///< of 31 bits and a sign, the first bit set, or zero
    int exponent_ = 0;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_SCALED_HPP
