// What tdma-slot asks of its command line, and what the library makes of the answers.
#ifndef SEAUTILS_TOOLS_TDMA_OPTIONS_HPP
#define SEAUTILS_TOOLS_TDMA_OPTIONS_HPP

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/rate_table.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"
#include "seautils/stream/whole_file.hpp"
#include "seautils/tdma/discovery.hpp"
#include "seautils/tdma/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

struct TdmaOptions {
    std::string mode = "fixed";
    std::vector<std::string> slots;
    int id = 0;  ///< 0: not said
    std::string origin = "epoch", guard = "0", lead = "0";
    std::string from, to, rates;
    // polled
    static constexpr double sound_speed_mps = 1500;
    int master = 0;
    double max_range_m = 0, cycle_init_s = 1;
    // auto
    std::string rule = "hash", length = "15", silence = "1800", feedback, state;
    std::uint32_t coolness = 2;
    int rate = 0;
    // simulation
    std::string simulate, pool = "1-10";
    std::size_t subsets = 0;
    double p_collide = 1;
    std::uint64_t start = 0, runs = 1, draw = 0, limit = 100'000;

    void add(CLI::App& app) {
        add_schedule(app);
        add_auto(app);
        add_simulation(app);
    }

    bool simulates() const { return !simulate.empty() || subsets > 0; }
    bool polled() const { return mode == "polled"; }
    bool discovers() const { return mode == "auto"; }
    std::int64_t guard_ns() const { return tdma::parse_seconds_ns(guard); }
    std::int64_t lead_ns() const { return tdma::parse_seconds_ns(lead); }

    tdma::Excitation excitation() const { return {tdma::parse_rule(rule), coolness}; }

    /// @throws Error(no_input), ConfigError
    RateTable rate_table() const;
    tdma::Cycle cycle() const;
    tdma::DiscoveryOptions discovery() const;
    /// @throws Error(usage)  what is given does not go together
    void check_schedule() const;

private:
    void add_schedule(CLI::App& app);
    void add_auto(CLI::App& app);
    void add_simulation(CLI::App& app);
    std::int64_t shortest_slot_ns(const std::vector<tdma::Slot>& parsed) const;
    std::vector<tdma::Slot> parsed_slots() const;
    void check_poll(const tdma::Slot& slot) const;
    void check_rates() const;
    void check_lengths() const;
};

[[noreturn]] inline void usage(const std::string& what) { throw Error(ExitCode::usage, what); }

/// For CLI11: what is wrong with a value, or nothing.
template <class Parse>
auto takes(Parse parse) {
    return [parse](const std::string& text) -> std::string {
        try {
            parse(text);
            return {};
        } catch (const DataError& e) {
            return e.what();
        }
    };
}

/// A decimal number within bounds.
inline auto within(double least, double most, const char* unit) {
    return [=](const std::string& text) -> std::string {
        double x = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        if (whole && x >= least && x <= most) return {};
        return fmt::format("{} is outside {} to {}{}", quote(text), least, most, unit);
    };
}

/// A whole number within bounds.
inline auto count_within(std::uint64_t least, std::uint64_t most) {
    return [=](const std::string& text) -> std::string {
        std::uint64_t x = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        if (whole && x >= least && x <= most) return {};
        return fmt::format("{} is outside {} to {}", quote(text), least, most);
    };
}

/// Seconds, as exact as they are written.
inline auto seconds_within(const char* least, const char* most) {
    return takes([=](const std::string& text) {
        const std::int64_t ns = tdma::parse_seconds_ns(text);
        if (ns < tdma::parse_seconds_ns(least) || ns > tdma::parse_seconds_ns(most))
            throw DataError(fmt::format("{} is outside {} to {} s", quote(text), least, most));
    });
}

inline void TdmaOptions::add_schedule(CLI::App& app) {
    app.add_option("--mode", mode,
                   "fixed (default): all know the slots; polled: a master asks; auto")
        ->check([](const std::string& name) {
            const bool known = name == "fixed" || name == "polled" || name == "auto";
            return known ? std::string() : quote(name) + " is none of fixed, polled, auto";
        })
        ->option_text("MODE");
    app.add_option("--slot", slots,
                   "src=1,dest=2,rate=1,length=10,kind=data; once for each, in order")
        ->allow_extra_args(false)
        ->check(takes(tdma::parse_slot))
        ->option_text("SLOT");
    app.add_option("--id", id, "Modem ID of this vehicle, 1 to 30")
        ->check(count_within(1, tdma::max_modem_id))
        ->option_text("ID");
    app.add_option("--origin", origin,
                   "Where cycles are counted from: epoch (default), midnight, TIME")
        ->check(takes(tdma::parse_origin))
        ->option_text("ORIGIN");
    app.add_option("--guard", guard, "Silence at the end of each slot, 0 s")
        ->check(seconds_within("0", "86400"))
        ->option_text("SECONDS");
    app.add_option("--lead", lead, "Say a slot so long before it begins, 0 s")
        ->check(seconds_within("0", "86400"))
        ->option_text("SECONDS");
    app.add_option("--from", from, "Print the slots from this time on, at once")
        ->check(takes(parse_utc_ns))
        ->option_text("TIME");
    app.add_option("--to", to, "Up to this time")->check(takes(parse_utc_ns))->option_text("TIME");
    app.add_option("--rates", rates, "Take frames and bytes of the rates from FILE")
        ->option_text("FILE");
    app.add_option("--master", master, "polled: modem ID of the master")
        ->check(count_within(1, tdma::max_modem_id))
        ->option_text("ID");
    app.add_option("--cycle-init", cycle_init_s, "polled: duration of a poll, 1 s")
        ->check(within(0, 60, " s"))
        ->option_text("SECONDS");
    app.add_option("--max-range", max_range_m, "polled: the farthest vehicle, 0 m")
        ->check(within(0, 100'000, " m"))
        ->option_text("METRES");
}

inline void TdmaOptions::add_auto(CLI::App& app) {
    app.add_option("--length", length, "auto: duration of a slot, 15 s")
        ->check(seconds_within("0.001", "86400"))
        ->option_text("SECONDS");
    app.add_option("--rate", rate, "auto: rate of the modem, 0")
        ->check(count_within(0, tdma::max_rate))
        ->option_text("RATE");
    app.add_option("--rule", rule, "auto: hash (default), goby1, eq, eqn, rot")
        ->check(takes(tdma::parse_rule))
        ->option_text("RULE");
    app.add_option("--coolness", coolness, "auto: cycles to each excited one, 2")
        ->check(count_within(1, tdma::max_coolness))
        ->option_text("N");
    app.add_option("--silence", silence, "auto: forget who is silent for so long, 1800 s")
        ->check(seconds_within("0.001", "2592000"))
        ->option_text("SECONDS");
    app.add_option("--feedback", feedback, "auto: FIFO with records of who was heard")
        ->option_text("FIFO");
    app.add_option("--state", state, "auto: keep there who is known")->option_text("FILE");
}

inline void TdmaOptions::add_simulation(CLI::App& app) {
    auto* simulated =
        app.add_option("--simulate", simulate, "Show how these vehicles find each other")
            ->check(takes(tdma::parse_addresses))
            ->option_text("IDS");
    app.add_option("--subsets", subsets, "The same for all sets of N vehicles of --pool")
        ->check(count_within(1, tdma::max_address))
        ->option_text("N")
        ->excludes(simulated);
    app.add_option("--pool", pool, "Where they are taken from, 1-10")
        ->check(takes(tdma::parse_pool))
        ->option_text("ID-ID");
    app.add_option("--draw", draw, "Instead of all sets N at random, from random slots on")
        ->check(count_within(1, 1'000'000'000))
        ->option_text("N")
        ->excludes(simulated);
    app.add_option("--start", start, "Slot in which they start, 0")
        ->check(count_within(0, 1'000'000'000'000))
        ->option_text("SLOT");
    app.add_option("--runs", runs, "Run N times, from one slot later each time, 1")
        ->check(count_within(1, 1'000'000'000))
        ->option_text("N");
    app.add_option("--p-collide", p_collide, "Probability that who speaks together is lost, 1")
        ->check(within(0, 1, ""))
        ->option_text("P");
    app.add_option("--limit", limit, "Slots of a run at most, 100000")
        ->check(count_within(1, 1'000'000'000))
        ->option_text("N");
}

inline std::vector<tdma::Slot> TdmaOptions::parsed_slots() const {
    std::vector<tdma::Slot> parsed;
    for (const std::string& text : slots) parsed.push_back(tdma::parse_slot(text));
    return parsed;
}

inline void TdmaOptions::check_poll(const tdma::Slot& slot) const {
    if (slot.kind == tdma::Kind::blank || slot.kind == tdma::Kind::data || slot.src == master)
        return;
    usage(
        fmt::format("option --slot: master {} can ask {} for nothing but data", master, slot.src));
}

inline std::int64_t TdmaOptions::shortest_slot_ns(const std::vector<tdma::Slot>& parsed) const {
    std::int64_t shortest = discovers() ? tdma::parse_seconds_ns(length) : tdma::max_slot_ns;
    for (const tdma::Slot& slot : parsed) shortest = std::min(shortest, slot.length_ns);
    return shortest;
}

inline void TdmaOptions::check_schedule() const {
    if (from.empty() != to.empty()) usage("options --from and --to go together");
    if (!from.empty() && parse_utc_ns(from) > parse_utc_ns(to)) usage("--to is before --from");
    if (discovers() && !slots.empty()) usage("option --slot: mode auto makes its own slots");
    if (!discovers() && slots.empty()) usage("option --slot is required (try --help)");
    if (id == 0 && (discovers() || from.empty())) usage("option --id is required (try --help)");
    if (polled() && master == 0) usage("option --master is required in mode polled (try --help)");
    const std::vector<tdma::Slot> parsed = parsed_slots();
    if (polled())
        for (const tdma::Slot& slot : parsed) check_poll(slot);
    check_rates();
    check_lengths();
    if (lead_ns() >= shortest_slot_ns(parsed))
        usage(fmt::format("--lead {} s is not less than the shortest slot", lead));
}

inline RateTable TdmaOptions::rate_table() const {
    if (rates.empty()) return {};
    constexpr std::size_t most_bytes = 1 << 20;
    return RateTable::parse(stream::read_input_file(rates, most_bytes), rates);
}

/// Each value alone was sound; together they may not be.
inline void TdmaOptions::check_lengths() const {
    try {
        if (discovers())
            tdma::Discovery(discovery(), 0);
        else
            cycle();
    } catch (const ConfigError& e) {
        usage(e.what());
    }
}

/// What the modem does not have is found before it is needed.
inline void TdmaOptions::check_rates() const {
    const RateTable table = rate_table();
    try {
        if (discovers()) table.data(static_cast<unsigned>(rate));
        for (const tdma::Slot& slot : parsed_slots())
            if (slot.kind == tdma::Kind::data) table.data(static_cast<unsigned>(slot.rate));
    } catch (const DataError& e) {
        usage(e.what());
    }
}

inline tdma::Cycle TdmaOptions::cycle() const {
    std::vector<tdma::Slot> parsed = parsed_slots();
    if (polled()) {
        tdma::add_poll_overhead(parsed,
                                tdma::poll_overhead_ns(cycle_init_s, max_range_m, sound_speed_mps));
    }
    return tdma::Cycle(std::move(parsed), tdma::parse_origin(origin), guard_ns());
}

inline tdma::DiscoveryOptions TdmaOptions::discovery() const {
    tdma::DiscoveryOptions options;
    options.address = id;
    options.rate = rate;
    options.excitation = excitation();
    options.origin = tdma::parse_origin(origin);
    options.slot_ns = tdma::parse_seconds_ns(length);
    options.guard_ns = guard_ns();
    options.silence_ns = tdma::parse_seconds_ns(silence);
    return options;
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TDMA_OPTIONS_HPP
