#ifndef SEAUTILS_POSITION_PLAN_MODEL_HPP
#define SEAUTILS_POSITION_PLAN_MODEL_HPP

#include "seautils/position/mixture.hpp"
#include "seautils/position/motion.hpp"
#include "seautils/position/predictors.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seautils::position {

/// Where a vehicle goes next whose waypoints both ends know: on towards its waypoint or already towards
/// the one after, at its usual speed; to their depths at its usual rate. It takes the vehicle to be on
/// the next leg when that explains a step better.
class PlanModel {
public:
    static constexpr std::size_t most_waypoints = 65'535;

    /// @param waypoints  in order, at most most_waypoints; none: there is no plan
    explicit PlanModel(std::vector<Cell> waypoints) : waypoints_(std::move(waypoints)) {}
    std::int64_t mark() const;  ///< a number that stands for the waypoints
    bool empty() const { return waypoints_.empty(); }

    /// The vehicle is found here: on the nearest leg, that it was on or a later one.
    void begin(const Cell& cell);
    /// Both empty without a plan, and beyond its last waypoint.
    PlaneMixture predict(const Motion& motion) const;
    Mixture predict_depth(const Motion& motion) const;
    void learn(const Motion& motion, const PlaneMixture& said, const Mixture& said_depth,
               const Cell& step);

    template <class Archive>
    void archive(Archive& a) {
        a.count(next_, waypoints_.size());
        a.number(lost_, 0, 8);
        a.number(speed_, 0, most_mean);
        a.number(rate_, 0, most_mean);
        a.all(along_, across_, depth_error_, legs_, shares_, depth_legs_, depth_shares_);
    }

private:
    /// Finds the leg anew, of all: the vehicle is on none that was thought of.
    void look_around(const Motion& motion);
    /// The step towards a waypoint, 1/256 cell.
    Pair towards(const Motion& motion, std::size_t waypoint) const;
    std::int32_t depth_towards(const Motion& motion, std::size_t waypoint) const;
    bool has(std::size_t waypoint) const { return waypoint < waypoints_.size(); }
    void learn_plane(const Motion& motion, const PlaneMixture& said, const Cell& step);
    void learn_depth(const Motion& motion, const Mixture& said, std::int32_t step);

    std::vector<Cell> waypoints_;
    std::size_t next_ = 0;           ///< the waypoint that the vehicle is going to
    std::uint32_t lost_ = 0;         ///< steps in a row that no leg explained
    std::int32_t speed_ = 10 * 256;  ///< usual step, 1/256 cell
    std::int32_t rate_ = 256;        ///< usual step of z where it changes
    MeanSquare along_, across_, depth_error_;
    Shares<2> legs_, depth_legs_;
    Shares<9> shares_;
    Shares<4> depth_shares_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_PLAN_MODEL_HPP
