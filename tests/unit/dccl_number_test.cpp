// Counting steps must give what the format's arithmetic of doubles gives, bit for bit.
#include "seautils/dccl/number.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <limits>

using namespace seautils;
using dccl::NumberCode;
using schema::Kind;

namespace {

/// Bounds and steps as people write them: decimals, powers of ten, and steps that are none.
NumberCode any_code(bool integers) {
    const auto kind = integers ? *rc::gen::element(Kind::int32, Kind::int64, Kind::uint32,
                                                   Kind::uint64, Kind::enumeration)
                               : *rc::gen::element(Kind::float32, Kind::float64);
    const double step = *rc::gen::element(1.0, 0.1, 0.01, 1e-3, 1e-6, 1e-9, 0.2, 0.25, 0.3, 2.0,
                                          2.5, 7.0, 10.0, 1000.0, 1e6);
    const auto digits = *rc::gen::inRange(0, 7);
    const double unit = dccl::step_of_precision(digits);
    auto first = *rc::gen::inRange<std::int64_t>(-4'000'000'000, 4'000'000'000);
    if (*rc::gen::arbitrary<bool>()) first /= 1'000'000;
    const bool is_unsigned = kind == Kind::uint32 || kind == Kind::uint64;
    if (is_unsigned) first = std::abs(first);
    const double min = static_cast<double>(first) * (integers ? 1.0 : unit);
    const auto codes = *rc::gen::inRange<std::int64_t>(1, 1 << *rc::gen::inRange(1, 24));
    const double max = min + static_cast<double>(codes) * step;
    return dccl::make_number_code(kind, min, integers ? std::floor(max) : max, step,
                                  *rc::gen::arbitrary<bool>());
}

double any_value(const NumberCode& c) {
    const double at = *rc::gen::inRange(-1'000'000, 2'000'000) * 1e-6;
    double x = c.min + (c.max - c.min) * at;
    switch (*rc::gen::inRange(0, 6)) {
        case 0:
            x = c.min;
            break;
        case 1:
            x = c.max;
            break;
        case 2:
            x = std::floor(x / c.resolution) * c.resolution;
            break;
        case 3:
            x = (std::floor(x / c.resolution) + 0.5) * c.resolution;
            break;  // halves
        case 4:
            x = std::nextafter(*rc::gen::element(c.min, c.max), *rc::gen::element(-1e300, 1e300));
            break;
        default:
            break;
    }
    return c.kind == Kind::float32 ? static_cast<double>(static_cast<float>(x)) : x;
}

std::uint64_t any_raw(const NumberCode& c) {
    return *rc::gen::arbitrary<std::uint64_t>() & ((std::uint64_t{1} << c.width) - 1);
}

}  // namespace

TEST(DcclNumber, CountedFloatsAreTheFormats) {
    std::size_t counted = 0, tried = 0;
    EXPECT_TRUE(rc::check("floats", [&] {
        const NumberCode c = any_code(false);
        ++tried;
        if (!c.counts_steps) return;
        ++counted;
        for (int k = 0; k < 500; ++k) {
            const double x = any_value(c);
            RC_ASSERT(dccl::encode_float(c, x) == dccl::encode_float_exactly(c, x));
            const std::uint64_t raw = any_raw(c);
            RC_ASSERT(std::bit_cast<std::uint64_t>(dccl::decode_float(c, raw)) ==
                      std::bit_cast<std::uint64_t>(dccl::decode_float_exactly(c, raw)));
        }
    }));
    EXPECT_GT(counted, tried / 4) << "the fast way is hardly tried";
}

TEST(DcclNumber, CountedIntegersAreTheFormats) {
    std::size_t counted = 0;
    EXPECT_TRUE(rc::check("integers", [&] {
        const NumberCode c = any_code(true);
        if (!c.counts_steps) return;
        ++counted;
        for (int k = 0; k < 500; ++k) {
            const auto x = *rc::gen::element(
                static_cast<std::int64_t>(any_value(c)), *rc::gen::arbitrary<std::int64_t>(),
                std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
            RC_ASSERT(dccl::encode_integer(c, x) == dccl::encode_integer_exactly(c, x));
            const std::uint64_t raw = any_raw(c);
            RC_ASSERT(dccl::decode_integer(c, raw) == dccl::decode_integer_exactly(c, raw));
        }
    }));
    EXPECT_GT(counted, 0U);
}

TEST(DcclNumber, WhatIsNoNumberOrTooLargeHasNoCode) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Kind kind : {Kind::float32, Kind::float64}) {
        const NumberCode c = dccl::make_number_code(kind, -10, 10, 0.1, false);
        ASSERT_TRUE(c.counts_steps);
        for (const double x :
             {infinity, -infinity, std::nan(""), 1e300, -1e300, 3e15, 10.06, -10.06}) {
            EXPECT_FALSE(dccl::encode_float(c, x)) << x;
        }
        // Code 0 is "not set": -10 is 1, and 10 is 200 steps more.
        EXPECT_EQ(dccl::encode_float(c, -10), 1U);
        EXPECT_EQ(dccl::encode_float(c, 10), 201U);
        EXPECT_EQ(dccl::encode_float(c, 10.04), 201U) << "rounds into the range";
    }
}

TEST(DcclNumber, BoundsThatStepsCannotCountAreTakenByTheFormatsWay) {
    EXPECT_FALSE(dccl::make_number_code(Kind::float64, 0, 1e15, 1e-3, true).counts_steps);
    EXPECT_FALSE(dccl::make_number_code(Kind::float32, 0, 1e6, 0.1, true).counts_steps);
    EXPECT_FALSE(dccl::make_number_code(Kind::int64, 0, 9e18, 1, true).counts_steps);
    EXPECT_FALSE(dccl::make_number_code(Kind::int32, 0, 100, 0.5, true).counts_steps);
}

TEST(DcclNumber, StepsOfPrecisionAreThoseOfPow) {
    for (int precision = -308; precision <= 323; ++precision) {
        EXPECT_EQ(dccl::step_of_precision(precision), std::pow(10.0, -precision)) << precision;
    }
}

TEST(DcclNumber, IntegersOfAllOf64BitsInSteps) {
    const double most = 9223372036854775808.0;  // 2^63
    const NumberCode c = dccl::make_number_code(Kind::int64, -most, most, 8192, false);
    EXPECT_EQ(c.width, 51);  // 2^64 / 8192 + 1 values, and "not set"
    const std::int64_t low = std::numeric_limits<std::int64_t>::min();
    for (const std::int64_t x : {low, low + 8192, std::int64_t{-8192}, std::int64_t{0},
                                 std::int64_t{8192}, std::int64_t{1} << 62}) {
        // From -2^63 on in steps of 2^13, and one for "not set".
        const std::uint64_t steps =
            (static_cast<std::uint64_t>(x) + (std::uint64_t{1} << 63)) >> 13;
        ASSERT_EQ(dccl::encode_integer(c, x), steps + 1);
        EXPECT_EQ(dccl::decode_integer(c, steps), x);
    }
}

TEST(DcclNumber, WidthIsTheFormats) {
    EXPECT_EQ(dccl::bits_for(1), 0U);
    EXPECT_EQ(dccl::bits_for(2), 1U);
    EXPECT_EQ(dccl::bits_for(129), 8U);
    EXPECT_EQ(dccl::bits_for(4503599627370497.0), 52U);
    // required -56 to -43.3 in steps of 0.1: (max - min) / step + 1 is 128.00000000000003 in doubles
    EXPECT_EQ(dccl::make_number_code(Kind::float64, -56, -43.3, 0.1, true).width, 8);
}
