#include "seautils/plan/acomms_depth.hpp"

#include "seautils/plan/instances.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::plan {

namespace {

/// No energy counts as this loss where a deviation is asked for.
constexpr double no_energy_db = 200;

/// H̄ of each field at a depth.
std::vector<double> losses(std::span<const LossField> fields, std::size_t depth,
                           RangeWindow window) {
    std::vector<double> all;
    for (const LossField& field : fields) all.push_back(mean_loss_db(field, depth, window));
    return all;
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
        curve.loss_db.push_back(loss_of_mean_db(all));
        curve.deviation_db.push_back(deviation_db(all, no_energy_db));
    }
    double limit_db = options.loss_limit_db.value_or(largest_loss_db(fields, window));
    if (std::isnan(limit_db)) limit_db = largest_of(curve.loss_db);
    curve.loss_limit_db = limit_db;
    for (const double h : curve.loss_db)
        curve.objective.utility.push_back(
            std::isnan(h) || !(limit_db > 0) ? not_known : std::clamp(1 - h / limit_db, 0.0, 1.0));
    blend(curve.objective, curve.deviation_db, {options.uncertainty_db, options.smoothing_m});
    return curve;
}

}  // namespace seautils::plan
