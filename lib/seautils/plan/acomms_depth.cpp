#include "seautils/plan/acomms_depth.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seautils::plan {

namespace {

/// No energy counts as this loss where a deviation is asked for.
constexpr double no_energy_db = 200;

/// H̄ of each field at a depth; those without a value are left out.
std::vector<double> losses(std::span<const LossField> fields, std::size_t depth,
                           RangeWindow window) {
    std::vector<double> all;
    for (const LossField& field : fields)
        if (const double h = mean_loss_db(field, depth, window); !std::isnan(h)) all.push_back(h);
    return all;
}

double loss_of_mean_db(const std::vector<double>& losses_db) {
    double sum = 0;
    for (const double h : losses_db) sum += std::pow(10, -h / 10);
    const double mean = sum / static_cast<double>(losses_db.size());
    return mean > 0 ? -10 * std::log10(mean) : HUGE_VAL;
}

double deviation_db(const std::vector<double>& losses_db) {
    const auto n = static_cast<double>(losses_db.size());
    if (n < 2) return 0;
    double mean = 0, square = 0;
    for (const double h : losses_db) mean += std::min(h, no_energy_db) / n;
    for (const double h : losses_db) square += std::pow(std::min(h, no_energy_db) - mean, 2);
    return std::sqrt(square / (n - 1));
}

/// The largest finite loss of all cells in the window.
double largest_loss_db(std::span<const LossField> fields, RangeWindow window) {
    double most = not_known;
    for (const LossField& field : fields) {
        for (std::size_t i = 0; i < field.range_m.size(); ++i) {
            if (field.range_m[i] < window.from_m || field.range_m[i] > window.to_m) continue;
            for (std::size_t k = 0; k < field.depth_m.size(); ++k)
                if (const double h = field.at(k, i); std::isfinite(h) && !(h <= most)) most = h;
        }
    }
    return most;
}

/// Where no range of the field lies in the window, its losses are those of H̄.
double largest_of(const std::vector<double>& losses_db) {
    double most = not_known;
    for (const double h : losses_db)
        if (std::isfinite(h) && !(h <= most)) most = h;
    return most;
}

void blend(AcommsCurve& curve, const AcommsOptions& options) {
    std::vector<double>& u = curve.objective.utility;
    double sum = 0, square = 0;
    std::size_t n = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
        if (std::isnan(u[k])) continue;
        sum += u[k];
        square += curve.deviation_db[k] * curve.deviation_db[k];
        ++n;
    }
    if (n == 0 || square == 0) return;
    const double mean = sum / static_cast<double>(n);
    const double s0 = options.uncertainty_db;
    for (std::size_t k = 0; k < u.size(); ++k) {
        const double s2 = curve.deviation_db[k] * curve.deviation_db[k];
        u[k] += s2 / (s2 + s0 * s0) * (mean - u[k]);
    }
    const double length_m = options.smoothing_m * std::sqrt(square / static_cast<double>(n)) / s0;
    low_pass_down(curve.objective.depth_m, u, length_m);
    low_pass_up(curve.objective.depth_m, u, length_m);
}

void check_depths(std::span<const LossField> fields) {
    for (const LossField& field : fields)
        if (field.depth_m != fields.front().depth_m)
            throw DataError("the fields of the profiles have different depths");
}

}  // namespace

AcommsCurve acomms_curve(std::span<const LossField> fields, RangeWindow window,
                         const AcommsOptions& options) {
    check_depths(fields);
    AcommsCurve curve;
    curve.cover = Cover::full;
    for (const LossField& field : fields) curve.cover = std::max(curve.cover, cover(field, window));
    curve.objective.name = "acomms";
    curve.objective.depth_m = fields.front().depth_m;
    for (std::size_t k = 0; k < fields.front().depth_m.size(); ++k) {
        const std::vector<double> all = losses(fields, k, window);
        curve.loss_db.push_back(all.empty() ? not_known : loss_of_mean_db(all));
        curve.deviation_db.push_back(deviation_db(all));
    }
    double limit_db = options.loss_limit_db.value_or(largest_loss_db(fields, window));
    if (std::isnan(limit_db)) limit_db = largest_of(curve.loss_db);
    curve.loss_limit_db = limit_db;
    for (const double h : curve.loss_db)
        curve.objective.utility.push_back(
            std::isnan(h) || !(limit_db > 0) ? not_known : std::clamp(1 - h / limit_db, 0.0, 1.0));
    blend(curve, options);
    return curve;
}

}  // namespace seautils::plan
