// Numbers as text: the shortest that reads back the same, and no longer than the C++ library's.
#include "seautils/schema/number_text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace seautils::schema {
namespace {

std::string text_of(double x) {
    std::string text;
    append_double(text, x);
    return text;
}

std::string text_of(float x) {
    std::string text;
    append_float(text, x);
    return text;
}

template <class Int>
std::string integer_of(Int x) {
    std::string text;
    append_integer(text, x);
    return text;
}

/// How many significant digits a number is written with.
std::size_t digits(std::string_view text) {
    text = text.substr(0, text.find('e'));
    std::string only;
    for (const char c : text) {
        if (c >= '0' && c <= '9') only += c;
    }
    only.erase(0, only.find_first_not_of('0'));
    if (text.find('.') == text.npos) only.erase(only.find_last_not_of('0') + 1);
    return only.size();
}

/// The shortest decimal by the C++ library.
template <class T>
std::string shortest(T x) {
    char text[64];
    const auto [end, error] =
        std::to_chars(text, text + sizeof text, x, std::chars_format::scientific);
    EXPECT_EQ(error, std::errc());
    return {text, end};
}

void check(double x) {
    const std::string text = text_of(x);
    RC_ASSERT(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)) ==
              std::bit_cast<std::uint64_t>(x));
    RC_ASSERT(digits(text) == digits(shortest(x)));
}

/// As short as the library's, or a whole number written out.
bool is_short(float x, std::string_view text) {
    const bool whole =
        std::fabs(x) < 1e9F && std::trunc(x) == x && text.find_first_of(".e") == text.npos;
    return whole || digits(text) == digits(shortest(x));
}

void check(float x) {
    const std::string text = text_of(x);
    RC_ASSERT(std::bit_cast<std::uint32_t>(std::strtof(text.c_str(), nullptr)) ==
              std::bit_cast<std::uint32_t>(x));
    // Rounded to binary64 first, as most readers do, it is the same.
    RC_ASSERT(static_cast<float>(std::strtod(text.c_str(), nullptr)) == x);
    RC_ASSERT(is_short(x, text));
}

}  // namespace

TEST(SchemaNumber, PlainDecimalsAndExponents) {
    EXPECT_EQ(text_of(0.0), "0");
    EXPECT_EQ(text_of(-0.0), "-0");
    EXPECT_EQ(text_of(1.0), "1");
    EXPECT_EQ(text_of(-1.5), "-1.5");
    EXPECT_EQ(text_of(0.1), "0.1");
    EXPECT_EQ(text_of(-62.4), "-62.4");
    EXPECT_EQ(text_of(12.3456), "12.3456");
    EXPECT_EQ(text_of(1714564825.25), "1714564825.25");
    EXPECT_EQ(text_of(0.3), "0.3");
    EXPECT_EQ(text_of(0.1 + 0.2), "0.30000000000000004");
    EXPECT_EQ(text_of(1e-4), "0.0001");
    EXPECT_EQ(text_of(1e-6), "0.000001");
    EXPECT_EQ(text_of(1e-7), "1e-07");
    EXPECT_EQ(text_of(1.5e-5), "0.000015");
    EXPECT_EQ(text_of(1.23456e-5), "1.23456e-05");
    EXPECT_EQ(text_of(123456789012345.0), "123456789012345");
    EXPECT_EQ(text_of(1e16), "1e+16");
    EXPECT_EQ(text_of(1e22), "1e+22");
    EXPECT_EQ(text_of(5e-324), "5e-324");
    EXPECT_EQ(text_of(1.7976931348623157e308), "1.7976931348623157e+308");
    EXPECT_EQ(text_of(9007199254740993.0), "9007199254740992");
    EXPECT_EQ(text_of(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(text_of(-std::numeric_limits<double>::infinity()), "-inf");
    EXPECT_EQ(text_of(std::nan("")), "nan");
}

TEST(SchemaNumber, AFloatIsShorterThanTheDoubleThatItIs) {
    EXPECT_EQ(text_of(0.1F), "0.1");
    EXPECT_EQ(text_of(16777216.0F), "16777216");
    EXPECT_EQ(text_of(3.4028235e38F), "3.4028235e+38");
    EXPECT_EQ(text_of(1.1754944e-38F), "1.1754944e-38");
    EXPECT_EQ(text_of(1e-45F), "1e-45");
    EXPECT_EQ(text_of(-0.0F), "-0");
    EXPECT_EQ(text_of(std::numeric_limits<float>::infinity()), "inf");
}

TEST(SchemaNumber, IntegersToTheirLimits) {
    EXPECT_EQ(integer_of(std::int64_t{0}), "0");
    EXPECT_EQ(integer_of(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
    EXPECT_EQ(integer_of(std::numeric_limits<std::int64_t>::max()), "9223372036854775807");
    EXPECT_EQ(integer_of(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
    std::string text = "x=";
    append_integer(text, std::int64_t{-7});
    append_double(text, 0.5);
    EXPECT_EQ(text, "x=-70.5");
}

TEST(SchemaNumber, AnyDoubleReadsBackTheSameAndIsShortest) {
    EXPECT_TRUE(rc::check("any bits", [] {
        const auto x = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
        RC_PRE(std::isfinite(x));
        check(x);
    }));
    EXPECT_TRUE(rc::check("measurements", [] {
        const auto n = *rc::gen::inRange<std::int64_t>(-1'000'000'000'000, 1'000'000'000'000);
        const double x = static_cast<double>(n) / std::pow(10.0, *rc::gen::inRange(0, 9));
        check(x);
        check(std::nextafter(x, 1e300));
        check(std::nextafter(x, -1e300));
    }));
}

TEST(SchemaNumber, AnyFloatReadsBackTheSameAndIsShortest) {
    EXPECT_TRUE(rc::check("any bits", [] {
        const auto x = std::bit_cast<float>(*rc::gen::arbitrary<std::uint32_t>());
        RC_PRE(std::isfinite(x));
        check(x);
    }));
    EXPECT_TRUE(rc::check("measurements", [] {
        const auto n = *rc::gen::inRange(-100'000'000, 100'000'000);
        const float x =
            static_cast<float>(n) / static_cast<float>(std::pow(10.0, *rc::gen::inRange(0, 8)));
        check(x);
        check(std::nextafter(x, 1e30F));
        check(std::nextafter(x, -1e30F));
    }));
    // Every millionth or so of all floats.
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << 32; bits += 1007273) {
        const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        if (!std::isfinite(x)) continue;
        const std::string text = text_of(x);
        ASSERT_EQ(std::strtof(text.c_str(), nullptr), x) << text;
        ASSERT_TRUE(is_short(x, text)) << text << ' ' << shortest(x);
    }
}

TEST(SchemaNumber, FixedHasAllOfItsDecimals) {
    const auto fixed = [](double x, unsigned decimals) {
        std::string out;
        append_fixed(out, x, decimals);
        return out;
    };
    EXPECT_EQ(fixed(0, 2), "0.00");
    EXPECT_EQ(fixed(-0.001, 2), "0.00");
    EXPECT_EQ(fixed(-0.005, 2), "-0.01");
    EXPECT_EQ(fixed(68.697, 2), "68.70");
    EXPECT_EQ(fixed(179.99996, 4), "180.0000");
    EXPECT_EQ(fixed(5.305768490123, 10), "5.3057684901");
    EXPECT_EQ(fixed(-12, 0), "-12");
    EXPECT_EQ(fixed(1e300, 2), "1e+300");
    EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 2), "inf");
}

}  // namespace seautils::schema
