#include "seautils/tdma/rule.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/random.hpp"
#include "seautils/core/text.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace seautils::tdma {

namespace {

constexpr std::array<std::pair<std::string_view, Rule>, 5> rules{{{"hash", Rule::hash},
                                                                  {"goby1", Rule::goby1},
                                                                  {"eq", Rule::eq},
                                                                  {"eqn", Rule::eqn},
                                                                  {"rot", Rule::rot}}};

std::uint64_t scattered(int address) {
    return splitmix64(static_cast<std::uint64_t>(address) * 0x1000193);
}

std::size_t hashed_place(std::uint64_t n, std::uint32_t coolness, const World& world) {
    const std::uint64_t h = splitmix64(splitmix64(n) ^ world.hash());
    return h % coolness == 0 ? (h >> 32) % world.size() : world.size();
}

}  // namespace

bool World::knows(int address) const {
    return std::binary_search(addresses_.begin(), addresses_.end(), address);
}

bool World::add(int address) {
    const auto at = std::lower_bound(addresses_.begin(), addresses_.end(), address);
    if (at != addresses_.end() && *at == address) return false;
    addresses_.insert(at, address);
    sum_ += static_cast<std::uint64_t>(address);
    hash_ ^= scattered(address);
    return true;
}

bool World::remove(int address) {
    if (!knows(address)) return false;
    addresses_.erase(std::lower_bound(addresses_.begin(), addresses_.end(), address));
    sum_ -= static_cast<std::uint64_t>(address);
    hash_ ^= scattered(address);
    return true;
}

Rule parse_rule(std::string_view name) {
    for (const auto& [known, rule] : rules)
        if (known == name) return rule;
    throw DataError("rule " + quote(name) + " is none of hash, goby1, eq, eqn, rot");
}

std::size_t blank_place(const Excitation& excitation, std::uint64_t n, const World& world) {
    if (excitation.rule == Rule::hash) return hashed_place(n, excitation.coolness, world);
    const std::size_t last = world.size();
    const bool excited = n % excitation.coolness == world.sum() % excitation.coolness;
    switch (excitation.rule) {
        case Rule::eq:
            return excited ? last : last - 1 - n % last;
        case Rule::eqn:
            return excited ? last : last - n % (last + 1);
        case Rule::rot:
            return excited ? last - 1 - n % last : last;
        default:  // goby1
            return excited ? last - 1 : last;
    }
}

int speaker(const Excitation& excitation, std::uint64_t n, std::size_t place, const World& world) {
    const std::size_t blank = blank_place(excitation, n, world);
    if (place == blank) return 0;
    return world.addresses()[place - (place > blank ? 1 : 0)];
}

std::uint64_t period_slots(const Excitation& excitation, std::uint64_t slots) {
    const std::uint64_t c = excitation.coolness;
    switch (excitation.rule) {
        case Rule::hash:
            return 0;
        case Rule::goby1:
            return slots * c;
        case Rule::eqn:
            return slots * std::lcm(slots, c);
        default:  // eq, rot
            return slots * std::lcm(slots - 1, c);
    }
}

}  // namespace seautils::tdma
