#include "seautils/cli/commands.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

namespace seautils::cli {

Commands::Commands(std::string name, std::string summary, std::string examples)
    : name_(std::move(name)), summary_(std::move(summary)), examples_(std::move(examples)) {}

void Commands::add(std::string name, std::string summary, Main main) {
    commands_.push_back({{std::move(name), std::move(summary)}, std::move(main)});
}

int Commands::main(int argc, char** argv) const {
    for (const Command& command : commands_) {
        if (argc > 1 && command.help.name == argv[1]) return command.main(argc - 1, argv + 1);
    }
    App app{name_, summary_, examples_, {.stream = false}};
    std::vector<CommandHelp> list;
    for (const Command& command : commands_) list.push_back(command.help);
    app.commands(std::move(list));
    std::vector<std::string> words;
    app.options().add_option("COMMAND", words, "");
    return app.main(argc, argv, [&](Io&) { throw Error(ExitCode::usage, fault(words)); });
}

std::string Commands::names() const {
    std::string text;
    for (const Command& command : commands_) text += (text.empty() ? "" : ", ") + command.help.name;
    return text;
}

/// What is wrong with the words that are no options.
std::string Commands::fault(const std::vector<std::string>& words) const {
    if (words.empty()) return "a command is missing: " + names() + " (try --help)";
    std::vector<std::string> known;
    for (const Command& command : commands_) known.push_back(command.help.name);
    for (const std::string& name : known) {
        if (name == words.front()) return "command " + quote(name) + " must be the first word";
    }
    const std::string near = nearest(words.front(), known);
    return "command " + quote(words.front()) + " is none of " + names() +
           (near.empty() ? "" : " (did you mean " + near + "?)");
}

}  // namespace seautils::cli
