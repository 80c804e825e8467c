#ifndef SEAUTILS_POSITION_MOTION_HPP
#define SEAUTILS_POSITION_MOTION_HPP

#include "seautils/position/cell.hpp"
#include "seautils/position/integer_math.hpp"
#include "seautils/position/track_filter.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace seautils::position {

/// What all predictors look at: where the vehicle was, is, and seems to be going. Follows from the
/// positions since the last full fix alone.
struct Motion {
    /// Gains of the filters, which are the same for all vehicles.
    struct Gains {
        FilterGains slow_xy, fast_xy, slow_z, fast_z;
        Gains();
    };

    /// A filter over the plane or along z, and for how many steps it has been running.
    struct PlaneFilter {
        AxisFilter x, y;
        std::uint32_t run = 0;
    };
    struct DepthFilter {
        AxisFilter z;
        std::uint32_t run = 0;
    };

    Cell last;
    std::uint32_t known = 0;             ///< steps since the full fix, at most 1000
    std::array<Pair, 3> moved{};         ///< the last steps over the plane, cells; the latest first
    std::array<std::int32_t, 3> sunk{};  ///< the last changes of z, cells
    PlaneFilter slow, fast;
    DepthFilter slow_z, fast_z;
    Direction heading;                 ///< of the fast filter
    std::array<Pair, 2> innovation{};  ///< of the fast filter along and across, 1/256 cell
    std::int32_t innovation_z = 0;     ///< of the fast filter, 1/256 cell
    std::uint32_t turn_class = 0;      ///< of the last step: below 5, 15, 40 degrees, more
    std::int32_t turn_sign = 1;        ///< of the last turn: 1 to the left, -1 to the right
    std::uint32_t since_turn = 1000;   ///< steps, at most 1000
    std::uint32_t since_dive = 1000;   ///< steps since the fast filter of z began anew

    void restart(const Cell& cell);
    void step(const Cell& cell);

    /// Class of the last step's turn, and steps since one: below 3, 8, more; 0 to 11.
    std::size_t turn_context() const {
        return turn_class * 3 + (since_turn < 3 ? 0 : since_turn < 8 ? 1 : 2);
    }

    /// What the filters expect next, from `last`, 1/256 cell.
    Pair expected(const PlaneFilter& filter) const;
    std::int32_t expected(const DepthFilter& filter) const;

    template <class Archive>
    void archive(Archive& a) {
        constexpr std::int64_t far = 1 << 23, deep = std::int64_t{1} << 44;
        for (auto* v : {&last.x, &last.y, &last.z}) a.number(*v, -far, far);
        for (auto& m : moved) {
            a.number(m.x, -far, far);
            a.number(m.y, -far, far);
        }
        for (auto& s : sunk) a.number(s, -far, far);
        for (auto* f : {&slow.x, &slow.y, &fast.x, &fast.y, &slow_z.z, &fast_z.z}) {
            a.number(f->position, -deep, deep);
            a.number(f->velocity, -deep, deep);
        }
        for (auto* n :
             {&known, &slow.run, &fast.run, &slow_z.run, &fast_z.run, &since_turn, &since_dive})
            a.number(*n, 0, 1000);
        a.number(heading.x, -(1 << 14), 1 << 14);
        a.number(heading.y, -(1 << 14), 1 << 14);
        for (auto& i : innovation) {
            a.number(i.x, -(1 << 26), 1 << 26);
            a.number(i.y, -(1 << 26), 1 << 26);
        }
        a.number(innovation_z, -(1 << 26), 1 << 26);
        a.number(turn_class, 0, 3);
        a.number(turn_sign, -1, 1);
    }

private:
    void step_plane(const Cell& cell);
    void step_depth(const Cell& cell);
    void look_at_turn(Pair step);
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_MOTION_HPP
