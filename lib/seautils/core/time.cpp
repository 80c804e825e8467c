#include "seautils/core/time.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <chrono>

namespace seautils {

namespace {

constexpr std::int64_t second_us = 1'000'000;
constexpr std::int64_t last_us = 253'402'300'800 * second_us;  ///< the year 10000

/// Reads a text from left to right; `good` turns false at the first thing that does not fit.
struct Scanner {
    std::string_view rest;
    bool good = true;

    bool accept(char c) {
        if (rest.empty() || rest.front() != c) return false;
        rest.remove_prefix(1);
        return true;
    }
    void expect(char c) { good = accept(c) && good; }

    bool digit() const { return !rest.empty() && rest.front() >= '0' && rest.front() <= '9'; }

    /// A number of at least `least` and at most `most` digits.
    std::int64_t number(int least, int most) {
        std::int64_t x = 0;
        int count = 0;
        for (; count < most && digit(); ++count, rest.remove_prefix(1))
            x = x * 10 + (rest.front() - '0');
        good = good && count >= least;
        return x;
    }

    /// `.5` as microseconds; 0 where no point follows.
    std::int64_t fraction_us() {
        if (!accept('.')) return 0;
        const std::size_t before = rest.size();
        std::int64_t x = number(1, 6);
        for (std::size_t k = before - rest.size(); k < 6; ++k) x *= 10;
        return x;
    }
};

std::int64_t civil_us(Scanner& s) {
    namespace chr = std::chrono;
    const auto year = static_cast<int>(s.number(4, 4));
    s.expect('-');
    const auto month = static_cast<unsigned>(s.number(2, 2));
    s.expect('-');
    const auto day = static_cast<unsigned>(s.number(2, 2));
    if (!s.accept('T')) s.expect('t');
    const std::int64_t hour = s.number(2, 2);
    s.expect(':');
    const std::int64_t minute = s.number(2, 2);
    s.expect(':');
    const std::int64_t second = s.number(2, 2);
    const std::int64_t fraction = s.fraction_us();
    const chr::year_month_day date{chr::year{year}, chr::month{month}, chr::day{day}};
    s.good = s.good && date.ok() && year >= 1970 && hour < 24 && minute < 60 && second < 60;
    if (!s.good) return 0;
    const std::int64_t days = chr::sys_days{date}.time_since_epoch().count();
    return (days * 86400 + hour * 3600 + minute * 60 + second) * second_us + fraction;
}

std::int64_t offset_us(Scanner& s) {
    if (s.accept('Z') || s.accept('z')) return 0;
    const bool west = s.accept('-');
    if (!west) s.expect('+');
    const std::int64_t hour = s.number(2, 2);
    s.expect(':');
    const std::int64_t minute = s.number(2, 2);
    s.good = s.good && hour < 24 && minute < 60;
    return (west ? 60 : -60) * (hour * 60 + minute) * second_us;
}

}  // namespace

std::int64_t parse_utc(std::string_view text) {
    Scanner s{text};
    std::int64_t time_us = 0;
    if (s.accept('@')) {
        time_us = s.number(1, 12) * second_us;
        time_us += s.fraction_us();
    } else {
        time_us = civil_us(s);
        time_us += offset_us(s);
    }
    if (!s.good || !s.rest.empty() || time_us < 0 || time_us >= last_us) {
        throw DataError("time " + quote(text) + " is not of the form 2024-05-01T12:00:25Z");
    }
    return time_us;
}

std::string format_utc(std::int64_t time_us) {
    namespace chr = std::chrono;
    const chr::sys_time<chr::microseconds> time{chr::microseconds{time_us}};
    const auto day = chr::floor<chr::days>(time);
    const chr::year_month_day date{day};
    const chr::hh_mm_ss<chr::microseconds> clock{time - day};
    std::string text =
        fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", static_cast<int>(date.year()),
                    static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                    clock.hours().count(), clock.minutes().count(), clock.seconds().count());
    const auto fraction = clock.subseconds().count();
    if (fraction % 1000 != 0)
        text += fmt::format(".{:06}", fraction);
    else if (fraction != 0)
        text += fmt::format(".{:03}", fraction / 1000);
    return text + "Z";
}

}  // namespace seautils
