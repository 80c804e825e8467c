// States of a vehicle as rows of a table.
#ifndef SEAUTILS_TOOLS_DEPTH_STATE_CSV_HPP
#define SEAUTILS_TOOLS_DEPTH_STATE_CSV_HPP

#include "depth_schema.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"
#include "seautils/plan/csv_lines.hpp"
#include "seautils/plan/loss_csv.hpp"
#include "seautils/schema/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seautils::tools {

/// Reads a DepthState a row, below a header with the names of its fields (`contact.x_m` for those of the contact) or those
/// that poscode knows. Other columns are passed over; an empty cell says nothing. A header may come again, with another
/// file's rows.
class DepthStateCsv {
public:
    explicit DepthStateCsv(const schema::Layout& layout) : layout_(layout) {}

    /// @return whether `values` has a state; else the line was a header or a comment
    /// @throws DataError  a row without a header, of another length, or with a cell that is not what its column holds
    bool read(std::string_view line, schema::Values& values) {
        if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
        line = plan::without_blanks(line);
        if (line.empty() || line.front() == '#') return false;
        plan::split_cells(line, cells_);
        if (take_header()) return false;
        if (columns_.empty())
            throw DataError(
                fmt::format("{} stands below no header that names depth_m or another "
                            "column that is known",
                            quote(line)));
        if (cells_.size() != columns_.size())
            throw DataError(fmt::format("{} where the header has {}",
                                        counted(cells_.size(), "cell"), columns_.size()));
        values.reset(layout_);
        contact_.reset();
        for (std::size_t k = 0; k < cells_.size(); ++k)
            if (columns_[k] && !cells_[k].empty()) put(*columns_[k], cells_[k], values);
        return true;
    }

private:
    struct Column {
        bool of_contact = false;
        std::uint32_t field = 0;
    };

    /// A line without a number that has a name is a header.
    bool take_header() {
        if (std::any_of(cells_.begin(), cells_.end(),
                        [](std::string_view cell) { return plan::read_number(cell).has_value(); }))
            return false;
        std::vector<std::optional<Column>> columns;
        for (const std::string_view cell : cells_) {
            std::optional<Column> column = column_of(cell);
            for (const auto& other : columns)  // of two alike the first
                if (column && other && other->of_contact == column->of_contact &&
                    other->field == column->field)
                    column.reset();
            columns.push_back(column);
        }
        if (std::none_of(columns.begin(), columns.end(), [](const auto& c) { return c; }))
            return false;
        columns_ = std::move(columns);
        return true;
    }

    std::optional<Column> column_of(std::string_view name) const {
        constexpr std::string_view prefix = "contact.";
        if (name.starts_with(prefix))
            return field_of(contact_layout(), name.substr(prefix.size()), true);
        static constexpr std::array<std::pair<std::string_view, std::string_view>, 11> others{
            {{"t", "time"},
             {"time_s", "time"},
             {"x", "x_m"},
             {"y", "y_m"},
             {"depth", "depth_m"},
             {"lat_deg", "latitude_deg"},
             {"latitude", "latitude_deg"},
             {"lat", "latitude_deg"},
             {"lon_deg", "longitude_deg"},
             {"longitude", "longitude_deg"},
             {"lon", "longitude_deg"}}};
        for (const auto& [other, own] : others)
            if (name == other) name = own;
        return name == "contact" ? std::nullopt : field_of(layout_, name, false);
    }

    static std::optional<Column> field_of(const schema::Layout& layout, std::string_view name,
                                          bool of_contact) {
        for (std::uint32_t f = 0; f < layout.fields.size(); ++f)
            if (layout.fields[f].name == name) return Column{of_contact, f};
        return std::nullopt;
    }

    const schema::Layout& contact_layout() const {
        return *layout_.fields[field::state::contact].message;
    }

    void put(const Column& column, std::string_view cell, schema::Values& values) {
        if (!column.of_contact && column.field == field::state::time) return put_time(cell, values);
        if (column.of_contact && !contact_)
            contact_ = values.add_block(field::state::contact, contact_layout());
        const schema::Layout& layout = column.of_contact ? contact_layout() : layout_;
        const std::optional<double> x = plan::read_number(cell);
        if (!x || std::isnan(*x))
            throw DataError(
                fmt::format("{} {} is no number", layout.fields[column.field].name, quote(cell)));
        schema::Slot& slot = values[(column.of_contact ? *contact_ : 0) + column.field];
        slot.d = *x;
        slot.present = true;
    }

    /// Seconds since 1970, or what a time is in JSON.
    void put_time(std::string_view cell, schema::Values& values) const {
        const bool is_number = plan::read_number(cell).has_value();
        const UtcInstant time = parse_instant((is_number ? "@" : "") + std::string(cell));
        const std::uint32_t block =
            values.add_block(field::state::time, *layout_.fields[field::state::time].message);
        values[block].i = time.seconds;
        values[block + 1].i = time.nanoseconds;
        values[block].present = values[block + 1].present = true;
    }

    const schema::Layout& layout_;
    std::vector<std::string_view> cells_;
    std::vector<std::optional<Column>> columns_;
    std::optional<std::uint32_t> contact_;  ///< its block in the row that is read
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_STATE_CSV_HPP
