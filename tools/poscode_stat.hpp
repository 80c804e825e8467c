// poscode stat: what each codec costs on a track.
#ifndef SEAUTILS_TOOLS_POSCODE_STAT_HPP
#define SEAUTILS_TOOLS_POSCODE_STAT_HPP

#include "poscode_plot.hpp"
#include "poscode_track.hpp"

#include "seautils/position/cost.hpp"

#include <future>
#include <stdexcept>
#include <string>
#include <vector>

namespace seautils::tools {

struct StatOptions {
    TrackOptions track;
    std::string deltas_per_packet = "1", plot;

    void add(CLI::App& app) {
        track.add_codec(app);
        track.add_sampling(app);
        app.add_option("--deltas-per-packet", deltas_per_packet, "Deltas that share an ending, 1")
            ->check(count_of_deltas)
            ->option_text("N");
        app.add_option("--plot", plot, "Draw how many deltas take how many bits: .png or .svg")
            ->option_text("FILE");
    }

    std::uint32_t deltas() const {
        return static_cast<std::uint32_t>(std::stoul(deltas_per_packet));
    }

    static std::string count_of_deltas(const std::string& text) {
        std::uint32_t n = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        if (whole && n >= 1 && n <= position::CostMeter::most_deltas) return {};
        return fmt::format("{} is outside 1 to {}", quote(text), position::CostMeter::most_deltas);
    }

    /// mix, and fixed and kalman with each model; those that the command line names.
    std::vector<CodecName> codecs() const {
        using Kind = CodecName::Kind;
        using Model = CodecName::Model;
        std::vector<CodecName> all;
        const CodecName wanted = track.codec();
        for (const Kind kind : {Kind::mix, Kind::fixed, Kind::kalman}) {
            if (track.names_codec() && wanted.kind != kind) continue;
            if (kind == Kind::mix) {
                if (!track.names_model()) all.push_back({kind, Model::adaptive});
                continue;
            }
            for (const Model model : {Model::uniform, Model::gaussian, Model::adaptive}) {
                if (!track.names_model() || wanted.model == model) all.push_back({kind, model});
            }
        }
        if (all.empty()) throw Error(ExitCode::usage, "option --model is for fixed and kalman");
        return all;
    }
};

class Stat {
public:
    Stat(cli::Io& io, const StatOptions& options) : io_(io), options_(options) {}

    void run() {
        const Plot::Target target = Plot::target(options_.plot);
        const std::vector<CodecName> codecs = options_.codecs();
        read();
        const std::vector<position::Cost> costs = measure(codecs);
        if (io_.format == "text") table(codecs, costs);
        if (io_.format == "csv")
            io_.out << "codec,model,deltas,fulls,bits_per_delta,bits_total,deltas_per_packet\n";
        for (std::size_t k = 0; k < codecs.size(); ++k) record(codecs[k], costs[k]);
        if (target.is_wanted()) draw(target, codecs, costs);
    }

private:
    void read() {
        position::FixReader::Options reading = options_.track.reading(io_.input_format);
        reading.first_is_datum = true;
        for_each_sample(io_, position::FixReader(std::move(reading)), options_.track.sampling(),
                        [this](const position::Sample& sample) { samples_.push_back(sample); });
    }

    std::vector<position::Cost> measure(const std::vector<CodecName>& codecs) const {
        std::vector<position::Cost> costs;
        for (const CodecName& codec : codecs) {
            auto made = position::make_codec(options_.track.codec_options(codec));
            position::CostCheck check(made->clone(), options_.deltas());
            position::CostMeter meter(std::move(made), options_.track.grid(), options_.deltas());
            const std::string fault = code(meter, check);
            if (!fault.empty())
                throw std::logic_error(
                    fmt::format("{} {}: {}", codec.codec(), codec.model_name(), fault));
            costs.push_back(meter.cost());
        }
        return costs;
    }

    /// Codes, and decodes meanwhile what is coded. @return what differs
    std::string code(position::CostMeter& meter, position::CostCheck& check) const {
        std::future<std::string> checked;
        for (std::size_t at = 0; at < samples_.size(); at += block) {
            std::vector<position::CodedPositions> packets;
            const std::size_t end = std::min(at + block, samples_.size());
            for (std::size_t k = at; k < end; ++k) meter.add(samples_[k], packets);
            if (end == samples_.size()) meter.finish(packets);
            std::string fault = checked.valid() ? checked.get() : std::string();
            if (!fault.empty()) return fault;
            checked = std::async(std::launch::async, [&check, coded = std::move(packets)] {
                return difference(check, coded);
            });
        }
        return checked.valid() ? checked.get() : std::string();
    }

    static std::string difference(position::CostCheck& check,
                                  const std::vector<position::CodedPositions>& packets) {
        try {
            for (const position::CodedPositions& packet : packets) check.check(packet);
            return {};
        } catch (const std::exception& e) {
            return e.what();
        }
    }

    void table(const std::vector<CodecName>& codecs, const std::vector<position::Cost>& costs) {
        const auto starts = std::count_if(samples_.begin(), samples_.end(),
                                          [](const position::Sample& s) { return s.starts; });
        io_.out << fmt::format("{} every {} s in {}; a full fix takes {} bits\n\n",
                               counted(samples_.size(), "sample"),
                               static_cast<double>(options_.track.interval_ms()) / 1000,
                               counted(static_cast<std::uint64_t>(starts), "run"),
                               position::full_bits(options_.track.grid()));
        io_.out << "codec   model     deltas  fulls  bits a delta  bits in all\n";
        for (std::size_t k = 0; k < codecs.size(); ++k) {
            io_.out << fmt::format("{:7} {:9}{:7}{:7}{:14.3f}{:13}\n", codecs[k].codec(),
                                   codecs[k].model_name(), costs[k].deltas, costs[k].fulls,
                                   costs[k].bits_per_delta(), costs[k].bits_total());
        }
    }

    void record(const CodecName& codec, const position::Cost& cost) {
        if (io_.format == "ndjson")
            io_.out << fmt::format(
                R"({{"codec":"{}","model":"{}","deltas":{},"fulls":{},"bits_per_delta":{:.4f},)"
                R"("bits_total":{},"deltas_per_packet":{}}})"
                "\n",
                codec.codec(), codec.model_name(), cost.deltas, cost.fulls, cost.bits_per_delta(),
                cost.bits_total(), options_.deltas());
        if (io_.format == "csv")
            io_.out << fmt::format("{},{},{},{},{:.4f},{},{}\n", codec.codec(), codec.model_name(),
                                   cost.deltas, cost.fulls, cost.bits_per_delta(),
                                   cost.bits_total(), options_.deltas());
    }

    void draw(const Plot::Target& target, const std::vector<CodecName>& codecs,
              const std::vector<position::Cost>& costs) const {
        std::vector<Plot::Curve> curves;
        for (std::size_t k = 0; k < codecs.size(); ++k) {
            const bool has_model = codecs[k].kind != CodecName::Kind::mix;
            curves.push_back(
                {fmt::format("{}{} ({:.2f} on average)", codecs[k].codec(),
                             has_model ? std::string(" ") + codecs[k].model_name() : "",
                             costs[k].bits_per_delta()),
                 costs[k].deltas_by_bits});
        }
        Plot::draw(target, curves);
    }

    static constexpr std::size_t block = 500;  ///< samples between two looks at the decoder

    cli::Io& io_;
    const StatOptions& options_;
    std::vector<position::Sample> samples_;
};

inline int stat_main(int argc, char** argv) {
    StatOptions options;
    cli::App app{"poscode stat",
                 "Say what each codec costs on a track.",
                 "  poscode stat --tau 10 track.csv\n"
                 "  zcat track.csv.gz | poscode stat --format ndjson\n",
                 {.config = true}};
    app.input_formats(fix_formats);
    app.output_formats({"text", "ndjson", "csv"});
    options.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) { Stat(io, options).run(); });
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_STAT_HPP
