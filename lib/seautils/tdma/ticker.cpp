#include "seautils/tdma/ticker.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace seautils::tdma {

Ticker::Ticker(Next next, std::int64_t lead_ns, std::int64_t now_ns)
    : next_(std::move(next)), lead_ns_(lead_ns) {
    if (lead_ns < 0) throw std::out_of_range("lead_ns is negative");
    plan(now_ns);
}

void Ticker::plan(std::int64_t now_ns) {
    pending_ = next_(now_ns);
    if (pending_.start_ns == last_start_ns_) pending_ = next_(last_start_ns_ + 1);
}

std::optional<Ticker::Handed> Ticker::take(std::int64_t now_ns) {
    const std::int64_t late_ns = now_ns - due_ns();
    if (late_ns < 0) return std::nullopt;
    const std::int64_t bearable_ns = std::min(pending_.slot.length_ns / 10, second_ns);
    const bool is_missed = now_ns - pending_.start_ns > bearable_ns;
    const Handed handed{pending_, late_ns, is_missed};
    last_start_ns_ = pending_.start_ns;
    // After a long sleep the next is one that has not begun, not the one that would have been next.
    plan(std::max(is_missed ? now_ns : 0, last_start_ns_ + 1));
    return handed;
}

}  // namespace seautils::tdma
