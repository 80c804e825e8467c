#ifndef SEAUTILS_QUEUE_CONFIG_HPP
#define SEAUTILS_QUEUE_CONFIG_HPP

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::queue {

/// What names a queue: a DCCL id (0 to 32767) and a modem ID (1 to 30; 0: everybody).
struct QueueKey {
    std::uint32_t id = 0;
    std::uint32_t dest = 0;
    auto operator<=>(const QueueKey&) const = default;
};

/// How a queue behaves. The defaults are those of Goby's queues.
struct QueueConfig {
    bool ack = true;                ///< ask for an acknowledgement where the message does not say
    std::int64_t blackout_ns = 0;   ///< least time between two messages of this queue
    std::uint32_t max_queue = 100;  ///< messages, waiting or under way; at least 1
    bool newest_first = true;       ///< and the oldest is dropped when there are too many; else
                                    ///< oldest first, and the new one is dropped
    std::int64_t ttl_ns =
        1800 * ns_per_s;  ///< age at which a message is worth nothing; 0: infinite
    std::uint64_t value_base_e6 = 1'000'000;  ///< value_base in millionths

    static constexpr std::int64_t ns_per_s = 1'000'000'000;
    bool is_infinite() const { return ttl_ns == 0; }
    bool operator==(const QueueConfig&) const = default;
};

/// What one section of a configuration says of its queues; the rest stays as it is.
class QueueSettings {
public:
    /// @param key    `ack`, `blackout_time_s`, `max_queue`, `newest_first`, `ttl_s`, `value_base`
    /// @param value  true or false; 0 to 1e9 s; 1 to 1,000,000 messages; true or false; more than 0
    ///               to 1e9 s, or `infinite`; 0 to 1,000,000. Decimal, without exponent; seconds
    ///               with at most 9 decimals, value_base with at most 6: they are kept exactly.
    /// @throws ConfigError  an unknown key (proposes the nearest), or a value that is none of these;
    ///                      quotes it with what it may be
    void set(std::string_view key, std::string_view value);

    void apply(QueueConfig& config) const;

private:
    std::optional<bool> ack_, newest_first_;
    std::optional<std::int64_t> blackout_ns_, ttl_ns_;
    std::optional<std::uint32_t> max_queue_;
    std::optional<std::uint64_t> value_base_e6_;
};

/// The configuration of all queues: settings for all, over them those of a DCCL id, over them those
/// of an id with a destination.
class QueueConfigs {
public:
    /// Sets a key of one section. As QueueSettings::set says.
    /// @param section  empty for all queues; `12` for DCCL id 12; `12.3` for id 12 to modem 3
    /// @throws ConfigError  also: no such section
    void set(std::string_view section, std::string_view key, std::string_view value);

    QueueConfig of(QueueKey key) const;

private:
    QueueSettings all_;
    std::map<std::uint32_t, QueueSettings> ids_;
    std::map<QueueKey, QueueSettings> keys_;
};

/// A decimal number as a whole number of its last decimal: 1.5 with 3 decimals is 1500.
/// @param decimals  at most so many; 0 to 9
/// @return          nothing: no digits, another character, too many decimals, more than 18 digits
std::optional<std::int64_t> parse_decimal(std::string_view text, unsigned decimals);

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_CONFIG_HPP
