#ifndef SEAUTILS_TDMA_DISCOVERY_HPP
#define SEAUTILS_TDMA_DISCOVERY_HPP

#include "seautils/tdma/cycle.hpp"
#include "seautils/tdma/rule.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::tdma {

inline constexpr std::int64_t default_silence_ns = 1800 * second_ns;

/// What vehicles that find each other must have in common, but for the address and the rate.
struct DiscoveryOptions {
    int address = 1;  ///< this vehicle's modem ID, 1 to max_modem_id
    int rate = 0;     ///< of its own slots, and assumed of the others'
    Excitation excitation;
    Origin origin;
    std::int64_t slot_ns = 15 * second_ns;  ///< min_slot_ns to max_slot_ns
    std::int64_t guard_ns = 0;              ///< less than slot_ns
    /// Who is silent for so long is forgotten; slot_ns to max_cycle_ns. The same instant for all
    /// that heard the last of it, however long their own cycles are.
    std::int64_t silence_ns = default_silence_ns;
};

/// Another vehicle, and the end of the slot in which it was last heard.
struct Heard {
    int address;
    std::int64_t until_ns;

    bool operator==(const Heard&) const = default;
};

/// What a vehicle keeps over a restart, so that it takes its turns again at once.
struct Memory {
    std::vector<Heard> others;   ///< by address
    std::int64_t resume_ns = 0;  ///< when it takes its turns again

    bool operator==(const Memory&) const = default;
};

/// A few lines of text, with a check of their bytes.
std::string to_text(const Memory& memory);

/// @throws DataError  the text is cut, was altered, or is none of to_text's
Memory parse_memory(std::string_view text);

/// Finds out whose turn it is from who is heard, without any message of its own: the live twin of
/// Network, for clocks of nanoseconds.
///
/// The cycle has a slot for each vehicle known, this one among them, by address, and a blank one
/// whose place Excitation tells; all slots are equally long. Whoever is new makes the cycle longer,
/// who falls silent makes it shorter; both let the vehicle pause until the first cycle of the new
/// length that begins strictly after the end of the slot under way.
class Discovery {
public:
    /// A vehicle that knows of nobody takes its turns from its first cycle on that begins at
    /// `now_ns` or later.
    /// @throws ConfigError  an option is out of its range
    Discovery(const DiscoveryOptions& options, std::int64_t now_ns);

    /// A vehicle that was away. What of its memory lies in the future, by a clock that was wrong,
    /// counts as of now.
    Discovery(const DiscoveryOptions& options, const Memory& memory, std::int64_t now_ns);

    /// Somebody was heard.
    /// @param address  whoever; 0 (nobody), this vehicle and those above max_modem_id do not count
    /// @param time_ns  when; earlier than what was heard since is fine, but for one who would have
    ///                 been forgotten by now: that does not count
    /// @return         whether it is new
    bool hear(int address, std::int64_t time_ns);

    /// Forgets who is silent for too long. @return whether anybody was
    bool advance(std::int64_t time_ns);

    /// The clock was set: `now_ns` is what it says now, `by_ns` more than it would have said.
    void clock_stepped(std::int64_t by_ns, std::int64_t now_ns);

    /// The first turn that begins at `time_ns` or later, if nobody new is heard before it.
    Turn next(std::int64_t time_ns) const;

    const World& world() const { return world_; }
    /// When this vehicle takes its turns (again).
    std::int64_t resume_ns() const { return resume_ns_; }
    Memory memory() const { return {others_, resume_ns_}; }

private:
    std::int64_t cycle_ns() const;
    std::int64_t slot_end(std::int64_t time_ns) const;
    std::int64_t expiry(const Heard& heard) const;
    std::optional<std::int64_t> first_expiry() const;
    void forget(std::int64_t expired_ns);
    void pause(std::int64_t slot_end_ns);
    void pull_back(std::int64_t now_ns);
    Turn turn_from(std::int64_t time_ns) const;

    DiscoveryOptions options_;
    World world_;
    std::vector<Heard> others_;
    std::int64_t resume_ns_;
    std::int64_t now_ns_;  ///< the latest instant that was told
};

}  // namespace seautils::tdma

#endif  // SEAUTILS_TDMA_DISCOVERY_HPP
