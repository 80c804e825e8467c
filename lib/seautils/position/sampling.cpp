#include "seautils/position/sampling.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

namespace seautils::position {

namespace {

constexpr std::int64_t us_of_s = 1'000'000, us_of_ms = 1'000;
constexpr std::int64_t latest_us = 7'258'118'400 * us_of_s;  ///< 2200-01-01T00:00:00Z
constexpr std::int64_t longest_interval_ms = 86'400'000;

double seconds(std::int64_t us) { return static_cast<double>(us) / 1e6; }

std::int64_t checked_interval(std::int64_t ms) {
    if (ms >= 1 && ms <= longest_interval_ms) return ms * us_of_ms;
    throw ConfigError(fmt::format("interval {} ms is outside 1 to {} ms", ms, longest_interval_ms));
}

std::int64_t checked_gap(std::int64_t ms, std::int64_t interval_us) {
    if (ms == 0) return interval_us * 3 / 2;
    const std::int64_t interval_ms = interval_us / us_of_ms;
    const std::int64_t most_ms = interval_ms * Sampler::longest_gap;
    if (ms >= interval_ms && ms <= most_ms) return ms * us_of_ms;
    throw ConfigError(fmt::format("gap {} ms is outside {} to {} ms, 1 to {} intervals", ms,
                                  interval_ms, most_ms, Sampler::longest_gap));
}

}  // namespace

Sampler::Sampler(const Options& options)
    : options_(options),
      interval_us_(checked_interval(options.interval_ms)),
      gap_us_(checked_gap(options.gap_ms, interval_us_)) {}

const std::vector<Sample>& Sampler::add(const RawFix& fix) {
    complete_.clear();
    cell_of(options_.grid, fix.place);  // refuses what is outside
    check_time(fix);
    if (!last_ || fix.time_us <= last_->time_us || fix.time_us - last_->time_us > gap_us_)
        begin(fix);
    sample(fix);
    last_ = fix;
    return complete_;
}

void Sampler::check_time(const RawFix& fix) {
    if (fix.time_us < 0 || fix.time_us > latest_us)
        throw DataError(fmt::format("time {} s is outside 0 to {} s (the year 2200)",
                                    seconds(fix.time_us), latest_us / us_of_s));
    if (!last_ || fix.time_us > last_->time_us) {
        back_ = 0;
        return;
    }
    const bool agrees = back_ > 0 && fix.time_us > back_us_ && fix.time_us - back_us_ <= gap_us_;
    back_ = agrees ? back_ + 1 : 1;
    back_us_ = fix.time_us;
    if (back_ < back_before_belief)
        throw DataError(fmt::format("time {} s is not after that of the fix before, {} s",
                                    seconds(fix.time_us), seconds(last_->time_us)));
    back_ = 0;
}

void Sampler::begin(const RawFix& fix) {
    next_us_ = (fix.time_us + us_of_ms - 1) / us_of_ms * us_of_ms;
    starts_ = true;
}

void Sampler::sample(const RawFix& fix) {
    for (; next_us_ <= fix.time_us; next_us_ += interval_us_) {
        complete_.push_back(
            {next_us_ / us_of_ms, cell_of(options_.grid, at(next_us_, fix)), starts_});
        starts_ = false;
    }
}

/// Between the last fix and this one.
Place Sampler::at(std::int64_t time_us, const RawFix& fix) const {
    if (time_us == fix.time_us) return fix.place;
    const std::int64_t before_us = time_us - last_->time_us, after_us = fix.time_us - time_us;
    if (options_.method == Method::nearest) return before_us <= after_us ? last_->place : fix.place;
    const double part = static_cast<double>(before_us) / static_cast<double>(before_us + after_us);
    const auto between = [part](double a, double b) { return a + (b - a) * part; };
    const Place &a = last_->place, &b = fix.place;
    return {between(a.x_m, b.x_m), between(a.y_m, b.y_m), between(a.z_m, b.z_m)};
}

}  // namespace seautils::position
