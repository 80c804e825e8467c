#ifndef SEAUTILS_PLAN_ACOMMS_DEPTH_HPP
#define SEAUTILS_PLAN_ACOMMS_DEPTH_HPP

#include "seautils/plan/loss_field.hpp"
#include "seautils/plan/objective.hpp"

#include <optional>
#include <span>
#include <vector>

namespace seautils::plan {

/// The depth at which a modem is heard: the behaviour AcommsDepth of the thesis, section 4.3.
struct AcommsOptions {
    /// H_max, 1 to 1000 dB: the loss at which nothing is worth anything. Nothing: the largest loss in the window.
    std::optional<double> loss_limit_db = 108;
    /// σ0 > 0: where losses by the profiles differ by so much, utility is half its depth mean.
    double uncertainty_db = 3;
    /// Length of the low-pass over depth where they differ by that; it grows with their difference. 0: none.
    double smoothing_m = 10;
};

/// Depth by depth; NaN: no value there.
struct AcommsCurve {
    std::vector<double>
        loss_db;  ///< H̄: of the mean intensity over window and profiles; infinite: no energy
    std::vector<double> deviation_db;  ///< σ of H̄ over the profiles; 0 where there is one
    Objective objective;               ///< O = max(1 - H̄ / H_max, 0), smoothed by σ
    double loss_limit_db =
        not_known;              ///< H_max that was used; NaN: no loss in the window is finite
    Cover cover = Cover::none;  ///< the worst of the fields
};

/// The utility of each depth of the fields (eqs 4.2 to 4.4). Fields are instances of one sea: their intensities are
/// averaged, and where they differ utility is blended and low-passed as blend() does.
/// Check value: losses of 90, 92, 88 and 100 dB in the window give 0.159124 of 108 dB.
/// @param fields  1 at least, each checked
/// @throws DataError  they have different depths
AcommsCurve acomms_curve(std::span<const LossField> fields, RangeWindow window,
                         const AcommsOptions& options);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_ACOMMS_DEPTH_HPP
