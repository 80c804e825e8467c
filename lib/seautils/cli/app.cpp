#include "seautils/cli/app.hpp"

#include "seautils/cli/help.hpp"
#include "seautils/cli/messages.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <new>
#include <optional>

namespace seautils::cli {

struct App::Impl {
    Impl(const std::string& name, const std::string& summary, std::string shell, Options options)
        : app(summary, name),
          tool(name.substr(0, name.find(' '))),
          examples(std::move(shell)),
          shared(options),
          messages(tool) {}

    CLI::App app;
    std::string tool;  ///< its name, without that of a command
    std::string examples;
    std::vector<CommandHelp> commands;
    Options shared;
    Messages messages;
    Settings settings;
    std::vector<std::string> input_formats, output_formats;
    std::vector<std::string> configs;
    std::optional<ConfigSections> sections;
    std::string color = "auto";
    std::string time, clock = "system";
    bool quiet = false, verbose = false, print_config = false;
    CLI::Option* progress = nullptr;
    bool show_progress = true;

    void add_common();
    void add_stream();
    void parse(int argc, char** argv);
    void apply_config(int argc, char** argv);
    bool set_in_section(const std::string& key, const std::vector<std::string>& values);
    void check_values();
    void check_clock();
    [[noreturn]] void config_fault(const std::string& what) const;
    void settle();
    void check_format(const char* option, const std::string& name,
                      const std::vector<std::string>& known) const;
    int run(const std::function<void(Io&)>& body);
};

namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// A closed standard descriptor would be given to the next file that is opened.
void fill_standard_descriptors() {
    for (int fd = 0; fd < 3; ++fd) {
        if (::fcntl(fd, F_GETFD) != -1) continue;
        const int null = ::open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
        if (null >= 0 && null != fd) ::close(null);
    }
}

/// CLI11 wants what is wrong, or nothing.
std::string is_record_size(const std::string& text) {
    std::uint64_t bytes = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bytes);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (whole && bytes >= 1 && bytes <= (1U << 24)) return {};
    return quote(text) + " is outside 1 to 16777216 bytes";
}

/// Whether the command line says it, or the contrary.
bool is_given(const CLI::Option& option) {
    const auto excluded = option.get_excludes();
    return option.count() > 0 ||
           std::any_of(excluded.begin(), excluded.end(),
                       [](const CLI::Option* other) { return other->count() > 0; });
}

[[noreturn]] void usage(const std::string& what) { throw Error(ExitCode::usage, what); }

/// A variable of the shell that is not set gives an empty value: nobody means that.
[[noreturn]] void empty_value(std::string_view name) {
    usage(fmt::format("option {}: the value is empty", name));
}

void check_not_empty(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return;
    for (const std::string& value : option.results()) {
        if (value.empty() && option.get_lnames().empty()) usage("the name of a FILE is empty");
        if (value.empty()) empty_value("--" + option.get_lnames().front());
    }
}

int status_of(ExitCode code) { return static_cast<int>(code); }

}  // namespace

App::App(const std::string& name, const std::string& summary, const std::string& examples,
         Options shared)
    : impl_(std::make_unique<Impl>(name, summary, examples, shared)) {
    impl_->add_common();
    impl_->add_stream();
}

App::~App() = default;

CLI::App& App::options() { return impl_->app; }

void App::Impl::add_common() {
    app.set_help_flag("-h,--help", "Show this help");
    app.set_version_flag("-V,--version", tool + " (seautils) " SEAUTILS_VERSION,
                         "Show the version");
    app.add_flag("-q,--quiet", quiet, "Errors only");
    app.add_flag("-v,--verbose", verbose, "Say more");
    app.add_option("--color", color, "Colour of messages: auto, always, never")
        ->option_text("WHEN");
    if (shared.schema) {
        app.add_option(
               "-s,--schema", settings.schemas,
               "Schema: a .proto file, a folder of them, or an .xml file of DCCL 1; may repeat")
            ->allow_extra_args(false)
            ->option_text("PATH");
        app.add_option("-m,--message", settings.messages, "Message type; may repeat")
            ->allow_extra_args(false)
            ->option_text("NAME");
    }
    if (shared.config) {
        app.add_option("-c,--config", configs,
                       "Read options from FILE; may repeat, the first to say a thing wins")
            ->allow_extra_args(false)
            ->option_text("FILE");
        app.add_flag("--print-config", print_config, "Print an example of such a file");
    }
    if (shared.time) {
        app.add_option("--time", time, "Stands in for the clock: 2024-05-01T12:00:25Z or @SECONDS")
            ->option_text("TIME");
    }
    if (shared.clock) {
        app.add_option("--clock", clock,
                       "Where time comes from: system, input (of the records), warp:N,BOOT,SIM")
            ->option_text("CLOCK");
    }
    if (shared.seed)
        app.add_option("--seed", settings.seed, "Seed of random numbers, 0")->option_text("N");
}

void App::Impl::add_stream() {
    if (!shared.stream) return;
    app.add_flag("--strict", settings.strict, "Stop at the first bad record");
    app.add_option("--max-record", settings.max_record, "Refuse a longer record (1048576)")
        ->option_text("BYTES")
        ->check(is_record_size);
    app.add_flag("--follow", settings.follow,
                 "At the end of FILE wait for more; open it again when it is replaced");
    progress = app.add_flag("--progress,!--no-progress", show_progress,
                            "Say how far it is, on a terminal");
    app.add_option("FILE", settings.files, "Inputs; none or -: standard input");
}

void App::input_formats(std::vector<std::string> names) {
    impl_->input_formats = std::move(names);
    impl_->settings.input_format = impl_->input_formats.front();
    impl_->app
        .add_option("-F,--input-format", impl_->settings.input_format,
                    "Format of input: " + joined(impl_->input_formats))
        ->option_text("FMT");
}

void App::output_formats(std::vector<std::string> names) {
    impl_->output_formats = std::move(names);
    impl_->settings.format = impl_->output_formats.front();
    impl_->app
        .add_option("-f,--format", impl_->settings.format,
                    "Format of output: " + joined(impl_->output_formats))
        ->option_text("FMT");
}

void App::config_sections(ConfigSections sections) { impl_->sections = std::move(sections); }

void App::commands(std::vector<CommandHelp> list) { impl_->commands = std::move(list); }

void App::Impl::parse(int argc, char** argv) {
    // CLI11 would take the word behind `--name=` for the value.
    for (int k = 1; k < argc && argv[k] != std::string_view("--"); ++k) {
        const std::string_view word = argv[k];
        if (word.starts_with("--") && word.find('=') == word.size() - 1)
            empty_value(word.substr(0, word.size() - 1));
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        throw;
    } catch (const CLI::CallForVersion&) {
        throw;
    } catch (const CLI::ParseError& e) {
        usage(parse_fault(app, e));
    }
}

/// Parses again, with what the files say of options that the command line leaves alone.
void App::Impl::apply_config(int argc, char** argv) {
    if (configs.empty()) return;
    std::vector<ConfigOption> known = config_options(app);
    if (sections) known.push_back({sections->name + ".*", "", ""});
    std::vector<std::string> words;
    for (const auto& [key, values] : read_config(configs, known)) {
        if (set_in_section(key, values)) continue;
        if (is_given(*app.get_option("--" + key))) continue;
        for (const std::string& value : values) {
            if (value.empty()) config_fault("option --" + key + ": the value is empty");
            words.push_back("--" + key + "=" + value);
        }
    }
    for (int k = 1; k < argc; ++k) words.emplace_back(argv[k]);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    try {
        app.parse(words);
    } catch (const CLI::ParseError& e) {
        config_fault(parse_fault(app, e));
    }
    try {
        check_values();
    } catch (const Error& e) {
        config_fault(e.what());
    }
}

/// Whether the key is in a section: then its value is taken.
bool App::Impl::set_in_section(const std::string& key, const std::vector<std::string>& values) {
    if (!sections || !key.starts_with(sections->name + ".")) return false;
    const std::size_t begin = sections->name.size() + 1;
    const std::size_t end = key.rfind('.');
    const std::string section = end < begin ? "" : key.substr(begin, end - begin);
    try {
        sections->set(section, key.substr(std::max(begin, end + 1)), values.front());
    } catch (const ConfigError& e) {
        throw ConfigError(config_place(configs, key) + e.what());
    }
    return true;
}

/// The command line alone was sound: `what` is the fault of a file.
void App::Impl::config_fault(const std::string& what) const {
    std::string place;
    for (const ConfigOption& option : config_options(app)) {
        const std::size_t at = what.find("--" + option.key);
        const std::size_t end = at + option.key.size() + 2;
        if (at == what.npos || what.find_first_of(" :", end) != end) continue;
        place = config_place(configs, option.key);
        if (!place.empty()) break;
    }
    throw ConfigError((place.empty() ? joined(configs) + ": " : place) + what);
}

void App::Impl::check_format(const char* option, const std::string& name,
                             const std::vector<std::string>& known) const {
    if (known.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
    usage(fmt::format("option {}: {} is none of {}", option, quote(name), joined(known)));
}

/// Checks the values of shared options, from the command line and then with the files' too.
void App::Impl::check_values() {
    for (const CLI::Option* option : app.get_options()) check_not_empty(*option);
    if (color != "auto" && color != "always" && color != "never") {
        usage("option --color: " + quote(color) + " is none of auto, always, never");
    }
    check_format("--input-format", settings.input_format, input_formats);
    check_format("--format", settings.format, output_formats);
    check_clock();
}

/// --time wins over --clock, and that over the environment.
void App::Impl::check_clock() {
    const char* inherited = std::getenv("SEAUTILS_CLOCK");
    const bool inherits = (shared.time || shared.clock) && inherited != nullptr && *inherited != 0;
    const bool chosen = shared.clock && app.get_option("--clock")->count() > 0;
    std::string from = chosen || !inherits ? "option --clock" : "SEAUTILS_CLOCK";
    try {
        settings.clock = Clock(chosen || !inherits ? clock : inherited);
        from = "option --time";
        if (!time.empty()) settings.clock = Clock::fixed(parse_utc(time));
    } catch (const DataError& e) {
        usage(from + ": " + e.what());
    }
    if (settings.clock.is_input() && !shared.clock)
        usage("SEAUTILS_CLOCK: this tool's records have no time to take");
}

/// Turns what was parsed into settings.
void App::Impl::settle() {
    messages.set_color(color);
    settings.verbosity = quiet ? -1 : verbose ? 1 : 0;
    if (progress != nullptr && progress->count() > 0) settings.progress = show_progress;
    if (shared.schema && settings.schemas.empty())
        usage("option --schema is required (try --help)");
    const std::string& f = settings.format;
    const bool binary = f == "delimited" || f == "raw" || f == "shd" || f == "arr-binary";
    if (binary && ::isatty(STDOUT_FILENO) == 1) {
        usage(fmt::format("format {} is binary and not written to a terminal", settings.format));
    }
}

int App::Impl::run(const std::function<void(Io&)>& body) {
    stream::Output out(STDOUT_FILENO);
    Io io(std::move(settings), out, messages);
    try {
        body(io);
    } catch (const Error& e) {
        // What was done before the fault is not lost with it.
        if (e.code() != ExitCode::io) out.close();
        throw;
    }
    out.close();
    if (io.ended_by != 0) ::raise(io.ended_by);
    return io.refused() > 0 ? status_of(ExitCode::some_refused) : 0;
}

int App::main(int argc, char** argv, const std::function<void(Io&)>& body) {
    ::signal(SIGPIPE, SIG_DFL);
    fill_standard_descriptors();
    Impl& a = *impl_;
    const auto print = [](const std::string& text) {
        stream::Output out(STDOUT_FILENO);
        out << text;
        out.close();
        return 0;
    };
    const auto fail = [&](ExitCode code, const std::string& what) {
        a.messages.write(Level::error, what);
        return status_of(code);
    };
    try {
        try {
            a.parse(argc, argv);
            if (a.print_config)
                return print(example_config(a.app.get_name(), config_options(a.app)) +
                             (a.sections ? example_sections(*a.sections) : ""));
            a.check_values();
            a.apply_config(argc, argv);
        } catch (const CLI::CallForHelp&) {
            return print(help_text(a.app, a.examples, a.commands));
        } catch (const CLI::CallForVersion&) {
            return print(a.app.version() + "\n");
        }
        a.settle();
        return a.run(body);
    } catch (const Error& e) {
        return fail(e.code(), e.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::internal, "out of memory");
    } catch (const std::exception& e) {
        return fail(ExitCode::internal, std::string("internal error: ") + e.what());
    }
}

}  // namespace seautils::cli
