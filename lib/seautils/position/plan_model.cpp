#include "seautils/position/plan_model.hpp"

#include "seautils/core/random.hpp"

#include <algorithm>
#include <cstdlib>

namespace seautils::position {

namespace {

constexpr std::array<std::int32_t, 3> scales{128, 256, 768};  // 0.5, 1, 3
constexpr std::int32_t leg_rate = 3277, share_rate = 1311;    // 0.05, 0.02
constexpr std::uint32_t patience = 8;                         // steps in a row that no leg explains

std::int64_t squared_distance(const Cell& a, const Cell& b) {
    const std::int64_t x = a.x - std::int64_t{b.x}, y = a.y - std::int64_t{b.y};
    return x * x + y * y;
}

std::int64_t distance(const Cell& a, const Cell& b) {
    return square_root(static_cast<std::uint64_t>(squared_distance(a, b)));
}

/// From a point to the nearest one between two others, over the plane.
std::int64_t distance_to_leg(const Cell& p, const Cell& from, const Cell& to) {
    const std::int64_t dx = to.x - std::int64_t{from.x}, dy = to.y - std::int64_t{from.y};
    const std::int64_t px = p.x - std::int64_t{from.x}, py = p.y - std::int64_t{from.y};
    const std::int64_t along = px * dx + py * dy, size = dx * dx + dy * dy;
    if (along <= 0) return distance(p, from);
    if (along >= size) return distance(p, to);
    const std::int64_t off = px * dy - py * dx;
    return std::abs(off) / std::max<std::int64_t>(1, square_root(static_cast<std::uint64_t>(size)));
}

}  // namespace

std::int64_t PlanModel::mark() const {
    std::uint64_t mark = waypoints_.size();
    for (const Cell& w : waypoints_)
        for (const std::int32_t v : {w.x, w.y, w.z})
            mark = splitmix64(mark ^ static_cast<std::uint32_t>(v));
    return static_cast<std::int64_t>(mark >> 1);
}

void PlanModel::begin(const Cell& cell) {
    lost_ = 0;
    std::int64_t nearest = INT64_MAX;
    const std::size_t first = next_;
    for (std::size_t k = first; k < waypoints_.size(); ++k) {
        // The leg to the first waypoint begins anywhere; later legs are as many steps less likely.
        const std::int64_t distance =
            k == 0 ? 0 : distance_to_leg(cell, waypoints_[k - 1], waypoints_[k]);
        const std::int64_t cost =
            distance + static_cast<std::int64_t>(k - first) * 2 * speed_ / 256;
        if (cost >= nearest) continue;
        nearest = cost;
        next_ = k;
    }
}

void PlanModel::look_around(const Motion& motion) {
    lost_ = 0;
    std::int64_t nearest = INT64_MAX;
    for (std::size_t k = 0; k < waypoints_.size(); ++k) {
        const std::int64_t distance =
            k == 0 ? speed_ / 256 : distance_to_leg(motion.last, waypoints_[k - 1], waypoints_[k]);
        const Direction leg = direction_of(towards(motion, k), 1, motion.heading);
        const std::int64_t turn =
            (1 << 14) - into_frame({leg.x, leg.y}, motion.heading).x;  // 1 - cos
        const std::int64_t cost = distance + (turn * 4 * speed_ >> 22);
        if (cost >= nearest) continue;
        nearest = cost;
        next_ = k;
    }
}

Pair PlanModel::towards(const Motion& motion, std::size_t waypoint) const {
    const Cell& w = waypoints_[waypoint];
    const Pair way{in_q8(w.x - std::int64_t{motion.last.x}),
                   in_q8(w.y - std::int64_t{motion.last.y})};
    const Direction d = direction_of(way, 64, motion.heading);
    return out_of_frame({speed_, 0}, d);
}

std::int32_t PlanModel::depth_towards(const Motion& motion, std::size_t waypoint) const {
    const std::int32_t way = in_q8(waypoints_[waypoint].z - std::int64_t{motion.last.z});
    return static_cast<std::int32_t>(clamp(way, -rate_, rate_));
}

PlaneMixture PlanModel::predict(const Motion& motion) const {
    PlaneMixture m;
    for (std::size_t leg = 0; leg < 2 && has(next_ + leg); ++leg) {
        const Pair mean = towards(motion, next_ + leg);
        const Direction d = direction_of(mean, 1, motion.heading);
        for (std::size_t k = 0; k < 9; ++k) {
            const std::int64_t weight = std::int64_t{legs_[leg]} * shares_[k] >> 20;
            m.add(static_cast<std::int32_t>(weight), mean, scaled(along_.root(), scales[k / 3]),
                  scaled(across_.root(), scales[k % 3]), d);
        }
    }
    return m;
}

Mixture PlanModel::predict_depth(const Motion& motion) const {
    Mixture m;
    for (std::size_t leg = 0; leg < 2 && has(next_ + leg); ++leg) {
        const std::int32_t mean = depth_towards(motion, next_ + leg);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int64_t weight = std::int64_t{depth_legs_[leg]} * depth_shares_[k] >> 20;
            m.add(static_cast<std::int32_t>(weight), mean,
                  scaled(depth_error_.root(), depth_scales[k]));
        }
    }
    return m;
}

void PlanModel::learn(const Motion& motion, const PlaneMixture& said, const Mixture& said_depth,
                      const Cell& step) {
    if (said.size() == 0) return;
    learn_depth(motion, said_depth, step.z);
    learn_plane(motion, said, step);
    const bool explained = said.probability_q24(step.x, step.y) > one_q24 >> 12;
    lost_ = explained ? 0 : lost_ + 1;
    if (lost_ >= patience) look_around(motion);
}

void PlanModel::learn_plane(const Motion& motion, const PlaneMixture& said, const Cell& step) {
    const auto each = said.responsibility(step.x, step.y);
    std::array<std::int32_t, 9> sizes{};
    std::array<std::int32_t, 2> legs{};
    for (std::size_t k = 0; k < said.size(); ++k) {
        sizes[k % 9] += each[k];
        legs[k / 9] += each[k];
    }
    const std::size_t on = legs[1] > legs[0] ? 1 : 0;
    const Pair mean = towards(motion, next_ + on);
    const Direction d = direction_of(mean, 1, motion.heading);
    const Pair moved{in_q8(step.x), in_q8(step.y)};
    const Pair error = into_frame({moved.x - mean.x, moved.y - mean.y}, d);
    along_.take(square(error.x), filter_rate_q8);
    across_.take(square(error.y), filter_rate_q8);
    shares_.follow(sizes, share_rate, one_q20 / 100);
    legs_.follow(legs, leg_rate, one_q20 / 20);
    const auto size = static_cast<std::int32_t>(std::min<std::uint32_t>(length(moved), most_mean));
    speed_ += (size - speed_) / 8;
    // The next leg; or the waypoint lies behind.
    const Cell now{motion.last.x + step.x, motion.last.y + step.y, motion.last.z + step.z};
    const std::int64_t near = std::int64_t{speed_} * speed_ >> 18;  // half a step
    if (on == 1 || squared_distance(now, waypoints_[next_]) <= near) ++next_;
}

void PlanModel::learn_depth(const Motion& motion, const Mixture& said, std::int32_t step) {
    const auto each = responsibility(said, step);
    std::array<std::int32_t, 4> sizes{};
    std::array<std::int32_t, 2> legs{};
    for (std::size_t k = 0; k < said.size(); ++k) {
        sizes[k % 4] += each[k];
        legs[k / 4] += each[k];
    }
    const std::size_t on = legs[1] > legs[0] ? 1 : 0;
    const std::int64_t error = in_q8(step) - depth_towards(motion, next_ + on);
    depth_error_.take(square(error), filter_rate_q8);
    depth_shares_.follow(sizes, share_rate, one_q20 / 100);
    depth_legs_.follow(legs, leg_rate, one_q20 / 20);
    const std::int32_t size = std::abs(in_q8(step));
    if (size >= 128) rate_ += (size - rate_) / 8;
}

}  // namespace seautils::position
