#include "seautils/position/grid.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

namespace seautils::position {

namespace {

/// One axis of a grid.
struct Axis {
    char name;
    double resolution_m;
    std::int32_t& min;
    std::int32_t& max;
};

Axis axis(Grid& grid, char name) {
    const double xy_m = static_cast<double>(grid.resolution_mm) / 1000;
    const double z_m = static_cast<double>(grid.resolution_z_mm) / 1000;
    if (name == 'x') return {name, xy_m, grid.min.x, grid.max.x};
    if (name == 'y') return {name, xy_m, grid.min.y, grid.max.y};
    return {name, z_m, grid.min.z, grid.max.z};
}

double nearest_cell(double value_m, std::int64_t resolution_mm) {
    return std::round(value_m * 1000 / static_cast<double>(resolution_mm));
}

std::int32_t cell_on(char name, double value_m, std::int64_t resolution_mm, std::int32_t min,
                     std::int32_t max) {
    const double cell = nearest_cell(value_m, resolution_mm);
    if (cell >= min && cell <= max) return static_cast<std::int32_t>(cell);
    const double step_m = static_cast<double>(resolution_mm) / 1000;
    throw DataError(fmt::format("{} {} m is outside the area, {} to {} m", name, value_m,
                                min * step_m, max * step_m));
}

std::int64_t checked_resolution(const char* name, std::int64_t mm) {
    if (mm >= 1 && mm <= 1'000'000) return mm;
    throw ConfigError(fmt::format("{} {} mm is outside 1 to 1000000 mm", name, mm));
}

double bound(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value))
        return value;
    throw DataError(fmt::format("{} is no number of metres", quote(text)));
}

std::int32_t bound_cell(const Axis& axis, std::string_view text) {
    const double cell = std::round(bound(text) / axis.resolution_m);
    if (std::fabs(cell) <= cell_limit) return static_cast<std::int32_t>(cell);
    throw DataError(fmt::format("{} is outside {} to {} m", quote(text),
                                -cell_limit * axis.resolution_m, cell_limit * axis.resolution_m));
}

void set_axis(Grid& grid, std::string_view word) {
    const std::size_t colon = word.find(':');
    if (word.size() < 2 || word[1] != '=' || word[0] < 'x' || word[0] > 'z' || colon == word.npos)
        throw DataError(quote(word) + " is not of the form x=-5000:5000");
    const Axis to = axis(grid, word[0]);
    const std::int32_t min = bound_cell(to, word.substr(2, colon - 2));
    const std::int32_t max = bound_cell(to, word.substr(colon + 1));
    if (min > max) throw DataError(quote(word) + ": the least is above the most");
    to.min = min;
    to.max = max;
}

unsigned bits_of(std::int32_t min, std::int32_t max) {
    return static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(max - min)));
}

}  // namespace

Grid make_grid(std::int64_t resolution_mm, std::int64_t resolution_z_mm) {
    Grid grid;
    grid.resolution_mm = checked_resolution("resolution", resolution_mm);
    grid.resolution_z_mm = checked_resolution("resolution of z", resolution_z_mm);
    const auto cells = [&](std::int64_t m) {
        return static_cast<std::int32_t>(
            std::min<std::int64_t>(cell_limit, (m * 1000 + resolution_z_mm - 1) / resolution_z_mm));
    };
    grid.min.z = -cells(12'000);
    grid.max.z = cells(1'000);
    return grid;
}

void set_area(Grid& grid, std::string_view text) {
    Grid narrowed = grid;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        set_axis(narrowed, text.substr(at, end - at));
        at = end + 1;
    }
    grid = narrowed;
}

Cell cell_of(const Grid& grid, const Place& place) {
    const auto [min, max] = std::pair(grid.min, grid.max);
    return {cell_on('x', place.x_m, grid.resolution_mm, min.x, max.x),
            cell_on('y', place.y_m, grid.resolution_mm, min.y, max.y),
            cell_on('z', place.z_m, grid.resolution_z_mm, min.z, max.z)};
}

Place place_of(const Grid& grid, const Cell& cell) {
    const auto metres = [](std::int32_t n, std::int64_t resolution_mm) {
        return static_cast<double>(n * resolution_mm) / 1000;
    };
    return {metres(cell.x, grid.resolution_mm), metres(cell.y, grid.resolution_mm),
            metres(cell.z, grid.resolution_z_mm)};
}

bool in_area(const Grid& grid, const Cell& c) {
    const Cell &min = grid.min, &max = grid.max;
    return c.x >= min.x && c.x <= max.x && c.y >= min.y && c.y <= max.y && c.z >= min.z &&
           c.z <= max.z;
}

unsigned full_bits(const Grid& grid) {
    return bits_of(grid.min.x, grid.max.x) + bits_of(grid.min.y, grid.max.y) +
           bits_of(grid.min.z, grid.max.z);
}

}  // namespace seautils::position
