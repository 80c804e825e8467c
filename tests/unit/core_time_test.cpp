// Times in text, held against a count of days of its own and against the C library's calendar.
#include "seautils/core/error.hpp"
#include "seautils/core/time.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <ctime>
#include <limits>

namespace seautils {
namespace {

constexpr std::int64_t second_us = 1'000'000;
constexpr std::int64_t last_us = 253'402'300'799'999'999;  ///< 9999-12-31T23:59:59.999999Z

bool is_leap(int year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

int days_of(int year, int month) {
    constexpr int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return month == 2 && is_leap(year) ? 29 : days[month - 1];
}

/// Days since 1970-01-01, counted month by month.
std::int64_t days_before(int year, int month, int day) {
    std::int64_t days = day - 1;
    for (int y = 1970; y < year; ++y) days += is_leap(y) ? 366 : 365;
    for (int m = 1; m < month; ++m) days += days_of(year, m);
    return days;
}

std::string refusal(const std::string& text) {
    try {
        return "taken: " + std::to_string(parse_utc(text));
    } catch (const DataError& e) {
        return e.what();
    }
}

bool is_refused(const std::string& text) {
    return refusal(text).ends_with(" is not of the form 2024-05-01T12:00:25Z");
}

}  // namespace

TEST(CoreTime, PublishedInstants) {
    EXPECT_EQ(parse_utc("1970-01-01T00:00:00Z"), 0);
    EXPECT_EQ(parse_utc("2001-09-09T01:46:40Z"), 1'000'000'000 * second_us);
    EXPECT_EQ(parse_utc("2038-01-19T03:14:07Z"), 2'147'483'647 * second_us);
    EXPECT_EQ(parse_utc("9999-12-31T23:59:59.999999Z"), last_us);
    EXPECT_EQ(parse_utc("1985-04-12T23:20:50.52Z"), 482'196'050'520'000);  // RFC 3339, 5.8
    // The same instant in two zones, RFC 3339, 5.8.
    EXPECT_EQ(parse_utc("1996-12-19T16:39:57-08:00"), parse_utc("1996-12-20T00:39:57Z"));
    EXPECT_EQ(parse_utc("1996-12-20T02:09:57+01:30"), parse_utc("1996-12-20T00:39:57Z"));
    EXPECT_EQ(parse_utc("1970-01-01t00:00:01z"), second_us);
}

TEST(CoreTime, SecondsBehindAnAt) {
    EXPECT_EQ(parse_utc("@0"), 0);
    EXPECT_EQ(parse_utc("@1714564825"), 1'714'564'825 * second_us);
    EXPECT_EQ(parse_utc("@1.5"), 1'500'000);
    EXPECT_EQ(parse_utc("@0.000001"), 1);
    EXPECT_EQ(parse_utc("@253402300799.999999"), last_us);
    for (const char* bad : {"@", "@-1", "@+1", "@1.", "@.5", "@1.0000001", "@1e3", "@ 1", "@1 ",
                            "@253402300800", "@9999999999999999999999", "@0x10"}) {
        EXPECT_TRUE(is_refused(bad)) << refusal(bad);
    }
}

TEST(CoreTime, LeapYears) {
    EXPECT_EQ(parse_utc("2024-02-29T00:00:00Z") + 86'400 * second_us,
              parse_utc("2024-03-01T00:00:00Z"));
    EXPECT_EQ(parse_utc("2000-02-29T12:00:00Z") + 86'400 * second_us,
              parse_utc("2000-03-01T12:00:00Z"));
    EXPECT_TRUE(is_refused("2023-02-29T00:00:00Z"));
    EXPECT_TRUE(is_refused("2100-02-29T00:00:00Z"));
    EXPECT_TRUE(is_refused("2024-02-30T00:00:00Z"));
}

TEST(CoreTime, AZoneMustStand) {
    for (const char* bad :
         {"2024-05-01T12:00:25", "2024-05-01 12:00:25Z", "2024-05-01", "2024-05-01T12:00:25+1",
          "2024-05-01T12:00:25+0100", "2024-05-01T12:00:25+24:00", "2024-05-01T12:00:25+00:60",
          "2024-05-01T12:00:25UTC", "2024-05-01T12:00:25Z+01:00"}) {
        EXPECT_TRUE(is_refused(bad)) << refusal(bad);
    }
}

TEST(CoreTime, EveryPartKeepsToItsRange) {
    for (const char* bad : {"",
                            "noon",
                            "T",
                            "Z",
                            "1969-12-31T23:59:59Z",
                            "10000-01-01T00:00:00Z",
                            "0000-01-01T00:00:00Z",
                            "2024-00-01T00:00:00Z",
                            "2024-13-01T00:00:00Z",
                            "2024-05-00T00:00:00Z",
                            "2024-05-32T00:00:00Z",
                            "2024-04-31T00:00:00Z",
                            "2024-05-01T24:00:00Z",
                            "2024-05-01T00:60:00Z",
                            "2024-05-01T00:00:60Z",
                            "2024-5-01T00:00:00Z",
                            "24-05-01T00:00:00Z",
                            "2024-05-01T0:00:00Z",
                            "2024-05-01T00:00:00.Z",
                            "2024-05-01T00:00:00.1234567Z",
                            "2024-05-01T00:00:00,5Z",
                            " 2024-05-01T00:00:00Z",
                            "2024-05-01T00:00:00Z ",
                            "2024-05-01T00:00:00Zx",
                            "-024-05-01T00:00:00Z",
                            "2024-05-01T-1:00:00Z"}) {
        EXPECT_TRUE(is_refused(bad)) << refusal(bad);
    }
    // The range is that of the instant, whatever its zone.
    EXPECT_TRUE(is_refused("1970-01-01T00:59:59+01:00"));
    EXPECT_EQ(parse_utc("1970-01-01T01:00:00+01:00"), 0);
    EXPECT_TRUE(is_refused("9999-12-31T23:59:59-00:01"));
}

TEST(CoreTime, ARefusalQuotesTheTimeInOneLine) {
    EXPECT_EQ(refusal("noon"), "time 'noon' is not of the form 2024-05-01T12:00:25Z");
    EXPECT_EQ(refusal(std::string("a\n\0b", 4)),
              R"(time 'a\x0a\x00b' is not of the form 2024-05-01T12:00:25Z)");
    EXPECT_LT(refusal(std::string(100'000, '9')).size(), 150U);
}

TEST(CoreTime, DecimalsAreAsManyAsItTakes) {
    EXPECT_EQ(format_utc(0), "1970-01-01T00:00:00Z");
    EXPECT_EQ(format_utc(500'000), "1970-01-01T00:00:00.500Z");
    EXPECT_EQ(format_utc(1'000), "1970-01-01T00:00:00.001Z");
    EXPECT_EQ(format_utc(1), "1970-01-01T00:00:00.000001Z");
    EXPECT_EQ(format_utc(last_us), "9999-12-31T23:59:59.999999Z");
}

TEST(CoreTime, ReadingIsTheInverseOfWriting) {
    EXPECT_TRUE(rc::check("parse_utc(format_utc(t)) is t", [] {
        const auto t = *rc::gen::inRange<std::int64_t>(0, last_us + 1);
        RC_ASSERT(parse_utc(format_utc(t)) == t);
        RC_ASSERT(parse_utc(fmt::format("@{}.{:06}", t / second_us, t % second_us)) == t);
    }));
}

TEST(CoreTime, DatesAreThoseOfAPlainCount) {
    EXPECT_TRUE(rc::check("civil dates", [] {
        const int year = *rc::gen::inRange(1970, 10000);
        const int month = *rc::gen::inRange(1, 13);
        const int day = *rc::gen::inRange(1, days_of(year, month) + 1);
        const int second = *rc::gen::inRange(0, 86400);
        const int offset = *rc::gen::inRange(0, 24 * 60);  // minutes
        const std::string clock = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", year, month,
                                              day, second / 3600, second / 60 % 60, second % 60);
        const std::int64_t t = (days_before(year, month, day) * 86400 + second) * second_us;
        RC_ASSERT(parse_utc(clock + "Z") == t);
        RC_ASSERT(format_utc(t) == clock + "Z");
        const std::int64_t shifted = t - offset * 60 * second_us;
        const std::string zoned = clock + fmt::format("+{:02}:{:02}", offset / 60, offset % 60);
        if (shifted < 0)
            RC_ASSERT(is_refused(zoned));
        else
            RC_ASSERT(parse_utc(zoned) == shifted);
    }));
}

TEST(CoreTime, DatesAreThoseOfTheCLibrary) {
    // A day in every month of every year, and the days around each new year.
    for (std::int64_t day = 0; day * 86400 * second_us <= last_us;
         day += day % 365 > 360 ? 1 : 13) {
        const std::time_t seconds = day * 86400 + day % 86400;
        std::tm tm{};
        ASSERT_NE(::gmtime_r(&seconds, &tm), nullptr);
        char text[32];
        ASSERT_GT(std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &tm), 0U);
        ASSERT_EQ(format_utc(seconds * second_us), text);
        ASSERT_EQ(parse_utc(text), seconds * second_us);
    }
}

TEST(CoreTime, NoTextOfAnyKindIsMoreThanATimeOrARefusal) {
    EXPECT_TRUE(rc::check("any text", [](const std::string& text) {
        try {
            const std::int64_t t = parse_utc(text);
            RC_ASSERT(t >= 0 && t <= last_us);
        } catch (const DataError&) {
        }
    }));
}

}  // namespace seautils
