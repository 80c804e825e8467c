#include "seautils/dccl/number.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>

namespace seautils::dccl {

namespace {

using schema::Kind;

std::int64_t wrap_add(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}
std::int64_t wrap_subtract(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

/// A double as the nearest value of 64 bits towards zero; saturated instead of undefined.
std::int64_t to_bits(double x, bool is_unsigned) {
    if (is_unsigned) {
        if (!(x > 0)) return 0;
        if (x >= 18446744073709551616.0) return -1;
        return static_cast<std::int64_t>(static_cast<std::uint64_t>(x));
    }
    if (x >= 9223372036854775808.0) return std::numeric_limits<std::int64_t>::max();
    if (!(x >= -9223372036854775808.0)) return std::numeric_limits<std::int64_t>::min();
    return static_cast<std::int64_t>(x);
}

double to_double(std::int64_t x, bool is_unsigned) {
    return is_unsigned ? static_cast<double>(static_cast<std::uint64_t>(x))
                       : static_cast<double>(x);
}

/// What a 64-bit result becomes in the field's own type (32-bit types wrap around).
std::int64_t narrow(std::int64_t x, Kind kind) {
    if (kind == Kind::uint32) return static_cast<std::int64_t>(static_cast<std::uint32_t>(x));
    if (kind == Kind::int32 || kind == Kind::enumeration) return static_cast<std::int32_t>(x);
    return x;
}

double to_float32(double x) { return static_cast<double>(static_cast<float>(x)); }

/// floor(x) without a call into libm where the value fits an integer.
double floor_of(double x) {
    if (!(std::fabs(x) < 4e15)) return std::floor(x);
    const double whole = static_cast<double>(static_cast<std::int64_t>(x));
    return whole > x ? whole - 1 : whole;
}

double quantize_fast(double x, const NumberCode& c) {
    if (c.resolution >= 1) return floor_of(x / c.resolution + 0.5) * c.resolution;
    return floor_of(x * c.inverse + 0.5) / c.inverse;
}

/// Steps of 1 whose bounds and codes are exact in doubles and fit the kind: nothing is rounded.
bool count_integers(NumberCode& c) {
    constexpr double exact = 4503599627370496.0;  // 2^52
    if (c.resolution != 1 || !(c.min >= -exact && c.max <= exact) || c.width > 52) return false;
    const std::int64_t last = c.base + static_cast<std::int64_t>((std::uint64_t{1} << c.width) - 1);
    if (narrow(c.base, c.kind) != c.base || narrow(last, c.kind) != last) return false;
    if (c.is_unsigned() && c.min < 0) return false;
    c.first_step = c.base;
    c.low_step = static_cast<std::int64_t>(std::ceil(c.min));
    c.high_step = static_cast<std::int64_t>(std::floor(c.max));
    return true;
}

/// Let n be a value's steps and b those of the minimum, both within M of 0. The format takes the
/// value as n / inverse (rounded), and codes it as floor((n / inverse - b / inverse) * inverse + 0.5).
/// Each of its four operations is off by at most u times its result: u = 2^-53 for float64, 2^-24
/// for float32. In steps the sum is at most (|n| + |b| + 2 |n - b|) u <= 6 M u. Decoding adds up to
/// less. With M = 2^40 (float64) or 2^19 (float32) that is below 0.2, so that the floor gives n - b.
bool count_floats(NumberCode& c) {
    const bool narrow_float = c.kind == Kind::float32;
    const double most = narrow_float ? 524288.0 : 1099511627776.0;
    const double min = narrow_float ? to_float32(c.min) : c.min;
    const double first =
        std::floor(c.resolution >= 1 ? min / c.resolution + 0.5 : min * c.inverse + 0.5);
    if (c.width > 40 || !(std::fabs(first) < most && c.max / c.resolution < 2 * most)) return false;
    if (first + std::ldexp(1.0, c.width) >= most) return false;
    c.first_step = static_cast<std::int64_t>(first);
    const auto last = c.first_step + static_cast<std::int64_t>(std::uint64_t{1} << c.width);
    c.low_step = c.first_step - 2;
    while (c.low_step <= last && value_of_steps(c, c.low_step) < c.min) ++c.low_step;
    c.high_step = static_cast<std::int64_t>(std::floor(c.max / c.resolution)) + 2;
    while (c.high_step >= c.first_step && value_of_steps(c, c.high_step) > c.max) --c.high_step;
    return c.low_step - c.first_step < 8 && c.low_step >= c.first_step;
}

}  // namespace

double step_of_precision(std::int32_t precision) {
    // 10^23 lies between two doubles, as good as in the middle; pow, whose result is on the wire,
    // takes the upper one. So it does for 10^210; all other powers are rounded correctly.
    if (precision == -23) return 1.0000000000000001e23;
    if (precision == -210) return 1.0000000000000001e210;
    const std::string text = fmt::format("1e{}", -static_cast<std::int64_t>(precision));
    double step = precision > 0 ? 0 : std::numeric_limits<double>::infinity();
    std::from_chars(text.data(), text.data() + text.size(), step);
    return step;
}

unsigned bits_for(double n) {
    if (!(n > 1)) return 0;
    int exponent = 0;
    const double mantissa = std::frexp(n, &exponent);  // n = mantissa * 2^exponent, in [0.5, 1)
    const int floor_log2 = exponent - 1;
    if (mantissa == 0.5) return static_cast<unsigned>(floor_log2);
    // log2(n) = floor_log2 + excess / ln 2 to first order; it rounds down to the whole number where
    // that is at most half a unit in the last place of floor_log2.
    const double excess = 2 * mantissa - 1;
    int magnitude = 0;
    std::frexp(static_cast<double>(floor_log2), &magnitude);
    const double half_ulp = floor_log2 == 0 ? 0 : std::ldexp(1.0, magnitude - 1 - 53);
    const bool rounds_down = excess / 0.69314718055994531 <= half_ulp;
    return static_cast<unsigned>(rounds_down ? floor_log2 : floor_log2 + 1);
}

NumberCode make_number_code(Kind kind, double min, double max, double resolution, bool required) {
    NumberCode c;
    c.kind = kind;
    c.null_code = !required;
    c.min = min;
    c.max = max;
    c.resolution = resolution;
    c.inverse = 1.0 / resolution;
    c.whole_step = resolution >= 1 && resolution - std::trunc(resolution) < 2.2e-16;
    c.step = c.whole_step ? to_bits(std::trunc(resolution), false) : 1;
    const double codes = (max - min) / resolution + 1 + (required ? 0 : 1);
    c.width = static_cast<std::uint8_t>(bits_for(std::ceil(codes)));
    if (c.is_integer()) {
        c.base = quantize_integer(to_bits(min, c.is_unsigned()), c);
    } else if (kind == Kind::float32) {
        c.base_d = to_float32(quantize(to_float32(min), c.resolution, c.inverse));
    } else {
        c.base_d = quantize(min, c.resolution, c.inverse);
    }
    if (c.is_integer() ? count_integers(c) : count_floats(c)) c.counts_steps = true;
    return c;
}

std::int64_t quantize_integer(std::int64_t x, const NumberCode& c) {
    if (!c.whole_step || c.step == 1) return x;
    const std::int64_t remainder =
        c.is_unsigned() ? static_cast<std::int64_t>(static_cast<std::uint64_t>(x) %
                                                    static_cast<std::uint64_t>(c.step))
                        : x % c.step;
    const std::int64_t down = wrap_subtract(x, remainder);
    return static_cast<double>(remainder) >= c.resolution / 2 ? wrap_add(down, c.step) : down;
}

std::optional<std::uint64_t> encode_integer_exactly(const NumberCode& c, std::int64_t value) {
    const std::int64_t rounded = quantize_integer(value, c);
    const double as_double = to_double(rounded, c.is_unsigned());
    if (as_double < c.min || as_double > c.max) return std::nullopt;
    std::int64_t code = wrap_subtract(rounded, c.base);  // never below 0: 64 bits hold it
    if (c.resolution != 1) {
        const double steps = to_double(code, true);
        code = to_bits(c.resolution > 1 ? steps / c.resolution : steps * c.inverse, true);
    }
    return static_cast<std::uint64_t>(code) + (c.null_code ? 1 : 0);
}

std::optional<std::uint64_t> encode_float_exactly(const NumberCode& c, double value) {
    double x = quantize_fast(value, c);
    if (c.kind == Kind::float32) {
        x = to_float32(x);
        if (!(x >= c.min && x <= c.max)) return std::nullopt;
        x = to_float32(x - c.base_d);
        x = to_float32(c.resolution >= 1 ? x / c.resolution : x * c.inverse);
    } else {
        if (!(x >= c.min && x <= c.max)) return std::nullopt;
        x -= c.base_d;
        x = c.resolution >= 1 ? x / c.resolution : x * c.inverse;
    }
    const auto code = static_cast<std::int64_t>(floor_of(x + 0.5));
    return static_cast<std::uint64_t>(code) + (c.null_code ? 1 : 0);
}

std::int64_t decode_integer_exactly(const NumberCode& c, std::uint64_t raw) {
    auto steps = static_cast<std::int64_t>(raw);
    if (c.resolution != 1) {
        const auto code = static_cast<double>(raw);
        steps = to_bits(c.resolution > 1 ? code * c.resolution : code / c.inverse, true);
    }
    return narrow(quantize_integer(wrap_add(steps, c.base), c), c.kind);
}

double decode_float_exactly(const NumberCode& c, std::uint64_t raw) {
    auto x = static_cast<double>(raw);
    if (c.kind == Kind::float32) {
        x = to_float32(x);
        x = to_float32(c.resolution >= 1 ? x * c.resolution : x / c.inverse);
        return to_float32(quantize_fast(to_float32(x + c.base_d), c));
    }
    x = c.resolution >= 1 ? x * c.resolution : x / c.inverse;
    return quantize_fast(x + c.base_d, c);
}

}  // namespace seautils::dccl
