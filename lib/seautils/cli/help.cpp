#include "seautils/cli/help.hpp"

#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

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

std::string lower_first(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0) {
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    }
    return text;
}

bool is_positional(const CLI::Option& option) {
    return option.get_snames().empty() && option.get_lnames().empty();
}

}  // namespace

std::string help_text(const CLI::App& app, const std::string& examples) {
    std::string files;
    std::string options;
    for (const CLI::Option* option : app.get_options()) {
        if (is_positional(*option))
            files += " [" + option->get_name() + "]...";
        else
            options += option_line(*option);
    }
    return app.get_description() + "\n\nUsage: " + app.get_name() + " [OPTION]..." + files +
           "\n\nOptions:\n" + options + "\nExamples:\n" + examples + "\nThe manual: man " +
           app.get_name() + "\n";
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
    return lower_first(error.what()) + " (try --help)";
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
