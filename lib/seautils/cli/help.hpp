#ifndef SEAUTILS_CLI_HELP_HPP
#define SEAUTILS_CLI_HELP_HPP

#include "seautils/cli/app.hpp"
#include "seautils/cli/config_file.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace seautils::cli {

/// What --help prints: the sentence, the usage, the commands, the options, the examples, where the manual is. No
/// line is longer than 100 columns where no word is.
std::string help_text(const CLI::App& app, const std::string& examples,
                      const std::vector<CommandHelp>& commands);

/// What went wrong with a command line, in one line without the tool's name.
std::string parse_fault(const CLI::App& app, const CLI::ParseError& error);

/// The options that a configuration file may set: all with a long name but those that say where
/// configuration comes from, and help and version.
std::vector<ConfigOption> config_options(const CLI::App& app);

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_HELP_HPP
