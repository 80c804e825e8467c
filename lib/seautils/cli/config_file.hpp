#ifndef SEAUTILS_CLI_CONFIG_FILE_HPP
#define SEAUTILS_CLI_CONFIG_FILE_HPP

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace seautils::cli {

/// An option that a configuration file may set.
struct ConfigOption {
    std::string key;  ///< its long name without dashes; `name.*`: any key of sections of that name
    std::string description;
    std::string value;  ///< its default, or what a value looks like
    bool repeatable = false;
    bool flag = false;
};

/// Reads layers of configuration: lines of `key = value`, sections of `[name]` whose keys are
/// `name.key`, comments from `#`. The first file to say a thing wins; within a file a repeatable
/// key may come again.
///
/// @param options  what may be said; anything else is refused
/// @return         the values of each key that some file sets, in the order of that file
/// @throws ConfigError  `FILE: what`: an unknown key (proposes the nearest), a line without `=`,
///                      more than 1 MiB
/// @throws Error        no_input: cannot be opened
std::map<std::string, std::vector<std::string>> read_config(
    const std::vector<std::string>& files, const std::vector<ConfigOption>& options);

/// The same for one text (tests, fuzzing); `name` stands for the file in messages.
std::map<std::string, std::vector<std::string>> parse_config(
    const std::string& name, const std::string& text, const std::vector<ConfigOption>& options);

/// Where a key is set, for messages: `FILE:LINE: ` of the first file that does; empty where none does.
/// @throws Error  no_input: cannot be opened
std::string config_place(const std::vector<std::string>& files, const std::string& key);

/// Sections of a configuration file that are no options: `[name]`, and any `[name.WORD]`.
struct ConfigSections {
    std::string name;
    std::string description;         ///< for --print-config
    std::vector<ConfigOption> keys;  ///< for --print-config
    /// Takes a key of a section; `section` is empty for `[name]`, else WORD.
    /// @throws ConfigError  without its place, which the caller puts in front
    std::function<void(const std::string& section, const std::string& key,
                       const std::string& value)>
        set;
};

/// What example_config() shows of them.
std::string example_sections(const ConfigSections& sections);

/// A file with each option, its description, and its default, all in comments.
std::string example_config(const std::string& tool, const std::vector<ConfigOption>& options);

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_CONFIG_FILE_HPP
