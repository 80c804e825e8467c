// What mm-sim puts between simulated modems and the programs that talk to them.
#ifndef SEAUTILS_TOOLS_MM_SIM_BENCH_HPP
#define SEAUTILS_TOOLS_MM_SIM_BENCH_HPP

#include "record_io.hpp"

#include "seautils/cli/loop.hpp"
#include "seautils/core/text.hpp"
#include "seautils/sim/ocean.hpp"
#include "seautils/stream/pty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seautils::tools {

/// The modems of a scenario on a bench: each with its terminal, all in one ocean, and what happens
/// written as records.
class MmSimBench : public sim::Sink {
public:
    /// @param start  when the modems are switched on
    MmSimBench(cli::Io& io, const sim::Scenario& scenario, sim::Time start,
               const std::string& folder, bool raw)
        : io_(io),
          records_(io),
          raw_(raw),
          scenario_(scenario),
          pending_(scenario.nodes.size()),
          ocean_(scenario, *this, start) {
        for (const sim::NodeSpec& node : scenario.nodes)
            lines_.push_back(std::make_unique<stream::Pty>(folder + "/" + node.name));
    }

    /// Until the loop ends, or the clock says `until`.
    void run(cli::Loop& loop, sim::Time until) {
        for (std::size_t k = 0; k < lines_.size(); ++k) {
            stream::Pty& line = *lines_[k];
            loop.watch(line.descriptor(), [this, k] { take(k); });
            if (line.changes() >= 0) loop.watch(line.changes(), [&line] { line.look(); });
        }
        const auto pump = [this, &loop, until] {
            const sim::Time now = io_.clock.now_ns();
            ocean_.advance(std::min(now, until));
            if (now >= until) return loop.stop();
            const sim::Time next = std::min(ocean_.next(), until);
            loop.wake_at(next == sim::never ? std::nullopt : std::optional(next));
        };
        loop.on_wake(pump);
        loop.before_wait(pump);
        loop.run();
    }

    /// Sentences that a program did not take in time.
    std::uint64_t overrun() const { return overrun_; }

    void to_host(std::size_t node, sim::Time time, std::string_view sentence) override {
        if (!lines_[node]->write(sentence)) ++overrun_;
        record_line(record::Raw::Direction::in, node, time,
                    sentence.substr(0, sentence.find_last_not_of("\r\n") + 1));
    }

    void truth(sim::Time time, const sim::Truth& t) override {
        record::Acoustic a;
        a.src = t.src;
        a.receiver = t.receiver;
        a.dest = t.dest;
        a.rate = t.rate;
        a.packet = name(t.kind);
        a.sent = {t.sent};
        if (t.heard) a.heard = record::UtcTime{*t.heard};
        a.air_time_s = sim::seconds(t.air);
        a.range_m = rounded(t.range_m);
        if (t.tl_db) a.tl_db = rounded(*t.tl_db);
        a.outcome = static_cast<record::Acoustic::Outcome>(t.outcome);
        a.bytes = static_cast<std::uint32_t>(t.bytes);
        a.bad_frame.assign(t.bad_frames.begin(), t.bad_frames.end());
        records_.write({.time = {time}, .kind = std::move(a)});
    }

private:
    static constexpr std::size_t longest_command = 8192;
    static constexpr std::size_t longest_record = 3500;  ///< of a line in a record

    /// To the millimetre, or the thousandth of a decibel.
    static double rounded(double value) { return std::round(value * 1000) / 1000; }

    /// Bytes from a program: each line is a command, however it ends.
    void take(std::size_t node) {
        const sim::Time now = io_.clock.now_ns();
        std::string& held = pending_[node];
        lines_[node]->read(held);
        for (;;) {
            const std::size_t end = held.find_first_of("\r\n");
            if (end == held.npos) break;
            const std::string line = held.substr(0, end);
            held.erase(0, end + 1);
            if (line.empty()) continue;
            record_line(record::Raw::Direction::out, node, now, line);
            ocean_.from_host(node, line, now);
        }
        if (held.size() > longest_command) held.clear();  // no command is so long
    }

    void record_line(record::Raw::Direction direction, std::size_t node, sim::Time time,
                     std::string_view line) {
        if (!raw_) return;
        record::Raw raw;
        raw.direction = direction;
        raw.line = printable(line, longest_record);
        raw.node = scenario_.nodes[node].name;
        records_.write({.time = {time}, .kind = std::move(raw)});
    }

    cli::Io& io_;
    RecordIo records_;
    bool raw_;
    const sim::Scenario& scenario_;
    std::vector<std::string> pending_;  ///< what is no whole line yet, for each node
    std::vector<std::unique_ptr<stream::Pty>> lines_;
    std::uint64_t overrun_ = 0;
    sim::Ocean ocean_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_MM_SIM_BENCH_HPP
