#include "seautils/position/motion.hpp"

#include <algorithm>

namespace seautils::position {

namespace {

constexpr std::uint32_t long_ago = 1000;
constexpr std::uint32_t least_speed = 64;  // 1/4 cell a step has a direction

const Motion::Gains gains;

std::size_t index_of(std::uint32_t run) {
    return std::min<std::size_t>(run, FilterGains::steps - 1);
}

void count(std::uint32_t& n) { n = std::min(n + 1, long_ago); }

/// Whether the square of an innovation is beyond so many times what is to be expected and a margin.
bool surprising(std::int64_t square_q16, std::int64_t expected_q16, std::int64_t sigmas_q8) {
    constexpr std::int64_t margin_q16 = 26214;  // 0.4 cell²
    return square_q16 > (sigmas_q8 * sigmas_q8 * (expected_q16 + margin_q16) >> 16);
}

/// Q16 to 1/256 cell, within what a mean may be.
std::int32_t to_q8(std::int64_t q16) {
    return static_cast<std::int32_t>(clamp(q16 >> 8, -(1 << 28), 1 << 28));
}

}  // namespace

Motion::Gains::Gains()  // Q16: 0.02, 0.12, 2; 0.2, 0.12, 2; 0.01, 0.1, 1; 0.1, 0.1, 1
    : slow_xy(1310, 7864, 131072),
      fast_xy(13107, 7864, 131072),
      slow_z(655, 6553, 65536),
      fast_z(6553, 6553, 65536) {}

void Motion::restart(const Cell& cell) {
    const Direction kept = heading;
    *this = Motion();
    last = cell;
    heading = kept;
}

void Motion::step(const Cell& cell) {
    step_plane(cell);
    step_depth(cell);
    last = cell;
    count(known);
}

Pair Motion::expected(const PlaneFilter& filter) const {
    if (known == 0) return {};
    const auto ahead = [](const AxisFilter& f, std::int32_t from) {
        return to_q8(f.position + f.velocity - std::int64_t{from} * 65536);
    };
    return {ahead(filter.x, last.x), ahead(filter.y, last.y)};
}

std::int32_t Motion::expected(const DepthFilter& filter) const {
    if (known == 0) return 0;
    return to_q8(filter.z.position + filter.z.velocity - std::int64_t{last.z} * 65536);
}

void Motion::look_at_turn(Pair step) {
    const Pair frame = into_frame({step.x * 16, step.y * 16}, heading);
    const std::int64_t across = frame.y < 0 ? -std::int64_t{frame.y} : frame.y;
    const auto within = [&](std::int64_t tangent_q16) {
        return frame.x > 0 && across * 65536 < tangent_q16 * frame.x;
    };
    turn_class = within(5734) ? 0 : within(17560) ? 1 : within(54991) ? 2 : 3;
    count(since_turn);
    if (turn_class < 2 || length(step) < 2) return;
    turn_sign = frame.y < 0 ? -1 : 1;
    since_turn = 0;
}

void Motion::step_plane(const Cell& cell) {
    const Pair step{cell.x - last.x, cell.y - last.y};
    if (known > 0) look_at_turn(step);
    moved = {step, moved[0], moved[1]};
    innovation[1] = innovation[0];
    innovation[0] = {};
    const auto begin = [&](PlaneFilter& f) {
        f.x.start(cell.x, step.x);
        f.y.start(cell.y, step.y);
        f.run = 0;
    };
    if (known == 0) {
        begin(slow);
        begin(fast);
    } else {
        for (PlaneFilter* f : {&slow, &fast}) {
            const FilterGains& g = f == &slow ? gains.slow_xy : gains.fast_xy;
            f->x.predict();
            f->y.predict();
            const std::int64_t ex = f->x.innovation(cell.x), ey = f->y.innovation(cell.y);
            const std::size_t run = index_of(f->run);
            const auto q8 = [](std::int64_t e) { return clamp(e >> 8, -(1 << 24), 1 << 24); };
            if (f == &fast)
                innovation[0] = into_frame(
                    {static_cast<std::int32_t>(q8(ex)), static_cast<std::int32_t>(q8(ey))},
                    heading);
            const std::int64_t square = q8(ex) * q8(ex) + q8(ey) * q8(ey);
            if (f == &fast && f->run >= 1 && surprising(square, g.innovation[run], 896)) {
                begin(*f);
                continue;
            }
            f->x.correct(ex, g, run);
            f->y.correct(ey, g, run);
            count(f->run);
        }
    }
    const Pair velocity{to_q8(fast.x.velocity), to_q8(fast.y.velocity)};
    heading = direction_of(velocity, least_speed, heading);
}

void Motion::step_depth(const Cell& cell) {
    const std::int32_t step = cell.z - last.z;
    sunk = {step, sunk[0], sunk[1]};
    count(since_dive);
    innovation_z = 0;
    if (known == 0) {
        for (DepthFilter* f : {&slow_z, &fast_z}) {
            f->z.start(cell.z, step);
            f->run = 0;
        }
        return;
    }
    for (DepthFilter* f : {&slow_z, &fast_z}) {
        const FilterGains& g = f == &slow_z ? gains.slow_z : gains.fast_z;
        f->z.predict();
        const std::int64_t e = f->z.innovation(cell.z);
        const std::size_t run = index_of(f->run);
        const std::int64_t e8 = clamp(e >> 8, -(1 << 24), 1 << 24);
        if (f == &fast_z) {
            innovation_z = static_cast<std::int32_t>(e8);
            if (f->run >= 1 && surprising(e8 * e8, g.innovation[run], 768)) {
                f->z.start(cell.z, step);
                f->run = 0;
                since_dive = 0;
                continue;
            }
        }
        f->z.correct(e, g, run);
        count(f->run);
    }
}

}  // namespace seautils::position
