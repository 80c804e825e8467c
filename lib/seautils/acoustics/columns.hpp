#ifndef SEAUTILS_ACOUSTICS_COLUMNS_HPP
#define SEAUTILS_ACOUSTICS_COLUMNS_HPP

#include "seautils/acoustics/sample.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::acoustics {

/// How a column says its quantity.
struct Column {
    enum class Form : std::uint8_t {
        plain,       ///< a number of the quantity's own unit, times `scale`
        ipts_68,     ///< a temperature on the scale of 1968
        utc,         ///< a time: RFC 3339 with `Z`, or seconds since 1970
        elapsed,     ///< seconds (times `scale`) since the file's start
        year_day,    ///< days since the year of the file's start began, from 1
        since_2000,  ///< seconds since 2000
        quality,     ///< a WOCE flag of the quantity: 3 and 4 are bad, 5 and 9 missing
        bad_scan,    ///< Sea-Bird's flag: the scan is bad where it has the bad value
    };
    Quantity quantity = Quantity::time;
    Form form = Form::plain;
    double scale = 1;
};

/// What a name in a header means, as sensors, archives and people write it: `temperature_C`, `Depth (m)`,
/// `CTDPRS`, `t090C`, `c0mS/cm`. Capitals, blanks and punctuation are no matter. Nothing: not ours.
std::optional<Column> column_of(std::string_view name);

/// The quantity whose own name this is, as options name it: `temperature_c`; also `conductivity_mspcm`,
/// `temperature_68_c`, `time`.
/// @throws DataError  lists them
Column parse_quantity(std::string_view name);

/// Where a file says when it began, for columns that count from there.
struct FileStart {
    std::int64_t time_ns = no_time;
    std::int64_t year_ns = no_time;  ///< when its year began
};

/// Puts what a cell says into the reading: an empty one, `nan`, `na`, `none`, `null`, and numbers of -99
/// and below but for a longitude's (-999 and its kin), are not available.
/// @param cell  without blanks around it
/// @throws DataError  the name of the quantity, and the cell: no number, no time
void fill(std::string_view cell, const Column& column, const FileStart& start, Reading& reading);

/// A text without blanks and then quotes around it; a view into it.
std::string_view trim(std::string_view text);

/// A whole text as a number; nothing: it is none. `1.5`, `+1.5`, `-3e-4`; also inf.
std::optional<double> number(std::string_view text);

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_COLUMNS_HPP
