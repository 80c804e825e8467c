#ifndef SEAUTILS_PLAN_RECEIPT_HPP
#define SEAUTILS_PLAN_RECEIPT_HPP

#include "seautils/plan/loss_field.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace seautils::plan {

/// One transmission that somebody listened for.
struct LinkSample {
    double depth_m = 0;          ///< of the end whose depth is in question
    double range_m = not_known;  ///< 0 or more
    double loss_db = not_known;  ///< by a model, at that time
    std::optional<std::int32_t> rate{};
    bool received = false;
};

/// How likely it is to be received at a depth.
struct ReceiptPoint {
    double depth_m = 0;
    double probability = 0;    ///< kernel-weighted success rate
    double low = 0, high = 1;  ///< Wilson's interval for it
    double share = 0;          ///< of the transmissions near this depth: ΣK(u) / (n K(0))
    double samples = 0;        ///< what the interval rests on: n_eff = (ΣK)² / ΣK²
    bool suppressed = true;    ///< the share is too small to say anything
};

struct ReceiptOptions {
    std::optional<double> bandwidth_m;  ///< h > 0; nothing: default_bandwidth_m()
    double deviations = 1.96;           ///< of the interval: 95 %
    double least_share = 0.01;
};

/// 2.345 σ n^(-1/5), σ that of the depths (n - 1); 0 where all are the same, or there are less than two.
double default_bandwidth_m(std::span<const LinkSample> samples);

/// P(received | d) by Bayes from densities over depth of all and of what was received, with the Epanechnikov kernel
/// K(u) = 3/4 (1 - u²), |u| < 1 (eq 4.6 of the thesis); it equals the kernel-weighted success rate.
/// Check value: see tests/unit/plan_receipt_test.cpp, 0.274096 at 15 m.
/// @param depth_m  where; a point each
std::vector<ReceiptPoint> receipt_curve(std::span<const LinkSample> samples,
                                        std::span<const double> depth_m,
                                        const ReceiptOptions& options);

/// Wilson's score interval for a share.
/// @param n  number of trials, > 0; need not be whole
struct Interval {
    double low = 0, high = 1;
};
Interval wilson_interval(double share, double n, double deviations);

/// Losses of what was received and what was not; samples without a loss do not count.
struct LossStatistics {
    std::size_t samples = 0, received = 0;
    double received_median_db = not_known, lost_median_db = not_known;
    /// H_max that fits: the least loss of a sample above which at most 1 % of what was received had its loss.
    double loss_limit_db = not_known;
    /// The loss that parts received from lost with the fewest errors; of equals the least. Between two losses: their middle.
    double threshold_db = not_known;
    std::size_t threshold_errors = 0;
};
/// @param share  of the received that may lie above loss_limit_db, 0 to 1
LossStatistics loss_statistics(std::span<const LinkSample> samples, double share = 0.01);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_RECEIPT_HPP
