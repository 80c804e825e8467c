#include "seautils/plan/receipt.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::plan {

namespace {

constexpr double kernel_top = 0.75;

double kernel(double u) { return std::abs(u) < 1 ? kernel_top * (1 - u * u) : 0; }

ReceiptPoint point_at(std::span<const LinkSample> samples, double depth_m, double bandwidth_m,
                      const ReceiptOptions& options) {
    double all = 0, good = 0, square = 0;
    for (const LinkSample& s : samples) {
        const double away = s.depth_m - depth_m;
        const double k = bandwidth_m > 0 ? kernel(away / bandwidth_m) : away == 0 ? kernel_top : 0;
        all += k;
        square += k * k;
        if (s.received) good += k;
    }
    ReceiptPoint point{.depth_m = depth_m, .probability = not_known};
    if (!(all > 0)) return point;
    point.probability = std::clamp(good / all, 0.0, 1.0);
    point.samples = all * all / square;
    point.share = all / kernel_top / static_cast<double>(samples.size());
    const Interval i = wilson_interval(point.probability, point.samples, options.deviations);
    point.low = i.low;
    point.high = i.high;
    point.suppressed = point.share < options.least_share;
    return point;
}

double median(std::vector<double> values) {
    if (values.empty()) return not_known;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

/// The threshold goes up through the losses; each received below it is right, each lost below it an error.
void find_threshold(std::vector<LinkSample> by_loss, LossStatistics& s) {
    std::sort(by_loss.begin(), by_loss.end(),
              [](const LinkSample& a, const LinkSample& b) { return a.loss_db < b.loss_db; });
    std::size_t errors = s.received;
    s.threshold_errors = errors;
    s.threshold_db = by_loss.front().loss_db;
    for (std::size_t k = 0; k < by_loss.size(); ++k) {
        by_loss[k].received ? --errors : ++errors;
        const bool is_last = k + 1 == by_loss.size();
        if (!is_last && by_loss[k + 1].loss_db == by_loss[k].loss_db) continue;
        if (errors >= s.threshold_errors) continue;
        s.threshold_errors = errors;
        s.threshold_db =
            is_last ? by_loss[k].loss_db : (by_loss[k].loss_db + by_loss[k + 1].loss_db) / 2;
    }
}

}  // namespace

double default_bandwidth_m(std::span<const LinkSample> samples) {
    const auto n = static_cast<double>(samples.size());
    if (n < 2) return 0;
    double mean = 0, square = 0;
    for (const LinkSample& s : samples) mean += s.depth_m / n;
    for (const LinkSample& s : samples) square += (s.depth_m - mean) * (s.depth_m - mean);
    return 2.345 * std::sqrt(square / (n - 1)) * std::pow(n, -0.2);
}

std::vector<ReceiptPoint> receipt_curve(std::span<const LinkSample> samples,
                                        std::span<const double> depth_m,
                                        const ReceiptOptions& options) {
    const double h = options.bandwidth_m.value_or(default_bandwidth_m(samples));
    std::vector<ReceiptPoint> curve;
    for (const double z : depth_m) curve.push_back(point_at(samples, z, h, options));
    return curve;
}

Interval wilson_interval(double share, double n, double deviations) {
    const double z2 = deviations * deviations;
    const double middle = (share + z2 / (2 * n)) / (1 + z2 / n);
    const double half =
        deviations / (1 + z2 / n) * std::sqrt(share * (1 - share) / n + z2 / (4 * n * n));
    return {std::max(middle - half, 0.0), std::min(middle + half, 1.0)};
}

LossStatistics loss_statistics(std::span<const LinkSample> samples, double share) {
    LossStatistics s;
    std::vector<double> received, lost;
    std::vector<LinkSample> known;
    for (const LinkSample& sample : samples) {
        if (std::isnan(sample.loss_db)) continue;
        known.push_back(sample);
        (sample.received ? received : lost).push_back(sample.loss_db);
    }
    s.samples = known.size();
    s.received = received.size();
    s.received_median_db = median(received);
    s.lost_median_db = median(lost);
    if (!received.empty()) {
        const double may = std::floor(share * static_cast<double>(received.size()) + 1e-9);
        const std::size_t above = std::min(static_cast<std::size_t>(may), received.size() - 1);
        std::sort(received.begin(), received.end());
        s.loss_limit_db = received[received.size() - 1 - above];
    }
    if (!known.empty()) find_threshold(known, s);
    return s;
}

}  // namespace seautils::plan
