#ifndef SEAUTILS_CLI_APP_HPP
#define SEAUTILS_CLI_APP_HPP

#include "seautils/cli/config_file.hpp"
#include "seautils/cli/io.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace seautils::cli {

/// Which of the shared options a tool has, beside help, version, quiet, verbose and color.
struct Options {
    bool schema = false;  ///< -s/--schema (may repeat, required), -m/--message (may repeat)
    bool config =
        false;  ///< -c/--config (may repeat, the first to say a thing wins), --print-config
    bool stream = true;  ///< --strict, --max-record, --follow, --progress; FILE...
    bool time = false;   ///< --time
    bool clock = false;  ///< --clock
    bool seed = false;   ///< --seed
};

/// A command of a tool that has several (commands.hpp).
struct CommandHelp {
    std::string name, summary;
};

/// What all tools share: the common options, `tool: file:line: what` messages, the statuses, the
/// default action of SIGPIPE, and the check of standard output when it is closed.
class App {
public:
    /// @param name      of the tool, or `TOOL COMMAND`: messages are TOOL's
    /// @param summary   one sentence, first in --help
    /// @param examples  lines of shell, last in --help, each with its line end
    App(const std::string& name, const std::string& summary, const std::string& examples,
        Options shared = {});
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    /// For the tool's own options. A repeatable option must say allow_extra_args(false), else it
    /// takes the FILE behind it for its second value.
    CLI::App& options();

    /// The formats that -F and -f accept; the first is the default. Not called: no such option.
    void input_formats(std::vector<std::string> names);
    void output_formats(std::vector<std::string> names);

    /// Takes sections of the configuration file, after the options.
    void config_sections(ConfigSections sections);

    /// Has --help name the commands of the tool (commands.hpp).
    void commands(std::vector<CommandHelp> list);

    /// Parses, runs `body`, flushes and checks standard output, and returns the exit status:
    /// exceptions become a message and their status; 1 where a record was refused.
    int main(int argc, char** argv, const std::function<void(Io&)>& body);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_APP_HPP
