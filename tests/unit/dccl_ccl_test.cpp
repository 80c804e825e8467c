#include "seautils/dccl/ccl.hpp"

#include "seautils/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace seautils::dccl {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Case {
    CclCodec codec;
    double value;
    std::uint32_t code;
    double back;
    bool metres_per_second = false;
};

unsigned bits(CclCodec codec) { return ccl_bits(codec, 13); }

std::uint32_t encode(const Case& c) {
    return ccl_encode(c.codec, c.value, bits(c.codec), c.metres_per_second);
}

// Codes read out of three messages of the reference library, bit by bit, and its decoded values.
TEST(DcclCcl, MessagesOfTheReferenceLibrary) {
    const Case cases[] = {
        {CclCodec::latloncompressed, 41.5257, 1935238, 41.525707426751545},
        {CclCodec::latloncompressed, -70.6712, 13483700, -70.67119487180649},
        {CclCodec::latloncompressed, -89.9, 12587573, -89.8999965071674},
        {CclCodec::latloncompressed, 179.9, 8383947, 179.90000723600474},
        {CclCodec::latloncompressed, 0, 0, 0},
        {CclCodec::fix_age, 10, 2, 8},
        {CclCodec::fix_age, 1020, 255, 1020},
        {CclCodec::fix_age, 3, 0, 0},
        {CclCodec::heading, 180, 128, 180.705887F},
        {CclCodec::heading, 0, 0, 0},
        {CclCodec::heading, 359.9F, 255, 360},
        {CclCodec::depth, 99.96F, 1000, 100},
        {CclCodec::depth, 150, 1250, 150},
        {CclCodec::depth, 1234.4F, 3334, 1234},
        {CclCodec::velocity, 1.5F, 38, 1.52F},
        {CclCodec::velocity, 0, 0, 0},
        {CclCodec::velocity, 5, 125, 5},
        {CclCodec::watts, 100, 25, 100},
        {CclCodec::watts, 2000, 255, 1020},
        {CclCodec::hires_altitude, 12.34F, 1234, 12.34F},
        {CclCodec::hires_altitude, 655.35F, 65534, 655.34F},
        {CclCodec::temperature, 15.5F, 125, 15.53125},
        {CclCodec::temperature, -4, 0, -4},
        {CclCodec::temperature, 40, 255, 35.84375},
        {CclCodec::salinity, 34.9F, 149, 34.9F},
        {CclCodec::salinity, 19, 0, 0},
        {CclCodec::salinity, 45, 250, 45},
        {CclCodec::sound_speed, 1501.5F, 153, 1501.5},
        {CclCodec::sound_speed, 1425, 0, 1425},
        {CclCodec::sound_speed, 1552, 254, 1552},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(encode(c), c.code) << static_cast<int>(c.codec) << ' ' << c.value;
        EXPECT_EQ(ccl_decode(c.codec, c.code, false), c.back)
            << static_cast<int>(c.codec) << ' ' << c.code;
    }
}

// Worked out by hand from the formulas.
TEST(DcclCcl, ByHand) {
    const Case cases[] = {
        {CclCodec::latloncompressed, 180, 8388607, 180},
        {CclCodec::latloncompressed, -180, 0x800001, -180},
        {CclCodec::depth, -3, 0, 0},
        {CclCodec::depth, 0.04, 0, 0},          // 0.9
        {CclCodec::depth, 0.06, 1, 0.1F},       // 1.1
        {CclCodec::depth, 199.95, 1500, 200},   // 1000 + 500.25
        {CclCodec::depth, 500.2, 2100, 500},    // 1500 + 600.9
        {CclCodec::depth, 999.8, 3100, 1000},   // 1500 + 1600.1
        {CclCodec::depth, 5999.4, 8099, 5999},  // 3100 + 4999.9
        {CclCodec::depth, 6000, 8100, 6000},
        {CclCodec::depth, 1e30, 8100, 6000},
        {CclCodec::velocity, -1.5F, 219, -1.48F},  // -37.5 + 0.5 = -37
        {CclCodec::velocity, 5.12, 128, -5.12F},   // 128.5: too large for the sign bit
        {CclCodec::speed, 1.5, 45, 1.5, true},
        {CclCodec::speed, -1.5, 211, -1.5, true},
        {CclCodec::speed, 0.02, 1, 1 / 30.0F, true},  // 0.6 rounds to 1
        {CclCodec::speed, -0.01, 0, 0, true},         // -0.3 to 0
        {CclCodec::speed, 1e9, 127, 127 / 30.0F, true},
        {CclCodec::speed, -99, 129, -127 / 30.0F, true},
        {CclCodec::speed, 3, 3, 60, false},  // comes back in twenties
        {CclCodec::speed, -200, 129, -2540, false},
        {CclCodec::watts, -5, 0, 0},
        {CclCodec::watts, 7.9, 1, 4},
        {CclCodec::hires_altitude, -1, 0, 0},
        {CclCodec::hires_altitude, 1e38, 65535, 655.35F},
        {CclCodec::salinity, 20, 0, 0},
        {CclCodec::salinity, 99, 255, 45.5},
        {CclCodec::temperature, -9, 0, -4},
        {CclCodec::temperature, 0, 26, 0.0625},  // 25.6 + 0.5; 26 * 40 / 256 - 4
        {CclCodec::sound_speed, 1500.4, 150, 1500},
        {CclCodec::sound_speed, 1553, 0, 1425},        // 256 loses its upper bit
        {CclCodec::sound_speed, 1424.5, 255, 1552.5},  // -1
        {CclCodec::fix_age, 1024, 0, 0},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(encode(c), c.code) << static_cast<int>(c.codec) << ' ' << c.value;
        EXPECT_EQ(ccl_decode(c.codec, c.code, c.metres_per_second), c.back)
            << static_cast<int>(c.codec) << ' ' << c.code;
    }
    EXPECT_EQ(ccl_decode(CclCodec::depth, 8191, false), 6000);
    EXPECT_EQ(ccl_decode(CclCodec::depth, 0xE000 + 1000, false), 100);  // low 13 bits count
    EXPECT_EQ(ccl_encode(CclCodec::depth, 6000, 8, false), 8100U % 256);
}

TEST(DcclCcl, NamesAndBits) {
    const std::pair<const char*, unsigned> all[] = {{"_ccl_latloncompressed", 24},
                                                    {"_ccl_fix_age", 8},
                                                    {"_ccl_time_date", 24},
                                                    {"_ccl_heading", 8},
                                                    {"_ccl_depth", 13},
                                                    {"_ccl_velocity", 8},
                                                    {"_ccl_speed", 8},
                                                    {"_ccl_watts", 8},
                                                    {"_ccl_hires_altitude", 16},
                                                    {"_ccl_salinity", 8},
                                                    {"_ccl_temperature", 8},
                                                    {"_ccl_sound_speed", 8},
                                                    {"_ccl_gfi_pitch_oil", 16}};
    int index = 0;
    for (const auto& [name, bits] : all) {
        const auto codec = ccl_codec(name);
        ASSERT_TRUE(codec) << name;
        EXPECT_EQ(static_cast<int>(*codec), index++) << name;
        EXPECT_EQ(ccl_bits(*codec, 13), bits) << name;
    }
    for (const char* name : {"", "_ccl_", "depth", "_ccl_depth2", "_ccl_dept"}) {
        EXPECT_FALSE(ccl_codec(name)) << name;
    }
}

TEST(DcclCcl, AnyFiniteNumberHasACodeOfItsBits) {
    for (int k = 0; k <= static_cast<int>(CclCodec::gfi_pitch_oil); ++k) {
        const auto codec = static_cast<CclCodec>(k);
        for (const double x : {0.0, -0.0, 1e300, -1e300, 3e9, -3e9, 1e19, -1e19, 5e-324}) {
            for (const bool metres : {false, true}) {
                EXPECT_EQ(ccl_encode(codec, x, bits(codec), metres) >> bits(codec), 0U)
                    << k << ' ' << x;
            }
        }
        for (const double x : {nan, HUGE_VAL, -HUGE_VAL}) {
            EXPECT_THROW(ccl_encode(codec, x, bits(codec), false), DataError) << k << ' ' << x;
        }
    }
}

/// How far a value may be off.
double tolerance(CclCodec codec, double value) {
    switch (codec) {
        case CclCodec::latloncompressed:
            return 180.0 / 8388607;
        case CclCodec::fix_age:
        case CclCodec::watts:
            return 4;
        case CclCodec::heading:
            return 360.0 / 255;
        case CclCodec::depth:
            return value < 99 ? 0.1 : value < 199 ? 0.2 : value < 999 ? 0.5 : 1;
        case CclCodec::velocity:
            return 1.5 / 25;  // negative ones are rounded up
        case CclCodec::speed:
            return 1 / 30.0;
        case CclCodec::hires_altitude:
            return 0.01;
        case CclCodec::salinity:
            return 0.1;
        case CclCodec::temperature:
            return 40 / 256.0;
        case CclCodec::sound_speed:
            return 0.5;
        default:
            return 0;
    }
}

TEST(DcclCcl, WhatIsNotOutOfRangeComesBack) {
    for (int k = 0; k <= static_cast<int>(CclCodec::sound_speed); ++k) {
        const auto codec = static_cast<CclCodec>(k);
        if (codec == CclCodec::time_date) continue;
        const auto range = ccl_out_of_range(codec, -1e9, bits(codec), true);
        ASSERT_TRUE(range) << k;
        for (int n = 0; n <= 10000; ++n) {
            const double x = range->min + (range->max - range->min) * n / 10000;
            const double value = codec == CclCodec::latloncompressed
                                     ? x
                                     : static_cast<double>(static_cast<float>(x));
            if (ccl_out_of_range(codec, value, bits(codec), true)) continue;  // the float's
            const std::uint32_t code = ccl_encode(codec, value, bits(codec), true);
            EXPECT_NEAR(ccl_decode(codec, code, true), value, 1.01 * tolerance(codec, value)) << k;
        }
    }
}

TEST(DcclCcl, WhatIsOutOfRange) {
    const auto outside = [](CclCodec codec, double x, unsigned bits) {
        const auto range = ccl_out_of_range(codec, x, bits, false);
        return range ? std::to_string(range->min) + " " + std::to_string(range->max) : "no";
    };
    EXPECT_EQ(outside(CclCodec::depth, 6000, 13), "no");
    EXPECT_EQ(outside(CclCodec::depth, 6000.5, 13), "0.000000 6000.000000");
    EXPECT_EQ(outside(CclCodec::depth, -0.1, 16), "0.000000 6000.000000");
    EXPECT_EQ(outside(CclCodec::depth, 105, 10), "0.000000 104.600000");  // (1023 - 1000) / 5
    EXPECT_EQ(outside(CclCodec::salinity, 0, 8), "no");
    EXPECT_EQ(outside(CclCodec::salinity, 20, 8), "20.100000 45.500000");
    EXPECT_EQ(outside(CclCodec::speed, 127, 8), "no");
    EXPECT_EQ(outside(CclCodec::speed, 128, 8), "-127.000000 127.000000");
    EXPECT_EQ(outside(CclCodec::latloncompressed, 200, 24), "-180.000000 180.000000");
    EXPECT_EQ(outside(CclCodec::time_date, 1e30, 24), "no");
}

// Times by `date -u -d @SECONDS`; the first three are in messages of the reference library.
TEST(DcclCcl, TimeDate) {
    EXPECT_EQ(ccl_encode_time_date(1699999999000000), 12015828U);
    EXPECT_EQ(ccl_encode_time_date(1700000003000000), 12015829U);
    EXPECT_EQ(ccl_encode_time_date(1672531200000000), 1081344U);
    constexpr std::int64_t now_s = 1700000000;  // 2023-11-14
    EXPECT_EQ(ccl_decode_time_date(12015828, now_s), 1699999996000000U);
    EXPECT_EQ(ccl_decode_time_date(12015829, now_s), 1700000000000000U);
    EXPECT_EQ(ccl_decode_time_date(1081344, now_s), 1672531200000000U);
    // 2024-02-29T23:59:59Z: 14 + 59 * 16 + 23 * 1024 + 29 * 32768 + 2 * 1048576
    EXPECT_EQ(ccl_encode_time_date(1709251199999999), 3071934U);
    EXPECT_EQ(ccl_decode_time_date(3071934, 1709000000), 1709251196000000U);
    EXPECT_THROW(ccl_decode_time_date(3071934, now_s), DataError);  // 2023 has no such day
}

TEST(DcclCcl, TimeDateAtTheEdges) {
    EXPECT_EQ(ccl_encode_time_date(0), 1U << 15 | 1U << 20);
    EXPECT_EQ(ccl_decode_time_date(1U << 15 | 1U << 20, 0), 0U);
    EXPECT_EQ(ccl_encode_time_date(253402300799999999),
              14U | 59U << 4 | 23U << 10 | 31U << 15 | 12U << 20);
    EXPECT_THROW(ccl_encode_time_date(253402300800000000), DataError);
    EXPECT_THROW(ccl_encode_time_date(~std::uint64_t{0}), DataError);
    EXPECT_THROW(ccl_decode_time_date(0, 0), DataError);                     // month 0
    EXPECT_THROW(ccl_decode_time_date(13U << 20 | 1U << 15, 0), DataError);  // month 13
    EXPECT_THROW(ccl_decode_time_date(1U << 20 | 1U << 15, -1), DataError);  // 1969
    EXPECT_EQ(ccl_decode_time_date(0xFFFFU | 1U << 20, 0),
              (60U + 63 * 60 + 31 * 3600) * 1000000ULL);  // carries over
    try {
        ccl_decode_time_date(2U << 20 | 30U << 15, 0);
        FAIL();
    } catch (const DataError& e) {
        EXPECT_STREQ(e.what(), "month 2 has no day 30 in the year 1970");
    }
}

TEST(DcclCcl, GfiPitchOil) {
    // 50 * 0.31 = 15.5, 30 * 63 / 180 = 10.5 rounds to 11, 100 * 0.31 = 31
    EXPECT_EQ(ccl_encode_gfi_pitch_oil({50, 30, 100}), 15U | 31U << 5 | 11U << 10);
    // -7 * 0.35 = -2.45 rounds to -2, which is 62 of 64
    EXPECT_EQ(ccl_encode_gfi_pitch_oil({-1, -7, 3.3F}), 0U | 1U << 5 | 62U << 10);
    EXPECT_EQ(ccl_encode_gfi_pitch_oil({999, -999, 0}), 31U | 0U << 5 | 32U << 10);  // -31.5 to -32
    const GfiPitchOil back = ccl_decode_gfi_pitch_oil(15U | 31U << 5 | 62U << 10);
    EXPECT_EQ(back.gfi_percent, 1500.0F / 31);
    EXPECT_EQ(back.oil_percent, 100.0F);
    EXPECT_EQ(back.pitch_deg, -360.0F / 63);
    EXPECT_EQ(ccl_decode_gfi_pitch_oil(ccl_encode_gfi_pitch_oil({0, 90, 0})).pitch_deg,
              -5760.0F / 63);  // +32 does not fit in six bits
    EXPECT_THROW(ccl_encode_gfi_pitch_oil({0, std::nanf(""), 0}), DataError);
}

}  // namespace
}  // namespace seautils::dccl
