#ifndef SEAUTILS_ACOUSTICS_CTD_CSV_HPP
#define SEAUTILS_ACOUSTICS_CTD_CSV_HPP

#include "seautils/acoustics/columns.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::acoustics {

/// A column that the caller names: by its name in the header, or by its place from 1 on.
struct NamedColumn {
    Column column;
    std::string name;
};

/// `QUANTITY=NAME`, the quantity as parse_quantity() takes it.
/// @throws DataError  no `=`, no such quantity, no name
NamedColumn parse_named_column(std::string_view text);

/// Reads a cast from a table of text, line by line: a header that names the columns (or places that the
/// caller names), and a row for each scan, parted by commas, semicolons, tabs or blanks. Lines that
/// begin with `#` are comments; a line of units below the header is passed over. WHP-exchange files
/// (`CTD,…`, `LATITUDE = …`, `END_DATA`) are known. A header may come again, with another file's rows.
class CtdCsv {
public:
    explicit CtdCsv(std::vector<NamedColumn> named = {}) : named_(std::move(named)) {}

    /// Reads one line, without its line end. @return whether it was a scan: `reading` has it
    /// @throws DataError  a row that cannot be read; a header that has neither depth nor pressure, or
    ///                    nothing else, after which all is passed over to the next header
    bool read(std::string_view line, Reading& reading);

private:
    enum class State : std::uint8_t { header, units, rows, ended };
    struct Used {
        std::size_t place;  ///< from 0
        Column column;
    };

    void split(std::string_view line);
    bool is_header();
    bool find_columns();
    void read_property(std::string_view line);
    bool read_row(Reading& reading);
    bool has_number() const;
    bool by_place() const;
    [[noreturn]] void refuse_header(std::string_view line);

    std::vector<NamedColumn> named_;
    State state_ = State::header;
    char separator_ = ',';
    std::vector<std::string_view> cells_;  ///< of the line that is read
    std::vector<Used> used_;
    std::size_t columns_ = 0;  ///< that a row has at least
    bool exchange_ = false;    ///< a WHP-exchange file, above its header
    double latitude_deg_ = not_available, longitude_deg_ = not_available;
    std::string date_, time_;
    FileStart start_;
};

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_CTD_CSV_HPP
