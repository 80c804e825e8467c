#ifndef SEAUTILS_ACOUSTICS_CNV_HPP
#define SEAUTILS_ACOUSTICS_CNV_HPP

#include "seautils/acoustics/columns.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace seautils::acoustics {

/// Reads a Sea-Bird `.cnv` file, line by line: the header names the columns (`# name 2 = prDM: …`), says what
/// stands for a bad value, and mostly where and when the cast was; behind `*END*` a line is a scan. Only
/// the first sensor of each kind is used. A header may come again, with another cast's scans.
///
/// Source: Sea-Bird Scientific, SBE Data Processing, software manual, "Converted data file (.cnv) format".
class Cnv {
public:
    /// Reads one line, without its line end. @return whether it was a scan: `reading` has it
    /// @throws DataError  a scan that cannot be read, or stands behind no header or no `*END*`; there: binary data,
    ///                    or no pressure or depth, or nothing else; then all is passed over to the next
    ///                    header
    bool read(std::string_view line, Reading& reading);

private:
    struct Used {
        std::size_t place;
        Column column;
    };

    void read_header(std::string_view line);
    void read_setting(std::string_view key, std::string_view value);
    void read_name(std::string_view key, std::string_view value);
    void read_position(std::string_view key, std::string_view value);
    void read_start(std::string_view key, std::string_view value);
    void end_header();
    void split(std::string_view line);
    bool read_scan(std::string_view line, Reading& reading);

    enum class State : std::uint8_t { nothing, header, scans, unusable };
    State state_ = State::nothing;
    bool binary_ = false;
    bool said_ = false;  ///< that *END* is missing
    std::size_t columns_ = 0;
    std::vector<Used> used_;
    std::vector<std::string_view> cells_;  ///< of the line that is read
    std::optional<double> bad_value_;
    double latitude_deg_ = not_available, longitude_deg_ = not_available;
    FileStart start_;
    int start_rank_ = 0;  ///< how good the source of the start is
};

/// Degrees of `71 20.70 N`, `N44 41.056`, `w63 38.633`, `-63.64`, `63 38 37.9 W`; nothing: none of these.
std::optional<double> parse_position(std::string_view text);

/// `Aug 09 2012 06:34:23` as a time, UTC; no_time: it is none, or before 1970.
std::int64_t parse_cnv_time(std::string_view text);

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_CNV_HPP
