#include "seautils/queue/config.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace seautils::queue {

namespace {

constexpr unsigned most_digits = 18;  ///< of which any number fits into 64 bits
constexpr std::int64_t most_s = 1'000'000'000;
constexpr std::int64_t most_messages = 1'000'000;
constexpr std::int64_t most_value = 1'000'000;
constexpr std::uint32_t most_id = 32767;
constexpr std::uint32_t most_dest = 30;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

[[noreturn]] void refuse(std::string_view key, std::string_view value, std::string_view may_be) {
    throw ConfigError(fmt::format("{} {} is not {}", key, quote(value), may_be));
}

bool parse_bool(std::string_view key, std::string_view text) {
    if (text != "true" && text != "false") refuse(key, text, "true or false");
    return text == "true";
}

/// A decimal within bounds, in units of its last decimal.
std::int64_t parse_within(std::string_view key, std::string_view text, unsigned decimals,
                          std::int64_t least, std::int64_t most, std::string_view may_be) {
    const auto value = parse_decimal(text, decimals);
    if (!value || *value < least || *value > most) refuse(key, text, may_be);
    return *value;
}

std::int64_t parse_ttl_ns(std::string_view key, std::string_view text) {
    if (text == "infinite") return 0;
    return parse_within(key, text, 9, 1, most_s * QueueConfig::ns_per_s,
                        "more than 0 and at most 1000000000 s, or infinite");
}

/// A whole number of a section's name.
std::optional<std::uint32_t> parse_number(std::string_view text, std::uint32_t most) {
    const auto value = parse_decimal(text, 0);
    if (!value || *value > most || (text.size() > 1 && text.front() == '0')) return {};
    return static_cast<std::uint32_t>(*value);
}

}  // namespace

std::optional<std::int64_t> parse_decimal(std::string_view text, unsigned decimals) {
    std::int64_t value = 0;
    unsigned digits = 0;
    const auto take = [&](char c) {
        if (!is_digit(c) || ++digits > most_digits) return false;
        value = value * 10 + (c - '0');
        return true;
    };
    const std::size_t point = std::min(text.find('.'), text.size());
    const std::string_view whole = text.substr(0, point);
    const std::string_view fraction = text.substr(std::min(point + 1, text.size()));
    if (whole.empty() || fraction.size() > decimals || text.ends_with('.')) return {};
    if (!std::all_of(whole.begin(), whole.end(), take)) return {};
    if (!std::all_of(fraction.begin(), fraction.end(), take)) return {};
    for (std::size_t k = fraction.size(); k < decimals; ++k) {
        if (!take('0')) return {};
    }
    return value;
}

void QueueSettings::set(std::string_view key, std::string_view value) {
    static const std::vector<std::string> keys{"ack",          "blackout_time_s", "max_queue",
                                               "newest_first", "ttl_s",           "value_base"};
    if (key == "ack") {
        ack_ = parse_bool(key, value);
    } else if (key == "newest_first") {
        newest_first_ = parse_bool(key, value);
    } else if (key == "ttl_s") {
        ttl_ns_ = parse_ttl_ns(key, value);
    } else if (key == "blackout_time_s") {
        blackout_ns_ = parse_within(key, value, 9, 0, most_s * QueueConfig::ns_per_s,
                                    "0 to 1000000000 s, with at most 9 decimals");
    } else if (key == "max_queue") {
        max_queue_ = static_cast<std::uint32_t>(
            parse_within(key, value, 0, 1, most_messages, "1 to 1000000 messages"));
    } else if (key == "value_base") {
        value_base_e6_ = static_cast<std::uint64_t>(parse_within(
            key, value, 6, 0, most_value * 1'000'000, "0 to 1000000, with at most 6 decimals"));
    } else {
        const std::string near = nearest(key, keys);
        throw ConfigError(fmt::format("unknown key {}{}", quote(key),
                                      near.empty() ? "" : " (did you mean '" + near + "'?)"));
    }
}

void QueueSettings::apply(QueueConfig& config) const {
    config.ack = ack_.value_or(config.ack);
    config.blackout_ns = blackout_ns_.value_or(config.blackout_ns);
    config.max_queue = max_queue_.value_or(config.max_queue);
    config.newest_first = newest_first_.value_or(config.newest_first);
    config.ttl_ns = ttl_ns_.value_or(config.ttl_ns);
    config.value_base_e6 = value_base_e6_.value_or(config.value_base_e6);
}

void QueueConfigs::set(std::string_view section, std::string_view key, std::string_view value) {
    if (section.empty()) return all_.set(key, value);
    const std::size_t point = std::min(section.find('.'), section.size());
    const auto id = parse_number(section.substr(0, point), most_id);
    const bool has_dest = point < section.size();
    const auto dest = parse_number(has_dest ? section.substr(point + 1) : "0", most_dest);
    if (!id || !dest) {
        throw ConfigError(
            fmt::format("{} names no queue: a DCCL id of 0 to 32767, or that, a point, and a modem "
                        "ID of 0 to 30",
                        quote(section)));
    }
    QueueSettings& settings = has_dest ? keys_[{*id, *dest}] : ids_[*id];
    settings.set(key, value);
}

QueueConfig QueueConfigs::of(QueueKey key) const {
    QueueConfig config;
    all_.apply(config);
    if (const auto found = ids_.find(key.id); found != ids_.end()) found->second.apply(config);
    if (const auto found = keys_.find(key); found != keys_.end()) found->second.apply(config);
    return config;
}

}  // namespace seautils::queue
