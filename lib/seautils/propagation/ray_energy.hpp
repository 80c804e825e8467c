#ifndef SEAUTILS_PROPAGATION_RAY_ENERGY_HPP
#define SEAUTILS_PROPAGATION_RAY_ENERGY_HPP

#include "seautils/propagation/ray_beam.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace seautils::propagation {

/// What an intensity needs of what a ray has gathered.
struct EnergyState {
    double range_m = 0, length_m = 0, p = 1, q = 0;
    double amplitude = 1;  ///< left by the walls, not by the water
};

/// What it needs of a leg's arc, wherever on it a column is met; distances are over range.
struct EnergyArc {
    float length_per_m = 0, spread_per_m = 0;
    float depth_m = 0, cosine = 1, sine = 0, curvature = 0;
    float speed_mps = 0, range_gradient = 0, depth_gradient = 0;
};

/// … and of all of it: a third of a leg.
struct EnergyLeg {
    double along_m = 0, spread = 0, kick = 0;
    float length_m = 0, magnitude = 1;
    EnergyArc arc;
};

inline void pass(const EnergyLeg& leg, EnergyState& state) {
    state.q += state.p * leg.spread;
    state.p += leg.kick * state.q;
    state.range_m += leg.along_m;
    state.length_m += double{leg.length_m};
    state.amplitude *= double{leg.magnitude};
}

/// What legs of a ray, one after another, come to: sums and products, and what becomes of q and p.
struct EnergyCycle {
    double range_m = 0, length_m = 0, amplitude = 1;
    double qq = 1, qp = 0, pq = 0, pp = 1;  ///< q' = qq·q + qp·p, p' = pq·q + pp·p

    /// The state behind it.
    EnergyState after(const EnergyState& start) const {
        return {.range_m = start.range_m + range_m,
                .length_m = start.length_m + length_m,
                .p = pq * start.q + pp * start.p,
                .q = qq * start.q + qp * start.p,
                .amplitude = start.amplitude * amplitude};
    }
    /// One leg more.
    void append(const EnergyLeg& leg);
    /// This one, then another.
    EnergyCycle then(const EnergyCycle& next) const;
    /// So many of them, one after another.
    EnergyCycle times(std::uint64_t n) const;
};

/// What is known of the ray of one angle in one sea, traced as far as it was wanted.
struct KeptRay {
    /// A ray on its way, farther out than it was at any time before.
    struct Mark {
        RayTracer tracer;
        EnergyState state;
        std::uint64_t left;  ///< legs
    };

    std::optional<RayTracer> tracer;  ///< behind the last of the legs
    EnergyState start;
    bool whole = false;               ///< arcs are a cycle
    std::vector<EnergyArc> arcs;      ///< of a periodic sea's legs, from the source on
    std::vector<EnergyCycle> so_far;  ///< the legs up to each, it included
    std::vector<double> end_m;        ///< ranges of those, close together
    std::vector<Mark> marks;          ///< else, one in every mark_every_m

    /// What it holds, in legs.
    std::size_t size() const { return arcs.size() + 3 * marks.size(); }
    void clear() { *this = {}; }
    /// The same, but the room is kept.
    void forget();
    KeptRay() = default;
    KeptRay(KeptRay&&) = default;
    KeptRay& operator=(KeptRay&& other) noexcept;
};

/// One ray after another, for intensities. Where the sea is periodic, a ray comes to the cycle in
/// which the first range lies at once, else to the last mark before it: what is met from there on
/// does not hang on what was known of the ray.
class EnergyWalk {
public:
    /// @param legs             after which a ray ends, and
    /// @param least_amplitude  below which it does
    /// @param mark_every_m     0: no marks
    EnergyWalk(const RaySea& sea, std::uint64_t legs, double least_amplitude, double mark_every_m)
        : sea_(sea),
          legs_of_ray_(legs),
          least_amplitude_(least_amplitude),
          mark_every_m_(mark_every_m) {}

    /// Rays that ended for the number of their legs.
    std::uint64_t cut() const { return cut_; }

    /// Calls meet(arc, state where it begins, k) for each k and leg on which the ray is at
    /// range_m[k].
    /// @param ray      of this angle and sea; or empty
    /// @param range_m  grows; 1 at least
    template <class Meet>
    void run(KeptRay& ray, double launch_rad, const std::vector<double>& range_m,
             const Meet& meet) {
        if (!ray.tracer) begin(ray, launch_rad);
        if (sea_.periodic)
            run_cycles(ray, range_m, meet);
        else
            run_along(ray, range_m, meet);
    }

private:
    /// On the way, in cycles.
    struct Place {
        EnergyState at;      ///< where this cycle began
        std::uint64_t left;  ///< legs, from there
        std::uint64_t cycle = 0;
        std::size_t leg = 0;
    };

    void begin(KeptRay& ray, double launch_rad) const;
    bool next(RayTracer& tracer, EnergyLeg& out) const;
    bool extend(KeptRay& ray) const;
    Place cycle_of(const KeptRay& ray, double range_m, std::uint64_t least) const;
    bool go_to(KeptRay& ray, double range_m, Place& place);
    void mark(KeptRay& ray, const RayTracer& tracer, const EnergyState& state,
              std::uint64_t left) const;

    template <class Meet>
    void run_cycles(KeptRay& ray, const std::vector<double>& range_m, const Meet& meet) {
        Place place = cycle_of(ray, range_m[0], 0);
        for (std::size_t k = 0; k < range_m.size() && go_to(ray, range_m[k], place); ++k) {
            const std::size_t leg = place.leg;
            meet(ray.arcs[leg], leg == 0 ? place.at : ray.so_far[leg - 1].after(place.at), k);
        }
    }

    template <class Meet>
    void run_along(KeptRay& ray, const std::vector<double>& range_m, const Meet& meet) {
        std::size_t known = ray.marks.size();
        while (known > 0 && ray.marks[known - 1].state.range_m >= range_m[0]) --known;
        RayTracer tracer = known > 0 ? ray.marks[known - 1].tracer : *ray.tracer;
        EnergyState state = known > 0 ? ray.marks[known - 1].state : ray.start;
        std::uint64_t left = known > 0 ? ray.marks[known - 1].left : legs_of_ray_;
        std::size_t k = 0;
        if (state.amplitude < least_amplitude_) return;
        for (EnergyLeg leg; next(tracer, leg); mark(ray, tracer, state, left)) {
            const double end_m = state.range_m + leg.along_m;
            for (; k < range_m.size() && range_m[k] <= end_m; ++k)
                meet(leg.arc, std::as_const(state), k);
            for (; k > 0 && range_m[k - 1] > end_m; --k) meet(leg.arc, std::as_const(state), k - 1);
            pass(leg, state);
            if (--left == 0) ++cut_;
            if (left == 0 || state.amplitude < least_amplitude_ || end_m >= range_m.back()) return;
        }
    }

    const RaySea& sea_;
    std::uint64_t legs_of_ray_, cut_ = 0;
    double least_amplitude_, mark_every_m_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_ENERGY_HPP
