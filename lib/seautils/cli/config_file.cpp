#include "seautils/cli/config_file.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>
#include <boost/program_options.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

namespace seautils::cli {

namespace {

namespace po = boost::program_options;

constexpr std::size_t max_file_bytes = 1U << 20;

/// The line on which a key is set, for messages: Boost does not keep it.
std::size_t line_of(const std::string& text, const std::string& key) {
    std::istringstream in(text);
    std::string section;
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        line = line.substr(0, line.find('#'));
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == line.npos) continue;
        line = line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
        if (line.front() == '[' && line.back() == ']') {
            section = line.substr(1, line.size() - 2) + ".";
            continue;
        }
        const std::size_t equals = line.find('=');
        std::string name = section + line.substr(0, equals);
        name.erase(name.find_last_not_of(" \t") + 1);
        if (name == key || (key.empty() && equals == line.npos)) return number;
    }
    return 0;
}

std::string place(const std::string& name, const std::string& text, const std::string& key) {
    const std::size_t line = line_of(text, key);
    return line == 0 ? name + ": " : fmt::format("{}:{}: ", name, line);
}

po::options_description described(const std::vector<ConfigOption>& options) {
    po::options_description all;
    for (const ConfigOption& o : options)
        all.add_options()(o.key.c_str(), po::value<std::vector<std::string>>());
    return all;
}

/// Whether a key is this option's: its own, or of its sections.
bool covers(const ConfigOption& option, const std::string& key) {
    if (!option.key.ends_with(".*")) return key == option.key;
    return key.starts_with(option.key.substr(0, option.key.size() - 1));
}

std::string file_text(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error(ExitCode::no_input, file + ": " + std::strerror(errno));
    std::string text(max_file_bytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (in.bad() || (text.empty() && !in.eof()))
        throw Error(ExitCode::no_input, file + ": cannot be read");
    if (text.size() > max_file_bytes) throw ConfigError(file + ": longer than 1 MiB");
    return text;
}

}  // namespace

std::map<std::string, std::vector<std::string>> parse_config(
    const std::string& name, const std::string& text, const std::vector<ConfigOption>& options) {
    std::map<std::string, std::vector<std::string>> values;
    const po::options_description all = described(options);
    try {
        std::istringstream in(text);
        const po::parsed_options parsed = po::parse_config_file(in, all, true);
        for (const po::option& o : parsed.options) {
            if (o.unregistered) {
                std::vector<std::string> keys;
                for (const ConfigOption& known : options) keys.push_back(known.key);
                const std::string near = nearest(o.string_key, keys);
                throw ConfigError(place(name, text, o.string_key) + "unknown key " +
                                  quote(o.string_key) +
                                  (near.empty() ? "" : " (did you mean '" + near + "'?)"));
            }
            auto& all_values = values[o.string_key];
            all_values.insert(all_values.end(), o.value.begin(), o.value.end());
        }
    } catch (const po::error&) {
        throw ConfigError(place(name, text, "") +
                          "a line that is neither 'key = value' nor '[section]'");
    }
    for (const ConfigOption& o : options) {
        for (const auto& [key, all_values] : values) {
            if (!covers(o, key) || o.repeatable || all_values.size() < 2) continue;
            throw ConfigError(place(name, text, key) + "key " + quote(key) + " is set twice");
        }
    }
    return values;
}

std::map<std::string, std::vector<std::string>> read_config(
    const std::vector<std::string>& files, const std::vector<ConfigOption>& options) {
    std::map<std::string, std::vector<std::string>> values;
    for (const std::string& file : files) {
        values.merge(parse_config(file, file_text(file), options));  // keeps what is there already
    }
    return values;
}

std::string config_place(const std::vector<std::string>& files, const std::string& key) {
    for (const std::string& file : files) {
        const std::size_t line = line_of(file_text(file), key);
        if (line != 0) return fmt::format("{}:{}: ", file, line);
    }
    return {};
}

std::string example_config(const std::string& tool, const std::vector<ConfigOption>& options) {
    std::string text = fmt::format(
        "# Configuration of {}: the options of its command line, which win over this file.\n",
        tool);
    for (const ConfigOption& o : options) {
        text += fmt::format("\n# {}{}\n#{} = {}\n", o.description,
                            o.repeatable ? " (may stand on several lines)" : "", o.key, o.value);
    }
    return text;
}

std::string example_sections(const ConfigSections& sections) {
    std::string text = fmt::format("\n# {}\n#[{}]\n", sections.description, sections.name);
    for (const ConfigOption& o : sections.keys)
        text += fmt::format("\n# {}\n#  {} = {}\n", o.description, o.key, o.value);
    return text;
}

}  // namespace seautils::cli
