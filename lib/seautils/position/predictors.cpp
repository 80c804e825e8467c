#include "seautils/position/predictors.hpp"

#include <algorithm>

namespace seautils::position {

namespace {

constexpr std::int64_t analog_rate_q8 = 8;
constexpr std::int32_t share_rate = 5243;  // 0.08

Pair in_q8(const Cell& step) { return {position::in_q8(step.x), position::in_q8(step.y)}; }

constexpr std::array<std::int32_t, 3> filter_scales{154, 307, 768};  // 0.6, 1.2, 3
constexpr std::array<std::int32_t, 3> analog_scales{60, 160, 700};   // 0.23, 0.63, 2.7

/// 1 / (rank + 2) of the first n, together 1, Q20.
std::array<std::int32_t, Analogs::most_found> rank_shares(std::size_t n) {
    std::int64_t total = 1;
    for (std::size_t k = 0; k < n; ++k) total += one_q20 / static_cast<std::int32_t>(k + 2);
    std::array<std::int32_t, Analogs::most_found> share{};
    for (std::size_t k = 0; k < n; ++k)
        share[k] = static_cast<std::int32_t>((std::int64_t{one_q20} << 20) /
                                             static_cast<std::int32_t>(k + 2) / total);
    return share;
}

template <std::size_t N>
std::array<std::int32_t, N> by_scale(const std::array<std::int32_t, most_components>& each) {
    std::array<std::int32_t, N> sum{};
    for (std::size_t k = 0; k < most_components; ++k) sum[k % N] += each[k];
    return sum;
}

}  // namespace

PlaneMixture FilterModel::predict(const Motion& motion, Pair expected) const {
    PlaneMixture m;
    const bool first = motion.known == 0;
    const std::int32_t along = first ? first_.root() : along_.root();
    const std::int32_t across = first ? first_.root() : across_.root();
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            m.add(shares_[3 * i + j], expected, scaled(along, filter_scales[i]),
                  scaled(across, filter_scales[j]), motion.heading);
    return m;
}

void FilterModel::learn(const Motion& motion, Pair expected, const PlaneMixture& said,
                        const Cell& step) {
    const Pair q = in_q8(step);
    const Pair error = into_frame({q.x - expected.x, q.y - expected.y}, motion.heading);
    if (motion.known == 0) {
        first_.take((square(error.x) + square(error.y)) / 2, filter_rate_q8);
        return;
    }
    const auto each = said.responsibility(step.x, step.y);
    std::array<std::int32_t, 9> seen{};
    std::copy_n(each.begin(), 9, seen.begin());
    shares_.follow(seen, 65535, one_q20 / 20);
    along_.take(square(error.x), filter_rate_q8);
    across_.take(square(error.y), filter_rate_q8);
}

namespace {

struct TurnAngle {
    std::int32_t cosine_q14, sine_q14,
        half_gap_q14;  ///< gap: radians between its neighbours, half of it
};
// 6, 13, 20, 28, 37, 47, 58, 70, 85, 105, 130, 165 degrees
constexpr std::array<TurnAngle, TurnModel::angles> turn_angles{{{16294, 1713, 1859},
                                                                {15964, 3686, 2002},
                                                                {15396, 5604, 2145},
                                                                {14466, 7692, 2431},
                                                                {13085, 9860, 2717},
                                                                {11174, 11982, 3003},
                                                                {8682, 13894, 3289},
                                                                {5604, 15396, 3861},
                                                                {1428, 16322, 5005},
                                                                {-4240, 15826, 6435},
                                                                {-10531, 12551, 8580},
                                                                {-15826, 4240, 9000}}};
constexpr std::size_t anywhere = 2 * TurnModel::angles, straight = anywhere + 1;

/// A vector of a length in the direction of an end, in the frame of the heading.
Pair turned(std::size_t end, std::int32_t length, std::int32_t sign) {
    if (end == straight) return {length, 0};
    const TurnAngle& a = turn_angles[end % TurnModel::angles];
    const std::int32_t side = end < TurnModel::angles ? sign : -sign;
    return {static_cast<std::int32_t>(std::int64_t{length} * a.cosine_q14 >> 14),
            static_cast<std::int32_t>(std::int64_t{side} * length * a.sine_q14 >> 14)};
}

}  // namespace

TurnModel::TurnModel() {
    for (auto& context : counts_) {
        context.fill(1 << 12);
        context[anywhere] = 1 << 14;
        context[straight] = 4 << 14;
    }
    ratio_.fill(1 << 12);
    speed_ = 10 * 256;
}

PlaneMixture TurnModel::predict(const Motion& motion) const {
    PlaneMixture m;
    if (motion.known == 0) return m;
    const auto& counts = counts_[motion.turn_context()];
    std::int64_t total = 1;
    for (const std::int32_t c : counts) total += c;
    for (std::size_t end = 0; end < ends; ++end) {
        const auto weight = static_cast<std::int32_t>(std::int64_t{counts[end]} * one_q20 / total);
        if (end == anywhere) {
            m.add(weight, {}, std::max<std::int64_t>(1280, speed_ * 3 / 2));
            continue;
        }
        const std::int32_t length =
            end == straight
                ? speed_
                : static_cast<std::int32_t>(std::int64_t{speed_} * ratio_[end % angles] >> 12);
        const std::int32_t gap =
            end == straight ? turn_angles[0].half_gap_q14 : turn_angles[end % angles].half_gap_q14;
        const Pair ahead = turned(end, length, motion.turn_sign);
        const std::int64_t along = std::max<std::int64_t>(230, length / 10);
        const std::int64_t across =
            std::max<std::int64_t>(205, (std::int64_t{length} * gap >> 14) * 6 / 10);
        const Direction direction =
            direction_of(out_of_frame(turned(end, 1 << 14, motion.turn_sign), motion.heading), 1,
                         motion.heading);
        m.add(weight, out_of_frame(ahead, motion.heading), along, across, direction);
    }
    return m;
}

void TurnModel::learn(const Motion& motion, const PlaneMixture& said, const Cell& step) {
    const Pair q = in_q8(step);
    const auto size = static_cast<std::int32_t>(std::min<std::uint32_t>(length(q), most_mean));
    if (motion.known > 0) {
        const auto each = said.responsibility(step.x, step.y);
        auto& counts = counts_[motion.turn_context()];
        for (std::size_t end = 0; end < ends; ++end) {
            counts[end] += (each[end] >> 6) - counts[end] / 512;
            if (end >= 2 * angles || speed_ < 16) continue;
            std::int32_t& ratio = ratio_[end % angles];
            const std::int64_t seen = clamp(std::int64_t{size} * 4096 / speed_, 0, 1 << 15);
            ratio += static_cast<std::int32_t>((seen - ratio) * each[end] >> 23);
        }
    }
    speed_ += (size - speed_) / 16;
}

AnalogModel::AnalogModel(Kind kind, std::size_t capacity)
    : kind_(kind),
      memory_(capacity, kind == Kind::path || kind == Kind::innovation ? 5 : 4,
              kind == Kind::path || kind == Kind::innovation, 3) {}

AnalogModel::View AnalogModel::view(const Motion& motion) const {
    View v{{}, {}, {}, motion.known >= 3};
    auto& f = v.features.value;
    const auto weighted = [](std::int32_t cells_or_q4, std::int32_t sixteenths) {
        return static_cast<std::int32_t>(std::int64_t{cells_or_q4} * sixteenths >> 4);
    };
    const auto q4 = [](Pair cells) { return Pair{cells.x * 16, cells.y * 16}; };
    switch (kind_) {
        case Kind::path: {
            v.frame = direction_of(q4(motion.moved[0]), 16, motion.heading);
            const Pair before = into_frame(q4(motion.moved[1]), v.frame);
            const Pair earlier = into_frame(q4(motion.moved[2]), v.frame);
            f = {weighted(static_cast<std::int32_t>(length(q4(motion.moved[0]))), 23),
                 weighted(before.x, 14), weighted(earlier.x, 8), weighted(before.y, 14),
                 weighted(earlier.y, 8)};
            break;
        }
        case Kind::innovation: {
            v.frame = motion.heading;
            v.base = motion.expected(motion.fast);
            const Pair velocity{static_cast<std::int32_t>(
                                    clamp(motion.fast.x.velocity >> 12, -most_mean, most_mean)),
                                static_cast<std::int32_t>(
                                    clamp(motion.fast.y.velocity >> 12, -most_mean, most_mean))};
            f = {static_cast<std::int32_t>(length(velocity) / 2),
                 weighted(motion.innovation[0].x >> 4, 14),
                 weighted(motion.innovation[1].x >> 4, 8),
                 weighted(motion.innovation[0].y >> 4, 14),
                 weighted(motion.innovation[1].y >> 4, 8)};
            break;
        }
        case Kind::world: {
            const Pair now = q4(motion.moved[0]), before = q4(motion.moved[1]);
            f = {weighted(now.x, 10), weighted(now.y, 10), weighted(before.x, 8),
                 weighted(before.y, 8), 0};
            break;
        }
        case Kind::place: {
            const Pair now = q4(motion.moved[0]);
            const auto place = [](std::int32_t cell) {
                return static_cast<std::int32_t>(std::int64_t{cell} * 16 * 26 >> 8);
            };
            f = {place(motion.last.x), place(motion.last.y), weighted(now.x, 10),
                 weighted(now.y, 10), 0};
            break;
        }
    }
    return v;
}

PlaneMixture AnalogModel::predict(const Motion& motion) {
    PlaneMixture m;
    const View v = view(motion);
    if (!v.usable) return m;
    std::array<Analogs::Found, Analogs::most_found> found;
    const std::size_t n = memory_.find(v.features, found);
    const auto rank = rank_shares(n);
    const std::int32_t sd = error_.root();
    for (std::size_t k = 0; k < n; ++k) {
        const Pair outcome = out_of_frame(found[k].outcome, v.frame);
        const Pair mean{v.base.x + outcome.x, v.base.y + outcome.y};
        for (std::size_t s = 0; s < 3; ++s)
            m.add(static_cast<std::int32_t>(std::int64_t{rank[k]} * shares_[s] >> 20), mean,
                  scaled(sd, analog_scales[s]));
    }
    return m;
}

void AnalogModel::learn(const Motion& motion, const PlaneMixture& said, const Cell& step) {
    const View v = view(motion);
    if (!v.usable) return;
    const Pair q = in_q8(step);
    Pair outcome = into_frame({q.x - v.base.x, q.y - v.base.y}, v.frame);
    if (kind_ == Kind::innovation) {
        const auto within = [](std::int32_t e) {
            return static_cast<std::int32_t>(clamp(e, -5120, 5120));
        };
        outcome = {within(outcome.x), within(outcome.y)};
    }
    if (said.size() > 0) {
        const auto each = said.responsibility(step.x, step.y);
        std::int64_t error = 0;
        for (std::size_t k = 0; k < said.size(); ++k) {
            const Pair mean = said.component(k).mean;
            error += (square(q.x - mean.x) + square(q.y - mean.y)) / 2 * (each[k] >> 8) >> 13;
        }
        error_.take(error, analog_rate_q8);
        shares_.follow(by_scale<3>(each), share_rate, one_q20 / 100);
    }
    memory_.remember(v.features, outcome);
}

Mixture DepthModel::predict(std::int32_t expected) const {
    Mixture m;
    for (std::size_t s = 0; s < 4; ++s)
        m.add(shares_[s], expected, scaled(error_.root(), depth_scales[s]));
    return m;
}

void DepthModel::learn(std::int32_t expected, const Mixture& said, std::int32_t step) {
    const auto each = responsibility(said, step);
    shares_.follow(by_scale<4>(each), 65535, one_q20 / 20);
    error_.take(square(clamp(std::int64_t{step} * 256 - expected, -most_mean, most_mean)),
                filter_rate_q8);
}

Features DepthAnalogModel::view(const Motion& motion) {
    const auto& d = motion.sunk;
    const auto bounded = [](std::int64_t v) {
        return static_cast<std::int32_t>(clamp(v, -most_mean, most_mean));
    };
    return {{bounded(std::int64_t{d[0]} * 16), bounded(std::int64_t{d[1]} * 14),
             bounded(std::int64_t{d[2]} * 14), bounded(std::int64_t{motion.last.z} * 12), 0}};
}

Mixture DepthAnalogModel::predict(const Motion& motion) {
    Mixture m;
    if (motion.known < 3) return m;
    std::array<Analogs::Found, 10> found;
    const std::size_t n = memory_.find(view(motion), found);
    const auto rank = rank_shares(n);
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t s = 0; s < 3; ++s)
            m.add(static_cast<std::int32_t>(std::int64_t{rank[k]} * shares_[s] >> 20),
                  found[k].outcome.x, scaled(error_.root(), analog_scales[s]));
    }
    return m;
}

void DepthAnalogModel::learn(const Motion& motion, const Mixture& said, std::int32_t step) {
    if (motion.known < 3) return;
    const std::int32_t q = position::in_q8(step);
    if (said.size() > 0) {
        const auto each = responsibility(said, step);
        std::int64_t error = 0;
        for (std::size_t k = 0; k < said.size(); ++k)
            error += square(q - said.mean(k)) * (each[k] >> 8) >> 13;
        error_.take(error, analog_rate_q8);
        shares_.follow(by_scale<3>(each), share_rate, one_q20 / 100);
    }
    memory_.remember(view(motion), {q, 0});
}

}  // namespace seautils::position
