#include "seautils/tdma/cycle.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace seautils::tdma {

namespace {

double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

void check_slot(const Slot& slot, std::size_t index, std::int64_t guard_ns) {
    if (slot.length_ns < min_slot_ns || slot.length_ns > max_slot_ns) {
        throw ConfigError(fmt::format("slot {}: length {} is outside 0.001 to 86400 s", index,
                                      seconds(slot.length_ns)));
    }
    if (guard_ns < 0 || guard_ns >= slot.length_ns) {
        throw ConfigError(fmt::format("slot {}: a guard time of {} s leaves nothing of {} s", index,
                                      seconds(guard_ns), seconds(slot.length_ns)));
    }
}

}  // namespace

Cycle::Cycle(std::vector<Slot> slots, Origin origin, std::int64_t guard_ns)
    : slots_(std::move(slots)), offsets_{0}, origin_(origin), guard_ns_(guard_ns) {
    if (slots_.empty()) throw ConfigError("a cycle needs a slot");
    if (slots_.size() > max_slots)
        throw ConfigError(fmt::format("{} slots are more than {}", slots_.size(), max_slots));
    for (std::size_t k = 0; k < slots_.size(); ++k) {
        check_slot(slots_[k], k, guard_ns);
        offsets_.push_back(offsets_.back() + slots_[k].length_ns);
    }
    const bool daily = origin.kind == Origin::Kind::midnight;
    const std::int64_t most_ns = daily ? day_ns : max_cycle_ns;
    if (length_ns() > most_ns) {
        throw ConfigError(fmt::format("a cycle of {} s is longer than {} s", seconds(length_ns()),
                                      seconds(most_ns)));
    }
}

Turn Cycle::turn(const Era& era, std::int64_t cycle, std::size_t index) const {
    const std::int64_t start = era.begin_ns + cycle * length_ns() + offsets_[index];
    return {slots_[index], cycle, static_cast<std::uint32_t>(index), start,
            start + slots_[index].length_ns - guard_ns_};
}

Turn Cycle::next(std::int64_t time_ns) const {
    const Era era = era_of(origin_, time_ns);
    const std::int64_t since = std::max<std::int64_t>(time_ns - era.begin_ns, 0);
    std::int64_t cycle = since / length_ns();
    const auto place = std::lower_bound(offsets_.begin(), offsets_.end(), since % length_ns());
    auto index = static_cast<std::size_t>(place - offsets_.begin());
    if (index == slots_.size()) {
        index = 0;
        ++cycle;
    }
    const Turn found = turn(era, cycle, index);
    const bool fits = found.start_ns <= era.end_ns - found.slot.length_ns;
    return fits ? found : turn(era_of(origin_, era.end_ns), 0, 0);
}

std::int64_t poll_overhead_ns(double cycle_init_s, double max_range_m, double sound_speed_mps) {
    const auto check = [](const char* what, double value, double least, double most,
                          const char* unit) {
        if (value >= least && value <= most) return;
        throw DataError(
            fmt::format("{} {} is outside {} to {} {}", what, value, least, most, unit));
    };
    check("cycle initiation", cycle_init_s, 0, 60, "s");
    check("range", max_range_m, 0, 100'000, "m");
    check("sound speed", sound_speed_mps, 1300, 1700, "m/s");
    return static_cast<std::int64_t>(std::ceil(cycle_init_s * 1e9)) +
           static_cast<std::int64_t>(std::ceil(max_range_m * 1e9 / sound_speed_mps));
}

void add_poll_overhead(std::vector<Slot>& slots, std::int64_t overhead_ns) {
    for (Slot& slot : slots)
        if (slot.kind != Kind::blank) slot.length_ns += overhead_ns;
}

}  // namespace seautils::tdma
