#ifndef SEAUTILS_PLAN_MAX_SNR_DEPTH_HPP
#define SEAUTILS_PLAN_MAX_SNR_DEPTH_HPP

#include "seautils/plan/instances.hpp"
#include "seautils/plan/limits.hpp"
#include "seautils/plan/loss_field.hpp"
#include "seautils/plan/objective.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace seautils::plan {

/// The depth of the best signal-to-noise ratio on the way: the behaviour MaxSNRDepth of the thesis, section 4.4.
struct SnrOptions {
    double signal_weight = 1, noise_weight = 1, gain_weight = 1;
    double horizon_s = 7200;  ///< how far ahead
    double step_s = 120;      ///< between the times that are looked at
    /// Length of both low-passes from the surface down, and of that where instances differ by σ0. 0: none.
    double smoothing_m = 50;
    double uncertainty_db =
        3;              ///< σ0 > 0: where instances differ by so much, utility is half its mean
    double weight = 1;  ///< beside that of other objectives
    double near_best = 0.05;  ///< ε: as good as the best depth is what has 1 - ε of its utility
    double near_m = 50;       ///< Δ: as good is what is no farther from it
    double short_horizon_s = 300;  ///< how far ahead to follow from there
    double most_pitch_deg = 20;
    double worst_loss_db = 200;  ///< more, and no energy at all, counts as this
};

/// A forecast: utility over depth at each of the times 0, step, 2 step, …
struct SnrForecast {
    std::vector<double> depth_m;
    std::vector<double> time_s;
    std::vector<double> range_m;  ///< at each time
    /// [time][depth]: w_s (-H) + w_n (-NL) + w_a AG, low-passed, dB; NaN: no value.
    std::vector<std::vector<double>> snr_db;
    /// The same: σ of it over the instances, each low-passed alone; 0 where there is one.
    std::vector<std::vector<double>> deviation_db;
    Uncertainty uncertainty;

    /// The objective of one time: 0 at the least value of the allowed depths, 1 at the largest; in proportion elsewhere,
    /// also above 1. Where instances differ it is less sharp, as blend() says.
    Objective objective(std::size_t time, const std::vector<DepthBand>& allowed) const;
};

/// Ranges r + ṙ t, at least 0. H is that of the mean intensity of all instances. What is low-passed is in dB, straight
/// between depths: two sections dy/dz = (x - y) / length, which are y += Δz / (Δz + length) (x - y) for steps that are
/// small beside the length, so that a coarse grid and a fine one of the same sea agree. They move what is smooth down by twice the
/// length, and the ridge of the deep Pacific, with the caustic's shadow above it, by 120 to 215 m. Times whose
/// ranges no field has are left out, but for the first.
/// @param fields  1 at least, each checked
/// @param noise_db, gain_db  over depth
/// @throws DataError  the fields have different depths
SnrForecast forecast_snr(std::span<const LossField> fields, double range_m, double range_rate_mps,
                         const std::function<double(double depth_m)>& noise_db,
                         const std::function<double(double depth_m)>& gain_db,
                         const SnrOptions& options);

enum class SnrRule : std::uint8_t {
    follow,    ///< it is good here: go to what will be best shortly
    approach,  ///< go to where the best depth will be when it can be reached with the least pitch
    steepest,  ///< it cannot be reached: as steep as allowed towards the least pitch
    none,      ///< nothing is known, or there is no speed to go anywhere
};
/// `follow`, …
std::string_view name(SnrRule rule);

struct SnrDecision {
    SnrRule rule = SnrRule::none;
    std::size_t time = 0;           ///< of the forecast: when the target is to be reached
    std::optional<double> depth_m;  ///< nothing: none
    double pitch_deg = 0;           ///< that takes, positive down, at most the largest in size
    Choice choice;                  ///< at that time
};

/// The rule of the thesis: where the vehicle is about as good as anywhere it follows the best depth; else it makes for the
/// best depth at that time of the forecast for which the least pitch is enough, so that it meets the ridge of utility at a
/// tangent. Of equal pitches the earliest.
/// @param speed_mps  through the water, 0 or more
/// @param others     further objectives, at all times the same
SnrDecision decide(const SnrForecast& forecast, const Limits& limits, const Situation& situation,
                   double speed_mps, const SnrOptions& options,
                   std::span<const Objective> others = {});

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_MAX_SNR_DEPTH_HPP
