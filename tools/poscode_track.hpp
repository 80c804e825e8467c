// What all commands of poscode ask of their command line: the codec, and how fixes become samples.
#ifndef SEAUTILS_TOOLS_POSCODE_TRACK_HPP
#define SEAUTILS_TOOLS_POSCODE_TRACK_HPP

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/position/codec.hpp"
#include "seautils/position/fix_reader.hpp"
#include "seautils/position/sampling.hpp"

#include "seautils/stream/whole_file.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

/// Thousandths of a decimal number, which must be whole: milliseconds of seconds. @throws DataError
inline std::int64_t thousandths(std::string_view text, double least, double most,
                                const char* unit) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    if (!is_number || !(value >= least && value <= most))
        throw DataError(fmt::format("{} is outside {} to {} {}", quote(text), least, most, unit));
    const double scaled = std::round(value * 1000);
    if (std::fabs(value * 1000 - scaled) > 1e-6)
        throw DataError(fmt::format("{} has more than three decimals", quote(text)));
    return static_cast<std::int64_t>(scaled);
}

/// For CLI11: what is wrong with a value, or nothing.
inline auto thousandths_within(double least, double most, const char* unit) {
    return [=](const std::string& text) -> std::string {
        try {
            thousandths(text, least, most, unit);
            return {};
        } catch (const DataError& e) {
            return e.what();
        }
    };
}

inline auto one_of(std::vector<std::string> names) {
    return [names = std::move(names)](const std::string& text) -> std::string {
        std::string all;
        for (const std::string& name : names) {
            if (name == text) return {};
            all += (all.empty() ? "" : ", ") + name;
        }
        return quote(text) + " is none of " + all;
    };
}

/// A codec as it is named on the command line.
struct CodecName {
    using Kind = position::CodecOptions::Kind;
    using Model = position::CodecOptions::Model;
    Kind kind = Kind::mix;
    Model model = Model::adaptive;

    const char* codec() const {
        return kind == Kind::mix ? "mix" : kind == Kind::fixed ? "fixed" : "kalman";
    }
    /// Of mix there is one: none is named.
    const char* model_name() const {
        if (kind == Kind::mix) return "-";
        return model == Model::uniform    ? "uniform"
               : model == Model::gaussian ? "gaussian"
                                          : "adaptive";
    }
};

class TrackOptions {
public:
    /// What both ends of a link must say alike.
    void add_codec(CLI::App& app) {
        app.add_option("--codec", codec_, "Codec: mix (default), fixed, kalman")
            ->check(one_of({"mix", "fixed", "kalman"}))
            ->option_text("CODEC");
        app.add_option("--model", model_, "Of fixed, kalman: adaptive (default), gaussian, uniform")
            ->check(one_of({"uniform", "gaussian", "adaptive"}))
            ->option_text("MODEL");
        app.add_flag("--small", small_, "Of mix: two thirds of the memory");
        app.add_option("--tau", tau_, "Between samples, 10")
            ->check(thousandths_within(0.001, 86'400, "s"))
            ->option_text("SECONDS");
        app.add_option("--speed", speed_, "The vehicle's usual speed, 1.5")
            ->check(thousandths_within(0.001, 100, "m/s"))
            ->option_text("M/S");
        app.add_option("--resolution", resolution_, "Of x and y, 1")
            ->check(thousandths_within(0.001, 1000, "m"))
            ->option_text("METRES");
        app.add_option("--resolution-z", resolution_z_, "Of z; as --resolution")
            ->check(thousandths_within(0.001, 1000, "m"))
            ->option_text("METRES");
        app.add_option("--area", area_,
                       "Operating area, metres: x=-5000:5000,y=-5000:5000,z=-6000:10")
            ->option_text("AREA");
        app.add_option("--plan", plan_,
                       "Waypoints that both ends know: x,y,z or latitudes, longitudes")
            ->option_text("FILE");
        app.add_option("--datum", datum_, "Where x and y are 0: 60.1,5.25")->option_text("LAT,LON");
        app.add_option("--frame", frame_, "Metres from the datum: local (default), utm")
            ->check(one_of({"local", "utm"}))
            ->option_text("FRAME");
    }

    /// How fixes become samples.
    void add_sampling(CLI::App& app) {
        app.add_option("--sampling", method_, "Between fixes: linear (default), nearest")
            ->check(one_of({"linear", "nearest"}))
            ->option_text("METHOD");
        app.add_option("--gap", gap_, "Longer steps between fixes are gaps, 1.5 tau")
            ->check(thousandths_within(0.001, 86'400'000, "s"))
            ->option_text("SECONDS");
        app.add_flag("--surface", on_surface_, "Fixes without z or depth are at 0");
    }

    bool names_codec() const { return !codec_.empty(); }
    bool names_model() const { return !model_.empty(); }

    CodecName codec() const {
        using Kind = CodecName::Kind;
        using Model = CodecName::Model;
        return {codec_ == "fixed"    ? Kind::fixed
                : codec_ == "kalman" ? Kind::kalman
                                     : Kind::mix,
                model_ == "uniform"    ? Model::uniform
                : model_ == "gaussian" ? Model::gaussian
                                       : Model::adaptive};
    }

    position::CodecOptions codec_options(const CodecName& name) const {
        return {.kind = name.kind,
                .model = name.model,
                .interval_ms = ms(tau_),
                .speed_mmps = ms(speed_),
                .resolution_mm = ms(resolution_),
                .small = small_,
                .plan = name.kind == CodecName::Kind::mix ? plan() : std::vector<position::Cell>()};
    }

    /// @throws Error(usage)
    position::Grid grid() const {
        const auto z_mm = ms(resolution_z_.empty() ? resolution_ : resolution_z_);
        position::Grid grid = position::make_grid(ms(resolution_), z_mm);
        if (!area_.empty()) named("--area", [&] { position::set_area(grid, area_); });
        return grid;
    }

    /// The waypoints of --plan, in order. @throws Error(no_input), ConfigError(located)
    std::vector<position::Cell> plan() const {
        std::vector<position::Cell> waypoints;
        if (plan_.empty()) return waypoints;
        position::FixReader::Options options = reading("auto");
        options.is_timeless = true;
        position::FixReader reader(std::move(options));
        const std::string text = stream::read_input_file(plan_, most_plan_bytes);
        std::size_t line = 0;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            std::string_view row = std::string_view(text).substr(at, end - at);
            if (row.ends_with('\r')) row.remove_suffix(1);
            at = end + 1;
            ++line;
            try {
                const auto fix = row.empty() ? std::nullopt : reader.read(row);
                if (fix) waypoints.push_back(position::cell_of(grid(), fix->place));
            } catch (const DataError& e) {
                throw ConfigError(fmt::format("{}:{}: {}", plan_, line, e.what()));
            }
        }
        return waypoints;
    }

    /// @throws Error(usage)
    std::optional<position::Frame> frame() const {
        using position::Frame;
        std::optional<Frame> frame;
        const auto kind = frame_ == "utm" ? Frame::Kind::utm : Frame::Kind::local;
        if (!datum_.empty())
            named("--datum", [&] { frame.emplace(kind, position::parse_datum(datum_)); });
        else if (!frame_.empty())
            throw Error(ExitCode::usage, "option --frame needs --datum");
        return frame;
    }

    position::Sampler::Options sampling() const {
        position::Sampler::Options options;
        options.interval_ms = ms(tau_);
        options.gap_ms = gap_.empty() ? 0 : ms(gap_);
        options.method = method_ == "nearest" ? position::Sampler::Method::nearest
                                              : position::Sampler::Method::linear;
        options.grid = grid();
        return options;
    }

    position::FixReader::Options reading(const std::string& form) const {
        using Form = position::FixReader::Form;
        position::FixReader::Options options;
        options.form = form == "csv" ? Form::csv : form == "ndjson" ? Form::ndjson : Form::detect;
        options.frame = frame();
        options.on_surface = on_surface_;
        return options;
    }

    /// The datum, however it is written, and the frame.
    std::string frame_text() const {
        const auto said = frame();
        if (!said) return "none";
        return fmt::format("{:.9f} {:.9f} {}", said->datum().latitude_deg,
                           said->datum().longitude_deg, frame_ == "utm" ? "utm" : "local");
    }

    std::int64_t interval_ms() const { return ms(tau_); }

private:
    static constexpr std::size_t most_plan_bytes = 1U << 23;

    static std::int64_t ms(const std::string& checked) { return thousandths(checked, 0, 1e9, ""); }

    template <class Work>
    static void named(const char* option, Work work) {
        try {
            work();
        } catch (const DataError& e) {
            throw Error(ExitCode::usage, fmt::format("option {}: {}", option, e.what()));
        }
    }

    std::string codec_, model_, tau_ = "10", speed_ = "1.5", resolution_ = "1", resolution_z_,
                                area_, datum_, frame_, method_ = "linear", gap_;
    std::string plan_;
    bool small_ = false, on_surface_ = false;
};

/// The forms of fixes, for App::input_formats.
inline const std::vector<std::string> fix_formats{"auto", "csv", "ndjson"};

/// Reads fixes from the inputs, and calls `take` with each sample as soon as it is complete.
inline void for_each_sample(cli::Io& io, position::FixReader reader,
                            const position::Sampler::Options& options,
                            const std::function<void(const position::Sample&)>& take) {
    std::optional<position::Sampler> sampler;
    try {
        sampler.emplace(options);
    } catch (const ConfigError& e) {
        throw Error(ExitCode::usage, e.what());
    }
    io.for_each(cli::Framing::lines, [&](std::string_view line) {
        const auto fix = reader.read(line);
        if (!fix) return;
        for (const position::Sample& sample : sampler->add(*fix)) take(sample);
    });
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_TRACK_HPP
