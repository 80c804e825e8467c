#ifndef SEAUTILS_PLAN_INSTANCES_HPP
#define SEAUTILS_PLAN_INSTANCES_HPP

#include "seautils/plan/loss_field.hpp"
#include "seautils/plan/objective.hpp"

#include <span>
#include <vector>

namespace seautils::plan {

/// Fields that are instances of one sea: each was computed from another profile. What they say together, and what their
/// differences are worth (eq 4.4 of the thesis, and the improvement that it proposes).

/// @throws DataError  they have different depths
void check_depths(std::span<const LossField> fields);

/// Loss of the mean intensity. @param losses_db  NaN: no value, left out; infinite: no energy
/// @return  NaN: none has a value; infinite: no energy
double loss_of_mean_db(std::span<const double> losses_db);

/// Sample standard deviation of those that have a value, of which each counts as `most_db` at most; 0 of one or none.
double deviation_db(std::span<const double> values_db, double most_db);

/// Loss of the mean intensity of all fields at a depth and range, as loss_at_db().
double mean_loss_at_db(std::span<const LossField> fields, double depth_m, double range_m);

struct Uncertainty {
    double half_db = 3;  ///< σ0 > 0: where instances differ by so much, utility is half its mean
    double smoothing_m = 10;  ///< length of the low-pass over depth where they do; 0: none
};

/// Takes from a utility what instances do not agree on: by σ(d) it is blended into its mean over depth with the weight
/// σ² / (σ² + σ0²), and then low-passed down and up with a length of smoothing_m σ_rms / σ0, so that no depth is chosen
/// for a detail that the next profile takes back. Where all agree nothing changes.
/// @param deviation_db  σ at each point
/// @param counts        whether a point counts for the mean and σ_rms; empty: all do. Points without a value never do
void blend(Objective& objective, std::span<const double> deviation_db,
           const Uncertainty& uncertainty, const std::vector<bool>& counts = {});

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_INSTANCES_HPP
