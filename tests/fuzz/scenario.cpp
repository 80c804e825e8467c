// Any text as a scenario, with what it says of files in it: refused decently, or good for a minute at
// sea in which every host talks nonsense.
#include "common.hpp"

#include "seautils/sim/ocean.hpp"

#include <cmath>

using namespace seautils;

namespace {

/// Holds that what the ocean says is what it may say.
struct Watch : sim::Sink {
    std::size_t nodes = 0;
    sim::Time last = 0;

    void to_host(std::size_t node, sim::Time time, std::string_view sentence) override {
        fuzz::require(node < nodes && time >= last, "time goes forward");
        last = time;
        fuzz::require(sentence.ends_with("\r\n") && sentence.starts_with("$"), "a sentence");
    }
    void truth(sim::Time time, const sim::Truth& t) override {
        fuzz::require(time >= last, "time goes forward");
        last = time;
        fuzz::require(std::isfinite(t.range_m) && t.range_m >= 0, "a range");
        fuzz::require(!t.heard || *t.heard >= t.sent, "sound takes time");
    }
};

/// Lines behind `%` go to the hosts, one node after the other, a second apart.
void sail(const sim::Scenario& scenario, std::string_view lines) {
    Watch watch;
    watch.nodes = scenario.nodes.size();
    watch.last = scenario.epoch;
    sim::Ocean ocean(scenario, watch, scenario.epoch);
    sim::Time now = scenario.epoch;
    for (std::size_t k = 0; k < 50; ++k) {
        now += sim::second_ns;
        const std::size_t end = std::min(lines.find('\n'), lines.size());
        if (end > 0) ocean.from_host(k % watch.nodes, lines.substr(0, end), now);
        lines.remove_prefix(std::min(lines.size(), end + 1));
    }
    ocean.advance(now + 10 * sim::second_ns);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view all = fuzz::view(data, size);
    const std::size_t cut = std::min(all.find('%'), all.size());
    const std::string_view text = all.substr(0, cut);
    const std::string_view rest = all.substr(std::min(all.size(), cut + 1));
    fuzz::accepted([&] {
        const sim::Scenario scenario =
            sim::parse_scenario("s.conf", text, 1'700'000'000 * sim::second_ns,
                                [&](const std::string&) { return std::string(rest); });
        sail(scenario, rest);
    });
    return 0;
}
