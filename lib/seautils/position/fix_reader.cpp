#include "seautils/position/fix_reader.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace seautils::position {

namespace {

namespace sj = simdjson::ondemand;

/// What a column says.
enum Role : std::size_t { time, x, y, z, latitude, longitude, depth, roles };
constexpr std::size_t none = roles;

constexpr std::array<std::pair<std::string_view, Role>, 19> names = {{{"t", time},
                                                                      {"time", time},
                                                                      {"time_s", time},
                                                                      {"x", x},
                                                                      {"x_m", x},
                                                                      {"y", y},
                                                                      {"y_m", y},
                                                                      {"z", z},
                                                                      {"z_m", z},
                                                                      {"latitude_deg", latitude},
                                                                      {"lat_deg", latitude},
                                                                      {"latitude", latitude},
                                                                      {"lat", latitude},
                                                                      {"longitude_deg", longitude},
                                                                      {"lon_deg", longitude},
                                                                      {"longitude", longitude},
                                                                      {"lon", longitude},
                                                                      {"depth_m", depth},
                                                                      {"depth", depth}}};
constexpr std::array<const char*, roles> shown = {
    "time", "x", "y", "z", "latitude_deg", "longitude_deg", "depth_m"};

constexpr std::size_t most_columns = 1000;
constexpr double most_seconds = 9e9;  ///< a count of microseconds holds it

std::size_t role_of(std::string_view name) {
    for (const auto& [known, role] : names) {
        if (name == known) return role;
    }
    return none;
}

/// What a line says of each role.
struct Said {
    std::array<double, roles> value{};
    std::array<bool, roles> is_said{};
    std::int64_t time_us = 0;

    void set(std::size_t role, double number) {
        value[role] = number;
        is_said[role] = true;
    }
};

void set_number(Said& said, std::size_t role, double number) {
    if (!std::isfinite(number)) throw DataError(fmt::format("{} is no number", shown[role]));
    if (role == time) {
        if (std::fabs(number) > most_seconds)
            throw DataError(fmt::format("time {} s is outside the years 1970 to 2200", number));
        said.time_us = std::llround(number * 1e6);
    }
    said.set(role, number);
}

void set_instant(Said& said, std::string_view text) {
    const UtcInstant at = parse_instant(text);
    said.time_us = at.seconds * 1'000'000 + at.nanoseconds / 1000;
    said.set(time, 0);
}

void set_text(Said& said, std::size_t role, std::string_view text) {
    if (role == time && (text.starts_with('@') || text.find('T') != text.npos))
        return set_instant(said, text);
    std::string_view digits = text;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(number))
        throw DataError(fmt::format("{} {} is no number", shown[role], quote(text)));
    set_number(said, role, number);
}

std::string_view trimmed(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

/// The cell that begins there, without its quotes; `at` comes to stand behind the comma.
std::string_view next_cell(std::string_view line, std::size_t& at) {
    while (at < line.size() && line[at] == ' ') ++at;
    std::size_t end = std::min(line.find(',', at), line.size());
    if (at < line.size() && line[at] == '"') {
        std::size_t close = line.find('"', at + 1);
        while (close != line.npos && close + 1 < line.size() && line[close + 1] == '"')
            close = line.find('"', close + 2);
        if (close == line.npos) throw DataError("a quote in the row does not end");
        end = std::min(line.find(',', close), line.size());
        const std::string_view cell = line.substr(at + 1, close - at - 1);
        at = end + 1;
        return cell;
    }
    const std::string_view cell = line.substr(at, end - at);
    at = end + 1;
    return trimmed(cell);
}

}  // namespace

struct FixReader::Impl {
    explicit Impl(Options given) : options(std::move(given)) {}

    Options options;
    std::vector<std::size_t> columns;  ///< role of each; empty: no header yet
    std::vector<std::string_view> cells;
    sj::parser parser;
    std::string padded;

    bool is_json(std::string_view line) const {
        return options.form == Form::ndjson ||
               (options.form == Form::detect && trimmed(line).starts_with('{'));
    }
    bool header();
    Said row();
    void split(std::string_view line);
    Said object(std::string_view line);
    static void member(sj::field& field, Said& said);
    RawFix fix(const Said& said);
    void place(const Said& said, Place& at);
};

FixReader::FixReader(Options options) : impl_(std::make_unique<Impl>(std::move(options))) {}
FixReader::~FixReader() = default;
FixReader::FixReader(FixReader&&) noexcept = default;
FixReader& FixReader::operator=(FixReader&&) noexcept = default;

std::optional<RawFix> FixReader::read(std::string_view line) {
    if (impl_->is_json(line)) return impl_->fix(impl_->object(line));
    impl_->split(line);
    if (impl_->header()) return {};
    return impl_->fix(impl_->row());
}

void FixReader::Impl::split(std::string_view line) {
    if (columns.empty() && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    cells.clear();
    for (std::size_t at = 0; at <= line.size();) {
        if (cells.size() == most_columns)
            throw DataError(fmt::format("a row of more than {} cells", most_columns));
        cells.push_back(next_cell(line, at));
    }
}

/// Whether the cells name columns: then these count from here.
bool FixReader::Impl::header() {
    const auto tells = [this](std::string_view cell) {
        const std::size_t role = role_of(cell);
        return options.is_timeless ? role == x || role == latitude : role == time;
    };
    if (std::none_of(cells.begin(), cells.end(), tells)) return false;
    std::array<std::string_view, roles> taken;
    std::vector<std::size_t> found;
    for (const std::string_view cell : cells) {
        const std::size_t role = role_of(cell);
        found.push_back(role);
        if (role == none) continue;
        if (!taken[role].empty())
            throw DataError(fmt::format("columns {} and {} say the same", taken[role], cell));
        taken[role] = cell;
    }
    columns = std::move(found);
    return true;
}

Said FixReader::Impl::row() {
    if (columns.empty())
        throw DataError("no line with the names of the columns (t,x,y,z) stands before it");
    if (cells.size() != columns.size())
        throw DataError(fmt::format("{} where there are {}", counted(cells.size(), "cell"),
                                    counted(columns.size(), "column")));
    Said said;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (columns[k] != none && !cells[k].empty()) set_text(said, columns[k], cells[k]);
    }
    return said;
}

void FixReader::Impl::member(sj::field& field, Said& said) {
    const std::string_view key = field.unescaped_key();
    const std::size_t role = role_of(key);
    if (role == none) return;
    if (said.is_said[role])
        throw DataError(fmt::format("{} comes after the same by another name", quote(key)));
    sj::value value = field.value();
    switch (value.type()) {
        case sj::json_type::number:
            return set_number(said, role, value.get_double());
        case sj::json_type::string:
            return set_text(said, role, value.get_string());
        case sj::json_type::null:
            value.is_null();
            return;
        default:
            throw DataError(fmt::format("{} is no number", shown[role]));
    }
}

Said FixReader::Impl::object(std::string_view line) {
    if (line.find('\0') != line.npos) throw DataError("a NUL byte is not JSON");
    padded.assign(line);
    padded.append(simdjson::SIMDJSON_PADDING, '\0');
    try {
        sj::document document =
            parser.iterate(simdjson::padded_string_view(padded.data(), line.size(), padded.size()));
        if (document.type() != sj::json_type::object)
            throw DataError("the record is not a JSON object");
        Said said;
        for (auto found : document.get_object()) {
            sj::field field;
            if (const auto error = std::move(found).get(field))
                throw simdjson::simdjson_error(error);
            member(field, said);
        }
        const char* rest = nullptr;
        if (document.current_location().get(rest) == simdjson::SUCCESS)
            throw DataError("something follows the JSON object");
        return said;
    } catch (const simdjson::simdjson_error&) {
        throw DataError("not valid JSON: " + quote(line));
    }
}

RawFix FixReader::Impl::fix(const Said& said) {
    if (!said.is_said[time] && !options.is_timeless)
        throw DataError("the fix has no time (t, time or time_s)");
    RawFix fix;
    fix.time_us = said.time_us;
    place(said, fix.place);
    if (said.is_said[z])
        fix.place.z_m = said.value[z];
    else if (said.is_said[depth])
        fix.place.z_m = -said.value[depth];
    else if (!options.on_surface)
        throw DataError("the fix has no z or depth_m (on the surface: --surface)");
    return fix;
}

void FixReader::Impl::place(const Said& said, Place& at) {
    if (said.is_said[x] && said.is_said[y]) {
        at.x_m = said.value[x];
        at.y_m = said.value[y];
        return;
    }
    if (said.is_said[x] || said.is_said[y])
        throw DataError(said.is_said[x] ? "the fix has no y" : "the fix has no x");
    if (!said.is_said[latitude] || !said.is_said[longitude])
        throw DataError("the fix has neither x and y nor latitude_deg and longitude_deg");
    const Geographic place{said.value[latitude], said.value[longitude]};
    if (!options.frame && options.first_is_datum) options.frame.emplace(Frame::Kind::local, place);
    if (!options.frame) throw DataError("latitude and longitude need a datum (--datum)");
    const Frame::Metres metres = options.frame->forward(place);
    at.x_m = metres.x_m;
    at.y_m = metres.y_m;
}

}  // namespace seautils::position
