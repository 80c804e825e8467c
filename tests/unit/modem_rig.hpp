// A driver under test: what it writes and tells, as short lines.
#ifndef SEAUTILS_TESTS_MODEM_RIG_HPP
#define SEAUTILS_TESTS_MODEM_RIG_HPP

#include "seautils/core/time.hpp"
#include "seautils/modem/driver.hpp"
#include "seautils/stream/hex.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace seautils::modem {

using Lines = std::vector<std::string>;

inline std::string hex(std::string_view bytes) {
    std::string out;
    stream::append_hex(out, bytes);
    return out;
}

inline std::string brief(const record::Reception& r) {
    Lines frames;
    for (const auto& f : r.frame) frames.push_back(hex(f));
    std::string text =
        fmt::format("reception {}>{} r{} [{}]", r.src, r.dest, r.rate, fmt::join(frames, " "));
    if (!r.bad_frame.empty()) text += fmt::format(" bad [{}]", fmt::join(r.bad_frame, " "));
    if (r.mini) text += fmt::format(" mini {}", *r.mini);
    if (r.ack_requested.value_or(false)) text += " ack";
    if (!r.statistics.empty()) text += fmt::format(" stats {}", r.statistics.size());
    return text;
}

inline std::string brief(const record::Result& r) {
    const char* const names[] = {"SENT", "LATE", "BUSY", "FAILED", "REFUSED"};
    std::string text =
        fmt::format("result #{} {}", r.transmission, names[static_cast<int>(r.outcome)]);
    if (!r.why.empty()) text += ": " + r.why;
    if (!r.statistics.empty()) text += fmt::format(" stats {}", r.statistics.size());
    return text;
}

inline std::string brief(const record::Range& r) {
    const char* const names[] = {"ping", "remus", "narrowband", "coded", "one way"};
    std::string text =
        fmt::format("range {}>{} {}", r.src, r.dest, names[static_cast<int>(r.method)]);
    for (const auto& leg : r.leg) {
        text += fmt::format(" {}={}s {:.1f}m", leg.transponder, leg.one_way_travel_time_s,
                            leg.range_m.value_or(-1));
    }
    if (r.transmission) text += fmt::format(" #{}", *r.transmission);
    return text;
}

inline std::string brief(const record::Slot& s) {
    return fmt::format("slot {}>{} r{} {}x{}{}{}", s.src, s.dest.value_or(99), s.rate, s.frames,
                       s.frame_bytes, s.polled.value_or(false) ? " polled" : "",
                       s.ack_requested.value_or(true) ? "" : " no ack");
}

inline std::string brief(const record::ModemEvent& e) {
    const char* const names[] = {"READY",       "REBOOT",    "NOT_RESPONDING", "DEVICE_LOST",
                                 "DEVICE_BACK", "CLOCK_SET", "CONFIG_REFUSED", "ERROR",
                                 "GAP",         "HEARD"};
    std::string text = names[static_cast<int>(e.event)];
    if (!e.text.empty()) text += " " + e.text;
    if (e.src) text += fmt::format(" {}>{}", *e.src, e.dest.value_or(99));
    return text;
}

inline std::string brief(const record::Raw& r) {
    const char* const arrow = r.direction == record::Raw::Direction::in ? "< " : "> ";
    return arrow + r.line + (r.fault.empty() ? "" : " (" + r.fault + ")");
}

inline std::string brief(const record::Ack& a) {
    return fmt::format("ack {}>{} #{} [{}]", a.src, a.dest, a.transmission,
                       fmt::join(a.frame, " "));
}

inline std::string brief(const record::Record& record) {
    return std::visit(
        [](const auto& kind) -> std::string {
            if constexpr (requires { brief(kind); })
                return brief(kind);
            else
                return "something else";
        },
        record.kind);
}

/// A driver, the time, and what came of it.
class Rig {
public:
    explicit Rig(Options options = {}) : driver_(std::move(options)) {}

    void open() { driver_.opened(now_); }
    /// The modem says this; checksum and line end are put to it.
    void says(std::string_view body) { driver_.line(stream::sentence(body), now_); }
    void says_all(const Lines& bodies) {
        for (const std::string& body : bodies) says(body);
    }
    void line(std::string_view line) { driver_.line(line, now_); }
    void transmit(const record::Transmission& t) { driver_.transmit(t, now_); }

    /// Time passes; the driver is woken whenever it asked for that.
    void pass(double seconds) {
        const std::int64_t end = now_.steady_ns + static_cast<std::int64_t>(seconds * 1e9);
        for (int k = 0; k < 10000; ++k) {
            const auto wake = driver_.wake();
            if (!wake || *wake > end) break;
            go_to(std::max(*wake, now_.steady_ns));
            driver_.tick(now_);
        }
        go_to(end);
        driver_.tick(now_);
    }

    /// Bodies of the lines written since the last call; each ends right and has its checksum.
    Lines written() {
        Lines bodies;
        std::string all = std::move(driver_.output().to_modem);
        driver_.output().to_modem.clear();
        for (std::size_t at = 0; at < all.size();) {
            const std::size_t end = all.find("\r\n", at);
            const std::string line = all.substr(at, end - at);
            stream::Sentence s;
            if (stream::parse_sentence(line, s) == stream::SentenceFault::none) {
                EXPECT_EQ(s.checksum(), stream::Checksum::good) << line;
                bodies.push_back(std::string(s.noise()) + std::string(s.body()));
            } else {
                bodies.push_back(line);
            }
            at = end + 2;
        }
        return bodies;
    }

    std::vector<record::Record> records() {
        auto taken = std::move(driver_.output().records);
        driver_.output().records.clear();
        return taken;
    }
    Lines told() {
        Lines lines;
        for (const auto& r : records()) lines.push_back(brief(r));
        return lines;
    }

    /// Answers everything as a modem does until it is ready, and forgets that.
    void start(const std::string& revision = "0.93.0.30") {
        open();
        for (int k = 0; k < 100 && !driver_.ready(); ++k) {
            for (const std::string& body : written()) answer(body, revision);
            pass(0.1);
        }
        EXPECT_TRUE(driver_.ready());
        written();
        records();
    }

    void answer(const std::string& body, const std::string& revision) {
        const std::string rest = body.substr(std::min<std::size_t>(5, body.size()));
        if (body.starts_with("CCCFG")) says("CACFG" + rest);
        if (body.starts_with("CCCLK")) says("CACLK" + rest);
        if (body.starts_with("CCTMS")) says("CATMS,0," + body.substr(6, 20));
        if (!body.starts_with("CCMSC")) return;
        says_all({"CAREV,120000,INIT,0", "CAREV,120000,AUV," + revision});
    }

    Driver& driver() { return driver_; }
    Moment now() const { return now_; }
    void step_clock(double seconds) { now_.utc.ns += static_cast<std::int64_t>(seconds * 1e9); }

private:
    void go_to(std::int64_t steady_ns) {
        now_.utc.ns += steady_ns - now_.steady_ns;
        now_.steady_ns = steady_ns;
    }

    Driver driver_;
    Moment now_{{parse_utc_ns("2024-05-01T12:00:00.3Z")}, 5'000'000'000};
};

/// Data of our own.
inline record::Transmission data_for(std::uint32_t dest, std::uint32_t rate, bool ack,
                                     std::vector<std::string> frames, std::uint32_t number = 7) {
    record::Transmission t;
    t.number = number;
    t.src = 1;
    t.dest = dest;
    t.rate = rate;
    t.ack_requested = ack;
    t.frame = std::move(frames);
    return t;
}

}  // namespace seautils::modem

#endif  // SEAUTILS_TESTS_MODEM_RIG_HPP
