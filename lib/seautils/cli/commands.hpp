#ifndef SEAUTILS_CLI_COMMANDS_HPP
#define SEAUTILS_CLI_COMMANDS_HPP

#include "seautils/cli/app.hpp"

#include <functional>
#include <string>
#include <vector>

namespace seautils::cli {

/// A tool of several jobs, each named by the first word: `TOOL COMMAND [OPTION]... [FILE]...`.
///
/// A command is a tool of its own, with an App that is called `TOOL COMMAND`; messages, version and
/// manual are those of TOOL. Without a command there is --help, which names them, and --version.
class Commands {
public:
    /// The rest of a command: gets the command line from its own name on, returns the status.
    using Main = std::function<int(int argc, char** argv)>;

    /// As App().
    Commands(std::string name, std::string summary, std::string examples);

    /// @param summary  what it does, for --help of the tool: a few words without a stop
    void add(std::string name, std::string summary, Main main);

    int main(int argc, char** argv) const;

private:
    struct Command {
        CommandHelp help;
        Main main;
    };

    std::string names() const;
    std::string fault(const std::vector<std::string>& words) const;

    std::string name_, summary_, examples_;
    std::vector<Command> commands_;
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_COMMANDS_HPP
