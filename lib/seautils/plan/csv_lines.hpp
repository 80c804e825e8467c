#ifndef SEAUTILS_PLAN_CSV_LINES_HPP
#define SEAUTILS_PLAN_CSV_LINES_HPP

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace seautils::plan {

inline std::string_view without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The cells of a line, parted by commas, without blanks around them.
inline void split_cells(std::string_view line, std::vector<std::string_view>& cells) {
    cells.clear();
    for (;;) {
        const std::size_t end = std::min(line.find(','), line.size());
        cells.push_back(without_blanks(line.substr(0, end)));
        if (end == line.size()) return;
        line.remove_prefix(end + 1);
    }
}

/// Calls `row` with the cells of each line that is neither empty nor a comment.
/// @throws DataError  what `row` throws, with `LINE: ` in front
template <class Row>
void for_each_row(std::string_view text, Row row) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    std::vector<std::string_view> cells;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = without_blanks(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.front() == '#') continue;
        split_cells(line, cells);
        try {
            row(cells);
        } catch (const DataError& e) {
            throw DataError(fmt::format("{}: {}", number, e.what()));
        }
    }
}

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_CSV_LINES_HPP
