// What depth-plan acomms and snr are told on the command line.
#ifndef SEAUTILS_TOOLS_DEPTH_OPTIONS_HPP
#define SEAUTILS_TOOLS_DEPTH_OPTIONS_HPP

#include "depth_sea.hpp"

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/plan/acomms_depth.hpp"
#include "seautils/plan/limits.hpp"
#include "seautils/plan/loss_csv.hpp"
#include "seautils/plan/max_snr_depth.hpp"
#include "seautils/plan/noise.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace seautils::tools {

/// An option that takes a number within bounds.
struct Bounds {
    double least, most;
    const char* unit;
};
template <class Number>  // double, or one that may be missing
void add_number(CLI::App& app, const char* option, Number& value, const char* what, Bounds bounds,
                const char* text) {
    app.add_option(option, value, what)
        ->option_text(text)
        ->check([bounds](const std::string& said) {
            const std::optional<double> x = plan::read_number(said);
            if (x && *x >= bounds.least && *x <= bounds.most) return std::string();
            return fmt::format("{} is outside {} to {}{}", quote(said), bounds.least, bounds.most,
                               bounds.unit);
        });
}

/// `FROM,TO`, in metres. @throws Error(usage)
inline plan::DepthBand parse_band(const std::string& text, const char* option) {
    const std::size_t comma = text.find(',');
    const auto from = plan::read_number(text.substr(0, comma));
    const auto to = plan::read_number(comma == text.npos ? "" : text.substr(comma + 1));
    if (from && to && *from >= 0 && *to > *from && *to <= 1e7) return {*from, *to};
    throw Error(ExitCode::usage,
                fmt::format("option {}: {} is not of the form FROM,TO with 0 <= FROM < TO", option,
                            quote(text)));
}

/// A whole file of a value over depth. @throws Error  located
inline plan::DepthTable read_table_file(const std::string& file) {
    const std::string text = stream::read_input_file(file, 1U << 20);
    try {
        return plan::read_depth_table(text);
    } catch (const DataError& e) {
        throw Error(ExitCode::data, file + ":" + (e.what()[0] == 'h' ? " " : "") + e.what());
    }
}

/// What both planners are told.
class DepthOptions {
public:
    DepthSea::Options sea;
    plan::Limits limits;
    double most_age_s = 600, every_s = 0, weight = 1, range_step_m = 10, depth_step_m = 1;

    void add(CLI::App& app, double default_range_step_m, double default_depth_step_m) {
        range_step_m = default_range_step_m;
        depth_step_m = default_depth_step_m;
        app.add_option("--loss", sea.files, "Losses from a table or an answer; of each profile one")
            ->allow_extra_args(false)
            ->option_text("FILE");
        app.add_option("--model", sea.model, "A program that is asked for losses, as 'tl-model'")
            ->option_text("COMMAND");
        add_number(app, "--model-timeout", sea.timeout_s, "It answers within (10)",
                   {0.001, 3600, " s"}, "SECONDS");
        add_number(app, "--instances", instances_, "Average over the last profiles or answers (1)",
                   {1, 100, ""}, "N");
        add_number(app, "--range-step", range_step_m, "Asked of the model", {0.1, 1e5, " m"},
                   "METRES");
        add_number(app, "--depth-step", depth_step_m, "Asked of the model", {0.1, 1e4, " m"},
                   "METRES");
        add_number(app, "--min-depth", limits.least_depth_m, "Never less deep (0)",
                   {0, 12000, " m"}, "METRES");
        add_number(app, "--max-depth", limits.most_depth_m, "Never deeper", {0, 12000, " m"},
                   "METRES");
        add_number(app, "--min-altitude", limits.least_altitude_m, "Never nearer the seabed (0)",
                   {0, 12000, " m"}, "METRES");
        app.add_option("--exclude", bands_, "Depths not to stay at; may repeat")
            ->allow_extra_args(false)
            ->option_text("FROM,TO");
        add_number(app, "--weight", weight, "Beside other objectives (1)", {0, 1e6, ""}, "W");
        add_number(app, "--max-age", most_age_s, "What was said before is not known (600)",
                   {0, 1e9, " s"}, "SECONDS");
        add_number(app, "--every", every_s, "Decide no more often (0: at each state)",
                   {0, 1e6, " s"}, "SECONDS");
    }

    /// @throws Error(usage)
    void settle() {
        sea.instances = static_cast<std::size_t>(instances_);
        if (instances_ != std::floor(instances_))
            throw Error(ExitCode::usage, "option --instances is no whole number");
        for (const std::string& band : bands_)
            limits.excluded.push_back(parse_band(band, "--exclude"));
        if (!sea.files.empty() && !sea.model.empty())
            throw Error(ExitCode::usage, "options --loss and --model exclude each other");
        if (!sea.model.empty() && sea.model.find_first_not_of(' ') == std::string::npos)
            throw Error(ExitCode::usage, "option --model: the value is empty");
    }

private:
    double instances_ = 1;
    std::vector<std::string> bands_;
};

struct AcommsToolOptions {
    DepthOptions common;
    plan::AcommsOptions acomms;
    double horizon_s = 120;

    void add(CLI::App& app) {
        add_number(app, "--horizon", horizon_s, "Plan for the ranges met within (120)",
                   {0, 1e6, " s"}, "SECONDS");
        app.add_option("--loss-limit", limit_, "Worth nothing: dB, or 'window': its largest (108)")
            ->option_text("DB");
        add_number(app, "--uncertainty", acomms.uncertainty_db,
                   "Profiles that differ so much halve what is known (3)", {0.01, 1000, " dB"},
                   "DB");
        add_number(app, "--smoothing", acomms.smoothing_m, "Low-pass over depth then (10)",
                   {0, 1e4, " m"}, "METRES");
        common.add(app, 10, 1);
    }
    void settle() {
        common.settle();
        if (limit_ == "window") {
            acomms.loss_limit_db.reset();
            return;
        }
        const auto x = plan::read_number(limit_);
        if (!x || !(*x >= 1 && *x <= 1000))
            throw Error(ExitCode::usage, "option --loss-limit: " + quote(limit_) +
                                             " is neither window nor from 1 to 1000 dB");
        acomms.loss_limit_db = *x;
    }

private:
    std::string limit_ = "108";
};

struct SnrToolOptions {
    DepthOptions common;
    plan::SnrOptions snr;
    plan::NoiseProfile noise;
    std::optional<plan::DepthTable> noise_table, gain_table;

    void add(CLI::App& app) {
        add_number(app, "--horizon", snr.horizon_s, "Look ahead (7200)", {0, 1e6, " s"}, "SECONDS");
        add_number(app, "--step", snr.step_s, "At every (120)", {1, 1e5, " s"}, "SECONDS");
        add_number(app, "--short-horizon", snr.short_horizon_s, "Where it is good, follow by (300)",
                   {0, 1e6, " s"}, "SECONDS");
        add_number(app, "--near-best", snr.near_best, "Good is this close to the best (0.05)",
                   {0, 1, ""}, "SHARE");
        add_number(app, "--near", snr.near_m, "Or so near to its depth (50)", {0, 1e4, " m"},
                   "METRES");
        add_number(app, "--max-pitch", snr.most_pitch_deg, "Never steeper (20)",
                   {0.1, 90, " degrees"}, "DEGREES");
        add_number(app, "--smoothing", snr.smoothing_m, "Low-passes from the surface down (50)",
                   {0, 1e4, " m"}, "METRES");
        add_number(app, "--uncertainty", snr.uncertainty_db,
                   "Profiles that differ so much halve what is known (3)", {0.01, 1000, " dB"},
                   "DB");
        add_number(app, "--signal-weight", snr.signal_weight, "Of loss (1)", {0, 1000, ""}, "W");
        add_number(app, "--noise-weight", snr.noise_weight, "Of noise (1)", {0, 1000, ""}, "W");
        add_number(app, "--gain-weight", snr.gain_weight, "Of array gain (1)", {0, 1000, ""}, "W");
        add_number(app, "--critical-depth", noise.critical_depth_m, "Noise is less below",
                   {0, 12000, " m"}, "METRES");
        add_number(app, "--noise-slope", noise.slope_db_per_km, "By so much (-3)",
                   {-100, 100, " dB/km"}, "DB/KM");
        app.add_option("--noise", noise_file_, "Noise over depth: a table")->option_text("FILE");
        app.add_option("--array-gain", gain_file_, "Array gain over depth: a table")
            ->option_text("FILE");
        common.add(app, 250, 50);
    }
    void settle() {
        common.settle();
        snr.weight = common.weight;
        if (snr.horizon_s / snr.step_s > 10000)
            throw Error(ExitCode::usage, "option --step: more than 10000 steps within --horizon");
        if (!noise_file_.empty()) noise_table = read_table_file(noise_file_);
        if (!gain_file_.empty()) gain_table = read_table_file(gain_file_);
    }
    double noise_db(double depth_m) const {
        if (!noise_table) return noise.at_db(depth_m);
        return plan::interpolated(noise_table->depth_m, noise_table->values, depth_m);
    }
    double gain_db(double depth_m) const {
        if (!gain_table) return 0;
        return plan::interpolated(gain_table->depth_m, gain_table->values, depth_m);
    }

private:
    std::string noise_file_, gain_file_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_OPTIONS_HPP
