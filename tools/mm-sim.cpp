// mm-sim - simulated Micro-Modems on pseudo-terminals, sharing one simulated ocean
#include "mm_sim_bench.hpp"
#include "mm_sim_clock.hpp"

#include "seautils/core/error.hpp"
#include "seautils/stream/whole_file.hpp"

#include <charconv>
#include <functional>

using namespace seautils;

namespace {

/// What the command line says beside what all tools share.
struct Options {
    std::string folder = ".";
    double warp = 0;  ///< 0: not said
    double duration_s = 0;
    bool raw = false;
};

/// What CLI11 asks of a value: what is wrong, or nothing.
std::function<std::string(std::string)> in_range(unsigned most, const char* unit) {
    return [most, unit](const std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        if (whole && value >= 0.001 && value <= most) return std::string();
        return fmt::format("{} is outside 0.001 to {}{}", quote(text), most, unit);
    };
}

/// Files that a scenario names are looked for beside it.
sim::Scenario load(const std::string& file, sim::Time now) {
    constexpr std::size_t most_bytes = 16U << 20;
    const std::string folder = file.substr(0, file.rfind('/') + 1);
    const sim::Scenario scenario = sim::parse_scenario(
        file, stream::read_input_file(file, most_bytes), now, [&](const std::string& name) {
            return stream::read_input_file(name.starts_with('/') ? name : folder + name,
                                           most_bytes);
        });
    for (const sim::NodeSpec& node : scenario.nodes)
        if (node.name == "clock") throw ConfigError(file + ": the name 'clock' is taken");
    return scenario;
}

void simulate(cli::Io& io, const Options& options) {
    const sim::Scenario scenario = load(io.files.at(0), io.clock.now_ns());
    const sim::Time start = tools::choose_clock(io, options.warp, scenario.epoch);
    tools::make_folder(options.folder);
    const tools::ClockFile clock_file(options.folder + "/clock", io.clock.word());
    tools::MmSimBench bench(io, scenario, start, options.folder, options.raw);
    cli::Loop loop(io);
    bench.run(loop,
              options.duration_s == 0 ? sim::never : start + sim::nanoseconds(options.duration_s));
    if (bench.overrun() > 0)
        io.warn(counted(bench.overrun(), "sentence") + " lost: a host did not read them in time");
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    cli::App app{"mm-sim",
                 "Simulate Micro-Modems on pseudo-terminals, sharing one simulated ocean.",
                 "  mm-sim --dir run --warp 10 two-nodes.conf > truth.ndjson\n",
                 {.config = true, .stream = false, .clock = true}};
    app.output_formats(tools::record_formats);
    app.options()
        .add_option("--dir", options.folder, "Folder of the terminals' links (.)")
        ->option_text("DIR");
    app.options()
        .add_option("--warp", options.warp, "Run N times as fast, 0.001 to 1000 (1)")
        ->option_text("N")
        ->check(in_range(1000, ""));
    app.options()
        .add_option("--duration", options.duration_s, "End after so much simulated time")
        ->option_text("SECONDS")
        ->check(in_range(100'000'000, " s"));
    app.options().add_flag("--raw", options.raw, "Write each line of the serial lines too");
    std::string scenario;
    app.options().add_option("SCENARIO", scenario, "What is simulated");
    return app.main(argc, argv, [&](cli::Io& io) {
        if (scenario.empty()) throw Error(ExitCode::usage, "SCENARIO is missing (try --help)");
        io.files = {scenario};
        io.input_format = io.format;
        simulate(io, options);
    });
}
