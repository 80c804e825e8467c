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
    double amplitude = 1;  ///< left by the walls
    double fade = 1;       ///< of intensity, by the water
};

/// What it needs of a leg: a third of it.
struct EnergyLeg {
    double along_m = 0, spread = 0, kick = 0;
    float length_m = 0, magnitude = 1, fade = 1;
    float length_per_m = 0, spread_per_m = 0;  ///< over range
    float depth_m = 0, cosine = 1, sine = 0, curvature = 0;
    float speed_mps = 0, range_gradient = 0, depth_gradient = 0;
};

inline void pass(const EnergyLeg& leg, EnergyState& state) {
    state.q += state.p * leg.spread;
    state.p += leg.kick * state.q;
    state.range_m += leg.along_m;
    state.length_m += double{leg.length_m};
    state.amplitude *= double{leg.magnitude};
    state.fade *= double{leg.fade};
}

/// What legs of a ray, one after another, come to: sums and products, and what becomes of q and p.
struct EnergyCycle {
    double range_m = 0, length_m = 0, amplitude = 1, fade = 1;
    double qq = 1, qp = 0, pq = 0, pp = 1;  ///< q' = qq·q + qp·p, p' = pq·q + pp·p

    /// The state behind it.
    EnergyState after(const EnergyState& start) const;
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
    bool whole = false;               ///< legs are a cycle
    std::vector<EnergyLeg> legs;      ///< of a periodic sea, from the source on
    EnergyCycle cycle;                ///< all of them
    std::vector<EnergyCycle> so_far;  ///< those before each eighth leg
    std::vector<Mark> marks;          ///< else, one in every mark_every_m

    /// What it holds, in legs.
    std::size_t size() const { return legs.size() + so_far.size() + 3 * marks.size(); }
    void clear() { *this = {}; }
    /// The same, but the room is kept.
    void forget();
    KeptRay() = default;
    KeptRay(KeptRay&&) = default;
    KeptRay& operator=(KeptRay&& other) noexcept;
};

/// Legs of one ray after another, for intensities. Where the sea is periodic, a ray comes to the
/// cycle in which the first range lies at once, else to the last mark before it: what is met from
/// there on does not hang on what was known of the ray.
class EnergyWalk {
public:
    /// @param legs          after which a ray ends
    /// @param mark_every_m  0: no marks
    EnergyWalk(const RaySea& sea, std::uint64_t legs, double mark_every_m)
        : sea_(sea), legs_of_ray_(legs), mark_every_m_(mark_every_m) {}

    /// Rays that ended for the number of their legs.
    std::uint64_t cut() const { return cut_; }

    /// Calls visit(leg, state) for legs from before `first_m` up to `stop_m` in range, with the
    /// state at their beginning. The ray ends there, or when its amplitude is below
    /// `least_amplitude`.
    /// @param ray  of this angle and sea; or empty
    template <class Visit>
    void run(KeptRay& ray, double launch_rad, double first_m, double stop_m, double least_amplitude,
             const Visit& visit) {
        if (!ray.tracer) begin(ray, launch_rad);
        Way way{ray.start, legs_of_ray_};
        first_m_ = first_m;
        stop_m_ = stop_m;
        least_amplitude_ = least_amplitude;
        if (sea_.periodic)
            run_cycles(ray, way, visit);
        else
            run_along(ray, way, visit);
    }

private:
    static constexpr std::size_t stride = 8;
    struct Way {
        EnergyState state;
        std::uint64_t left;
        EnergyState at_cycle{};  ///< state where the cycle began
        std::size_t leg = 0;     ///< of the cycle
    };

    void begin(KeptRay& ray, double launch_rad) const;
    bool next(RayTracer& tracer, EnergyLeg& out) const;
    bool extend(KeptRay& ray) const;
    bool jump(const KeptRay& ray, Way& way);
    void skip(const KeptRay& ray, Way& way) const;
    bool ends(const Way& way);
    void mark(KeptRay& ray, const RayTracer& tracer, const Way& way) const;

    template <class Visit>
    void run_cycles(KeptRay& ray, Way& way, const Visit& visit) {
        way.at_cycle = way.state;
        if (!jump(ray, way)) return;
        for (;;) {
            const bool is_new = way.leg == ray.legs.size();
            if (is_new && !extend(ray)) return;
            const EnergyLeg& leg = ray.legs[way.leg++];
            visit(leg, std::as_const(way.state));
            pass(leg, way.state);
            // as skip() would have it, to the bit
            if (way.leg % stride == 0)
                way.state = ray.so_far[way.leg / stride - 1].after(way.at_cycle);
            --way.left;
            if (ends(way)) return;
            if (!ray.whole || way.leg < ray.legs.size()) continue;
            way.at_cycle = way.state;
            way.leg = 0;
            if (is_new && !jump(ray, way)) return;
        }
    }

    template <class Visit>
    void run_along(KeptRay& ray, Way& way, const Visit& visit) {
        std::size_t known = ray.marks.size();
        while (known > 0 && ray.marks[known - 1].state.range_m >= first_m_) --known;
        RayTracer tracer = known > 0 ? ray.marks[known - 1].tracer : *ray.tracer;
        if (known > 0) way = {ray.marks[known - 1].state, ray.marks[known - 1].left};
        if (way.state.amplitude < least_amplitude_) return;
        for (EnergyLeg leg; next(tracer, leg); mark(ray, tracer, way)) {
            visit(leg, std::as_const(way.state));
            pass(leg, way.state);
            --way.left;
            if (ends(way)) return;
        }
    }

    const RaySea& sea_;
    std::uint64_t legs_of_ray_, cut_ = 0;
    double mark_every_m_, first_m_ = 0, stop_m_ = 0, least_amplitude_ = 0;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAY_ENERGY_HPP
