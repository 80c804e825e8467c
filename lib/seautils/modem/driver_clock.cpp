// Driver: how it sets a modem's clock, and sees that it is off.
#include "seautils/modem/driver.hpp"

#include "seautils/core/time.hpp"
#include "seautils/modem/fields.hpp"

#include <fmt/format.h>

#include <cmath>

namespace seautils::modem {

namespace {

using record::ModemEvent;
using Kind = Command::Kind;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t clock_rest_ns = 60 * second_ns;  ///< between settings
constexpr std::int64_t clock_from_ns = 50'000'000;      ///< into a second: set the clock from here
constexpr std::int64_t clock_to_ns = 100'000'000;       ///< to here
constexpr double clock_error_s = 1;
constexpr int clock_tries = 5;

}  // namespace

/// A clock is set in whole seconds: a little behind one to the next, at which it takes it over.
void Driver::say_clock(Moment now) {
    const std::int64_t into_ns = (now.utc.ns % second_ns + second_ns) % second_ns;
    if (into_ns < clock_from_ns || into_ns > clock_to_ns) {
        const std::int64_t middle_ns = (clock_from_ns + clock_to_ns) / 2;
        clock_due_ = now.steady_ns + (middle_ns - into_ns + second_ns) % second_ns;
        return;
    }
    dialog_.word(compose_clock(now.utc.ns / second_ns + 1, second_generation()),
                 second_generation() ? "CATMS" : "CACLK");
    write(dialog_.front().body, now);
    dialog_.said(now.steady_ns);
}

/// A modem of the first generation says what time it has with its revision only.
void Driver::check_time_of_day(std::string_view time_of_day, Moment now) {
    const auto time_ns = time_of_day_ns(time_of_day);
    if (!time_ns || !ready_ || !clock_set_ || now.steady_ns < *clock_set_ + clock_rest_ns) return;
    const auto off_ns = nearest_day(*time_ns, now.utc).ns + second_ns / 2 - now.utc.ns;
    const double off_s = static_cast<double>(off_ns) / 1e9;
    if (std::abs(off_s) >= 2 * clock_error_s) clock_is_off(off_s, now);
}

/// What the modem says its clock is: as it was just set, or asked for by the keep-alive, whose answer
/// is half a second late and cut to whole seconds.
void Driver::on_clock(const Sentence& s, Moment now) {
    const bool query = s.type() == "TMQ";
    const auto clock = read_clock_ns(s);
    if (!clock) {
        event(ModemEvent::Event::error, "the clock could not be set", now);
        return;
    }
    const double off_s = static_cast<double>(*clock - now.utc.ns) / 1e9 + (query ? 1.0 : 0.0);
    if (!query) {
        clock_set_ = now.steady_ns;
        if (std::abs(off_s) < clock_error_s) {
            clock_tries_ = 0;
            event(ModemEvent::Event::clock_set, format_utc_ns(*clock), now);
            return;
        }
    } else if (std::abs(off_s) < clock_error_s ||
               now.steady_ns < clock_set_.value_or(INT64_MIN / 2) + clock_rest_ns) {
        return;
    }
    clock_is_off(off_s, now);
}

/// The clock is set again, but not for ever.
void Driver::clock_is_off(double error_s, Moment now) {
    if (++clock_tries_ < clock_tries) {
        dialog_.push_front({Kind::clock, {}, {}, {}});
        return;
    }
    clock_tries_ = 0;
    event(ModemEvent::Event::error, fmt::format("the modem's clock is off by {:.1f} s", error_s),
          now);
}

void Driver::clock_stepped(Moment now) {
    if (!open_ || !ready_) return;
    dialog_.push({Kind::clock, {}, {}, {}});
    step(now);
}

}  // namespace seautils::modem
