#include "seautils/position/analogs.hpp"

namespace seautils::position {

namespace {

constexpr std::int32_t mirror_distance = 77;  // 0.3 cells²
/// Situations are measured so many at a time, that compilers use vectors; columns are padded to this.
constexpr std::size_t block = 64;

std::size_t padded(std::size_t n) { return (n + block - 1) / block * block; }

std::int32_t bounded(std::int32_t feature) {
    return static_cast<std::int32_t>(clamp(feature, -Analogs::most_feature, Analogs::most_feature));
}

}  // namespace

Analogs::Analogs(std::size_t capacity, std::size_t features, bool mirrored,
                 std::size_t first_across)
    : capacity_(capacity),
      first_across_(first_across),
      mirrored_(mirrored),
      feature_(features, std::vector<std::int16_t>(padded(capacity))),
      outcome_(capacity) {}

void Analogs::remember(const Features& situation, Pair outcome) {
    for (std::size_t f = 0; f < feature_.size(); ++f)
        feature_[f][next_] = static_cast<std::int16_t>(bounded(situation.value[f]));
    const auto within = [](std::int32_t v) {
        return static_cast<std::int32_t>(clamp(v, -most_outcome, most_outcome));
    };
    outcome_[next_] = {within(outcome.x), within(outcome.y)};
    next_ = (next_ + 1) % capacity_;
    if (size_ < capacity_) ++size_;
}

void Analogs::measure(const Features& situation, std::vector<std::int32_t>& distance,
                      bool mirrored) const {
    const std::int32_t base = mirrored ? mirror_distance : 0;
    const auto youngest = static_cast<std::int32_t>(next_ + capacity_ - 1);
    for (std::size_t k = 0; k < distance.size(); ++k) {
        const std::int32_t age = youngest - static_cast<std::int32_t>(k);
        const auto capacity = static_cast<std::int32_t>(capacity_);
        distance[k] = base + (age >= capacity ? age - capacity : age) / 8;
    }
    for (std::size_t f = 0; f < feature_.size(); ++f) {
        const std::int32_t sign = mirrored && f >= first_across_ ? -1 : 1;
        const auto here = static_cast<std::int16_t>(sign * bounded(situation.value[f]));
        const std::int16_t* const there = feature_[f].data();
        std::int32_t* const sum = distance.data();
        for (std::size_t from = 0; from < size_; from += block) {
            for (std::size_t k = from; k < from + block; ++k) {
                // At most 2 * most_feature, which 16 bits hold; the product takes 32.
                const auto difference = static_cast<std::int16_t>(here - there[k]);
                sum[k] += std::int32_t{difference} * difference;
            }
        }
    }
}

std::size_t Analogs::find(const Features& situation, std::span<Found> found) const {
    thread_local std::vector<std::int32_t> distance;
    distance.resize(padded(capacity_));
    std::size_t count = 0;
    std::int32_t bound = INT32_MAX;  // what is not below it is not among the nearest
    const auto look = [&](std::size_t k, bool mirrored) {
        if (distance[k] >= bound) return;
        Pair outcome = outcome_[k];
        if (mirrored) outcome.y = -outcome.y;
        if (count < found.size()) ++count;
        std::size_t at = count - 1;
        for (; at > 0 && found[at - 1].distance > distance[k]; --at) found[at] = found[at - 1];
        found[at] = {distance[k], outcome};
        if (count == found.size()) bound = found[count - 1].distance;
    };
    for (const bool mirrored : {false, true}) {
        if (mirrored && !mirrored_) break;
        measure(situation, distance, mirrored);
        for (std::size_t k = next_; k > 0; --k) look(k - 1, mirrored);
        for (std::size_t k = size_; k > next_; --k) look(k - 1, mirrored);
    }
    return count;
}

}  // namespace seautils::position
