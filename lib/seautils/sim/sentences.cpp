#include "seautils/sim/sentences.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace seautils::sim {

namespace {

constexpr unsigned carrier_hz = 25000, fsk_hz = 4000, psk_hz = 5000;

/// A time in the parts that sentences name.
struct Calendar {
    int year;
    unsigned month, day;
    long hour, minute, second, tenth_ms;
};

Calendar parts(Time clock) {
    namespace chr = std::chrono;
    const chr::sys_time<chr::nanoseconds> time{chr::nanoseconds{clock}};
    const auto day = chr::floor<chr::days>(time);
    const chr::year_month_day date{day};
    const chr::hh_mm_ss<chr::nanoseconds> of_day{time - day};
    return {static_cast<int>(date.year()),
            static_cast<unsigned>(date.month()),
            static_cast<unsigned>(date.day()),
            of_day.hours().count(),
            of_day.minutes().count(),
            of_day.seconds().count(),
            of_day.subseconds().count() / 100'000};
}

std::string date(const Calendar& c) {
    return fmt::format("{:04}{:02}{:02}", c.year, c.month, c.day);
}

std::string time_of_day(const Calendar& c) {
    return fmt::format("{:02}{:02}{:02}.{:04}", c.hour, c.minute, c.second, c.tenth_ms);
}

long rounded(double value) { return std::lround(value); }

/// What follows the clock mode: levels are of the simulated water, the rest is made up but steady.
std::string statistics(const Heard& h) {
    const Packet& p = *h.packet;
    const unsigned psk_error = !p.is_fsk() && h.bad_count() > 0 ? 3 : 0;
    const long snr = rounded(h.snr_db);
    return fmt::format(
        "4105,30,0318,{:04},10,00,00,01,01,{},{:03},{:03},{},{},{},{},{},{:02},{:02},{:02},{},{:03}"
        ","
        "{:.1f},{},{},{}",
        rounded(h.level_db), p.rate, p.src, p.dest, psk_error, p.type(), p.frames.size(),
        h.bad_count(), rounded(h.level_db), snr, snr, snr, p.is_fsk() ? 0 : -6,
        p.is_fsk() ? 200 : 0, h.closing_mps, 41, carrier_hz, p.is_fsk() ? fsk_hz : psk_hz);
}

}  // namespace

std::string hhmmss(Time clock) {
    const Calendar c = parts(clock);
    return fmt::format("{:02}{:02}{:02}", c.hour, c.minute, c.second);
}

std::string iso8601(Time clock) {
    const Calendar c = parts(clock);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", c.year, c.month, c.day, c.hour,
                       c.minute, c.second);
}

std::string calendar(Time clock) {
    const Calendar c = parts(clock);
    return fmt::format("{},{},{},{},{},{}", c.year, c.month, c.day, c.hour, c.minute, c.second);
}

std::string cacst(const Heard& heard, Generation generation, Time arrival, unsigned clock_mode) {
    const Calendar c = parts(arrival);
    const bool mm2 = generation == Generation::mm2;
    const unsigned mode = heard.bad_count() > 0 ? 1 : 0;
    return fmt::format("CACST,{}{},{}{},{},{}", mm2 ? "6," : "", mode, mm2 ? date(c) : "",
                       time_of_day(c), clock_mode, statistics(heard));
}

std::string cacst_timeout(Generation generation) {
    return generation == Generation::mm2 ? "CACST,6,2" : "CACST,2";
}

std::string caxst(const Packet& p, Generation generation, Time began, unsigned clock_mode,
                  unsigned mode) {
    const Calendar c = parts(began);
    const std::size_t sent = mode == 0 ? p.frames.size() : 0;
    return fmt::format("CAXST,{}{},{},{},{},200,{},{},{},{},{},{},{},{},{},{}",
                       generation == Generation::mm2 ? "6," : "", date(c), time_of_day(c),
                       clock_mode, mode, p.is_fsk() ? fsk_hz : psk_hz, carrier_hz, p.rate, p.src,
                       p.dest, p.ack ? 1 : 0, p.frame_count, sent, p.type(), p.bytes());
}

}  // namespace seautils::sim
