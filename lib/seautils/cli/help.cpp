#include "seautils/cli/help.hpp"

#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::cli {

namespace {

constexpr std::size_t columns = 100;
constexpr std::size_t text_column = 34;

std::string value_name(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return {};
    return option.get_option_text().empty() ? "VALUE" : option.get_option_text();
}

/// `-f, --format FMT`
std::string names(const CLI::Option& option) {
    std::string text;
    for (const std::string& name : option.get_snames()) text += (text.empty() ? "-" : ", -") + name;
    for (const std::string& name : option.get_lnames())
        text += (text.empty() ? "    --" : ", --") + name;
    const std::string value = value_name(option);
    return value.empty() ? text : text + " " + value;
}

/// Breaks a description into lines behind a margin.
std::string wrapped(const std::string& text, std::size_t margin) {
    std::string out;
    std::size_t column = margin;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::size_t width = end - at;
        if (column + width + 1 > columns && column > margin) {
            out += '\n' + std::string(margin, ' ');
            column = margin;
        } else if (column > margin) {
            out += ' ';
            ++column;
        }
        out += text.substr(at, width);
        column += width;
        at = end + 1;
    }
    return out;
}

std::string option_line(const CLI::Option& option) {
    std::string line = "  " + names(option);
    if (line.size() + 2 > text_column)
        line += '\n' + std::string(text_column, ' ');
    else
        line.resize(text_column, ' ');
    return line + wrapped(option.get_description(), text_column) + '\n';
}

/// A sentence of CLI11 in one line, without its capital and its stop.
std::string tamed(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return lower_first(std::move(text));
}

/// The long option that CLI11's sentence speaks of, with its dashes.
std::string option_in(const std::string& text) {
    const std::size_t begin = text.find("--");
    if (begin == text.npos) return {};
    return text.substr(begin, std::min(text.find_first_of(" :", begin), text.size()) - begin);
}

/// What CLI11 has against the value of an option, in the words of the house.
std::string value_fault(const CLI::App& app, const CLI::ParseError& error) {
    const std::string text = error.what();
    const std::string name = option_in(text);
    const CLI::Option* option = name.empty() ? nullptr : app.get_option_no_throw(name);
    if (option == nullptr) return tamed(text);
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
        const std::size_t equals = text.find(" = ");
        const std::string value = equals == text.npos ? "" : quote(text.substr(equals + 3)) + " ";
        return "option " + name + ": " + value +
               (option->get_items_expected_max() == 0 ? "is neither true nor false"
                                                      : "is no whole number, or one too large");
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        if (text.find("missing") == text.npos) return "option " + name + " is given twice";
        return "option " + name + " lacks its value (" + value_name(*option) + ")";
    }
    if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
        return "options " + name + " and " + option_in(text.substr(text.find(name) + 2)) +
               " exclude each other";
    }
    return "option " + tamed(text);
}

std::string command_list(const std::string& tool, const std::vector<CommandHelp>& commands) {
    if (commands.empty()) return {};
    std::string text = "\n\nCommands (" + tool + " COMMAND --help says more):";
    for (const CommandHelp& command : commands) {
        std::string line = "  " + command.name;
        line.resize(text_column, ' ');
        text += '\n' + line + wrapped(command.summary, text_column);
    }
    return text;
}

bool is_positional(const CLI::Option& option) {
    return option.get_snames().empty() && option.get_lnames().empty();
}

}  // namespace

std::string help_text(const CLI::App& app, const std::string& examples,
                      const std::vector<CommandHelp>& commands) {
    std::string files;
    std::string options;
    for (const CLI::Option* option : app.get_options()) {
        if (is_positional(*option))
            files += option->get_items_expected_max() > 1 ? " [" + option->get_name() + "]..."
                                                          : " " + option->get_name();
        else
            options += option_line(*option);
    }
    const std::string name = app.get_name();
    const std::string usage =
        commands.empty() ? name + " [OPTION]..." + files : name + " COMMAND [OPTION]... [FILE]...";
    return app.get_description() + "\n\nUsage: " + usage + command_list(name, commands) +
           "\n\nOptions:\n" + options + "\nExamples:\n" + examples + "\nThe manual: man " +
           name.substr(0, name.find(' ')) + "\n";
}

std::string parse_fault(const CLI::App& app, const CLI::ParseError& error) {
    // The unknown option is what the user wants to hear of, even when others are missing too.
    for (const std::string& word : app.remaining()) {
        if (word.size() < 2 || word.front() != '-') continue;
        const std::string name = word.substr(0, word.find('='));
        std::vector<std::string> known;
        for (const CLI::Option* option : app.get_options()) {
            for (const std::string& l : option->get_lnames()) known.push_back("--" + l);
        }
        const std::string near = name.starts_with("--") ? nearest(name, known) : std::string();
        return "unknown option " + name +
               (near.empty() ? " (try --help)" : " (did you mean " + near + "?)");
    }
    if (!app.remaining().empty() && dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        return "argument " + quote(app.remaining().front()) + " is one too many (try --help)";
    }
    return value_fault(app, error);
}

std::vector<ConfigOption> config_options(const CLI::App& app) {
    std::vector<ConfigOption> all;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_lnames().empty()) continue;
        const std::string& key = option->get_lnames().front();
        if (key == "help" || key == "version" || key == "config" || key == "print-config") continue;
        ConfigOption o;
        o.key = key;
        o.description = option->get_description();
        o.flag = option->get_items_expected_max() == 0;
        o.value = o.flag ? "true" : value_name(*option);
        o.repeatable = !o.flag && option->get_expected_max() > 1;
        all.push_back(std::move(o));
    }
    return all;
}

}  // namespace seautils::cli
