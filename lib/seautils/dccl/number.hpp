#ifndef SEAUTILS_DCCL_NUMBER_HPP
#define SEAUTILS_DCCL_NUMBER_HPP

#include "seautils/schema/layout.hpp"

#include <cmath>
#include <cstdint>
#include <optional>

namespace seautils::dccl {

/// A bounded number as a code of a few bits: dccl.default2, 3 and 4.
///
/// Bounds and step are doubles, and the rounding errors of the arithmetic are part of the wire
/// format: required -56 to -43.3 in steps of 0.1 takes 8 bits, because (max - min) / step + 1
/// comes out as 128.00000000000003. The expressions below must not be rearranged, contracted, or
/// computed in another precision.
struct NumberCode {
    schema::Kind kind = schema::Kind::int32;  ///< the C++ type that the reference computes in
    bool null_code = false;                   ///< code 0 is "not set", values are shifted up by one
    std::uint8_t width = 0;                   ///< bits
    double min = 0, max = 0;
    double resolution = 1;   ///< step
    double inverse = 1;      ///< 1.0 / step
    bool whole_step = true;  ///< integers: the step has no fraction, so values snap to it
    std::int64_t step = 1;   ///< trunc(step)
    std::int64_t base = 0;  ///< integers: min on the grid, as 64 bits (two's complement for uint64)
    double base_d = 0;      ///< floating: min on the grid

    /// Whole numbers of steps give the very same values and codes as the arithmetic of doubles, and
    /// faster: the doubles' rounding errors are proven smaller than half a step (number.cpp).
    bool counts_steps = false;
    std::int64_t first_step = 0;  ///< of the value whose code is 0
    std::int64_t low_step = 0,
                 high_step = 0;  ///< of the least and the greatest value within bounds

    bool is_integer() const {
        return kind != schema::Kind::float32 && kind != schema::Kind::float64;
    }
    bool is_unsigned() const {
        return kind == schema::Kind::uint32 || kind == schema::Kind::uint64;
    }
};

/// 10^-precision as pow(10.0, -precision) of the GNU C library gives it, on any machine: the step
/// that an option `precision` means.
double step_of_precision(std::int32_t precision);

/// ceil(log2(n)) with log2 rounded to a double, as the reference computes it, without libm.
/// Check values: 1 gives 0, 2 gives 1, 129 gives 8, 2^52 + 1 gives 52.
unsigned bits_for(double n);

/// The code for values of `kind` from min to max in steps of `resolution`.
/// @param required  no code is spent on "not set"
NumberCode make_number_code(schema::Kind kind, double min, double max, double resolution,
                            bool required);

/// Q(x) for floating values: the nearest multiple of the step, halves up.
inline double quantize(double x, double resolution, double inverse) {
    if (resolution >= 1) return std::floor(x / resolution + 0.5) * resolution;
    return std::floor(x * inverse + 0.5) / inverse;
}

/// Q(x) for integers in 64 bits: halves of positive numbers up, negative ones towards zero, because
/// the remainder has the sign of x.
std::int64_t quantize_integer(std::int64_t x, const NumberCode& code);

/// The four functions below as the format defines them, in doubles.
std::optional<std::uint64_t> encode_integer_exactly(const NumberCode& code, std::int64_t value);
std::optional<std::uint64_t> encode_float_exactly(const NumberCode& code, double value);
std::int64_t decode_integer_exactly(const NumberCode& code, std::uint64_t raw);
double decode_float_exactly(const NumberCode& code, std::uint64_t raw);

/// The value of a number of steps.
inline double value_of_steps(const NumberCode& c, std::int64_t steps) {
    const auto n = static_cast<double>(steps);
    const double x = c.resolution >= 1 ? n * c.resolution : n / c.inverse;
    return c.kind == schema::Kind::float32 ? static_cast<double>(static_cast<float>(x)) : x;
}

/// The code of a value, or nothing where it is out of range. The value is rounded first.
/// Integers: `value` holds 64 bits, unsigned for uint32 and uint64.
inline std::optional<std::uint64_t> encode_integer(const NumberCode& c, std::int64_t value) {
    if (!c.counts_steps) return encode_integer_exactly(c, value);
    if (value < c.low_step || value > c.high_step) return std::nullopt;
    return static_cast<std::uint64_t>(value - c.first_step) + (c.null_code ? 1 : 0);
}

/// float64, and float32 with its roundings. NaN is out of range.
inline std::optional<std::uint64_t> encode_float(const NumberCode& c, double value) {
    if (!c.counts_steps) return encode_float_exactly(c, value);
    const double y = (c.resolution >= 1 ? value / c.resolution : value * c.inverse) + 0.5;
    if (!(y > -2e15 && y < 2e15)) return std::nullopt;
    auto steps = static_cast<std::int64_t>(y);
    if (static_cast<double>(steps) > y) --steps;
    if (steps < c.low_step || steps > c.high_step) return std::nullopt;
    return static_cast<std::uint64_t>(steps - c.first_step) + (c.null_code ? 1 : 0);
}

/// The value of a code, which is not checked against the maximum; the code "not set" must have been
/// taken out and the shift undone.
inline std::int64_t decode_integer(const NumberCode& c, std::uint64_t raw) {
    if (!c.counts_steps) return decode_integer_exactly(c, raw);
    return c.first_step + static_cast<std::int64_t>(raw);
}
inline double decode_float(const NumberCode& c, std::uint64_t raw) {
    if (!c.counts_steps) return decode_float_exactly(c, raw);
    return value_of_steps(c, c.first_step + static_cast<std::int64_t>(raw));
}

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_NUMBER_HPP
