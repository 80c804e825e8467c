// poscode simulate: what a track costs over a lossy link, and how late it comes.
#ifndef SEAUTILS_TOOLS_POSCODE_SIMULATE_HPP
#define SEAUTILS_TOOLS_POSCODE_SIMULATE_HPP

#include "poscode_plot.hpp"
#include "poscode_track.hpp"

#include "seautils/position/simulation.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace seautils::tools {

struct SimulateOptions {
    TrackOptions track;
    std::vector<double> losses;
    double ack_loss = 0, delta_bits = 11.1, full_bits = 55;
    bool acks_as_data = false;
    std::uint32_t max_bytes = 34, runs = 0;
    std::string plot;

    void add(CLI::App& app) {
        track.add_codec(app);
        track.add_sampling(app);
        const auto share = CLI::Range(0.0, 0.999);
        app.add_option("--loss", losses, "Chance that a packet is lost; may repeat")
            ->check(share)
            ->allow_extra_args(false)
            ->option_text("P");
        app.add_option("--ack-loss", ack_loss, "Chance that an acknowledgement is lost, 0")
            ->check(share)
            ->option_text("P");
        app.add_flag("--acks-as-data", acks_as_data, "Acknowledgements are lost as packets are");
        app.add_option("--delta-bits", delta_bits, "Of the thesis's deltas, 11.1")
            ->check(CLI::Range(1.0, 55.0))
            ->option_text("BITS");
        app.add_option("--max-bytes", max_bytes, "Of a packet with its check, 34")
            ->check(CLI::Range(8, 2048))
            ->option_text("N");
        app.add_option("--runs", runs,
                       "How often the track is sent, for the mean; 1 to 8 by its length")
            ->check(CLI::Range(1, 1000))
            ->option_text("N");
        app.add_option("--plot", plot, "Draw cost and age against loss: .png or .svg")
            ->option_text("FILE");
    }
};

class Simulate {
public:
    Simulate(cli::Io& io, const SimulateOptions& options) : io_(io), options_(options) {
        if (options_.losses.empty()) options_.losses = {0, 0.3, 0.5, 0.65, 0.8, 0.9};
    }

    void run() {
        const Plot::Target target = Plot::target(options_.plot);
        read();
        codec_ = position::make_codec(options_.track.codec_options(options_.track.codec()));
        if (io_.format == "text")
            io_.out << "loss  acks  way           bits a position  age, intervals  arrived\n";
        if (io_.format == "csv") io_.out << "loss,ack_loss,way,bits,age,stable,arrived\n";
        for (const double loss : options_.losses) all_ways(loss);
        if (target.is_wanted()) Plot::draw(target, ways_);
    }

private:
    void read() {
        position::FixReader::Options reading = options_.track.reading(io_.input_format);
        reading.first_is_datum = true;
        for_each_sample(io_, position::FixReader(std::move(reading)), options_.track.sampling(),
                        [this](const position::Sample& sample) {
                            track_.push_back({sample.time_ms, sample.cell});
                        });
        if (track_.empty()) throw DataError("there is no fix to simulate with");
        // Chance makes less of many positions.
        constexpr std::size_t enough = 2000, most_runs = 8;
        runs_ = options_.runs;
        if (runs_ == 0) runs_ = std::clamp<std::size_t>(enough / track_.size(), 1, most_runs);
    }

    /// Those of the thesis's Fig 3.10, and ours.
    void all_ways(double loss) {
        const position::Losses losses{loss, options_.acks_as_data ? loss : options_.ack_loss,
                                      io_.seed};
        constexpr std::size_t slots = 200'000;
        say(losses, "full", position::simulate_full(options_.full_bits, losses, slots), {});
        for (const double packet : {55.0, 256.0}) {
            say(losses, fmt::format("arq-{}", packet),
                position::simulate_arq(options_.delta_bits, packet, losses, slots), {});
        }
        using position::LinkMode;
        for (const auto& [name, mode] :
             {std::pair{"history", LinkMode::history}, std::pair{"newest", LinkMode::newest},
              std::pair{"auto", LinkMode::automatic}}) {
            const position::LinkReport report = ours(losses, mode);
            if (report.wrong > 0) throw std::logic_error("what was decoded was not sent");
            say(losses, name, report.cost,
                static_cast<double>(report.arrived) / static_cast<double>(report.sampled));
        }
    }

    position::LinkReport ours(const position::Losses& losses, position::LinkMode mode) const {
        const position::Grid grid = options_.track.grid();
        position::LinkOptions link;
        link.interval_ms = options_.track.interval_ms();
        link.least = grid.min;
        link.most = grid.max;
        link.mode = mode;
        return position::simulate_link(track_, link, *codec_, *position::make_horizon(),
                                       options_.max_bytes, losses, runs_);
    }

    void say(const position::Losses& losses, const std::string& way, const position::LinkCost& cost,
             std::optional<double> arrived) {
        note(losses, way, cost);
        const std::string share = arrived ? fmt::format("{:.4f}", *arrived) : "";
        if (io_.format == "text") {
            io_.out << fmt::format("{:<6.2f}{:<6.2f}{:12}{:17.1f}{:>16}{:>9}\n", losses.packet,
                                   losses.ack, way, cost.bits,
                                   cost.is_stable ? fmt::format("{:.1f}", cost.age) : "unstable",
                                   share.empty() ? "-" : share);
        } else if (io_.format == "csv") {
            io_.out << fmt::format("{:.4f},{:.4f},{},{:.2f},{:.2f},{},{}\n", losses.packet,
                                   losses.ack, way, cost.bits, cost.age, cost.is_stable, share);
        } else {
            io_.out << fmt::format(
                R"({{"loss":{:.4f},"ack_loss":{:.4f},"way":"{}","bits":{:.2f},"age":{:.2f},)"
                R"("stable":{}{}}})"
                "\n",
                losses.packet, losses.ack, way, cost.bits, cost.age, cost.is_stable,
                share.empty() ? "" : ",\"arrived\":" + share);
        }
    }

    /// For the picture.
    void note(const position::Losses& losses, const std::string& name,
              const position::LinkCost& cost) {
        auto way = std::find_if(ways_.begin(), ways_.end(),
                                [&](const Plot::Way& known) { return known.title == name; });
        if (way == ways_.end()) way = ways_.insert(way, {name, {}});
        const Plot::Way::Point point{losses.packet, cost.bits, cost.age, cost.is_stable};
        const auto place = std::upper_bound(
            way->points.begin(), way->points.end(), point,
            [](const auto& one, const auto& other) { return one.loss < other.loss; });
        way->points.insert(place, point);
    }

    cli::Io& io_;
    SimulateOptions options_;
    std::vector<Plot::Way> ways_;
    std::vector<position::Fix> track_;
    std::size_t runs_ = 1;
    std::unique_ptr<position::Codec> codec_;
};

inline int simulate_main(int argc, char** argv) {
    SimulateOptions options;
    cli::App app{"poscode simulate",
                 "Say what a track costs over a lossy link, and how late it comes.",
                 "  poscode simulate --tau 10 --loss 0.3 --loss 0.65 track.csv\n",
                 {.config = true, .seed = true}};
    app.input_formats(fix_formats);
    app.output_formats({"text", "ndjson", "csv"});
    options.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) { Simulate(io, options).run(); });
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_SIMULATE_HPP
