#include "seautils/cli/io.hpp"

#include "seautils/cli/messages.hpp"
#include "seautils/cli/progress.hpp"
#include "seautils/cli/source.hpp"
#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::cli {

namespace {

const std::vector<std::string> standard_input{"-"};

std::string too_long(const Settings& settings) {
    return fmt::format("longer than {} bytes (--max-record)", settings.max_record);
}

}  // namespace

struct Io::Impl {
    const Messages& messages;
    Settings& settings;
    stream::Output& out;
    std::uint64_t refused = 0;
    std::unique_ptr<Source> source;
    std::unique_ptr<Progress> progress;

    void open(const std::string& file, bool text);
    void refuse(const std::string& place, const std::string& what);
    bool next(Framing framing, std::string_view& record);
    void follow_progress() {
        if (progress) progress->update(source->input().bytes_read());
    }
};

void Io::Impl::open(const std::string& file, bool text) {
    const OpenedFile opened = open_input(file, text);
    if (opened.is_terminal)
        messages.write(Level::info, "reading from the terminal (end with Ctrl-D)");
    stream::Input::Options options;
    options.max_record = settings.max_record;
    options.follow = settings.follow && file != "-";
    options.before_wait = [this] {
        if (progress) progress->clear();
        out.flush();
    };
    const std::string path = options.follow ? file : "";
    source = std::make_unique<Source>(opened.name, opened.fd, path, std::move(options));
    const bool sized = opened.bytes >= 0 && !settings.follow;
    progress.reset();
    if (sized && settings.progress.value_or(true)) {
        progress =
            std::make_unique<Progress>(opened.name, static_cast<std::uint64_t>(opened.bytes));
    }
}

void Io::Impl::refuse(const std::string& place, const std::string& what) {
    if (progress) progress->clear();
    if (settings.strict) throw Error(ExitCode::data, place + what);
    ++refused;
    messages.write(Level::error, place + what);
}

bool Io::Impl::next(Framing framing, std::string_view& record) {
    using Got = stream::Input::Got;
    for (;;) {
        const Got got = source->next(framing, record);
        if (got != Got::too_long) return got == Got::record;
        refuse(source->place(framing), too_long(settings));
    }
}

Io::Io(Settings settings, stream::Output& output, const Messages& reporter)
    : Settings(std::move(settings)),
      out(output),
      impl_(new Impl{reporter, *this, output, 0, {}, {}}) {}

Io::~Io() = default;

void Io::for_each(Framing framing, const std::function<void(std::string_view record)>& record) {
    for (const std::string& file : files.empty() ? standard_input : files) {
        impl_->open(file, framing == Framing::lines);
        std::string_view bytes;
        while (impl_->next(framing, bytes)) {
            if (bytes.empty() && framing == Framing::lines) continue;
            try {
                record(bytes);
            } catch (const DataError& e) {
                impl_->refuse(impl_->source->place(framing), e.what());
            }
            if ((impl_->source->input().count() & 1023) == 0) impl_->follow_progress();
        }
    }
}

void Io::for_each_block(const Block& block) {
    for (const std::string& file : files.empty() ? standard_input : files) {
        impl_->open(file, false);
        for (bool ended = false; !ended;) {
            const std::string_view bytes = impl_->source->located(
                Framing::delimited, [&] { return impl_->source->input().block(ended); });
            const std::size_t used = block(bytes, impl_->source->input().offset(), ended);
            if (used == 0 && impl_->source->input().full()) {
                stop_at(impl_->source->input().offset(),
                        fmt::format("no message in {} bytes (--max-record)", max_record));
            }
            impl_->source->input().consume(used);
            impl_->follow_progress();
        }
    }
}

void Io::refuse_at(std::uint64_t offset, const std::string& what) {
    impl_->refuse(fmt::format("{}:byte {}: ", impl_->source->name(), offset), what);
}

void Io::stop_at(std::uint64_t offset, const std::string& what) {
    throw Error(ExitCode::data, fmt::format("{}:byte {}: {}", impl_->source->name(), offset, what));
}

void Io::warn(const std::string& what) const {
    if (verbosity >= 0) impl_->messages.write(Level::warning, what);
}

void Io::inform(const std::string& what) const {
    if (verbosity > 0) impl_->messages.write(Level::info, what);
}

std::int64_t Io::now_us() const { return clock.now_ns() / 1000; }

void Io::refuse(const std::string& place, const std::string& what) { impl_->refuse(place, what); }

bool Io::reads_stdin() const {
    return files.empty() || std::find(files.begin(), files.end(), "-") != files.end();
}

std::uint64_t Io::record_number() const {
    return impl_->source ? impl_->source->input().count() : 0;
}

std::uint64_t Io::refused() const { return impl_->refused; }

}  // namespace seautils::cli
