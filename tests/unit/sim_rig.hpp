// An ocean under test: what its modems say, and what became of their packets.
#ifndef SEAUTILS_TESTS_SIM_RIG_HPP
#define SEAUTILS_TESTS_SIM_RIG_HPP

#include "seautils/core/time.hpp"
#include "seautils/sim/ocean.hpp"
#include "seautils/stream/nmea.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace seautils::sim {

/// 2024-05-01T20:45:00Z, where no test says otherwise.
inline const Time epoch = parse_utc("2024-05-01T20:45:00Z") * 1000;

class Rig : public Sink {
public:
    struct Line {
        Time time;
        std::string text;  ///< without line end
    };

    explicit Rig(const std::string& scenario, const ReadFile& read = no_files)
        : spec(parse_scenario("s.conf", scenario, epoch, read)),
          said(spec.nodes.size()),
          ocean(spec, *this, spec.epoch),
          now(spec.epoch) {}

    /// Two modems on one spot line, `range_m` apart, that have booted and say all they can.
    static std::string pair(const std::string& generation, double range_m = 1500,
                            const std::string& water = "") {
        return "[water]\n" + water + "\n[nodes]\nmodem = " + generation +
               "\nnvram = CST:1, RXP:1, REV:1\n"
               "[node modem1]\nid = 1\nx_m = 0\ny_m = 0\n"
               "[node modem2]\nid = 2\ny_m = 0\nx_m = " +
               std::to_string(range_m) + "\n";
    }

    void to_host(std::size_t node, Time time, std::string_view sentence) override {
        ASSERT_TRUE(sentence.ends_with("\r\n"));
        said.at(node).push_back({time, std::string(sentence.substr(0, sentence.size() - 2))});
    }
    void truth(Time, const Truth& t) override { truths.push_back(t); }

    /// The host of a node (from 0) says a line as it is.
    void raw(std::size_t node, const std::string& line) { ocean.from_host(node, line, now); }
    /// A sentence, with its checksum put behind it.
    void say(std::size_t node, const std::string& body) {
        std::string line = stream::sentence(body);
        line.resize(line.size() - 2);
        raw(node, line);
    }
    void run(double seconds) {
        now += nanoseconds(seconds);
        ocean.advance(now);
    }
    /// Forgets what was said so far.
    void clear() {
        for (auto& lines : said) lines.clear();
        truths.clear();
    }
    void boot() {
        run(2);
        clear();
    }

    /// What a node said, without checksums; statistics down to their name, requests without time.
    std::vector<std::string> heard(std::size_t node) const {
        std::vector<std::string> all;
        for (const Line& line : said.at(node)) {
            std::string body = line.text.substr(1, line.text.find('*') - 1);
            if (body.starts_with("CACST") || body.starts_with("CAXST")) body.resize(5);
            if (body.starts_with("CADRQ")) body.replace(6, 6, "hhmmss");
            all.push_back(std::move(body));
        }
        return all;
    }
    /// The first line of a node that begins so; empty where there is none.
    std::string first(std::size_t node, const std::string& beginning) const {
        for (const Line& line : said.at(node))
            if (line.text.starts_with(beginning)) return line.text;
        return {};
    }
    std::size_t count(std::size_t node, const std::string& beginning) const {
        std::size_t n = 0;
        for (const Line& line : said.at(node)) n += line.text.starts_with(beginning) ? 1 : 0;
        return n;
    }

    static std::string no_files(const std::string& file) {
        ADD_FAILURE() << "reads " << file;
        return {};
    }

    Scenario spec;
    std::vector<std::vector<Line>> said;
    std::vector<Truth> truths;
    Ocean ocean;
    Time now;
};

using Lines = std::vector<std::string>;

/// Digits of `count` bytes of 32 (the two digits "32"), as the published example has them.
inline std::string digits(std::size_t count, const std::string& byte = "32") {
    std::string all;
    for (std::size_t k = 0; k < count; ++k) all += byte;
    return all;
}

}  // namespace seautils::sim

#endif  // SEAUTILS_TESTS_SIM_RIG_HPP
