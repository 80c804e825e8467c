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
#include <csignal>
#include <new>

namespace seautils::cli {

struct App::Impl {
    Impl(const std::string& name, const std::string& summary, std::string shell, Options options)
        : app(summary, name), examples(std::move(shell)), shared(options), messages(name) {}

    CLI::App app;
    std::string examples;
    Options shared;
    Messages messages;
    Settings settings;
    std::vector<std::string> input_formats, output_formats;
    std::vector<std::string> configs;
    std::string color = "auto";
    std::string time;
    bool quiet = false, verbose = false, print_config = false;
    CLI::Option* progress = nullptr;
    bool show_progress = true;

    void add_common();
    void add_stream();
    void parse(int argc, char** argv);
    void apply_config(int argc, char** argv);
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

[[noreturn]] void usage(const std::string& what) { throw Error(ExitCode::usage, what); }

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
    app.set_version_flag("-V,--version", app.get_name() + " (seautils) " SEAUTILS_VERSION,
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
    if (shared.seed)
        app.add_option("--seed", settings.seed, "Seed of random numbers, 0")->option_text("N");
}

void App::Impl::add_stream() {
    if (!shared.stream) return;
    app.add_flag("--strict", settings.strict, "Stop at the first bad record");
    app.add_option("--max-record", settings.max_record, "Refuse a longer record (1048576)")
        ->option_text("BYTES")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 24));
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

void App::Impl::parse(int argc, char** argv) {
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
    const std::vector<ConfigOption> known = config_options(app);
    std::vector<std::string> words;
    for (const auto& [key, values] : read_config(configs, known)) {
        if (app.get_option("--" + key)->count() > 0) continue;
        for (const std::string& value : values) words.push_back("--" + key + "=" + value);
    }
    for (int k = 1; k < argc; ++k) words.emplace_back(argv[k]);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    try {
        app.parse(words);
    } catch (const CLI::ParseError& e) {
        throw ConfigError(joined(configs) + ": " + parse_fault(app, e));
    }
}

void App::Impl::check_format(const char* option, const std::string& name,
                             const std::vector<std::string>& known) const {
    if (known.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
    usage(fmt::format("option {}: {} is none of {}", option, quote(name), joined(known)));
}

/// Checks what was parsed, and turns it into settings.
void App::Impl::settle() {
    if (color != "auto" && color != "always" && color != "never") {
        usage("option --color: " + quote(color) + " is none of auto, always, never");
    }
    messages.set_color(color);
    check_format("--input-format", settings.input_format, input_formats);
    check_format("--format", settings.format, output_formats);
    settings.verbosity = quiet ? -1 : verbose ? 1 : 0;
    if (progress != nullptr && progress->count() > 0) settings.progress = show_progress;
    if (shared.schema && settings.schemas.empty())
        usage("option --schema is required (try --help)");
    if (!time.empty()) {
        try {
            settings.time_us = parse_utc(time);
        } catch (const DataError& e) {
            usage(std::string("option --time: ") + e.what());
        }
    }
    const bool binary = settings.format == "delimited" || settings.format == "raw";
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
                return print(example_config(a.app.get_name(), config_options(a.app)));
            a.apply_config(argc, argv);
        } catch (const CLI::CallForHelp&) {
            return print(help_text(a.app, a.examples));
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
