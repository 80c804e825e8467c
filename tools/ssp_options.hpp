// What ssp is told on the command line.
#ifndef SEAUTILS_TOOLS_SSP_OPTIONS_HPP
#define SEAUTILS_TOOLS_SSP_OPTIONS_HPP

#include "seautils/acoustics/columns.hpp"
#include "seautils/acoustics/ctd_csv.hpp"
#include "seautils/acoustics/extend.hpp"
#include "seautils/acoustics/profile.hpp"
#include "seautils/acoustics/window.hpp"
#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

/// The options as they are given, and what the library makes of them.
class SspOptions {
public:
    void add(CLI::App& app) {
        app.add_option("--column", columns_,
                       "A column's quantity, as temperature_c=TEMP; once for each")
            ->allow_extra_args(false)
            ->option_text("QUANTITY=NAME");
        app.add_option("--formula", formula_,
                       "chen-millero, del-grosso, mackenzie, leroy, medwin, coppens, measured "
                       "(chen-millero)")
            ->option_text("NAME");
        number(app, "--latitude", latitude_deg_, "Where none is said: for depth (45)",
               {-90, 90, " degrees"}, "DEGREES");
        number(app, "--salinity", salinity_, "Where none is known", {0, 50, ""}, "SALINITY");
        app.add_option("--split", split_, "A profile of each window, leg or cast (window)")
            ->option_text("WHAT");
        number(app, "--window", window_s_, "Of so much time (1800)", {0.001, 1e9, " s"}, "SECONDS");
        number(app, "--every", every_s_,
               "A window is due so often; 0: after each sample (the window)", {0, 1e9, " s"},
               "SECONDS");
        number(app, "--silence", silence_s_, "What is there is due when nothing comes for so long",
               {0.001, 2592000, " s"}, "SECONDS");
        number(app, "--bin", bin_m_, "Height of a bin (1)", {0.01, 1000, " m"}, "METRES");
        number(app, "--turn", turn_m_, "A leg ends where the sensor comes back by this (10)",
               {0.1, 1000, " m"}, "METRES");
        number(app, "--spike", spike_, "Leave out what is so many deviations off; 0: nothing (5)",
               {0, 1e6, ""}, "N");
        number(app, "--loop", loop_m_, "Leave out what goes back and comes again; 0: nothing (0.1)",
               {0, 1000, " m"}, "METRES");
        number(app, "--min-speed", least_speed_mps_,
               "Leave out what sinks or climbs more slowly (0)", {0, 100, " m/s"}, "MPS");
        number(app, "--extend", extend_m_, "Continue profiles down to there, and up to the surface",
               {0, 12000, " m"}, "METRES");
        app.add_option("--climatology", climatology, "Continue them by the profile of a file")
            ->option_text("FILE");
        number(app, "--blend", blend_m_, "Over so much depth the climatology takes over (100)",
               {0.1, 12000, " m"}, "METRES");
    }

    /// Makes the settings. @throws Error(usage)
    void settle() {
        try {
            for (const std::string& column : columns_)
                columns.push_back(acoustics::parse_named_column(column));
        } catch (const DataError& e) {
            throw Error(ExitCode::usage, std::string("option --column: ") + e.what());
        }
        settle_formula();
        reduction.salinity = salinity_;
        reduction.latitude_deg = latitude_deg_;
        settle_windows();
        silence_ns = std::llround(silence_s_.value_or(0) * 1e9);
        binning.bin_m = bin_m_.value_or(1);
        binning.cleaning = {.spike_deviations = spike_.value_or(5),
                            .loop_m = loop_m_.value_or(0.1),
                            .least_speed_mps = least_speed_mps_.value_or(0),
                            .turn_m = windowing.turn_m};
        binning.formula = extending.formula = reduction.formula;
        extending.salinity = salinity_;
        extending.latitude_deg = latitude_deg_;
        extending.blend_m = blend_m_.value_or(100);
        if (blend_m_ && climatology.empty())
            throw Error(ExitCode::usage, "option --blend is for --climatology");
        extending.to_m = extend_m_.value_or(0);
        extends = extend_m_ || !climatology.empty();
        to_end_of_climatology = !extend_m_;
    }

    std::vector<acoustics::NamedColumn> columns;
    acoustics::Reduction reduction;
    acoustics::Windowing windowing;
    acoustics::Binning binning;
    acoustics::Extending extending;
    std::int64_t silence_ns = 0;  ///< 0: a sensor may be silent for ever
    bool extends = false, to_end_of_climatology = false;
    std::string climatology;

private:
    struct Range {
        double least, most;
        const char* unit;
    };

    static void number(CLI::App& app, const char* option, std::optional<double>& value,
                       const char* what, Range range, const char* text) {
        app.add_option(option, value, what)
            ->option_text(text)
            ->check([range](const std::string& said) {
                const std::optional<double> x = acoustics::number(said);
                if (x && *x >= range.least && *x <= range.most) return std::string();
                return fmt::format("{} is outside {} to {}{}", quote(said), range.least, range.most,
                                   range.unit);
            });
    }

    void settle_formula() {
        reduction.measured = formula_ == "measured";
        if (reduction.measured) return;
        try {
            reduction.formula = acoustics::parse_formula(formula_);
        } catch (const DataError&) {
            std::string all;
            for (const auto f : acoustics::all_formulas)
                all.append(acoustics::name(f)).append(", ");
            throw Error(ExitCode::usage,
                        "option --formula: " + quote(formula_) + " is none of " + all + "measured");
        }
    }

    void settle_windows() {
        if (split_ == "leg")
            windowing.split = acoustics::Split::leg;
        else if (split_ == "cast")
            windowing.split = acoustics::Split::cast;
        else if (split_ != "window")
            throw Error(ExitCode::usage,
                        "option --split: " + quote(split_) + " is none of window, leg, cast");
        for (const auto& [given, option] :
             {std::pair{window_s_, "--window"}, {every_s_, "--every"}})
            if (given && windowing.split != acoustics::Split::window)
                throw Error(ExitCode::usage,
                            std::string("option ") + option + " is for --split window");
        const double window_s = window_s_.value_or(1800);
        windowing.window_ns = std::llround(window_s * 1e9);
        windowing.every_ns = std::llround(every_s_.value_or(window_s) * 1e9);
        windowing.turn_m = turn_m_.value_or(10);
    }

    std::vector<std::string> columns_;
    std::string formula_ = "chen-millero", split_ = "window";
    std::optional<double> latitude_deg_, salinity_, window_s_, every_s_, silence_s_, bin_m_,
        turn_m_, spike_, loop_m_, least_speed_mps_, extend_m_, blend_m_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_SSP_OPTIONS_HPP
