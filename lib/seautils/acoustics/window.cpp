#include "seautils/acoustics/window.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <utility>

namespace seautils::acoustics {

namespace {

/// Times of years 1970 to 2262 are far enough from the ends of their type to add an hour; but a
/// window may be long.
std::int64_t later(std::int64_t time_ns, std::int64_t by_ns) {
    std::int64_t sum = 0;
    return __builtin_add_overflow(time_ns, by_ns, &sum) ? INT64_MAX : sum;
}

}  // namespace

void Windows::add(const Sample& sample) {
    if (samples_.size() - begin_ >= Windowing::most_samples) {
        samples_.clear();
        begin_ = 0;
        legs_ = LegFinder(how_.turn_m);
        throw DataError(
            fmt::format("more than {} samples for one profile: they are left out (--window)",
                        Windowing::most_samples));
    }
    if (how_.split == Split::window) add_to_window(sample);
    if (how_.split == Split::leg) add_to_leg(sample);
    if (how_.split == Split::cast) hold(sample);
}

void Windows::hold(const Sample& sample) {
    samples_.push_back(sample);
    fresh_ = true;
}

void Windows::add_to_leg(const Sample& sample) {
    hold(sample);
    const auto leg = legs_.add(sample.depth_m);
    if (!leg) return;
    leave(no_time);
    const auto samples = held().subspan(leg->first, leg->end - leg->first);
    begin_ += leg->end;
    legs_.forget(leg->end);
    due_(samples, leg->direction);
}

void Windows::add_to_window(const Sample& sample) {
    const std::int64_t now = sample.time_ns;
    if (now == no_time) return hold(sample);
    const bool anew = last_ns_ == no_time || now > later(last_ns_, how_.window_ns) ||
                      last_ns_ > later(now, how_.window_ns);
    if (anew) {
        if (last_ns_ != no_time) end();
        boundary_ns_ = later(now, how_.every_ns);
    }
    last_ns_ = now;
    if (how_.every_ns > 0 && now >= boundary_ns_) {
        leave(boundary_ns_ - how_.window_ns - 1);
        const std::int64_t steps = (now - boundary_ns_) / how_.every_ns + 1;
        boundary_ns_ = later(boundary_ns_, steps * how_.every_ns);
        emit();
    }
    leave(now - how_.window_ns);
    hold(sample);
    if (how_.every_ns == 0) emit();
}

/// Windows that begin where the last one ended share nothing. What is due may be refused: all is
/// settled before.
void Windows::emit() {
    const auto samples = held();
    fresh_ = false;
    if (how_.every_ns >= how_.window_ns) begin_ = samples_.size();
    if (!samples.empty()) due_(samples, Direction::none);
}

/// Forgets what lies before a time, and moves the rest together now and then.
void Windows::leave(std::int64_t before_ns) {
    while (begin_ < samples_.size() && samples_[begin_].time_ns != no_time &&
           samples_[begin_].time_ns <= before_ns)
        ++begin_;
    if (begin_ * 2 <= samples_.size()) return;
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
}

void Windows::end() {
    const std::vector<Sample> all = std::move(samples_);
    const auto rest = std::span(all).subspan(begin_);
    const std::vector<Leg> legs = legs_.finish();
    const bool fresh = fresh_;
    samples_ = {};
    begin_ = 0;
    fresh_ = false;
    last_ns_ = no_time;
    legs_ = LegFinder(how_.turn_m);
    if (how_.split != Split::leg) {
        if (fresh && !rest.empty()) due_(rest, Direction::none);
        return;
    }
    for (const Leg& leg : legs) due_(rest.subspan(leg.first, leg.end - leg.first), leg.direction);
}

}  // namespace seautils::acoustics
