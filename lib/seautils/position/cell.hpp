#ifndef SEAUTILS_POSITION_CELL_HPP
#define SEAUTILS_POSITION_CELL_HPP

#include <cstdint>

namespace seautils::position {

/// A position as it is sent: whole numbers of the resolution from the origin of the grid, along
/// each axis. x east, y north, z up (under water: negative).
struct Cell {
    std::int32_t x = 0, y = 0, z = 0;

    friend bool operator==(const Cell&, const Cell&) = default;
};

/// All three are within -cell_limit to cell_limit: with 1 m, 4194 km.
inline constexpr std::int32_t cell_limit = (1 << 22) - 1;

inline bool in_limits(const Cell& c) {
    const auto fits = [](std::int32_t v) { return v >= -cell_limit && v <= cell_limit; };
    return fits(c.x) && fits(c.y) && fits(c.z);
}

/// Where one is on the straight way from a to b after `part` of `whole`, rounded; 0 <= part <= whole.
inline Cell on_the_way(const Cell& a, const Cell& b, std::int64_t part, std::int64_t whole) {
    const auto axis = [&](std::int32_t from, std::int32_t to) {
        const std::int64_t way = (std::int64_t{to} - from) * part;
        return static_cast<std::int32_t>(from + (way + (way < 0 ? -whole : whole) / 2) / whole);
    };
    return {axis(a.x, b.x), axis(a.y, b.y), axis(a.z, b.z)};
}

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_CELL_HPP
