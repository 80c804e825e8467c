#ifndef SEAUTILS_POSITION_GRID_HPP
#define SEAUTILS_POSITION_GRID_HPP

#include "seautils/position/cell.hpp"

#include <cstdint>
#include <string_view>

namespace seautils::position {

/// A place in metres from the datum: x east, y north, z up (under water: negative).
struct Place {
    double x_m = 0, y_m = 0, z_m = 0;
};

/// What cells there are: their size, and the operating area, which both ends of a link must agree
/// on. Whole numbers, so that they are the same at both.
struct Grid {
    std::int64_t resolution_mm = 1000;    ///< of x and y: 1 to 1,000,000
    std::int64_t resolution_z_mm = 1000;  ///< 1 to 1,000,000
    /// The lowest and the highest cell of each axis, both of the area.
    Cell min{-cell_limit, -cell_limit, -12'000}, max{cell_limit, cell_limit, 1'000};

    friend bool operator==(const Grid&, const Grid&) = default;
};

/// A grid whose area is all that has cells in x and y, and -12,000 to 1,000 m in z.
/// @throws ConfigError  a resolution outside 1 to 1,000,000 mm
Grid make_grid(std::int64_t resolution_mm, std::int64_t resolution_z_mm);

/// Narrows the area: `x=-5000:5000,y=-2000:8000,z=-6000:10`, metres; what is not named stays. A
/// bound that lies within a cell takes in the whole of that cell.
/// @throws DataError  not of this form, the least above the most, beyond the cells of the grid
void set_area(Grid& grid, std::string_view text);

/// The cell whose middle is nearest; of two that are equally near the one away from 0.
/// @throws DataError  outside the area: names the axis, the value and the bounds in metres; a NaN
Cell cell_of(const Grid& grid, const Place& place);

/// The middle of a cell.
Place place_of(const Grid& grid, const Cell& cell);

bool in_area(const Grid& grid, const Cell& cell);

/// Bits of a full fix: for each axis as many as its number of cells takes. Of the default grid
/// with 1 m: 23 + 23 + 14 = 60.
unsigned full_bits(const Grid& grid);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_GRID_HPP
