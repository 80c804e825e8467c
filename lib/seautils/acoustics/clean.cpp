#include "seautils/acoustics/clean.hpp"

#include "seautils/acoustics/legs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace seautils::acoustics {

namespace {

constexpr std::size_t reach = 3;  ///< scans before and behind the one that is judged
constexpr double speed_floor_mps = 0.5, depth_floor_m = 1;

using Window = std::array<double, 2 * reach + 1>;

double median(Window& values, std::size_t count) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
}

/// F. R. Hampel's identifier (J. Am. Stat. Assoc. 69, 383-393 (1974)): a value that is far from the
/// median of its neighbourhood, measured by the median of such distances.
bool is_outlier(std::span<const Sample> samples, std::size_t at, double Sample::*value,
                double deviations, double floor) {
    const double x = samples[at].*value;
    const std::size_t side = std::min({reach, at, samples.size() - 1 - at});
    const std::size_t count = 2 * side + 1;
    Window around{};
    for (std::size_t k = 0; k < count; ++k) around[k] = samples[at - side + k].*value;
    const double middle = median(around, count);
    if (!(std::fabs(x - middle) > floor)) return false;
    for (std::size_t k = 0; k < count; ++k) around[k] = std::fabs(around[k] - middle);
    return std::fabs(x - middle) > deviations * 1.4826 * median(around, count);
}

/// Of three depths from an end on: whether the first leaps away, against the way of the others.
bool leaps(double end, double next, double third) {
    const double leap = end - next, step = next - third;
    return std::fabs(leap) > std::max(5.0, 20 * std::fabs(step)) && leap * step <= 0;
}

void find_spikes(std::span<const Sample> samples, const Cleaning& how, std::vector<Drop>& why) {
    const std::size_t n = samples.size();
    if (how.spike_deviations <= 0 || n < 3) return;
    for (std::size_t k = 0; k < n; ++k) {
        if (is_outlier(samples, k, &Sample::sound_speed_mps, how.spike_deviations,
                       speed_floor_mps) ||
            is_outlier(samples, k, &Sample::depth_m, how.spike_deviations, depth_floor_m))
            why[k] = Drop::spike;
    }
    const auto depth = [&](std::size_t k) { return samples[k].depth_m; };
    if (leaps(depth(0), depth(1), depth(2))) why[0] = Drop::spike;
    if (leaps(depth(n - 1), depth(n - 2), depth(n - 3))) why[n - 1] = Drop::spike;
}

double seconds_between(const Sample& a, const Sample& b) {
    if (a.time_ns == no_time || b.time_ns == no_time) return not_available;
    return (static_cast<double>(b.time_ns) - static_cast<double>(a.time_ns)) * 1e-9;
}

void find_slow(std::span<const Sample> samples, const std::vector<std::size_t>& kept,
               const Cleaning& how, std::vector<Drop>& why) {
    for (std::size_t k = 0; k < kept.size() && kept.size() > 1; ++k) {
        const Sample& before = samples[kept[k == 0 ? 0 : k - 1]];
        const Sample& behind = samples[kept[std::min(k + 1, kept.size() - 1)]];
        const double seconds = seconds_between(before, behind);
        if (std::fabs(behind.depth_m - before.depth_m) < how.least_speed_mps * seconds)
            why[kept[k]] = Drop::slow;
    }
}

/// The scans of one leg that lie behind the farthest so far, and are passed again soon.
void find_loops(std::span<const Sample> samples, std::span<const std::size_t> leg, double sign,
                const Cleaning& how, std::vector<Drop>& why) {
    std::size_t farthest = 0;
    for (std::size_t k = 1; k < leg.size(); ++k) {
        const double ahead = sign * (samples[leg[k]].depth_m - samples[leg[farthest]].depth_m);
        if (ahead < 0) continue;
        const bool soon = !(seconds_between(samples[leg[farthest]], samples[leg[k]]) > how.loop_s);
        for (std::size_t j = farthest + 1; j < k && soon; ++j) {
            const double behind = samples[leg[farthest]].depth_m - samples[leg[j]].depth_m;
            if (sign * behind > how.loop_m) why[leg[j]] = Drop::loop;
        }
        farthest = k;
    }
}

std::vector<std::size_t> not_dropped(const std::vector<Drop>& why) {
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < why.size(); ++k)
        if (why[k] == Drop::none) kept.push_back(k);
    return kept;
}

}  // namespace

std::vector<Drop> clean(std::span<const Sample> samples, const Cleaning& how) {
    std::vector<Drop> why(samples.size(), Drop::none);
    find_spikes(samples, how, why);
    if (how.least_speed_mps > 0) find_slow(samples, not_dropped(why), how, why);
    if (how.loop_m <= 0) return why;
    const std::vector<std::size_t> kept = not_dropped(why);
    const auto look_at = [&](const Leg& leg) {
        if (leg.direction == Direction::none) return;
        find_loops(samples, std::span(kept).subspan(leg.first, leg.end - leg.first),
                   leg.direction == Direction::dive ? 1 : -1, how, why);
    };
    LegFinder finder(how.turn_m);
    for (const std::size_t k : kept)
        if (const auto leg = finder.add(samples[k].depth_m)) look_at(*leg);
    for (const Leg& leg : finder.finish()) look_at(leg);
    return why;
}

}  // namespace seautils::acoustics
