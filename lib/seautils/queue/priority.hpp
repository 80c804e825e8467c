#ifndef SEAUTILS_QUEUE_PRIORITY_HPP
#define SEAUTILS_QUEUE_PRIORITY_HPP

#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>

namespace seautils::queue {

/// What decides a contest.
enum class Policy {
    priority,  ///< the greatest value_base · (now − last) / ttl
    value,     ///< the greatest value_base
    ttl,       ///< the shortest ttl
    oldest,    ///< the longest not served
};

/// `priority`, `value`, `ttl` or `oldest`; nothing for another word.
std::optional<Policy> parse_policy(std::string_view name);

/// What a queue brings to a contest.
struct Claim {
    std::uint64_t value_e6 = 0;  ///< value_base in millionths, up to 10^12
    std::int64_t ttl_ns = 0;     ///< more than 0; 0: infinite
    std::int64_t waited_ns = 0;  ///< since a message of it was handed over last; not negative
};

/// Which of two claims is greater, exactly: whole numbers of up to 192 bits, cross-multiplied.
///
/// The priority V·Δt/ttl is 0 for many: a queue that has been served at this instant (Δt = 0) and
/// one whose ttl is infinite. Those stand behind every queue that has a priority, and are told
/// apart by what is left: first infinite ones that have waited, by V·Δt; then served ones, by V/ttl;
/// then served infinite ones, by V. A value of 0 stands behind all.
///
/// Equal claims are told apart by the caller: the lowest DCCL id wins, then the lowest destination.
///
/// Source: T. Schneider, PhD thesis, MIT/WHOI 2013, eq. 2.1, after which a queue's priority is
/// P = V · (t − t_last) / ttl.
std::strong_ordering compare(Policy policy, const Claim& a, const Claim& b);

/// value_base · waited_s / ttl_s for people, rounded; 0 where the ttl is infinite.
double priority(const Claim& claim);

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_PRIORITY_HPP
