#include "seautils/queue/priority.hpp"

#include <utility>

namespace seautils::queue {

namespace {

__extension__ using Wide = unsigned __int128;

/// A whole number of 192 bits.
struct Product {
    Wide high;          ///< in units of 2^64
    std::uint64_t low;  ///< less than that
    auto operator<=>(const Product&) const = default;
};

Product multiply(Wide a, std::uint64_t b) {
    const Wide low = Wide{static_cast<std::uint64_t>(a)} * b;
    const Wide high = (a >> 64) * b + (low >> 64);
    return {high, static_cast<std::uint64_t>(low)};
}

/// The order in which claims are told apart before any number is looked at.
int rank(const Claim& c) {
    if (c.value_e6 == 0) return 0;
    return 1 + (c.ttl_ns != 0 ? 1 : 0) + (c.waited_ns > 0 ? 2 : 0);
}

/// A claim within its rank: numerator / denominator.
std::pair<Wide, std::uint64_t> fraction(const Claim& c) {
    const Wide waited = c.waited_ns > 0 ? static_cast<std::uint64_t>(c.waited_ns) : 1;
    return {c.value_e6 * waited, c.ttl_ns != 0 ? static_cast<std::uint64_t>(c.ttl_ns) : 1};
}

std::strong_ordering compare_priority(const Claim& a, const Claim& b) {
    if (rank(a) != rank(b) || rank(a) == 0) return rank(a) <=> rank(b);
    const auto [p, q] = fraction(a);
    const auto [r, s] = fraction(b);
    return multiply(p, s) <=> multiply(r, q);
}

std::strong_ordering compare_ttl(const Claim& a, const Claim& b) {
    const bool infinite = a.ttl_ns == 0 || b.ttl_ns == 0;
    return infinite ? a.ttl_ns <=> b.ttl_ns : b.ttl_ns <=> a.ttl_ns;
}

}  // namespace

std::optional<Policy> parse_policy(std::string_view name) {
    if (name == "priority") return Policy::priority;
    if (name == "value") return Policy::value;
    if (name == "ttl") return Policy::ttl;
    if (name == "oldest") return Policy::oldest;
    return {};
}

std::strong_ordering compare(Policy policy, const Claim& a, const Claim& b) {
    switch (policy) {
        case Policy::value:
            return a.value_e6 <=> b.value_e6;
        case Policy::ttl:
            return compare_ttl(a, b);
        case Policy::oldest:
            return a.waited_ns <=> b.waited_ns;
        case Policy::priority:
            break;
    }
    return compare_priority(a, b);
}

double priority(const Claim& claim) {
    if (claim.ttl_ns == 0) return 0;
    return static_cast<double>(claim.value_e6) / 1e6 * static_cast<double>(claim.waited_ns) /
           static_cast<double>(claim.ttl_ns);
}

}  // namespace seautils::queue
