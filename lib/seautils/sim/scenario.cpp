#include "seautils/sim/scenario.hpp"

#include "seautils/sim/scenario_values.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace seautils::sim {

namespace {

constexpr std::size_t max_bytes = 1U << 20;
constexpr std::size_t max_nodes = 30, max_transponders = 16;
constexpr std::int64_t last_us = 7'258'118'400'000'000;  ///< the year 2200

/// Where something is, as the keys of a section say it.
struct Place {
    std::optional<double> x_m, y_m, depth_m, latitude_deg, longitude_deg;
    std::string track;
    std::size_t track_line = 0;
    bool track_is_utc = false;
};

/// What is known of a scenario while it is read.
class Reader {
public:
    Reader(std::string name, Time now, const ReadFile& read) : name_(std::move(name)), read_(read) {
        scenario_.epoch = now;
        defaults_.id = 0;
    }

    Scenario run(std::string_view text);

private:
    enum class Section { none, water, nodes, node, transponder };
    using Setter = std::function<void(std::string_view)>;

    void line(std::string_view line);
    void begin(std::string_view title);
    void begin_named(std::string_view kind, std::string_view name);
    void end();
    void set(std::string_view key, std::string_view value);
    std::map<std::string_view, Setter> keys();
    void water_keys(std::map<std::string_view, Setter>& keys);
    void node_keys(std::map<std::string_view, Setter>& keys, NodeSpec& node);
    void transponder_keys(std::map<std::string_view, Setter>& keys);
    void place_keys(std::map<std::string_view, Setter>& keys);
    void place_all();
    Track placed(const Place& place);
    Track tracked(const Place& place);
    void set_tl(const std::string& file);
    void set_origin(std::string_view value);
    void set_epoch(std::string_view value);
    void check();
    std::string file_text(const std::string& file) const;
    void located(const std::function<void()>& body) const;
    [[noreturn]] void fault(const std::string& what) const { throw ConfigError(what); }

    std::string name_;
    const ReadFile& read_;
    Scenario scenario_;
    NodeSpec defaults_;
    std::vector<Place> node_places_, transponder_places_;
    std::optional<Origin> origin_;
    std::size_t number_ = 0;  ///< of the line
    Section section_ = Section::none;
    std::set<std::string, std::less<>> seen_;   ///< keys of this section
    std::set<std::string, std::less<>> names_;  ///< of nodes and transponders
};

/// The name of a file as messages have it.
std::string shown(const std::string& file) { return printable(file, 200); }

Scenario Reader::run(std::string_view text) {
    if (text.size() > max_bytes) fault(name_ + ": longer than 1 MiB");
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        ++number_;
        located([&] { line(text.substr(0, end)); });
        text.remove_prefix(std::min(text.size(), end + 1));
    }
    located([&] { end(); });
    check();
    place_all();
    return std::move(scenario_);
}

void Reader::located(const std::function<void()>& body) const {
    try {
        body();
    } catch (const ConfigError& e) {
        throw ConfigError(fmt::format("{}:{}: {}", name_, number_, e.what()));
    }
}

void Reader::line(std::string_view line) {
    line = trim(line.substr(0, line.find('#')));
    if (line.empty()) return;
    if (line.front() == '[' && line.back() == ']')
        return begin(trim(line.substr(1, line.size() - 2)));
    const std::size_t equals = line.find('=');
    if (equals == line.npos) fault(quote(line) + " is neither 'key = value' nor '[section]'");
    set(trim(line.substr(0, equals)), trim(line.substr(equals + 1)));
}

void Reader::begin(std::string_view title) {
    end();
    seen_.clear();
    const std::size_t blank = std::min(title.find(' '), title.size());
    const std::string_view kind = title.substr(0, blank);
    const std::string_view name = trim(title.substr(blank));
    if (title == "water" || title == "nodes") {
        if (!names_.insert("[" + std::string(title)).second)
            fault("section [" + std::string(title) + "] stands twice");
        section_ = title == "water" ? Section::water : Section::nodes;
        return;
    }
    if (kind != "node" && kind != "transponder") {
        const std::string near = nearest(kind, {"water", "nodes", "node", "transponder"});
        fault("unknown section " + quote(title) +
              (near.empty() ? "" : " (did you mean '" + near + "'?)"));
    }
    begin_named(kind, name);
}

void Reader::begin_named(std::string_view kind, std::string_view name) {
    if (!is_name(name)) {
        fault(fmt::format("{} name {} is not 1 to 32 letters, digits, '-', '_' or '.'", kind,
                          quote(name)));
    }
    if (!names_.emplace(name).second) fault("name " + quote(name) + " is given twice");
    if (kind == "node") {
        if (scenario_.nodes.size() == max_nodes)
            fault(fmt::format("more than {} nodes", max_nodes));
        section_ = Section::node;
        scenario_.nodes.push_back(defaults_);
        scenario_.nodes.back().name = name;
        node_places_.emplace_back();
        return;
    }
    if (scenario_.transponders.size() == max_transponders)
        fault(fmt::format("more than {} transponders", max_transponders));
    section_ = Section::transponder;
    scenario_.transponders.emplace_back().name = name;
    transponder_places_.emplace_back();
}

/// Checks the section that ends.
void Reader::end() {
    if (section_ == Section::node) {
        const NodeSpec& node = scenario_.nodes.back();
        if (node.id == 0) fault("node " + quote(node.name) + " has no id");
        for (const NodeSpec& other : scenario_.nodes)
            if (&other != &node && other.id == node.id)
                fault(fmt::format("nodes {} and {} have the same id {}", quote(other.name),
                                  quote(node.name), node.id));
    }
    if (section_ == Section::transponder) {
        const TransponderSpec& t = scenario_.transponders.back();
        if (t.letter == 0 && (t.query_hz == 0 || t.reply_hz == 0))
            fault("transponder " + quote(t.name) +
                  " has neither a letter nor query_hz and reply_hz");
    }
    section_ = Section::none;
}

void Reader::set(std::string_view key, std::string_view value) {
    if (section_ == Section::none) fault("key " + quote(key) + " stands before any section");
    const auto all = keys();
    const auto found = all.find(key);
    if (found == all.end()) {
        std::vector<std::string> known;
        for (const auto& [name, setter] : all) known.emplace_back(name);
        const std::string near = nearest(key, known);
        fault("unknown key " + quote(key) +
              (near.empty() ? "" : " (did you mean '" + near + "'?)"));
    }
    if (!seen_.emplace(key).second) fault("key " + quote(key) + " stands twice");
    if (value.empty()) fault("key " + quote(key) + " has no value");
    found->second(value);
}

std::map<std::string_view, Reader::Setter> Reader::keys() {
    std::map<std::string_view, Setter> keys;
    if (section_ == Section::water) water_keys(keys);
    if (section_ == Section::nodes) node_keys(keys, defaults_);
    if (section_ == Section::transponder) transponder_keys(keys);
    if (section_ != Section::node) return keys;
    NodeSpec& node = scenario_.nodes.back();
    node_keys(keys, node);
    place_keys(keys);
    keys["id"] = [&node](std::string_view v) { node.id = whole("id", v, 1, 30); };
    return keys;
}

void Reader::water_keys(std::map<std::string_view, Setter>& keys) {
    WaterSpec& w = scenario_.water;
    keys["sound_speed_mps"] = [&w](auto v) {
        w.sound_speed_mps = number("sound_speed_mps", v, 1300, 1700, "m/s");
    };
    keys["max_range_m"] = [&w](auto v) { w.max_range_m = number("max_range_m", v, 1, 1e6, "m"); };
    keys["loss_by_range"] = [&w](auto v) { w.loss_by_range = loss_curve(v); };
    keys["loss"] = [&w](auto v) { w.loss = probability("loss", v); };
    keys["bad_crc"] = [&w](auto v) { w.bad_crc = probability("bad_crc", v); };
    keys["transmission_loss"] = [this](auto v) { set_tl(std::string(v)); };
    keys["source_level_db"] = [&w](auto v) {
        w.source_level_db = number("source_level_db", v, 50, 250, "dB");
    };
    keys["noise_db"] = [&w](auto v) { w.noise_db = number("noise_db", v, 0, 200, "dB"); };
    keys["threshold_db"] = [&w](auto v) { set_thresholds(w.threshold_db, v); };
    keys["seed"] = [this](auto v) { scenario_.seed = whole("seed", v, 0, UINT32_MAX); };
    keys["epoch"] = [this](auto v) { set_epoch(v); };
    keys["origin"] = [this](auto v) { set_origin(v); };
    keys["rates"] = [this](auto v) {
        const std::string file(v);
        scenario_.rates = RateTable::parse(file_text(file), shown(file));
    };
}

void Reader::node_keys(std::map<std::string_view, Setter>& keys, NodeSpec& n) {
    keys["modem"] = [&n](auto v) { n.generation = generation(v); };
    keys["firmware"] = [&n](auto v) { n.firmware = firmware(v); };
    keys["clock_offset_s"] = [&n](auto v) {
        n.clock_offset_s = number("clock_offset_s", v, -86400, 86400, "s");
    };
    keys["clock_drift_ppm"] = [&n](auto v) {
        n.clock_drift_ppm = number("clock_drift_ppm", v, -1000, 1000, "ppm");
    };
    keys["pps"] = [&n](auto v) { n.pps = yes_or_no("pps", v); };
    keys["nvram"] = [&n](auto v) { set_nvram(n.nvram, v); };
    keys["reboot_s"] = [&n](auto v) { n.reboot_s = reboot_times(v); };
    keys["boot_s"] = [&n](auto v) { n.boot_s = number("boot_s", v, 0, 60, "s"); };
    keys["baud"] = [&n](auto v) { n.baud = whole("baud", v, 1200, 1'000'000); };
}

void Reader::transponder_keys(std::map<std::string_view, Setter>& keys) {
    TransponderSpec& t = scenario_.transponders.back();
    place_keys(keys);
    keys["letter"] = [&t](auto v) {
        if (v.size() != 1 || v[0] < 'A' || v[0] > 'D')
            throw ConfigError("letter " + quote(v) + " is none of A, B, C, D");
        t.letter = v[0];
    };
    keys["query_hz"] = [&t](auto v) { t.query_hz = whole("query_hz", v, 1, 200'000, "Hz"); };
    keys["reply_hz"] = [&t](auto v) { t.reply_hz = whole("reply_hz", v, 1, 200'000, "Hz"); };
    keys["turn_around_ms"] = [&t](auto v) {
        t.turn_around_ms = number("turn_around_ms", v, 0, 10'000, "ms");
    };
}

void Reader::place_keys(std::map<std::string_view, Setter>& keys) {
    Place& p = section_ == Section::node ? node_places_.back() : transponder_places_.back();
    keys["x_m"] = [&p](auto v) { p.x_m = number("x_m", v, -1e6, 1e6, "m"); };
    keys["y_m"] = [&p](auto v) { p.y_m = number("y_m", v, -1e6, 1e6, "m"); };
    keys["depth_m"] = [&p](auto v) { p.depth_m = number("depth_m", v, -1000, 12000, "m"); };
    keys["latitude_deg"] = [&p](auto v) { p.latitude_deg = number("latitude_deg", v, -89, 89); };
    keys["longitude_deg"] = [&p](auto v) {
        p.longitude_deg = number("longitude_deg", v, -180, 180);
    };
    keys["track"] = [this, &p](auto v) {
        p.track = v;
        p.track_line = number_;
    };
    keys["track_time"] = [&p](auto v) {
        if (v != "start" && v != "utc")
            throw ConfigError("track_time " + quote(v) + " is neither start nor utc");
        p.track_is_utc = v == "utc";
    };
}

void Reader::set_origin(std::string_view value) {
    const auto words = split(value, ',');
    if (words.size() != 2)
        fault("origin " + quote(value) + " is not of the form LATITUDE, LONGITUDE");
    origin_ = Origin{number("latitude", words[0], -89, 89, "degrees"),
                     number("longitude", words[1], -180, 180, "degrees")};
}

void Reader::set_epoch(std::string_view value) {
    try {
        const std::int64_t epoch_us = parse_utc(value);
        if (epoch_us > last_us) fault("epoch " + quote(value) + " is after the year 2200");
        scenario_.epoch = epoch_us * 1000;
    } catch (const DataError& e) {
        fault(std::string("epoch: ") + e.what());
    }
}

void Reader::set_tl(const std::string& file) {
    const std::string text = file_text(file);
    Csv csv(shown(file), text);
    const int range = csv.column({"range_m"}), loss = csv.column({"tl_db"});
    if (range < 0 || loss < 0) fault(shown(file) + ": no columns 'range_m' and 'tl_db'");
    std::vector<std::pair<double, double>> points;
    std::vector<std::string_view> values;
    while (csv.next(values)) {
        try {
            points.emplace_back(
                number("range_m", values[static_cast<std::size_t>(range)], 0, 1e6, "m"),
                number("tl_db", values[static_cast<std::size_t>(loss)], -50, 400, "dB"));
        } catch (const ConfigError& e) {
            csv.fault(e.what());
        }
        if (points.size() > max_points) csv.fault(fmt::format("more than {} rows", max_points));
    }
    try {
        scenario_.water.tl_db = Curve(std::move(points));
    } catch (const ConfigError& e) {
        fault(shown(file) + ": " + e.what());
    }
}

std::string Reader::file_text(const std::string& file) const { return read_(file); }

void Reader::check() {
    if (scenario_.nodes.empty()) fault(name_ + ": no section [node NAME]");
    std::set<char> letters;
    for (const TransponderSpec& t : scenario_.transponders) {
        if (t.letter != 0 && !letters.insert(t.letter).second)
            fault(fmt::format("{}: two transponders have the letter {}", name_, t.letter));
    }
}

/// Positions come last: the epoch and the origin may stand anywhere.
void Reader::place_all() {
    for (std::size_t k = 0; k < scenario_.nodes.size(); ++k) {
        try {
            scenario_.nodes[k].track = placed(node_places_[k]);
        } catch (const ConfigError& e) {
            fault(fmt::format("{}: node {}: {}", name_, quote(scenario_.nodes[k].name), e.what()));
        }
    }
    for (std::size_t k = 0; k < scenario_.transponders.size(); ++k) {
        TransponderSpec& t = scenario_.transponders[k];
        try {
            t.track = placed(transponder_places_[k]);
        } catch (const ConfigError& e) {
            fault(fmt::format("{}: transponder {}: {}", name_, quote(t.name), e.what()));
        }
    }
}

Track Reader::placed(const Place& p) {
    const bool plane = p.x_m || p.y_m, globe = p.latitude_deg || p.longitude_deg;
    if (plane + globe + !p.track.empty() > 1 || (p.depth_m && !p.track.empty()))
        fault(
            "says where it is in two ways: x_m and y_m, latitude_deg and longitude_deg, or track");
    if (!p.track.empty()) return tracked(p);
    if (plane && !(p.x_m && p.y_m)) fault("has only one of x_m and y_m");
    if (globe && !(p.latitude_deg && p.longitude_deg))
        fault("has only one of latitude_deg and longitude_deg");
    if (!plane && !globe) fault("does not say where it is: x_m and y_m, or track");
    const double depth_m = p.depth_m.value_or(0);
    if (plane) return Track(Position{*p.x_m, *p.y_m, depth_m});
    if (!origin_) origin_ = Origin{*p.latitude_deg, *p.longitude_deg};
    return Track(origin_->position(*p.latitude_deg, *p.longitude_deg, depth_m));
}

Track Reader::tracked(const Place& p) {
    std::optional<Time> start;
    if (!p.track_is_utc) start = scenario_.epoch;
    return read_track(shown(p.track), file_text(p.track), start, origin_);
}

}  // namespace

Scenario parse_scenario(const std::string& name, std::string_view text, Time now,
                        const ReadFile& read) {
    return Reader(name, now, read).run(text);
}

}  // namespace seautils::sim
