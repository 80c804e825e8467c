#ifndef SEAUTILS_TDMA_TICKER_HPP
#define SEAUTILS_TDMA_TICKER_HPP

#include "seautils/tdma/cycle.hpp"

#include <cstdint>
#include <functional>
#include <optional>

namespace seautils::tdma {

/// Hands out turns as a clock that others read comes to them: each once, in order, `lead_ns` before
/// it begins, and not at all when the clock comes too late for it.
class Ticker {
public:
    /// The first turn that begins at a time or later.
    using Next = std::function<Turn(std::int64_t time_ns)>;

    /// @param lead_ns  0 to less than the length of any slot
    /// @throws std::out_of_range  it is negative
    Ticker(Next next, std::int64_t lead_ns, std::int64_t now_ns);

    /// Looks again for the next turn: when the clock was set, or `next` says something else now. A
    /// turn that was handed out does not come again.
    void plan(std::int64_t now_ns);

    /// When the next turn is to be handed out.
    std::int64_t due_ns() const { return pending_.start_ns - lead_ns_; }

    struct Handed {
        Turn turn;
        std::int64_t late_ns;  ///< after it was due
        bool is_missed;  ///< it is too late for it: more than a tenth of the slot, or 1 s, gone
    };
    /// The next turn, if it is due.
    std::optional<Handed> take(std::int64_t now_ns);

private:
    Next next_;
    std::int64_t lead_ns_;
    std::int64_t last_start_ns_ = -1;
    Turn pending_;
};

}  // namespace seautils::tdma

#endif  // SEAUTILS_TDMA_TICKER_HPP
