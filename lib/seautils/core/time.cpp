#include "seautils/core/time.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <chrono>
#include <cstdlib>

namespace seautils {

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t last_s = 253'402'300'800;   ///< the year 10000
constexpr std::int64_t last_ns_s = 9'223'372'036;  ///< the last second of 64-bit nanoseconds

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

    /// `.5` as nanoseconds; 0 where no point follows.
    std::int32_t fraction_ns(int most_digits) {
        if (!accept('.')) return 0;
        const std::size_t before = rest.size();
        std::int64_t x = number(1, most_digits);
        for (std::size_t k = before - rest.size(); k < 9; ++k) x *= 10;
        return static_cast<std::int32_t>(x);
    }
};

/// Seconds since 1970 of `2024-05-01T12:00:25`.
std::int64_t civil_s(Scanner& s) {
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
    const chr::year_month_day date{chr::year{year}, chr::month{month}, chr::day{day}};
    s.good = s.good && date.ok() && year >= 1970 && hour < 24 && minute < 60 && second < 60;
    if (!s.good) return 0;
    const std::int64_t days = chr::sys_days{date}.time_since_epoch().count();
    return days * 86400 + hour * 3600 + minute * 60 + second;
}

std::int64_t offset_s(Scanner& s) {
    if (s.accept('Z') || s.accept('z')) return 0;
    const bool west = s.accept('-');
    if (!west) s.expect('+');
    const std::int64_t hour = s.number(2, 2);
    s.expect(':');
    const std::int64_t minute = s.number(2, 2);
    s.good = s.good && hour < 24 && minute < 60;
    return (west ? 60 : -60) * (hour * 60 + minute);
}

[[noreturn]] void refuse(std::string_view text) {
    throw DataError("time " + quote(text) + " is not of the form 2024-05-01T12:00:25Z");
}

UtcInstant parse(std::string_view text, int most_digits) {
    Scanner s{text};
    UtcInstant time;
    if (s.accept('@')) {
        time.seconds = s.number(1, 12);
        time.nanoseconds = s.fraction_ns(most_digits);
    } else {
        time.seconds = civil_s(s);
        time.nanoseconds = s.fraction_ns(most_digits);
        time.seconds += offset_s(s);
    }
    if (!s.good || !s.rest.empty() || time.seconds < 0 || time.seconds >= last_s) refuse(text);
    return time;
}

/// Writes `digits` digits, the last at end[-1].
void put_digits(char* end, int digits, std::uint32_t x) {
    for (; digits > 0; --digits, x /= 10) *--end = static_cast<char>('0' + x % 10);
}

}  // namespace

std::int64_t parse_utc(std::string_view text) {
    const UtcInstant time = parse(text, 6);
    return time.seconds * 1'000'000 + time.nanoseconds / 1000;
}

UtcInstant parse_instant(std::string_view text) { return parse(text, 9); }

std::int64_t parse_utc_ns(std::string_view text) {
    const UtcInstant time = parse(text, 9);
    if (time.seconds >= last_ns_s)
        throw DataError("time " + quote(text) + " is later than 2262-04-11T23:47:16Z");
    return time.seconds * second_ns + time.nanoseconds;
}

void append_instant(std::string& out, UtcInstant instant) {
    namespace chr = std::chrono;
    const auto [days, second] = std::div(instant.seconds, std::int64_t{86400});
    const chr::year_month_day date{chr::sys_days{chr::days{days}}};
    const auto clock = static_cast<std::uint32_t>(second);
    char text[] = "0000-00-00T00:00:00.000000000";
    put_digits(text + 4, 4, static_cast<std::uint32_t>(static_cast<int>(date.year())));
    put_digits(text + 7, 2, static_cast<unsigned>(date.month()));
    put_digits(text + 10, 2, static_cast<unsigned>(date.day()));
    put_digits(text + 13, 2, clock / 3600);
    put_digits(text + 16, 2, clock / 60 % 60);
    put_digits(text + 19, 2, clock % 60);
    const auto fraction = static_cast<std::uint32_t>(instant.nanoseconds);
    put_digits(text + 29, 9, fraction);
    const bool whole = fraction == 0, thousandths = fraction % 1'000'000 == 0;
    const std::size_t length = whole ? 19 : thousandths ? 23 : fraction % 1000 == 0 ? 26 : 29;
    out.append(text, length);
    out += 'Z';
}

std::string format_utc(std::int64_t time_us) {
    const auto [seconds, rest] = std::div(time_us, std::int64_t{1'000'000});
    std::string text;
    append_instant(text, {seconds, static_cast<std::int32_t>(rest) * 1000});
    return text;
}

std::string format_utc_ns(std::int64_t time_ns) {
    const auto [seconds, rest] = std::div(time_ns, second_ns);
    std::string text;
    append_instant(text, {seconds, static_cast<std::int32_t>(rest)});
    return text;
}

}  // namespace seautils
