// What tl-model is told on the command line.
#ifndef SEAUTILS_TOOLS_TL_OPTIONS_HPP
#define SEAUTILS_TOOLS_TL_OPTIONS_HPP

#include "gnuplot.hpp"
#include "tl_request.hpp"

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/toolbox/external.hpp"
#include "seautils/toolbox/shd_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace seautils::tools {

class TlOptions {
public:
    void add(CLI::App& app) {
        choice(app, "--sum", sum_, "Of paths: incoherent, semicoherent, coherent (incoherent)",
               [](const std::string& s) { parse_sum(s); });
        choice(app, "--beam", beam_, "Around rays: gaussian, hat (gaussian)",
               [](const std::string& s) { parse_beam(s); });
        choice(app, "--engine", engine_,
               "auto, rays, modes, wavenumber, or another's: bellhop, bellhopcxx, kraken, krakenc, "
               "scooter, oases (auto)",
               [](const std::string& s) { check_engine(s); });
        whole(app, "--beams", beams_, "Launch angles, in place of as many as are needed", 1,
              1'000'000, "N");
        app.add_flag("--arrivals", arrivals, "The paths to each receiver, in place of losses");
        app.add_flag("--smooth", smooth, "Average intensity over 5 depths and 9 ranges");
        number(app, "--min-amp", least_amplitude_,
               "Give up a ray when its boundaries have left less (1e-4)", 0, 1, "A");
        whole(app, "--threads", threads_, "For one field (1)", 1, 64, "N");
        whole(app, "--jobs", jobs_, "Requests answered at the same time (1)", 1, 64, "N");
        choice(app, "--shd-format", shd_format_, "Layout of a .shd file: 2022, 2023 (2023)",
               [](const std::string& s) {
                   if (s != "2022" && s != "2023")
                       throw DataError(quote(s) + " is none of 2022, 2023");
               });
        number(app, "--engine-timeout", timeout_s_, "Of another's engine (60)", 0.1, 86400,
               "SECONDS");
        whole(app, "--engine-memory", memory_mib_, "It may take (2048)", 16, 1'048'576, "MIB");
        app.add_option("--plot", plot_, "Draw the last result into a .png or .svg file")
            ->option_text("FILE");
        whole(app, "--rays", rays_, "Draw so many rays over the losses", 1, 1000, "N");
        app.add_option("--base", base, "CASE.json or .env that requests begin with")
            ->option_text("FILE");
    }

    /// The task that a file asks for, as these options change it.
    void apply(TlTask& task) const {
        if (sum_) task.options.sum = parse_sum(*sum_);
        if (beam_) task.options.beam = parse_beam(*beam_);
        if (engine_)
            is_foreign(*engine_) ? void(task.program = *engine_)
                                 : void(task.engine = parse_engine(*engine_));
        if (beams_) task.environment.fan.beams = *beams_;
        if (least_amplitude_) task.options.least_amplitude = *least_amplitude_;
        task.options.threads = threads_.value_or(1);
        task.smooth = smooth;
        if (!arrivals) return;
        task.arrivals = true;
        task.loss = false;
    }

    /// Checks what the command line has left to check. @throws Error(usage)
    void settle() {
        picture_ = Gnuplot::target(plot_);
        if (rays_ && plot_.empty()) throw Error(ExitCode::usage, "option --rays needs --plot");
    }
    std::size_t rays() const { return rays_.value_or(0); }
    const Gnuplot::Target& picture() const { return picture_; }

    toolbox::ShdLayout shd_layout() const {
        return shd_format_ == "2022" ? toolbox::ShdLayout::of_2022 : toolbox::ShdLayout::of_2023;
    }
    toolbox::ExternalRun external() const {
        std::error_code none;
        const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
        return {none ? "/tmp" : folder.string(),
                {timeout_s_.value_or(60), std::uint64_t{memory_mib_.value_or(2048)} << 20U}};
    }
    std::uint32_t jobs() const { return jobs_.value_or(1); }

    bool arrivals = false, smooth = false;
    std::string base;

private:
    static bool is_foreign(const std::string& name) {
        static const std::vector<std::string> all{"bellhop", "bellhopcxx", "kraken",
                                                  "krakenc", "scooter",    "oases"};
        return std::find(all.begin(), all.end(), name) != all.end();
    }
    static void check_engine(const std::string& name) {
        if (is_foreign(name)) return;
        try {
            parse_engine(name);
        } catch (const DataError& e) {
            throw DataError(std::string(e.what()) +
                            ", bellhop, bellhopcxx, kraken, krakenc, scooter, oases");
        }
    }

    template <class Check>
    static void choice(CLI::App& app, const char* option, std::optional<std::string>& value,
                       const char* what, Check check) {
        app.add_option(option, value, what)
            ->option_text("NAME")
            ->check([check](const std::string& said) -> std::string {
                try {
                    check(said);
                } catch (const DataError& e) {
                    return e.what();
                }
                return {};
            });
    }

    template <class T>
    static void bounded(CLI::App& app, const char* option, std::optional<T>& value,
                        const char* what, T least, T most, const char* text) {
        app.add_option(option, value, what)
            ->option_text(text)
            ->check([least, most](const std::string& said) -> std::string {
                T x{};
                const auto [end, fault] =
                    std::from_chars(said.data(), said.data() + said.size(), x);
                const bool good = fault == std::errc() && end == said.data() + said.size();
                if (good && x >= least && x <= most) return {};
                return fmt::format("{} is outside {} to {}", quote(said), least, most);
            });
    }
    static void whole(CLI::App& app, const char* option, std::optional<std::uint32_t>& value,
                      const char* what, std::uint32_t least, std::uint32_t most, const char* text) {
        bounded(app, option, value, what, least, most, text);
    }
    static void number(CLI::App& app, const char* option, std::optional<double>& value,
                       const char* what, double least, double most, const char* text) {
        bounded(app, option, value, what, least, most, text);
    }

    std::string plot_;
    Gnuplot::Target picture_;
    std::optional<std::string> sum_, beam_, engine_, shd_format_;
    std::optional<std::uint32_t> beams_, threads_, jobs_, memory_mib_, rays_;
    std::optional<double> least_amplitude_, timeout_s_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_OPTIONS_HPP
