#ifndef SEAUTILS_TDMA_RULE_HPP
#define SEAUTILS_TDMA_RULE_HPP

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace seautils::tdma {

inline constexpr int max_address = 127;  ///< of vehicles that find each other; modems use 1 to 30
inline constexpr std::uint32_t max_coolness = 1'000'000;

/// The vehicles that one vehicle knows of, itself among them.
class World {
public:
    explicit World(int address) { add(address); }

    /// @param address  1 to max_address. @return whether it is new
    bool add(int address);
    /// @return whether it was known
    bool remove(int address);
    bool knows(int address) const;

    const std::vector<int>& addresses() const { return addresses_; }  ///< ascending
    std::size_t size() const { return addresses_.size(); }
    /// Slots of its cycle: one for each vehicle, and a blank one.
    std::size_t slots() const { return size() + 1; }
    std::uint64_t sum() const { return sum_; }    ///< of the addresses
    std::uint64_t hash() const { return hash_; }  ///< W of Rule::hash

    bool operator==(const World& other) const { return addresses_ == other.addresses_; }

private:
    std::vector<int> addresses_;
    std::uint64_t sum_ = 0;
    std::uint64_t hash_ = 0;
};

/// How the blank slot's place is found in each cycle, so that vehicles that do not know of each
/// other sooner or later listen while the other speaks. `n` is the number of the cycle, K the
/// number of vehicles, N = K + 1 that of slots, S the sum of the addresses. In "excited" cycles,
/// about one in C (the coolness), the blank slot leaves its usual place:
///
/// | rule  | excited if       | usual place               | excited place             |
/// |-------|------------------|---------------------------|---------------------------|
/// | hash  | h mod C = 0      | last                      | (h >> 32) mod K           |
/// | goby1 | n mod C = S mod C | last                     | last but one              |
/// | eq    | n mod C = S mod C | N-2 - n mod (N-1)        | last                      |
/// | eqn   | n mod C = S mod C | N-1 - n mod N            | last                      |
/// | rot   | n mod C = S mod C | last                     | N-2 - n mod (N-1)         |
///
/// with h = splitmix64(splitmix64(n) xor W), W the exclusive or of splitmix64(a · 0x1000193) over
/// the addresses a. The sums of two worlds may be equal modulo C, and then those rules excite them
/// together for ever; `hash` has no such pairs. `goby1` is the rule of Goby 1 (2010) and of table
/// 2.7 of T. Schneider's thesis (2013); `eq` and `eqn` are two readings of its equations 2.6 and
/// 2.7; `rot` is `eq` with the two cases exchanged.
enum class Rule { hash, goby1, eq, eqn, rot };

/// @throws DataError  no such rule
Rule parse_rule(std::string_view name);

struct Excitation {
    Rule rule = Rule::hash;
    std::uint32_t coolness = 2;  ///< C, 1 to max_coolness; 1: always excited
};

/// Where in its cycle number `n` a world's blank slot is, 0 to world.size().
std::size_t blank_place(const Excitation& excitation, std::uint64_t n, const World& world);

/// Whose the slot is at `place` of cycle `n`; 0: nobody's.
int speaker(const Excitation& excitation, std::uint64_t n, std::size_t place, const World& world);

/// Slots after which the cycles of a world of `slots` slots repeat themselves; 0: never (hash).
std::uint64_t period_slots(const Excitation& excitation, std::uint64_t slots);

}  // namespace seautils::tdma

#endif  // SEAUTILS_TDMA_RULE_HPP
