#include "seautils/acoustics/columns.hpp"

#include "seautils/acoustics/seawater.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"

#include <charconv>
#include <cmath>

namespace seautils::acoustics {

namespace {

using Form = Column::Form;

/// Names as plain() makes them, each with what it means. Where a unit is not said it is the quantity's.
struct Known {
    std::string_view name;
    Column column;
};
constexpr Known known[]{
    // Our own, first: parse_quantity() lists them.
    {"time", {Quantity::time, Form::utc}},
    {"pressure_dbar", {Quantity::pressure_dbar}},
    {"depth_m", {Quantity::depth_m}},
    {"temperature_c", {Quantity::temperature_c}},
    {"temperature_68_c", {Quantity::temperature_c, Form::ipts_68}},
    {"salinity", {Quantity::salinity}},
    {"conductivity_spm", {Quantity::conductivity_spm}},
    {"conductivity_mspcm", {Quantity::conductivity_spm, Form::plain, 0.1}},
    {"sound_speed_mps", {Quantity::sound_speed_mps}},
    {"latitude_deg", {Quantity::latitude_deg}},
    {"longitude_deg", {Quantity::longitude_deg}},
    // Archives and spreadsheets.
    {"time_s", {Quantity::time, Form::utc}},
    {"time_utc", {Quantity::time, Form::utc}},
    {"timestamp", {Quantity::time, Form::utc}},
    {"datetime", {Quantity::time, Form::utc}},
    {"date_time", {Quantity::time, Form::utc}},
    {"utc", {Quantity::time, Form::utc}},
    {"pressure", {Quantity::pressure_dbar}},
    {"pressure_db", {Quantity::pressure_dbar}},
    {"pressure_decibars", {Quantity::pressure_dbar}},
    {"pres", {Quantity::pressure_dbar}},
    {"pres_adjusted", {Quantity::pressure_dbar}},
    {"ctdprs", {Quantity::pressure_dbar}},
    {"ctdprs_flag_w", {Quantity::pressure_dbar, Form::quality}},
    {"depth", {Quantity::depth_m}},
    {"depth_meters", {Quantity::depth_m}},
    {"depth_metres", {Quantity::depth_m}},
    {"temperature", {Quantity::temperature_c}},
    {"temperature_degc", {Quantity::temperature_c}},
    {"temperature_deg_c", {Quantity::temperature_c}},
    {"temp", {Quantity::temperature_c}},
    {"temp_c", {Quantity::temperature_c}},
    {"temp_adjusted", {Quantity::temperature_c}},
    {"ctdtmp", {Quantity::temperature_c}},
    {"ctdtmp_flag_w", {Quantity::temperature_c, Form::quality}},
    {"salinity_psu", {Quantity::salinity}},
    {"salinity_pss_78", {Quantity::salinity}},
    {"practical_salinity", {Quantity::salinity}},
    {"sal", {Quantity::salinity}},
    {"psal", {Quantity::salinity}},
    {"psal_adjusted", {Quantity::salinity}},
    {"ctdsal", {Quantity::salinity}},
    {"ctdsal_flag_w", {Quantity::salinity, Form::quality}},
    {"conductivity", {Quantity::conductivity_spm}},
    {"conductivity_sm", {Quantity::conductivity_spm}},
    {"conductivity_s_m", {Quantity::conductivity_spm}},
    {"conductivity_mscm", {Quantity::conductivity_spm, Form::plain, 0.1}},
    {"conductivity_ms_cm", {Quantity::conductivity_spm, Form::plain, 0.1}},
    {"sound_speed", {Quantity::sound_speed_mps}},
    {"sound_speed_m_s", {Quantity::sound_speed_mps}},
    {"soundspeed", {Quantity::sound_speed_mps}},
    {"sound_velocity", {Quantity::sound_speed_mps}},
    {"sound_velocity_m_s", {Quantity::sound_speed_mps}},
    {"svel", {Quantity::sound_speed_mps}},
    {"latitude", {Quantity::latitude_deg}},
    {"lat", {Quantity::latitude_deg}},
    {"longitude", {Quantity::longitude_deg}},
    {"lon", {Quantity::longitude_deg}},
    // Sea-Bird's short names, of the first sensor of each kind.
    {"prdm", {Quantity::pressure_dbar}},
    {"prm", {Quantity::pressure_dbar}},
    {"prsm", {Quantity::pressure_dbar}},
    {"pr50m", {Quantity::pressure_dbar}},
    {"pr", {Quantity::pressure_dbar}},
    {"prde", {Quantity::pressure_dbar, Form::plain, 0.6894757}},  // psi
    {"depsm", {Quantity::depth_m}},
    {"deps", {Quantity::depth_m}},
    {"depfm", {Quantity::depth_m}},
    {"t090c", {Quantity::temperature_c}},
    {"t090", {Quantity::temperature_c}},
    {"tv290c", {Quantity::temperature_c}},
    {"t068c", {Quantity::temperature_c, Form::ipts_68}},
    {"t068", {Quantity::temperature_c, Form::ipts_68}},
    {"sal00", {Quantity::salinity}},
    {"c0s_m", {Quantity::conductivity_spm}},
    {"c0ms_cm", {Quantity::conductivity_spm, Form::plain, 0.1}},
    {"c0us_cm", {Quantity::conductivity_spm, Form::plain, 0.0001}},
    {"cond0s_m", {Quantity::conductivity_spm}},
    {"cond0ms_cm", {Quantity::conductivity_spm, Form::plain, 0.1}},
    {"svcm", {Quantity::sound_speed_mps}},
    {"svdm", {Quantity::sound_speed_mps}},
    {"svwm", {Quantity::sound_speed_mps}},
    {"times", {Quantity::time, Form::elapsed}},
    {"timem", {Quantity::time, Form::elapsed, 60}},
    {"timeh", {Quantity::time, Form::elapsed, 3600}},
    {"timej", {Quantity::time, Form::year_day}},
    {"timejv2", {Quantity::time, Form::year_day}},
    {"timey", {Quantity::time, Form::utc}},
    {"timek", {Quantity::time, Form::since_2000}},
    {"flag", {Quantity::time, Form::bad_scan}},
};
constexpr std::size_t own_names = 11;

/// Lower case; what is neither letter nor digit is one `_`, and none at the ends.
std::string plain(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const bool upper = c >= 'A' && c <= 'Z';
        const bool word = upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (word)
            out += upper ? static_cast<char>(c - 'A' + 'a') : c;
        else if (!out.empty() && out.back() != '_')
            out += '_';
    }
    if (!out.empty() && out.back() == '_') out.pop_back();
    return out;
}

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t year_2000_s = 946'684'800;

[[noreturn]] void refuse(const Column& column, std::string_view cell, const char* is_not) {
    throw DataError(std::string(name(column.quantity)) + " " + quote(cell) + " is no " + is_not);
}

/// Seconds after a time, to a microsecond; no_time where that is no time of ours.
std::int64_t after(std::int64_t start_ns, double seconds) {
    if (start_ns == no_time || !(std::fabs(seconds) < 9e9)) return no_time;
    const std::int64_t us = start_ns / 1000 + std::llround(seconds * 1e6);
    return us < 0 || us > INT64_MAX / 1000 ? no_time : us * 1000;
}

std::int64_t time_of(std::string_view cell, const Column& column, const FileStart& start) {
    if (cell.find(':') != cell.npos || cell.starts_with('@')) return parse_utc_ns(cell);
    const std::optional<double> x = number(cell);
    if (!x) refuse(column, cell, "time of the form 2024-05-01T12:00:25Z, nor a number of seconds");
    switch (column.form) {
        case Form::elapsed:
            return after(start.time_ns, *x * column.scale);
        case Form::year_day:
            return after(start.year_ns, (*x - 1) * 86400);
        case Form::since_2000:
            return after(year_2000_s * second_ns, *x);
        default:
            return after(0, *x);
    }
}

bool is_missing(std::string_view cell) {
    if (cell.empty()) return true;
    if (cell.size() > 4) return false;
    const std::string word = plain(cell);
    return word == "nan" || word == "na" || word == "null" || word == "none";
}

}  // namespace

std::string_view trim(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == text.npos) return {};
    text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
    if (text.size() > 1 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    return text;
}

std::optional<double> number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double x = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return x;
}

std::optional<Column> column_of(std::string_view text) {
    const std::string word = plain(text);
    for (const Known& k : known)
        if (k.name == word) return k.column;
    return std::nullopt;
}

Column parse_quantity(std::string_view text) {
    std::string all;
    for (std::size_t k = 0; k < own_names; ++k) {
        if (known[k].name == text) return known[k].column;
        all.append(all.empty() ? "" : ", ").append(known[k].name);
    }
    throw DataError("quantity " + quote(text) + " is none of " + all);
}

void fill(std::string_view cell, const Column& column, const FileStart& start, Reading& reading) {
    if (is_missing(cell) || column.form == Form::bad_scan) return;
    if (column.quantity == Quantity::time) {
        reading.time_ns = time_of(cell, column, start);
        return;
    }
    const std::optional<double> x = number(cell);
    if (!x) refuse(column, cell, "number");
    if (column.form == Form::quality) {
        if (*x == 3 || *x == 4) reading.flagged = true;
        if (*x == 5 || *x == 9) reading[column.quantity] = not_available;
    } else if (*x > -99 || (column.quantity == Quantity::longitude_deg && *x >= -180)) {
        const double value = *x * column.scale;
        reading[column.quantity] = column.form == Form::ipts_68 ? to_its_90_c(value) : value;
    }
}

}  // namespace seautils::acoustics
