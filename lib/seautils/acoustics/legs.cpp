#include "seautils/acoustics/legs.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::acoustics {

namespace {

double median(double a, double b, double c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

}  // namespace

/// A scan is judged when its successor is known: the tip of a leg stays, a wild depth does not.
std::optional<Leg> LegFinder::add(double depth_m) {
    std::optional<Leg> ended;
    if (scans_ == 1) ended = judge(0, last_m_);
    if (scans_ > 1) {
        const double middle = median(before_m_, last_m_, depth_m);
        const bool wild = std::fabs(last_m_ - middle) > turn_m_ / 2;
        ended = judge(scans_ - 1, wild ? middle : last_m_);
    }
    before_m_ = last_m_;
    last_m_ = depth_m;
    ++scans_;
    return ended;
}

std::vector<Leg> LegFinder::finish() {
    std::vector<Leg> legs;
    if (scans_ == 0) return legs;
    if (const auto ended = judge(scans_ - 1, last_m_)) legs.push_back(*ended);
    if (first_ < scans_) legs.push_back(end_at(scans_, Direction::none));
    return legs;
}

void LegFinder::forget(std::size_t scans) {
    scans_ -= scans;
    first_ -= scans;
    least_at_ -= std::min(scans, least_at_);
    most_at_ -= std::min(scans, most_at_);
}

Leg LegFinder::end_at(std::size_t end, Direction next) {
    const Leg leg{first_, end, direction_};
    first_ = end;
    direction_ = next;
    return leg;
}

std::optional<Leg> LegFinder::judge_without_direction(std::size_t at, double depth_m) {
    std::optional<Leg> ended;
    if (depth_m - least_m_ > turn_m_) {
        if (least_at_ > first_) ended = end_at(least_at_, Direction::dive);
        direction_ = Direction::dive;
        most_m_ = depth_m, most_at_ = at;
    } else if (most_m_ - depth_m > turn_m_) {
        if (most_at_ > first_) ended = end_at(most_at_, Direction::climb);
        direction_ = Direction::climb;
        least_m_ = depth_m, least_at_ = at;
    }
    return ended;
}

std::optional<Leg> LegFinder::judge(std::size_t at, double depth_m) {
    if (at == first_ && direction_ == Direction::none) {
        least_m_ = most_m_ = depth_m;
        least_at_ = most_at_ = at;
    }
    if (depth_m < least_m_) least_m_ = depth_m, least_at_ = at;
    if (depth_m > most_m_) most_m_ = depth_m, most_at_ = at;
    if (direction_ == Direction::none) return judge_without_direction(at, depth_m);
    std::optional<Leg> ended;
    if (direction_ == Direction::dive && most_m_ - depth_m > turn_m_) {
        ended = end_at(most_at_ + 1, Direction::climb);
        least_m_ = depth_m, least_at_ = at;
    } else if (direction_ == Direction::climb && depth_m - least_m_ > turn_m_) {
        ended = end_at(least_at_ + 1, Direction::dive);
        most_m_ = depth_m, most_at_ = at;
    }
    return ended;
}

}  // namespace seautils::acoustics
