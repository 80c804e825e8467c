#ifndef SEAUTILS_SCHEMA_CSV_HPP
#define SEAUTILS_SCHEMA_CSV_HPP

#include "seautils/schema/values.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace seautils::schema {

/// Values as rows of a table (RFC 4180, `\n` line ends), for spreadsheets and R.
///
/// One column for each leaf in declaration order: a sub-message's as `leg.seq`, element k of a
/// repeated field as `sample[0].depth_m` up to that field's largest count. An unset value is an
/// empty cell; numbers are written as in JSON (64-bit ones without quotes); bytes in base64; a text
/// with a comma, a quote or a line end is quoted.
class CsvWriter {
public:
    /// @param max_repeat  gives the largest number of elements for a repeated field
    ///                    (by its path without indices, such as "sample"); absent: 1
    /// @throws ConfigError  more than 10,000 columns
    CsvWriter(const Layout& layout, const std::map<std::string, std::uint32_t>& max_repeat);

    const std::vector<std::string>& columns() const { return columns_; }

    void header(std::string& out) const;
    /// Elements beyond the columns have no place and are left out: a decoder keeps to max_repeat.
    void row(const Values& values, std::string& out) const;

private:
    const Layout* layout_;
    std::vector<std::string> columns_;
    /// For each column: field index, element index where it is repeated, field index, …
    std::vector<std::vector<std::uint32_t>> paths_;
    std::map<std::string, std::uint32_t> max_repeat_;
};

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_CSV_HPP
