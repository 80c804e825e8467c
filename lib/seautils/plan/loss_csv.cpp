#include "seautils/plan/loss_csv.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/plan/csv_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace seautils::plan {

namespace {

constexpr std::size_t most_cells = std::size_t{1} << 24;

double number_or_refuse(std::string_view cell, const char* what) {
    const std::optional<double> x = read_number(cell);
    if (x && std::isfinite(*x)) return *x;
    throw DataError(fmt::format("{} {} is no number", what, quote(cell)));
}

float loss_of(std::string_view cell) {
    if (cell.empty()) return std::numeric_limits<float>::quiet_NaN();
    const std::optional<double> x = read_number(cell);
    if (!x) throw DataError(fmt::format("loss {} is no number", quote(cell)));
    if (!std::isnan(*x) && *x != HUGE_VAL && !(*x >= -100 && *x <= 1000))
        throw DataError(fmt::format("loss {} is outside -100 to 1000 dB", quote(cell)));
    return static_cast<float>(*x);
}

void read_ranges(const std::vector<std::string_view>& cells, LossField& field) {
    if (cells.size() < 2) throw DataError("no ranges behind the first cell");
    for (std::size_t k = 1; k < cells.size(); ++k) {
        field.range_m.push_back(number_or_refuse(cells[k], "range_m"));
        if (k > 1 && field.range_m[k - 1] <= field.range_m[k - 2])
            throw DataError(fmt::format("range_m {} does not grow", quote(cells[k])));
    }
}

void read_losses(const std::vector<std::string_view>& cells, LossField& field) {
    if (cells.size() != field.range_m.size() + 1)
        throw DataError(fmt::format("{} where the first row has {}", counted(cells.size(), "cell"),
                                    field.range_m.size() + 1));
    if (field.loss_db.size() > most_cells)
        throw DataError(fmt::format("more than {} losses", most_cells));
    const double depth_m = number_or_refuse(cells[0], "depth_m");
    if (!field.depth_m.empty() && depth_m <= field.depth_m.back())
        throw DataError(fmt::format("depth_m {} does not grow", quote(cells[0])));
    field.depth_m.push_back(depth_m);
    for (std::size_t k = 1; k < cells.size(); ++k) field.loss_db.push_back(loss_of(cells[k]));
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
    text = without_blanks(text);
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-')) return std::nullopt;
    }
    double x = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return x;
}

LossField read_loss_csv(std::string_view text) {
    LossField field;
    for_each_row(text, [&](const std::vector<std::string_view>& cells) {
        field.range_m.empty() ? read_ranges(cells, field) : read_losses(cells, field);
    });
    check(field);
    return field;
}

DepthTable read_depth_table(std::string_view text) {
    DepthTable table;
    bool first = true;
    for_each_row(text, [&](const std::vector<std::string_view>& cells) {
        if (cells.size() != 2)
            throw DataError(fmt::format("{} in place of 2", counted(cells.size(), "cell")));
        const bool header = first && !read_number(cells[0]);
        first = false;
        if (header) return;
        const double depth_m = number_or_refuse(cells[0], "depth_m");
        if (!table.depth_m.empty() && depth_m <= table.depth_m.back())
            throw DataError(fmt::format("depth_m {} does not grow", quote(cells[0])));
        table.depth_m.push_back(depth_m);
        table.values.push_back(number_or_refuse(cells[1], "value"));
    });
    if (table.depth_m.empty()) throw DataError("holds no row");
    return table;
}

}  // namespace seautils::plan
