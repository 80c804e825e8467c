#ifndef SEAUTILS_TDMA_CYCLE_HPP
#define SEAUTILS_TDMA_CYCLE_HPP

#include "seautils/tdma/grid.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace seautils::tdma {

inline constexpr int max_modem_id = 30;
inline constexpr int max_rate = 14;  ///< that a table of rates may have (core/rate_table.hpp)
inline constexpr int max_mini = 8191;
inline constexpr std::size_t max_slots = 1000;
inline constexpr std::int64_t min_slot_ns = second_ns / 1000;
inline constexpr std::int64_t max_slot_ns = day_ns;
inline constexpr std::int64_t max_cycle_ns = 30 * day_ns;

/// What a slot is for.
enum class Kind : std::uint8_t {
    data,   ///< frames of bytes
    ping,   ///< a two-way ping to `dest`
    lbl,    ///< an interrogation of transponders
    mini,   ///< a minipacket of 13 bits
    blank,  ///< nobody speaks
};

/// One entry of a cycle.
struct Slot {
    int src = 0;                              ///< modem ID of who speaks, 1 to 30; 0: nobody
    std::optional<int> dest;                  ///< 0 to 30; none: whoever fills the slot chooses
    int rate = 0;                             ///< 0 to 6
    std::int64_t length_ns = 10 * second_ns;  ///< 1 ms to a day
    Kind kind = Kind::data;
    int mini = 0;  ///< what a minipacket says, 0 to 8191

    bool operator==(const Slot&) const = default;
};

/// @param text  `key=value`, parted by commas or blanks: `src`, `dest`, `rate`, `length` (seconds,
///              10 by default), `kind` (`data`, `ping`, `lbl`, `mini`, `blank`), `mini`.
///              Without `src`, or with 0, the slot is blank
/// @throws DataError  an unknown key, one given twice, a value out of its range, or a slot that is
///                    none: a kind without `src`, a blank one with it, a ping without another's
///                    `dest`, `mini` where the kind is another
Slot parse_slot(std::string_view text);

/// A slot at its place in time.
struct Turn {
    Slot slot;
    std::int64_t cycle = 0;     ///< number of the cycle in its era, from 0
    std::uint32_t index = 0;    ///< place in the cycle, from 0
    std::int64_t start_ns = 0;  ///< when it begins
    std::int64_t end_ns = 0;    ///< when the last sound must have left: the guard time is taken off

    bool operator==(const Turn&) const = default;
};

/// A list of slots that repeats from the origin on, in the order in which they were declared.
///
/// With Origin::Kind::midnight a slot that 00:00 UTC would cut short is not used.
class Cycle {
public:
    /// @param guard_ns  taken off the end of each slot; at least 0
    /// @throws ConfigError  no slot, more than max_slots, a length out of its range, a cycle longer
    ///                      than max_cycle_ns (or than the day that restarts it), a guard time that
    ///                      leaves nothing of a slot
    explicit Cycle(std::vector<Slot> slots, Origin origin = {}, std::int64_t guard_ns = 0);

    std::int64_t length_ns() const { return offsets_.back(); }

    /// The first turn that begins at `time_ns` or later, and not before the origin. A slot that has
    /// begun is never it.
    Turn next(std::int64_t time_ns) const;

private:
    Turn turn(const Era& era, std::int64_t cycle, std::size_t index) const;

    std::vector<Slot> slots_;
    std::vector<std::int64_t> offsets_;  ///< of each slot in the cycle; the cycle's length behind
    Origin origin_;
    std::int64_t guard_ns_;
};

/// What polling adds to each slot: the poll itself, and its way to the farthest vehicle,
/// cycle_init_s + max_range_m / sound_speed_mps, rounded up (eq. 2.5 of T. Schneider's thesis, 2013).
/// @throws DataError  a time outside 0 to 60 s, a range outside 0 to 100,000 m, a sound speed
///                    outside 1300 to 1700 m/s
/// Check value: 1 s, 1500 m and 1500 m/s are 2 s.
std::int64_t poll_overhead_ns(double cycle_init_s, double max_range_m, double sound_speed_mps);

/// Makes each slot longer in which somebody speaks.
void add_poll_overhead(std::vector<Slot>& slots, std::int64_t overhead_ns);

}  // namespace seautils::tdma

#endif  // SEAUTILS_TDMA_CYCLE_HPP
