#ifndef SEAUTILS_POSITION_FIX_READER_HPP
#define SEAUTILS_POSITION_FIX_READER_HPP

#include "seautils/position/frame.hpp"
#include "seautils/position/sampling.hpp"

#include <memory>
#include <string_view>

namespace seautils::position {

/// Reads fixes as navigation logs hold them: rows of a CSV table, or JSON objects, a line each.
///
/// | what | names of the column or key | |
/// |------|----------------------------|-|
/// | time | `t` `time` `time_s` | seconds, or `2024-05-01T12:00:25Z` |
/// | place | `x` `x_m`, `y` `y_m` | metres east and north of the datum |
/// | or | `latitude_deg` `lat_deg` `latitude` `lat`, `longitude_deg` `lon_deg` `longitude` `lon` | degrees, WGS84 |
/// | height | `z` `z_m` | metres, up |
/// | or | `depth_m` `depth` | metres, down |
///
/// Other columns and keys are passed over. Where a fix has both, x and y count more than latitude
/// and longitude, z more than depth. CSV: RFC 4180 without line ends in cells; a line that names a
/// column of time (of waypoints, of x or latitude) is a header, wherever it stands, and must be there before the first row. An empty
/// cell and JSON's null say nothing.
class FixReader {
public:
    enum class Form {
        detect,  ///< a line that begins with `{` is JSON, any other CSV
        csv,
        ndjson,
    };
    struct Options {
        Form form = Form::detect;
        /// For latitude and longitude. Without one they are refused, unless first_is_datum.
        std::optional<Frame> frame;
        bool first_is_datum = false;  ///< the first fix makes a local frame
        bool is_timeless = false;     ///< waypoints: what says a time is passed over
        bool on_surface = false;      ///< fixes without height are at 0, else refused
    };

    explicit FixReader(Options options);
    ~FixReader();
    FixReader(FixReader&&) noexcept;
    FixReader& operator=(FixReader&&) noexcept;

    /// @param line  without its line end
    /// @return      nothing: a header
    /// @throws DataError  no fix, and why
    std::optional<RawFix> read(std::string_view line);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_FIX_READER_HPP
