#include "seautils/acoustics/ctd_csv.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::acoustics {

namespace {

constexpr std::size_t most_columns = 1000;

/// What parts the cells of a line.
char separator_of(std::string_view line) {
    for (const char c : {',', ';', '\t'})
        if (line.find(c) != line.npos) return c;
    return ' ';
}

/// The place that a name says, from 0: `3`; nothing where it is a name.
std::optional<std::size_t> place_of(std::string_view name) {
    if (name.empty() || name.size() > 4 || name.find_first_not_of("0123456789") != name.npos)
        return std::nullopt;
    const auto place = static_cast<std::size_t>(*number(name));
    if (place < 1 || place > most_columns) return std::nullopt;
    return place - 1;
}

/// `19970821` and `0613` as a time; no_time where they are none.
std::int64_t exchange_time(std::string_view date, std::string_view clock) {
    if (date.size() != 8) return no_time;
    std::string hours(clock.empty() ? "0000" : clock);
    hours.insert(0, hours.size() < 4 ? 4 - hours.size() : 0, '0');
    try {
        return parse_utc_ns(fmt::format("{}-{}-{}T{}:{}:00Z", date.substr(0, 4), date.substr(4, 2),
                                        date.substr(6, 2), hours.substr(0, 2), hours.substr(2, 2)));
    } catch (const DataError&) {
        return no_time;
    }
}

}  // namespace

NamedColumn parse_named_column(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals + 1 == text.size())
        throw DataError(quote(text) + " is not of the form QUANTITY=NAME");
    return {parse_quantity(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

/// A separator within quotes parts nothing.
void CtdCsv::split(std::string_view line) {
    cells_.clear();
    std::size_t from = 0;
    bool quoted = false;
    for (std::size_t k = 0; k <= line.size() && cells_.size() < most_columns; ++k) {
        const bool end = k == line.size();
        if (!end && line[k] == '"') quoted = !quoted;
        const bool parts =
            !end && !quoted && (line[k] == separator_ || (separator_ == ' ' && line[k] == '\t'));
        if (!end && !parts) continue;
        if (separator_ != ' ' || k > from) cells_.push_back(trim(line.substr(from, k - from)));
        from = k + 1;
    }
}

bool CtdCsv::by_place() const {
    return std::any_of(named_.begin(), named_.end(),
                       [](const NamedColumn& n) { return place_of(n.name).has_value(); });
}

bool CtdCsv::has_number() const {
    return std::any_of(cells_.begin(), cells_.end(),
                       [](std::string_view cell) { return number(cell).has_value(); });
}

/// Fills used_ from the header in cells_. @return whether a cast can be read from it
bool CtdCsv::find_columns() {
    used_.clear();
    std::array<bool, quantities> taken{};
    const auto use = [&](std::size_t place, const Column& column) {
        used_.push_back({place, column});
        taken[static_cast<std::size_t>(column.quantity)] = true;
    };
    for (const NamedColumn& n : named_) {
        const auto place = place_of(n.name);
        const auto found = std::find(cells_.begin(), cells_.end(), n.name);
        if (place) use(*place, n.column);
        if (!place && found != cells_.end())
            use(static_cast<std::size_t>(found - cells_.begin()), n.column);
    }
    const std::array<bool, quantities> named = taken;
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        const std::optional<Column> column = column_of(cells_[k]);
        if (!column) continue;
        const auto q = static_cast<std::size_t>(column->quantity);
        const bool extra = column->form == Column::Form::quality;
        if (extra ? !named[q] : !taken[q]) extra ? used_.push_back({k, *column}) : use(k, *column);
    }
    columns_ = 0;
    for (const Used& u : used_) columns_ = std::max(columns_, u.place + 1);
    const auto has = [&](Quantity q) { return taken[static_cast<std::size_t>(q)]; };
    return (has(Quantity::depth_m) || has(Quantity::pressure_dbar)) &&
           (has(Quantity::temperature_c) || has(Quantity::sound_speed_mps));
}

void CtdCsv::refuse_header(std::string_view line) {
    state_ = State::ended;
    throw DataError("header " + quote(line) +
                    " names no depth or pressure beside a temperature or a sound speed (--column)");
}

/// `KEY = VALUE` above the header of a WHP-exchange file.
void CtdCsv::read_property(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == line.npos) return;
    const std::string_view key = trim(line.substr(0, equals)),
                           value = trim(line.substr(equals + 1));
    if (key == "LATITUDE") latitude_deg_ = number(value).value_or(not_available);
    if (key == "LONGITUDE") longitude_deg_ = number(value).value_or(not_available);
    if (key == "DATE") date_ = value;
    if (key == "TIME") time_ = value;
    start_.time_ns = exchange_time(date_, time_);
}

/// Whether cells_ are the header of other rows.
bool CtdCsv::is_header() {
    if (has_number()) return false;
    return std::count_if(cells_.begin(), cells_.end(),
                         [](std::string_view cell) { return column_of(cell).has_value(); }) > 1;
}

bool CtdCsv::read_row(Reading& reading) {
    if (cells_.size() < columns_)
        throw DataError(
            fmt::format("{} where the header has {}", counted(cells_.size(), "column"), columns_));
    reading = {};
    reading.time_ns = start_.time_ns;
    reading[Quantity::latitude_deg] = latitude_deg_;
    reading[Quantity::longitude_deg] = longitude_deg_;
    for (const Used& u : used_) fill(cells_[u.place], u.column, start_, reading);
    return true;
}

bool CtdCsv::read(std::string_view line, Reading& reading) {
    const std::string_view text = trim(line);
    if (text.empty() || text.front() == '#') return false;
    if (text.starts_with("CTD,")) {
        *this = CtdCsv(std::move(named_));
        exchange_ = true;
        return false;
    }
    if (text == "END_DATA") {
        state_ = State::ended;
        return false;
    }
    if (exchange_ && state_ == State::header && text.find('=') != text.npos) {
        read_property(text);
        return false;
    }
    if (state_ != State::rows) separator_ = separator_of(text);
    split(text);
    if (state_ == State::header || (state_ == State::ended && is_header()) ||
        (state_ == State::rows && is_header())) {
        separator_ = separator_of(text);
        split(text);
        const bool usable = find_columns();
        if (!usable) refuse_header(text);
        state_ = State::units;
        if (!by_place() || !has_number()) return false;
    }
    if (state_ == State::ended) return false;
    const bool units = state_ == State::units && !has_number();
    state_ = State::rows;
    return units ? false : read_row(reading);
}

}  // namespace seautils::acoustics
