#include "seautils/plan/loss_field.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace seautils::plan {

namespace {

constexpr std::size_t most_values = 100'000;

void check_axis(const std::vector<double>& axis, const char* name) {
    if (axis.empty()) throw DataError(fmt::format("{} has no values", name));
    if (axis.size() > most_values)
        throw DataError(
            fmt::format("{} has {} values of at most {}", name, axis.size(), most_values));
    double last = -1;
    for (const double x : axis) {
        if (!(x >= 0 && x <= 1e8))
            throw DataError(fmt::format("{} {} is outside 0 to 1e8 m", name, x));
        if (x <= last) throw DataError(fmt::format("{} {} does not grow after {}", name, x, last));
        last = x;
    }
}

double intensity(double loss_db) { return std::pow(10, -loss_db / 10); }
double loss(double intensity) {
    return intensity > 0 ? -10 * std::log10(intensity) : std::numeric_limits<double>::infinity();
}

/// Where a value lies between those of an axis: the index below it, and how far to the next, 0 to 1. Below its first or
/// above its last value: NaN.
std::pair<std::size_t, double> place(const std::vector<double>& axis, double x) {
    if (!(x >= axis.front() && x <= axis.back())) return {0, not_known};
    const auto above = std::upper_bound(axis.begin(), axis.end(), x);
    const auto k = static_cast<std::size_t>(above - axis.begin()) - 1;
    if (above == axis.end()) return {k, 0};
    return {k, (x - axis[k]) / (axis[k + 1] - axis[k])};
}

/// Between two losses in intensity; where one has no value, the other.
double between(double first_db, double second_db, double share) {
    if (share == 0 || std::isnan(second_db)) return first_db;
    if (std::isnan(first_db)) return second_db;
    return loss((1 - share) * intensity(first_db) + share * intensity(second_db));
}

double half_last_step(const std::vector<double>& axis) {
    return axis.size() < 2 ? 0 : (axis.back() - axis[axis.size() - 2]) / 2;
}

std::size_t nearest(const std::vector<double>& axis, double x) {
    const auto above = std::lower_bound(axis.begin(), axis.end(), x);
    if (above == axis.begin()) return 0;
    const auto k = static_cast<std::size_t>(above - axis.begin());
    return above == axis.end() || x - axis[k - 1] <= axis[k] - x ? k - 1 : k;
}

}  // namespace

void check(const LossField& field) {
    check_axis(field.depth_m, "depth_m");
    check_axis(field.range_m, "range_m");
    const std::size_t cells = field.depth_m.size() * field.range_m.size();
    if (field.loss_db.size() != cells)
        throw DataError(fmt::format("tl_db has {} values where {} depths and {} ranges need {}",
                                    field.loss_db.size(), field.depth_m.size(),
                                    field.range_m.size(), cells));
    for (const float x : field.loss_db)
        if (!std::isnan(x) && x != std::numeric_limits<float>::infinity() &&
            !(x >= -100 && x <= 1000))
            throw DataError(fmt::format("tl_db {} is outside -100 to 1000 dB", x));
}

Cover cover(const LossField& field, RangeWindow window) {
    const double end_m = field.range_m.back() + half_last_step(field.range_m);
    if (!(window.from_m <= end_m)) return Cover::none;
    return window.to_m <= end_m ? Cover::full : Cover::part;
}

double mean_loss_db(const LossField& field, std::size_t depth, RangeWindow window) {
    if (cover(field, window) == Cover::none) return not_known;
    const auto& axis = field.range_m;
    auto first = static_cast<std::size_t>(
        std::lower_bound(axis.begin(), axis.end(), window.from_m) - axis.begin());
    auto end = static_cast<std::size_t>(std::upper_bound(axis.begin(), axis.end(), window.to_m) -
                                        axis.begin());
    if (first >= end) {
        first = nearest(axis, (window.from_m + window.to_m) / 2);
        end = first + 1;
    }
    double sum = 0;
    std::size_t n = 0;
    for (std::size_t k = first; k < end; ++k) {
        const double h = field.at(depth, k);
        if (std::isnan(h)) continue;
        sum += intensity(h);
        ++n;
    }
    return n == 0 ? not_known : loss(sum / static_cast<double>(n));
}

double loss_at_db(const LossField& field, std::size_t depth, double range_m) {
    const auto [k, share] = place(field.range_m, range_m);
    if (std::isnan(share)) return not_known;
    if (share == 0) return field.at(depth, k);
    return between(field.at(depth, k), field.at(depth, k + 1), share);
}

double loss_at_db(const LossField& field, double depth_m, double range_m) {
    const auto [k, share] = place(field.depth_m, depth_m);
    if (std::isnan(share)) return not_known;
    const double first = loss_at_db(field, k, range_m);
    return share == 0 ? first : between(first, loss_at_db(field, k + 1, range_m), share);
}

}  // namespace seautils::plan
