#ifndef SEAUTILS_POSITION_FIX_WRITER_HPP
#define SEAUTILS_POSITION_FIX_WRITER_HPP

#include "seautils/position/frame.hpp"
#include "seautils/position/grid.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace seautils::position {

/// Writes positions as their sender quantised them: the middles of cells, with the decimals of the
/// resolution; with a datum also latitude and longitude, with decimals for a twentieth of it.
///
/// | form | a position |
/// |------|------------|
/// | csv | `1622104190,-123,84,0`, below a header `t,x,y,z` (`,latitude_deg,longitude_deg`) |
/// | ndjson | `{"time":"2021-05-27T08:29:50Z","x_m":-123,"y_m":84,"z_m":0}` |
/// | delimited | varint length, then seautils.Fix (schemas/seautils/position.proto) |
class FixWriter {
public:
    enum class Form { csv, ndjson, delimited };

    FixWriter(Form form, const Grid& grid, std::optional<Frame> frame);

    /// Appends the header of a table; of other forms nothing.
    void header(std::string& out) const;
    /// @param time_ms  UTC since 1970, not negative
    void write(std::int64_t time_ms, const Cell& cell, std::string& out) const;

private:
    std::string decimal(std::int32_t cell, std::int64_t resolution_mm) const;
    void text(std::int64_t time_ms, const Cell& cell, std::string& out) const;
    void binary(std::int64_t time_ms, const Cell& cell, std::string& out) const;
    Geographic geographic(const Cell& cell) const;

    Form form_;
    Grid grid_;
    std::optional<Frame> frame_;
    int decimals_ = 0;  ///< of latitude and longitude
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_FIX_WRITER_HPP
