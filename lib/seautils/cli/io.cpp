#include "seautils/cli/io.hpp"

#include "seautils/cli/messages.hpp"
#include "seautils/cli/progress.hpp"
#include "seautils/core/error.hpp"
#include "seautils/stream/input.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

namespace seautils::cli {

struct Io::Impl {
    const Messages& messages;
    Settings& settings;
    stream::Output& out;
    std::string name;  ///< of the current input
    std::uint64_t refused = 0;
    std::unique_ptr<stream::Input> input;
    std::unique_ptr<Progress> progress;

    void open(const std::string& file, bool text);
    int open_descriptor(const std::string& file);
    void refuse(const std::string& place, const std::string& what);
    std::string place(Framing framing) const;
    template <class Read>
    auto located(Framing framing, Read read);
    bool next(Framing framing, std::string_view& record);
    void follow_progress() {
        if (progress) progress->update(input->bytes_read());
    }
};

int Io::Impl::open_descriptor(const std::string& file) {
    if (file == "-") {
        name = "<stdin>";
        struct stat status {};
        if (::fstat(STDIN_FILENO, &status) != 0)
            throw Error(ExitCode::no_input, "<stdin>: " + std::string(std::strerror(errno)));
        return STDIN_FILENO;
    }
    name = file;
    const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) throw Error(ExitCode::no_input, file + ": " + std::strerror(errno));
    return fd;
}

void Io::Impl::open(const std::string& file, bool text) {
    const int fd = open_descriptor(file);
    struct stat status {};
    ::fstat(fd, &status);
    if (S_ISDIR(status.st_mode)) throw Error(ExitCode::no_input, name + ": Is a directory");
    if (::isatty(fd) == 1) {
        if (!text) throw Error(ExitCode::usage, "binary input is not read from a terminal");
        messages.write(Level::info, "reading from the terminal (end with Ctrl-D)");
    }
    stream::Input::Options options;
    options.max_record = settings.max_record;
    options.follow = settings.follow && file != "-";
    options.before_wait = [this] {
        if (progress) progress->clear();
        out.flush();
    };
    input = std::make_unique<stream::Input>(fd, options.follow ? file : "", std::move(options));
    const bool sized = S_ISREG(status.st_mode) && !settings.follow;
    progress.reset();
    if (sized && settings.progress.value_or(true)) {
        progress = std::make_unique<Progress>(name, static_cast<std::uint64_t>(status.st_size));
    }
}

void Io::Impl::refuse(const std::string& place, const std::string& what) {
    if (progress) progress->clear();
    if (settings.strict) throw Error(ExitCode::data, place + what);
    ++refused;
    messages.write(Level::error, place + what);
}

std::string Io::Impl::place(Framing framing) const {
    if (framing == Framing::lines) return fmt::format("{}:{}: ", name, input->count());
    return fmt::format("{}:record {} (byte {}): ", name, input->count(), input->offset());
}

/// Does what reads the input, and says where it was when that fails.
template <class Read>
auto Io::Impl::located(Framing framing, Read read) {
    try {
        return read();
    } catch (const Error& e) {
        if (e.code() == ExitCode::data) throw Error(e.code(), place(framing) + e.what());
        const bool failed = std::string_view(e.what()).starts_with("read failed");
        if (e.code() == ExitCode::io && failed) throw Error(e.code(), name + ": " + e.what());
        throw;
    }
}

bool Io::Impl::next(Framing framing, std::string_view& record) {
    using Got = stream::Input::Got;
    for (;;) {
        const Got got = located(framing, [&] {
            return framing == Framing::lines ? input->line(record) : input->record(record);
        });
        if (got != Got::too_long) return got == Got::record;
        refuse(place(framing),
               fmt::format("longer than {} bytes (--max-record)", settings.max_record));
    }
}

Io::Io(Settings settings, stream::Output& output, const Messages& reporter)
    : Settings(std::move(settings)),
      out(output),
      impl_(new Impl{reporter, *this, output, {}, 0, {}, {}}) {}

Io::~Io() = default;

void Io::for_each(Framing framing, const std::function<void(std::string_view record)>& record) {
    const std::vector<std::string> standard_input = {"-"};
    for (const std::string& file : files.empty() ? standard_input : files) {
        impl_->open(file, framing == Framing::lines);
        std::string_view bytes;
        while (impl_->next(framing, bytes)) {
            if (bytes.empty() && framing == Framing::lines) continue;
            try {
                record(bytes);
            } catch (const DataError& e) {
                impl_->refuse(impl_->place(framing), e.what());
            }
            if ((impl_->input->count() & 1023) == 0) impl_->follow_progress();
        }
    }
}

void Io::for_each_block(const Block& block) {
    const std::vector<std::string> standard_input = {"-"};
    for (const std::string& file : files.empty() ? standard_input : files) {
        impl_->open(file, false);
        for (bool ended = false; !ended;) {
            const std::string_view bytes =
                impl_->located(Framing::delimited, [&] { return impl_->input->block(ended); });
            const std::size_t used = block(bytes, impl_->input->offset(), ended);
            if (used == 0 && impl_->input->full()) {
                stop_at(impl_->input->offset(),
                        fmt::format("no message in {} bytes (--max-record)", max_record));
            }
            impl_->input->consume(used);
            impl_->follow_progress();
        }
    }
}

void Io::refuse_at(std::uint64_t offset, const std::string& what) {
    impl_->refuse(fmt::format("{}:byte {}: ", impl_->name, offset), what);
}

void Io::stop_at(std::uint64_t offset, const std::string& what) {
    throw Error(ExitCode::data, fmt::format("{}:byte {}: {}", impl_->name, offset, what));
}

void Io::warn(const std::string& what) const {
    if (verbosity >= 0) impl_->messages.write(Level::warning, what);
}

void Io::inform(const std::string& what) const {
    if (verbosity > 0) impl_->messages.write(Level::info, what);
}

std::int64_t Io::now_us() const {
    if (time_us) return *time_us;
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

bool Io::reads_stdin() const {
    return files.empty() || std::find(files.begin(), files.end(), "-") != files.end();
}

std::uint64_t Io::refused() const { return impl_->refused; }

}  // namespace seautils::cli
