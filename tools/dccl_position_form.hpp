// What a schema says of a field with the codec seautils.position.
#ifndef SEAUTILS_TOOLS_DCCL_POSITION_FORM_HPP
#define SEAUTILS_TOOLS_DCCL_POSITION_FORM_HPP

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/dccl/options.hpp"
#include "seautils/position/field.hpp"
#include "seautils/position/grid.hpp"
#include "seautils/position/hash.hpp"
#include "seautils/schema/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace seautils::tools {

/// Both ends must have it alike; the check of the packets sees to that.
struct PositionForm {
    std::uint32_t time = 0, x = 0, y = 0, z = 0;  ///< the sub-message's fields: indices
    bool is_depth = false;                        ///< z is depth_m, positive down
    position::Grid grid;
    position::LinkOptions link;
    position::CodecOptions codec;
    std::size_t max_bytes = 0;  ///< of a packet

    /// @throws ConfigError  what the field lacks, or has too much
    PositionForm(const schema::Field& field, const dccl::FieldOptions& options,
                 unsigned check_bits);

    /// @throws DataError  a member is not set, or outside of its bounds
    position::Fix fix(const schema::Values& values, const schema::Slot& slot) const;
    void put(const position::Fix& fix, schema::Values& values, std::uint32_t slot,
             const schema::Layout& layout) const;

private:
    struct Axis {
        std::uint32_t index = 0;
        std::int64_t resolution_mm = 0;
        std::int32_t min = 0, max = 0;  ///< cells
    };
    static std::uint32_t number(const schema::Layout& layout, const std::string& name);
    static Axis axis(const schema::Layout& layout, const std::string& name);
    static std::int64_t milli(double value, double least, double most, const std::string& what);
};

/// Index of the member of that name. @throws ConfigError  there is none, or it is no double
inline std::uint32_t PositionForm::number(const schema::Layout& layout, const std::string& name) {
    const std::int32_t at = layout.find(name);
    if (at < 0) throw ConfigError("message " + layout.full_name + " has no field " + name);
    const auto index = static_cast<std::uint32_t>(at);
    const schema::Field& field = layout.fields[index];
    if (field.kind != schema::Kind::float64 || field.repeated)
        throw ConfigError(name + " is no single double");
    return index;
}

/// In thousandths. @throws ConfigError  beyond the bounds, or no whole number of them
inline std::int64_t PositionForm::milli(double value, double least, double most,
                                        const std::string& what) {
    if (!(value >= least && value <= most))
        throw ConfigError(fmt::format("{} {} is outside {} to {}", what, value, least, most));
    const std::int64_t whole = std::llround(value * 1000);
    if (std::fabs(value * 1000 - static_cast<double>(whole)) > 1e-6)
        throw ConfigError(fmt::format("{} {} is no multiple of 0.001", what, value));
    return whole;
}

inline PositionForm::Axis PositionForm::axis(const schema::Layout& layout,
                                             const std::string& name) {
    Axis axis;
    axis.index = number(layout, name);
    const auto options = dccl::field_options(*layout.fields[axis.index].descriptor);
    if (!options.min || !options.max) throw ConfigError(name + " has no option min or max");
    if (options.precision && options.resolution)
        throw ConfigError("options precision and resolution of " + name + " exclude each other");
    const double step =
        options.precision ? std::pow(10, -*options.precision) : options.resolution.value_or(1);
    axis.resolution_mm = milli(step, 0.001, 1000, "resolution of " + name);
    const auto cell = [&](double bound, const std::string& what) {
        const std::int64_t mm = milli(bound, -4e9, 4e9, what + " of " + name);
        const std::int64_t cells = mm / axis.resolution_mm;
        if (cells * axis.resolution_mm != mm)
            throw ConfigError(
                fmt::format("{} {} of {} is no multiple of its resolution", what, bound, name));
        if (std::abs(cells) > position::cell_limit)
            throw ConfigError(fmt::format("{} {} of {} is more than {} steps from 0", what, bound,
                                          name, position::cell_limit));
        return static_cast<std::int32_t>(cells);
    };
    axis.min = cell(*options.min, "min");
    axis.max = cell(*options.max, "max");
    if (axis.min > axis.max) throw ConfigError("min of " + name + " is above its max");
    return axis;
}

inline PositionForm::PositionForm(const schema::Field& field, const dccl::FieldOptions& options,
                                  unsigned check_bits) {
    if (field.kind != schema::Kind::message)
        throw ConfigError("is for a message of time_s, x_m, y_m, and z_m or depth_m");
    if (field.repeated || field.required)
        throw ConfigError("is for optional fields: a position may be absent");
    const schema::Layout& layout = *field.message;
    is_depth = layout.find("z_m") < 0;
    const Axis ax = axis(layout, "x_m");
    const Axis ay = axis(layout, "y_m");
    Axis az = axis(layout, is_depth ? "depth_m" : "z_m");
    if (layout.fields.size() != 4)
        throw ConfigError("message " + layout.full_name + " has more fields than a position");
    if (ax.resolution_mm != ay.resolution_mm)
        throw ConfigError("x_m and y_m differ in their resolution");
    if (is_depth) az = {az.index, az.resolution_mm, -az.max, -az.min};
    time = number(layout, "time_s");
    x = ax.index, y = ay.index, z = az.index;
    grid = {ax.resolution_mm, az.resolution_mm, {ax.min, ay.min, az.min}, {ax.max, ay.max, az.max}};
    const auto interval = dccl::field_options(*layout.fields[time].descriptor).resolution;
    if (!interval) throw ConfigError("time_s has no option resolution, the interval of positions");
    codec.interval_ms = milli(*interval, 0.001, 86'400, "resolution of time_s");
    codec.resolution_mm = grid.resolution_mm;
    link.interval_ms = codec.interval_ms;
    link.least = grid.min;
    link.most = grid.max;
    link.check_bits = check_bits;
    link.agreed =
        position::hash(fmt::format("field {} {}", grid.resolution_mm, grid.resolution_z_mm), 0);
    const std::size_t least = position::least_bytes(link);
    max_bytes = options.max_length.value_or(static_cast<std::uint32_t>(least));
    if (max_bytes < least || max_bytes > 1024)
        throw ConfigError(fmt::format(
            "max_length {} is outside {}, which a full fix takes, to 1024", max_bytes, least));
}

inline position::Fix PositionForm::fix(const schema::Values& values,
                                       const schema::Slot& slot) const {
    const auto block = static_cast<std::uint32_t>(slot.u);
    const auto member = [&](std::uint32_t index, const char* name) {
        const schema::Slot& value = values[block + index];
        if (!value.present) throw DataError(std::string(name) + " is not set");
        return value.d;
    };
    const double seconds = member(time, "time_s");
    if (!(seconds >= 0 && seconds <= static_cast<double>(position::most_time_ms / 1000)))
        throw DataError(fmt::format("time_s {} is outside the years 1970 to 2248", seconds));
    const double up = member(z, is_depth ? "depth_m" : "z_m");
    const position::Place place{member(x, "x_m"), member(y, "y_m"), is_depth ? -up : up};
    return {std::llround(seconds * 1000), position::cell_of(grid, place)};
}

inline void PositionForm::put(const position::Fix& fix, schema::Values& values, std::uint32_t slot,
                              const schema::Layout& layout) const {
    const std::uint32_t block = values.add_block(slot, layout);
    const position::Place place = position::place_of(grid, fix.cell);
    const auto set = [&](std::uint32_t index, double value) {
        values[block + index].d = value + 0.0;  // no -0
        values[block + index].present = true;
    };
    set(time, static_cast<double>(fix.time_ms) / 1000);
    set(x, place.x_m);
    set(y, place.y_m);
    set(z, is_depth ? -place.z_m : place.z_m);
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DCCL_POSITION_FORM_HPP
