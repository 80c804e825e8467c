#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/tdma/cycle.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <map>
#include <string>
#include <utility>

namespace seautils::tdma {

namespace {

constexpr std::array<std::pair<std::string_view, Kind>, 5> kinds{{{"data", Kind::data},
                                                                  {"ping", Kind::ping},
                                                                  {"lbl", Kind::lbl},
                                                                  {"mini", Kind::mini},
                                                                  {"blank", Kind::blank}}};

Kind parse_kind(std::string_view text) {
    for (const auto& [name, kind] : kinds)
        if (name == text) return kind;
    throw DataError("kind " + quote(text) + " is none of data, ping, lbl, mini, blank");
}

int parse_number(std::string_view key, std::string_view text, int most) {
    int number = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 0 || number > most)
        throw DataError(fmt::format("{} {} is outside 0 to {}", key, quote(text), most));
    return number;
}

using Words = std::map<std::string_view, std::string_view>;

Words words_of(std::string_view text) {
    Words words;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of(", \t"), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (word.empty()) continue;
        const std::size_t sign = word.find('=');
        if (sign == word.npos) throw DataError(quote(word) + " is not of the form key=value");
        if (!words.emplace(word.substr(0, sign), word.substr(sign + 1)).second)
            throw DataError(quote(word.substr(0, sign)) + " is given twice");
    }
    return words;
}

void set(Slot& slot, std::string_view key, std::string_view value) {
    if (key == "src") {
        slot.src = parse_number(key, value, max_modem_id);
    } else if (key == "dest") {
        slot.dest = parse_number(key, value, max_modem_id);
    } else if (key == "rate") {
        slot.rate = parse_number(key, value, max_rate);
    } else if (key == "mini") {
        slot.mini = parse_number(key, value, max_mini);
    } else if (key == "kind") {
        slot.kind = parse_kind(value);
    } else if (key == "length") {
        slot.length_ns = parse_seconds_ns(value);
        if (slot.length_ns < min_slot_ns || slot.length_ns > max_slot_ns)
            throw DataError(fmt::format("length {} is outside 0.001 to 86400 s", quote(value)));
    } else {
        throw DataError(quote(key) + " is none of src, dest, rate, length, kind, mini");
    }
}

void check(const Slot& slot, const Words& words) {
    const bool blank = slot.kind == Kind::blank;
    if (slot.src == 0 && !blank) throw DataError("nobody speaks in a slot without src");
    if (slot.src != 0 && blank) throw DataError("a blank slot has no src");
    if (blank && slot.dest) throw DataError("a blank slot has no dest");
    if (slot.kind == Kind::ping && slot.dest.value_or(0) == 0)
        throw DataError("a ping needs a dest, 1 to 30");
    if (slot.dest && *slot.dest != 0 && *slot.dest == slot.src)
        throw DataError(fmt::format("src and dest are both {}", slot.src));
    if (words.contains("mini") && slot.kind != Kind::mini)
        throw DataError("mini is for slots of kind mini");
}

}  // namespace

Slot parse_slot(std::string_view text) {
    const Words words = words_of(text);
    if (words.empty()) throw DataError("a slot says at least its length");
    Slot slot;
    for (const auto& [key, value] : words) set(slot, key, value);
    if (slot.src == 0 && !words.contains("kind")) slot.kind = Kind::blank;
    check(slot, words);
    return slot;
}

}  // namespace seautils::tdma
