#include "seautils/tdma/discovery.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::tdma {

namespace {

double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

void check_span(const char* what, std::int64_t ns, std::int64_t least, std::int64_t most) {
    if (ns >= least && ns <= most) return;
    throw ConfigError(fmt::format("{} of {} s is outside {} to {} s", what, seconds(ns),
                                  seconds(least), seconds(most)));
}

const DiscoveryOptions& checked(const DiscoveryOptions& options) {
    if (options.address < 1 || options.address > max_modem_id)
        throw ConfigError(fmt::format("id {} is outside 1 to {}", options.address, max_modem_id));
    if (options.excitation.coolness < 1 || options.excitation.coolness > max_coolness) {
        throw ConfigError(fmt::format("coolness {} is outside 1 to {}", options.excitation.coolness,
                                      max_coolness));
    }
    check_span("a slot", options.slot_ns, min_slot_ns, max_slot_ns);
    check_span("a silence limit", options.silence_ns, options.slot_ns, max_cycle_ns);
    check_span("a guard time", options.guard_ns, 0, options.slot_ns - 1);
    return options;
}

}  // namespace

Discovery::Discovery(const DiscoveryOptions& options, std::int64_t now_ns)
    : options_(checked(options)),
      world_(options.address),
      resume_ns_(boundary_from(options.origin, cycle_ns(), now_ns)),
      now_ns_(now_ns) {}

Discovery::Discovery(const DiscoveryOptions& options, const Memory& memory, std::int64_t now_ns)
    : options_(checked(options)),
      world_(options.address),
      resume_ns_(memory.resume_ns),
      now_ns_(now_ns) {
    for (const Heard& heard : memory.others) {
        if (heard.address < 1 || heard.address > max_modem_id || !world_.add(heard.address))
            continue;
        others_.push_back(heard);
    }
    pull_back(now_ns);
    if (resume_ns_ > now_ns + 2 * cycle_ns()) pause(slot_end(now_ns));
}

std::int64_t Discovery::cycle_ns() const {
    return static_cast<std::int64_t>(world_.slots()) * options_.slot_ns;
}

std::int64_t Discovery::slot_end(std::int64_t time_ns) const {
    return boundary_after(options_.origin, options_.slot_ns, time_ns);
}

/// When it is forgotten: at the beginning of a slot, so that all do it between the same two.
std::int64_t Discovery::expiry(const Heard& heard) const {
    return boundary_from(options_.origin, options_.slot_ns, heard.until_ns + options_.silence_ns);
}

std::optional<std::int64_t> Discovery::first_expiry() const {
    const auto first =
        std::min_element(others_.begin(), others_.end(),
                         [](const Heard& a, const Heard& b) { return a.until_ns < b.until_ns; });
    if (first == others_.end()) return std::nullopt;
    return expiry(*first);
}

void Discovery::pause(std::int64_t slot_end_ns) {
    resume_ns_ = boundary_after(options_.origin, cycle_ns(), slot_end_ns);
}

void Discovery::forget(std::int64_t expired_ns) {
    for (const Heard& heard : others_)
        if (expiry(heard) <= expired_ns) world_.remove(heard.address);
    std::erase_if(others_, [&](const Heard& heard) { return expiry(heard) <= expired_ns; });
    pause(slot_end(expired_ns));
}

void Discovery::pull_back(std::int64_t now_ns) {
    const std::int64_t latest = slot_end(now_ns);
    for (Heard& heard : others_) heard.until_ns = std::min(heard.until_ns, latest);
}

bool Discovery::hear(int address, std::int64_t time_ns) {
    if (address < 1 || address > max_modem_id || address == options_.address) return false;
    advance(time_ns);
    const std::int64_t end = slot_end(time_ns);
    if (expiry({address, end}) <= now_ns_) return false;
    if (world_.add(address)) {
        const auto at =
            std::lower_bound(others_.begin(), others_.end(), address,
                             [](const Heard& heard, int a) { return heard.address < a; });
        others_.insert(at, {address, end});
        pause(end);
        return true;
    }
    for (Heard& heard : others_)
        if (heard.address == address) heard.until_ns = std::max(heard.until_ns, end);
    return false;
}

bool Discovery::advance(std::int64_t time_ns) {
    bool any = false;
    now_ns_ = std::max(now_ns_, time_ns);
    for (auto first = first_expiry(); first && *first <= time_ns; first = first_expiry()) {
        forget(*first);
        any = true;
    }
    return any;
}

void Discovery::clock_stepped(std::int64_t by_ns, std::int64_t now_ns) {
    const bool is_waiting = resume_ns_ > now_ns - by_ns;
    now_ns_ = now_ns;
    for (Heard& heard : others_) {
        const std::int64_t moved = std::clamp<std::int64_t>(heard.until_ns + by_ns, 0, last_ns);
        heard.until_ns = boundary_from(options_.origin, options_.slot_ns, moved);
    }
    pull_back(now_ns);
    if (is_waiting || resume_ns_ > now_ns) pause(slot_end(now_ns));
}

Turn Discovery::turn_from(std::int64_t time_ns) const {
    std::int64_t start = boundary_from(options_.origin, options_.slot_ns, time_ns);
    Era era = era_of(options_.origin, start);
    if (start > era.end_ns - options_.slot_ns) {
        start = era.end_ns;
        era = era_of(options_.origin, start);
    }
    const std::int64_t place = (start - era.begin_ns) / options_.slot_ns;
    const auto slots = static_cast<std::int64_t>(world_.slots());
    Turn turn;
    turn.cycle = place / slots;
    turn.index = static_cast<std::uint32_t>(place % slots);
    turn.slot.src =
        speaker(options_.excitation, static_cast<std::uint64_t>(turn.cycle), turn.index, world_);
    turn.slot.kind = turn.slot.src == 0 ? Kind::blank : Kind::data;
    turn.slot.rate = options_.rate;
    turn.slot.length_ns = options_.slot_ns;
    turn.start_ns = start;
    turn.end_ns = start + options_.slot_ns - options_.guard_ns;
    return turn;
}

Turn Discovery::next(std::int64_t time_ns) const {
    Discovery ahead = *this;
    for (;;) {
        const Turn turn = ahead.turn_from(std::max(time_ns, ahead.resume_ns_));
        const auto first = ahead.first_expiry();
        if (!first || *first > turn.start_ns) return turn;
        ahead.forget(*first);
    }
}

}  // namespace seautils::tdma
