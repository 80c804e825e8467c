#include "seautils/sim/scenario_values.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seautils::sim {

namespace {

/// `A:B, A:B`: the words on both sides of each colon.
std::vector<std::pair<std::string_view, std::string_view>> pairs(std::string_view what,
                                                                 std::string_view text) {
    std::vector<std::pair<std::string_view, std::string_view>> all;
    for (const std::string_view word : split(text, ',')) {
        const std::size_t colon = word.find(':');
        if (colon == word.npos)
            throw ConfigError(fmt::format("{} {} is not of the form A:B, A:B", what, quote(word)));
        all.emplace_back(trim(word.substr(0, colon)), trim(word.substr(colon + 1)));
    }
    if (all.size() > max_points)
        throw ConfigError(fmt::format("{} has more than {} points", what, max_points));
    return all;
}

/// A name of the modem's memory or its value, as a sentence can say them.
bool is_field(std::string_view text) {
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
        return c > ' ' && c < 127 && c != '*' && c != '$' && c != '!' && c != ',';
    });
}

}  // namespace

double probability(std::string_view what, std::string_view text) {
    return number(what, text, 0, 1);
}

unsigned whole(std::string_view what, std::string_view text, unsigned least, unsigned most,
               std::string_view unit) {
    const double value = number(what, text, least, most, unit);
    if (value != std::floor(value))
        throw ConfigError(fmt::format("{} {} is not a whole number", what, quote(text)));
    return static_cast<unsigned>(value);
}

bool yes_or_no(std::string_view what, std::string_view text) {
    if (text == "yes" || text == "true") return true;
    if (text == "no" || text == "false") return false;
    throw ConfigError(fmt::format("{} {} is neither yes nor no", what, quote(text)));
}

Curve loss_curve(std::string_view text) {
    std::vector<std::pair<double, double>> points;
    for (const auto& [range, loss] : pairs("loss_by_range", text)) {
        points.emplace_back(number("range", range, 0, 1e6, "m"), probability("loss", loss));
    }
    return Curve(std::move(points));
}

void set_thresholds(std::array<double, rate_count>& thresholds, std::string_view text) {
    for (const auto& [rate, snr] : pairs("threshold_db", text))
        thresholds[whole("rate", rate, 0, rate_count - 1)] =
            number("threshold", snr, -50, 100, "dB");
}

bool is_name(std::string_view name) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    return !name.empty() && name.size() <= 32 && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(),
                       [&](char c) { return is_letter(c) || c == '-' || c == '_' || c == '.'; });
}

std::string firmware(std::string_view text) {
    if (!is_field(text))
        throw ConfigError("firmware " + quote(text) + " cannot be said in a sentence");
    return std::string(text);
}

void set_nvram(std::map<std::string, std::string>& nvram, std::string_view text) {
    for (const auto& [key, value] : pairs("nvram", text)) {
        if (!is_field(key) || !is_field(value))
            throw ConfigError(
                fmt::format("nvram {}:{} cannot be said in a sentence", quote(key), quote(value)));
        nvram[std::string(key)] = value;
    }
    if (nvram.size() > 200) throw ConfigError("nvram has more than 200 names");
}

std::vector<double> reboot_times(std::string_view text) {
    std::vector<double> times;
    for (const std::string_view word : split(text, ',')) {
        times.push_back(number("reboot_s", word, 0, 1e8, "s"));
        if (times.size() > 1 && times.back() <= times[times.size() - 2])
            throw ConfigError(
                fmt::format("reboot_s {} does not come after the one before", quote(word)));
    }
    return times;
}

Generation generation(std::string_view text) {
    if (text == "mm1") return Generation::mm1;
    if (text == "mm2") return Generation::mm2;
    throw ConfigError(fmt::format("modem {} is neither mm1 nor mm2", quote(text)));
}

}  // namespace seautils::sim
