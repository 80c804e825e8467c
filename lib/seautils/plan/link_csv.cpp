#include "seautils/plan/link_csv.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/plan/csv_lines.hpp"
#include "seautils/plan/loss_csv.hpp"

#include <fmt/format.h>

#include <cmath>

namespace seautils::plan {

namespace {

void refuse_outside(double value, double least, double most, const char* what, const char* unit) {
    if (value >= least && value <= most) return;
    throw DataError(fmt::format("{} {} is outside {} to {}{}", what, value, least, most, unit));
}

double number(std::string_view cell, const char* what) {
    const std::optional<double> x = read_number(cell);
    if (!x || std::isnan(*x)) throw DataError(fmt::format("{} {} is no number", what, quote(cell)));
    return *x;
}

bool truth(std::string_view cell) {
    for (const char* yes : {"1", "true", "yes", "True", "TRUE"})
        if (cell == yes) return true;
    for (const char* no : {"0", "false", "no", "False", "FALSE"})
        if (cell == no) return false;
    throw DataError(fmt::format("received {} is none of 1, 0, true, false, yes, no", quote(cell)));
}

}  // namespace

void check(const LinkSample& s) {
    refuse_outside(s.depth_m, 0, 12000, "depth_m", " m");
    if (!std::isnan(s.range_m)) refuse_outside(s.range_m, 0, 1e7, "range_m", " m");
    if (!std::isnan(s.loss_db)) refuse_outside(s.loss_db, -100, 1000, "tl_db", " dB");
    if (s.rate) refuse_outside(*s.rate, 0, 1000, "rate", "");
}

std::optional<LinkSample> LinkCsv::read(std::string_view line) {
    if (!has_header_ && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    line = without_blanks(line);
    if (line.empty() || line.front() == '#') return std::nullopt;
    split_cells(line, cells_);
    if (has_header_) return read_row();
    has_header_ = true;
    read_header();
    return std::nullopt;
}

void LinkCsv::read_header() {
    columns_ = cells_.size();
    for (std::size_t k = 0; k < columns_; ++k) {
        const auto take = [&](const char* name, std::optional<std::size_t>& column) {
            if (cells_[k] == name && !column) column = k;
        };
        take("depth_m", depth_);
        take("received", received_);
        take("range_m", range_);
        take("tl_db", loss_);
        take("loss_db", loss_);
        take("rate", rate_);
    }
    if (!depth_) throw DataError("the header has no column depth_m");
    if (!received_) throw DataError("the header has no column received");
}

std::string_view LinkCsv::cell(std::optional<std::size_t> column) const {
    return column ? cells_[*column] : std::string_view();
}

LinkSample LinkCsv::read_row() const {
    if (!depth_ || !received_) throw DataError("a row below a header that cannot be used");
    if (cells_.size() != columns_)
        throw DataError(
            fmt::format("{} where the header has {}", counted(cells_.size(), "cell"), columns_));
    LinkSample s;
    s.depth_m = number(cell(depth_), "depth_m");
    s.received = truth(cell(received_));
    if (const auto text = cell(range_); !text.empty()) s.range_m = number(text, "range_m");
    if (const auto text = cell(loss_); !text.empty()) s.loss_db = number(text, "tl_db");
    if (const auto text = cell(rate_); !text.empty()) {
        const double rate = number(text, "rate");
        refuse_outside(rate, 0, 1000, "rate", "");
        if (rate != std::floor(rate))
            throw DataError(fmt::format("rate {} is no whole number", quote(text)));
        s.rate = static_cast<std::int32_t>(rate);
    }
    check(s);
    return s;
}

}  // namespace seautils::plan
