#ifndef SEAUTILS_PROPAGATION_EIGENRAYS_HPP
#define SEAUTILS_PROPAGATION_EIGENRAYS_HPP

#include "seautils/propagation/beam_kind.hpp"
#include "seautils/propagation/ray_beam.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace seautils::propagation {

/// A ray where it first comes to a range.
struct Probe {
    double launch_rad = 0;
    bool reached = false;
    double depth_m = 0, sine = 0, cosine = 1, speed_mps = 0;
    BeamState state;

    bool same_history(const Probe& other) const {
        return reached && other.reached && state.surface_bounces == other.state.surface_bounces &&
               state.bottom_bounces == other.state.bottom_bounces;
    }
    /// |dz/dα| at the range.
    double metres_per_rad(double source_speed_mps) const {
        return std::abs(state.q) / (source_speed_mps * std::max(std::abs(cosine), 1e-3));
    }
};

/// Finds the rays that meet given depths at a range: between neighbours of a fan that have the same
/// bounces behind them and no caustic between them depth runs one way. So it does where one of them
/// has just met a level wall, and the other is about to: in the mirror. Other intervals are halved,
/// where a receiver may lie in them.
class EigenraySearch {
public:
    /// @param depth_m  grows
    /// @throws DataError  (all but this) more than `most_search` legs and probes would be needed
    EigenraySearch(const RaySea& sea, const std::vector<double>& depth_m, double least_amplitude);

    /// The ray of an angle at each of some ranges (which grow), without delays.
    std::vector<Probe> trace(double launch_rad, const std::vector<double>& range_m);
    /// Calls found(depth's index, ray) for each ray between two neighbours that meets a depth: launch,
    /// direction, delay and spreading are those there, the rest that of a ray within 2 cm.
    template <class Found>
    void between(const Probe& a, const Probe& b, double range_m, Found&& found) {
        brackets_.clear();
        split(a, b, range_m, most_halvings);
        for (std::size_t k = 0; k < brackets_.size(); ++k) {
            const Bracket bracket = brackets_[k];
            if (const auto ray = refine(bracket, range_m))
                found(bracket.depth, *ray);
            else if (bracket.mirror)
                split_again(bracket, range_m);
        }
    }

private:
    static constexpr int most_halvings = 22;
    static constexpr std::uint64_t most_search = 200'000'000;
    /// Two rays, and a depth between theirs. Behind a mirror rays go on as if the wall were not there.
    struct Bracket {
        Probe a, b;
        std::size_t depth;
        std::optional<double> mirror =
            {};              ///< the depth of a wall; b has met it less or more often
        double depth_m = 0;  ///< it lies there, or in the mirror
    };
    void split(const Probe& a, const Probe& b, double range_m, int halvings);
    void split_again(const Bracket& bracket, double range_m);
    std::optional<double> mirror_between(const Probe& a, const Probe& b) const;
    void add_brackets(const Probe& a, const Probe& b, std::optional<double> mirror);
    bool runs_one_way(const Probe& a, const Probe& b, double least, double most) const;
    bool may_hold_depth(const Probe& a, const Probe& b) const;
    std::optional<Probe> refine(const Bracket& bracket, double range_m);
    double launch_for(const Probe& from, const Probe& to, double depth_m) const;
    Probe probe(double launch_rad, double range_m);
    void count_probe();

    const RaySea& sea_;
    const std::vector<double>& depth_m_;
    double least_amplitude_;
    BeamWalk walk_;
    std::uint64_t probes_ = 0;
    std::vector<Bracket> brackets_;
    std::optional<std::size_t> only_;  ///< depth that is looked for; none: all
    bool mirrors_ = true;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_EIGENRAYS_HPP
