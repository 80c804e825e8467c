#ifndef SEAUTILS_POSITION_MIX_MODEL_HPP
#define SEAUTILS_POSITION_MIX_MODEL_HPP

#include "seautils/position/plan_model.hpp"
#include "seautils/position/predictors.hpp"
#include "seautils/position/value_coder.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace seautils::position {

/// All that is known of one vehicle's ways, and what it makes of the motion so far. A value.
class MixModel {
public:
    static constexpr std::size_t planes = 8, depths = 5;  ///< the last of each is the plan's

    /// @param capacity  situations that each memory keeps
    /// @param plan      waypoints, or none
    MixModel(std::size_t capacity, const std::vector<Cell>& plan);

    /// The vehicle was found here.
    void begin(const Cell& cell) { plan_.begin(cell); }
    /// A number that stands for the plan.
    std::int64_t plan_mark() const { return plan_.mark(); }

    /// What is expected next, from the last known position.
    struct Forecast {
        std::array<PlaneMixture, planes> plane;
        std::array<Mixture, depths> depth;
        std::array<Mixture, planes> along_x, along_y;
        Pair slow, fast;
        std::int32_t slow_z, fast_z;
    };
    void forecast(const Motion& motion, Forecast& f);

    ValueCoder z_coder(const Motion& motion, const Forecast& f);
    ValueCoder x_coder(const Motion& motion, Forecast& f);
    ValueCoder y_coder(const Motion& motion, Forecast& f, std::int32_t step_x);

    /// Finds a step by questions about each axis: z, x, and then y.
    /// @param decide  as ValueCoder::find(), with the axis (0 x, 1 y, 2 z) before
    /// @param learn   whether the mixers learn each answer
    template <class Decide>
    Cell find(const Motion& motion, Forecast& f, Decide decide, bool learn) {
        const auto on = [&](std::size_t axis) {
            return [&decide, axis](std::int32_t yes, std::int32_t least, std::int32_t most) {
                return decide(axis, yes, least, most);
            };
        };
        Cell step;
        step.z = z_coder(motion, f).find(on(2), learn);
        step.x = x_coder(motion, f).find(on(0), learn);
        step.y = y_coder(motion, f, step.x).find(on(1), learn);
        return step;
    }

    /// Before anything is learnt: a step lasts so many times longer than usual, and so may its errors
    /// be as many times larger over the plane; along z, by the root. 1 to 1024
    void widen(std::int64_t times);

    /// @param step  from the last known position, cells
    void learn(const Motion& motion, const Forecast& f, const Cell& step);

    template <class Archive>
    void archive(Archive& a) {
        a.all(slow_, fast_, turn_, path_, innovation_, world_, place_, slow_z_, fast_z_, hold_z_,
              cases_, plan_, plane_mixer_, depth_mixer_);
        for (auto& s : plane_score_) a.number(s, -(1 << 28), 1 << 28);
        for (auto& s : depth_score_) a.number(s, -(1 << 28), 1 << 28);
    }

private:
    static Mixer::Contexts plane_contexts(const Motion& motion);
    static Mixer::Contexts depth_contexts(const Motion& motion);
    std::size_t plane_count() const { return plan_.empty() ? planes - 1 : planes; }
    ValueCoder coder_of(const std::array<Mixture, planes>& models, const Motion& motion);

    FilterModel slow_, fast_;
    TurnModel turn_;
    AnalogModel path_, innovation_, world_, place_;
    DepthModel slow_z_, fast_z_, hold_z_;
    DepthAnalogModel cases_;
    PlanModel plan_;
    Mixer plane_mixer_, depth_mixer_;
    /// How well the filters did of late: sums of log2 of what they expected, Q16.
    std::array<std::int32_t, 2> plane_score_{};
    std::array<std::int32_t, 3> depth_score_{};
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_MIX_MODEL_HPP
