#include "seautils/acoustics/cnv.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace seautils::acoustics {

namespace {

constexpr std::size_t most_columns = 1000, column_width = 11;

/// The words of a text, parted by blanks.
std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> all;
    for (std::size_t from = 0; (from = text.find_first_not_of(" \t", from)) != text.npos;) {
        const std::size_t end = std::min(text.find_first_of(" \t", from), text.size());
        all.push_back(text.substr(from, end - from));
        from = end;
    }
    return all;
}

char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// Digits alone, as a number.
std::optional<unsigned> whole(std::string_view text) {
    if (text.empty() || text.size() > 4 || text.find_first_not_of("0123456789") != text.npos)
        return std::nullopt;
    return static_cast<unsigned>(*number(text));
}

std::optional<unsigned> month_of(std::string_view text) {
    constexpr std::string_view months = "JANFEBMARAPRMAYJUNJULAUGSEPOCTNOVDEC";
    if (text.size() < 3) return std::nullopt;
    const std::string word{upper(text[0]), upper(text[1]), upper(text[2])};
    const std::size_t at = months.find(word);
    if (at == months.npos || at % 3 != 0) return std::nullopt;
    return static_cast<unsigned>(at / 3 + 1);
}

std::int64_t time_or_none(const std::string& text) {
    try {
        return parse_utc_ns(text);
    } catch (const DataError&) {
        return no_time;
    }
}

}  // namespace

std::optional<double> parse_position(std::string_view text) {
    std::string digits;
    double sign = 1;
    for (const char c : text) {
        const char letter = upper(c);
        if (letter == 'S' || letter == 'W') sign = -1;
        const bool blank = letter == 'N' || letter == 'S' || letter == 'E' || letter == 'W';
        digits += blank ? ' ' : c;
    }
    const auto parts = words(digits);
    if (parts.empty() || parts.size() > 3) return std::nullopt;
    double degrees = 0, unit = 1;
    for (const std::string_view part : parts) {
        const std::optional<double> x = number(part);
        if (!x || (unit < 1 && !(*x >= 0 && *x < 60))) return std::nullopt;
        if (unit == 1 && part.front() == '-') sign = -sign;
        degrees += (*x < 0 ? -*x : *x) * unit;
        unit /= 60;
    }
    if (!(degrees <= 360)) return std::nullopt;
    return sign * degrees;
}

std::int64_t parse_cnv_time(std::string_view text) {
    const auto parts = words(text);
    if (parts.size() < 4) return no_time;
    const auto month = month_of(parts[0]), day = whole(parts[1]), year = whole(parts[2]);
    if (!month || !day || !year) return no_time;
    return time_or_none(fmt::format("{:04}-{:02}-{:02}T{}Z", *year, *month, *day, parts[3]));
}

/// `name 2`: a column, whose short name stands before the colon.
void Cnv::read_name(std::string_view key, std::string_view value) {
    const auto place = whole(trim(key.substr(5)));
    if (!place || *place >= most_columns) return;
    columns_ = std::max<std::size_t>(columns_, *place + 1);
    const auto column = column_of(value.substr(0, value.find(':')));
    const auto same = [&](const Used& u) {
        return u.column.quantity == column->quantity &&
               (u.column.form == Column::Form::bad_scan) ==
                   (column->form == Column::Form::bad_scan);
    };
    if (column && std::none_of(used_.begin(), used_.end(), same))
        used_.push_back({*place, *column});
}

/// The instrument's own position counts, else what somebody typed in.
void Cnv::read_position(std::string_view key, std::string_view value) {
    const bool own = key.starts_with("NMEA");
    const auto is = [&](std::string_view word) {
        return key.size() >= word.size() && key.substr(key.size() - word.size()) == word;
    };
    const bool latitude = is("Latitude"), longitude = is("Longitude");
    double& degrees = latitude ? latitude_deg_ : longitude_deg_;
    if ((!latitude && !longitude) || (!own && degrees == degrees)) return;
    const double found = parse_position(value).value_or(not_available);
    if (found >= -180 && found <= 360 && (!latitude || (found >= -90 && found <= 90)))
        degrees = found;
}

/// When the cast began, from the best of what the header says; when it was read out, if nothing else.
void Cnv::read_start(std::string_view key, std::string_view value) {
    static constexpr std::string_view keys[]{"System UpLoad Time", "System UTC", "start_time",
                                             "NMEA UTC (Time)"};
    const auto* found = std::find(std::begin(keys), std::end(keys), key);
    const int rank = static_cast<int>(found - std::begin(keys)) + 1;
    if (found == std::end(keys) || rank < start_rank_) return;
    const std::int64_t time = parse_cnv_time(value);
    if (time == no_time) return;
    start_rank_ = rank;
    start_.time_ns = time;
    start_.year_ns = time_or_none(format_utc_ns(time).substr(0, 4) + "-01-01T00:00:00Z");
}

void Cnv::read_setting(std::string_view key, std::string_view value) {
    if (key.starts_with("name ")) read_name(key, value);
    if (key == "bad_flag") bad_value_ = number(value);
    if (key == "file_type") binary_ = value == "binary";
    read_position(key, value);
    read_start(key, value);
}

/// `# key = value`, `* key = value`, `** key: value`.
void Cnv::read_header(std::string_view line) {
    const std::size_t first = std::min(line.find_first_not_of("*#"), line.size());
    const bool typed = first > 1;
    const std::string_view text = line.substr(first);
    std::size_t parts = text.find(typed ? ':' : '=');
    if (typed && parts == text.npos) parts = text.find('=');
    if (parts == text.npos) return;
    read_setting(trim(text.substr(0, parts)), trim(text.substr(parts + 1)));
}

void Cnv::end_header() {
    state_ = State::unusable;
    said_ = false;
    if (binary_) throw DataError("the data are binary: convert them to ascii");
    const auto has = [&](Quantity q) {
        return std::any_of(used_.begin(), used_.end(), [q](const Used& u) {
            return u.column.quantity == q && u.column.form != Column::Form::bad_scan;
        });
    };
    if (!has(Quantity::pressure_dbar) && !has(Quantity::depth_m))
        throw DataError("the header names no pressure or depth");
    if (!has(Quantity::temperature_c) && !has(Quantity::sound_speed_mps))
        throw DataError("the header names no temperature or sound speed");
    state_ = State::scans;
}

/// Where numbers fill their eleven places no blank parts them.
void Cnv::split(std::string_view line) {
    cells_ = words(line);
    if (cells_.size() >= columns_ || line.size() < columns_ * column_width) return;
    cells_.clear();
    for (std::size_t k = 0; k < columns_; ++k)
        cells_.push_back(trim(line.substr(k * column_width, column_width)));
}

bool Cnv::read_scan(std::string_view line, Reading& reading) {
    split(line);
    if (cells_.size() < columns_)
        throw DataError(
            fmt::format("{} where the header has {}", counted(cells_.size(), "column"), columns_));
    reading = {};
    reading.time_ns = start_.time_ns;
    reading[Quantity::latitude_deg] = latitude_deg_;
    reading[Quantity::longitude_deg] = longitude_deg_;
    for (const Used& u : used_) {
        const bool is_bad = bad_value_ && number(cells_[u.place]) == bad_value_;
        if (is_bad && u.column.form == Column::Form::bad_scan) reading.flagged = true;
        if (!is_bad) fill(cells_[u.place], u.column, start_, reading);
    }
    return true;
}

bool Cnv::read(std::string_view line, Reading& reading) {
    const std::string_view text = trim(line);
    if (text.empty()) return false;
    if (text == "*END*") {
        if (state_ != State::header) throw DataError("*END* behind no header");
        end_header();
        return false;
    }
    if (text.front() == '*' || text.front() == '#') {
        if (state_ != State::header) *this = Cnv();
        state_ = State::header;
        read_header(text);
        return false;
    }
    if (state_ == State::unusable || said_) return false;
    if (state_ == State::header) {
        said_ = true;
        throw DataError("neither a line of the header, nor behind its *END*");
    }
    if (state_ == State::nothing) {
        state_ = State::unusable;
        throw DataError("no header of a .cnv file");
    }
    return read_scan(line, reading);
}

}  // namespace seautils::acoustics
