#include "seautils/tdma/report.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>

namespace seautils::tdma {

namespace {

constexpr const char* step_row = "{:>8}{:>12}";

double time_s(std::uint64_t slots, std::int64_t slot_ns) {
    return static_cast<double>(slots) * static_cast<double>(slot_ns) / 1e9;
}

std::string_view word_of(Does does) {
    switch (does) {
        case Does::send:
            return "send";
        case Does::listen:
            return "listen";
        case Does::blank:
            return "blank";
        default:
            return "wait";
    }
}

std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "null";
}

double percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string numbers_of(const Summary& summary) {
    return fmt::format(
        R"("runs":{},"failed":{},"proven":{},"quiet":{},"mean_slots":{},"mean_settled_slots":{},)"
        R"("longest_slots":{})",
        summary.runs, summary.failed, summary.proven, summary.quiet, number(summary.mean_slots()),
        number(summary.mean_settled_slots()), summary.longest_slots);
}

int address(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size() && number >= 1 &&
        number <= max_address)
        return number;
    throw DataError(fmt::format("address {} is outside 1 to {}", quote(text), max_address));
}

}  // namespace

void append_head_text(const Network& network, std::string& out) {
    out += fmt::format(fmt::runtime(step_row), "slot", "time_s");
    for (const Vehicle& vehicle : network.vehicles()) out += fmt::format("{:>4}", vehicle.address);
    out += '\n';
}

void append_step_text(const Network& network, const std::vector<std::size_t>& known,
                      std::int64_t slot_ns, std::string& out) {
    const std::uint64_t slot = network.slot() - 1;
    out += fmt::format(fmt::runtime(step_row), slot, time_s(slot, slot_ns));
    for (const Vehicle& vehicle : network.vehicles())
        out += fmt::format("{:>4}", static_cast<char>(vehicle.does));
    const char* gap = "   ";
    for (std::size_t k = 0; k < known.size(); ++k) {
        const Vehicle& vehicle = network.vehicles()[k];
        if (vehicle.world.size() == known[k]) continue;
        out += fmt::format("{}{} finds {}", gap, vehicle.address, fmt::join(vehicle.heard, ", "));
        gap = "; ";
    }
    out += '\n';
}

void append_step_json(const Network& network, std::int64_t slot_ns, std::string& out) {
    const std::uint64_t slot = network.slot() - 1;
    out += fmt::format(R"({{"step":{{"slot":{},"time_s":{},"vehicles":[)", slot,
                       time_s(slot, slot_ns));
    const char* comma = "";
    for (const Vehicle& vehicle : network.vehicles()) {
        out +=
            fmt::format(R"({}{{"id":{},"cycle":{},"does":"{}","heard":[{}],"knows":[{}]}})", comma,
                        vehicle.address, vehicle.cycle, word_of(vehicle.does),
                        fmt::join(vehicle.heard, ","), fmt::join(vehicle.world.addresses(), ","));
        comma = ",";
    }
    out += "]}}\n";
}

void append_outcome_text(const Network& network, const Outcome& outcome, std::int64_t slot_ns,
                         std::string& out) {
    if (outcome.succeeded) {
        out += fmt::format(
            "everybody knows everybody after {} slots ({} s), and all take turns after {} ({} s)\n",
            outcome.known_slots, time_s(outcome.known_slots, slot_ns), outcome.settled_slots,
            time_s(outcome.settled_slots, slot_ns));
        return;
    }
    out +=
        fmt::format("not everybody knows everybody after {} slots{}\n",
                    network.slot() - network.start(), outcome.is_proven ? ", and never will" : "");
}

void append_set_text(const std::vector<int>& addresses, const Summary& summary, std::string& out) {
    out += fmt::format("{:<24}", fmt::format("{}", fmt::join(addresses, " ")));
    if (summary.failed > 0) out += fmt::format(" {} of {} failed", summary.failed, summary.runs);
    if (const auto mean = summary.mean_slots())
        out += fmt::format("{}{:.3f} slots", summary.failed > 0 ? ", else " : " ", *mean);
    out += '\n';
}

void append_set_json(const std::vector<int>& addresses, const Summary& summary, std::string& out) {
    out += fmt::format(R"({{"network":{{"vehicles":[{}],{}}}}})", fmt::join(addresses, ","),
                       numbers_of(summary));
    out += '\n';
}

void append_summary_text(const Summary& summary, std::string& out) {
    out += fmt::format("{}, {} failed ({:.2f} %)", counted(summary.runs, "run"), summary.failed,
                       percent(summary.failed, summary.runs));
    if (summary.failed > summary.proven)
        out += fmt::format(", {} of them by the limit", summary.failed - summary.proven);
    if (const auto mean = summary.mean_slots()) {
        out += fmt::format("; everybody known after {:.3f} slots on average, {} at most", *mean,
                           summary.longest_slots);
    }
    out += fmt::format("; nothing got through in the first two slots of {:.3f} %\n",
                       percent(summary.quiet, summary.runs));
}

void append_summary_json(const Summary& summary, std::string& out) {
    out += fmt::format(R"({{"summary":{{{}}}}})", numbers_of(summary));
    out += '\n';
}

std::vector<int> parse_addresses(std::string_view text) {
    std::vector<int> addresses;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const int one = address(text.substr(at, end - at));
        if (std::find(addresses.begin(), addresses.end(), one) != addresses.end())
            throw DataError(fmt::format("address {} is given twice", one));
        addresses.push_back(one);
        at = end + 1;
    }
    std::sort(addresses.begin(), addresses.end());
    return addresses;
}

Pool parse_pool(std::string_view text) {
    const std::size_t dash = text.find('-');
    if (dash == text.npos) throw DataError("pool " + quote(text) + " is not of the form 1-10");
    const Pool pool{address(text.substr(0, dash)), address(text.substr(dash + 1))};
    if (pool.last < pool.first) throw DataError("pool " + quote(text) + " is empty");
    return pool;
}

}  // namespace seautils::tdma
