#include "seautils/plan/instances.hpp"

#include "seautils/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::plan {

void check_depths(std::span<const LossField> fields) {
    for (const LossField& field : fields)
        if (field.depth_m != fields.front().depth_m)
            throw DataError("the fields of the profiles have different depths");
}

double loss_of_mean_db(std::span<const double> losses_db) {
    double sum = 0, n = 0;
    for (const double h : losses_db) {
        if (std::isnan(h)) continue;
        sum += std::pow(10, -h / 10);
        ++n;
    }
    if (n == 0) return not_known;
    return sum > 0 ? -10 * std::log10(sum / n) : HUGE_VAL;
}

double deviation_db(std::span<const double> values_db, double most_db) {
    double n = 0, sum = 0, square = 0;
    for (const double x : values_db) {
        if (std::isnan(x)) continue;
        sum += std::min(x, most_db);
        ++n;
    }
    if (n < 2) return 0;
    for (const double x : values_db)
        if (!std::isnan(x)) square += std::pow(std::min(x, most_db) - sum / n, 2);
    return std::sqrt(square / (n - 1));
}

double mean_loss_at_db(std::span<const LossField> fields, double depth_m, double range_m) {
    std::vector<double> all;
    for (const LossField& field : fields) all.push_back(loss_at_db(field, depth_m, range_m));
    return loss_of_mean_db(all);
}

void blend(Objective& objective, std::span<const double> deviation_db,
           const Uncertainty& uncertainty, const std::vector<bool>& counts) {
    std::vector<double>& u = objective.utility;
    double sum = 0, square = 0, n = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
        if (std::isnan(u[k]) || (!counts.empty() && !counts[k])) continue;
        sum += u[k];
        square += deviation_db[k] * deviation_db[k];
        ++n;
    }
    if (n == 0 || square == 0) return;
    const double mean = sum / n, s0 = uncertainty.half_db;
    for (std::size_t k = 0; k < u.size(); ++k) {
        const double s2 = deviation_db[k] * deviation_db[k];
        u[k] += s2 / (s2 + s0 * s0) * (mean - u[k]);
    }
    const double length_m = uncertainty.smoothing_m * std::sqrt(square / n) / s0;
    low_pass_down(objective.depth_m, u, length_m);
    low_pass_up(objective.depth_m, u, length_m);
}

}  // namespace seautils::plan
