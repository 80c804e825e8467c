#include "seautils/plan/objective.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seautils::plan {

namespace {

constexpr std::size_t most_points = 100'000;
constexpr double most_depth_m = 1e5;

void refuse_unless(bool holds, const Objective& objective, const std::string& what) {
    if (holds) return;
    throw DataError(fmt::format("objective {}: {}", quote(objective.name), what));
}

/// Filters in the order of `index`.
template <class Index>
void low_pass(std::span<const double> depth_m, std::vector<double>& values, double length_m,
              Index index) {
    bool started = false;
    double y = 0, last_m = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        double& x = values[index(k)];
        const double z = depth_m[index(k)];
        if (std::isnan(x)) continue;
        const double step = started ? std::abs(z - last_m) : 0;
        y = started ? y + (step > 0 ? step / (step + length_m) * (x - y) : 0) : x;
        started = true;
        last_m = z;
        x = y;
    }
}

/// The farthest point from which a straight line to `first` passes all points between within the tolerance.
std::size_t end_of_piece(const Objective& o, std::size_t first, double tolerance) {
    double least = -HUGE_VAL, most = HUGE_VAL;  // slopes that pass all points so far
    std::size_t end = first + 1;
    for (std::size_t k = first + 1; k < o.depth_m.size(); ++k) {
        const double run = o.depth_m[k] - o.depth_m[first];
        if (run <= 0) break;
        const double rise = o.utility[k] - o.utility[first];
        if (rise / run >= least && rise / run <= most) end = k;
        least = std::max(least, (rise - tolerance) / run);
        most = std::min(most, (rise + tolerance) / run);
        if (least > most) break;
    }
    return end;
}

}  // namespace

void check(const Objective& o) {
    const std::size_t n = o.depth_m.size();
    refuse_unless(n == o.utility.size(), o,
                  fmt::format("depth_m has {} values, utility {}", n, o.utility.size()));
    refuse_unless(n > 0, o, "depth_m has no values");
    refuse_unless(n <= most_points, o, fmt::format("{} points of at most {}", n, most_points));
    refuse_unless(o.weight >= 0 && o.weight <= 1e6, o,
                  fmt::format("weight {} is outside 0 to 1e6", o.weight));
    for (std::size_t k = 0; k < n; ++k) {
        refuse_unless(o.depth_m[k] >= 0 && o.depth_m[k] <= most_depth_m, o,
                      fmt::format("depth_m {} is outside 0 to 1e5 m", o.depth_m[k]));
        refuse_unless(o.utility[k] >= 0 && o.utility[k] <= 1, o,
                      fmt::format("utility {} is outside 0 to 1", o.utility[k]));
        const bool grows = k == 0 || o.depth_m[k] >= o.depth_m[k - 1];
        const bool thrice = k >= 2 && o.depth_m[k] == o.depth_m[k - 2];
        refuse_unless(grows && !thrice, o, fmt::format("depth_m {} does not grow", o.depth_m[k]));
    }
}

double utility_at(const Objective& o, double depth_m) {
    const auto above = std::upper_bound(o.depth_m.begin(), o.depth_m.end(), depth_m);
    if (above == o.depth_m.begin()) return o.utility.front();
    if (const auto k = static_cast<std::size_t>(above - o.depth_m.begin());
        k >= 2 && o.depth_m[k - 1] == depth_m && o.depth_m[k - 2] == depth_m)
        return std::max(o.utility[k - 1], o.utility[k - 2]);
    if (above == o.depth_m.end()) return o.utility.back();
    const auto k = static_cast<std::size_t>(above - o.depth_m.begin());
    const double from_m = o.depth_m[k - 1];
    if (from_m == depth_m) return o.utility[k - 1];
    const double share = (depth_m - from_m) / (o.depth_m[k] - from_m);
    return (1 - share) * o.utility[k - 1] + share * o.utility[k];
}

Objective combined(const Objective& first, std::span<const Objective> others) {
    Objective sum = first;
    for (const Objective& other : others) sum.weight += other.weight;
    if (!(sum.weight > 0)) return first;
    for (std::size_t k = 0; k < sum.depth_m.size(); ++k) {
        sum.utility[k] *= first.weight;
        for (const Objective& other : others)
            sum.utility[k] += other.weight * utility_at(other, sum.depth_m[k]);
        sum.utility[k] /= sum.weight;
    }
    return sum;
}

Objective simplified(const Objective& objective, double tolerance) {
    Objective whole = objective;
    for (double& u : whole.utility)
        if (std::isnan(u)) u = 0;
    Objective few{.name = whole.name, .weight = whole.weight, .depth_m = {}, .utility = {}};
    for (std::size_t k = 0; k < whole.depth_m.size(); k = end_of_piece(whole, k, tolerance)) {
        few.depth_m.push_back(whole.depth_m[k]);
        few.utility.push_back(whole.utility[k]);
    }
    return few;
}

void low_pass_down(std::span<const double> depth_m, std::vector<double>& values, double length_m) {
    low_pass(depth_m, values, length_m, [](std::size_t k) { return k; });
}

void low_pass_up(std::span<const double> depth_m, std::vector<double>& values, double length_m) {
    low_pass(depth_m, values, length_m, [n = values.size()](std::size_t k) { return n - 1 - k; });
}

}  // namespace seautils::plan
