#include "seautils/cli/messages.hpp"

#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace seautils::cli {

namespace {

/// Whether standard error is the stream that systemd says it is (sd-daemon(3)).
bool is_journal() {
    const char* stream = std::getenv("JOURNAL_STREAM");
    struct stat status {};
    if (stream == nullptr || ::fstat(STDERR_FILENO, &status) != 0) return false;
    return fmt::format("{}:{}", status.st_dev, status.st_ino) == stream;
}

bool wants_color() {
    const char* no_color = std::getenv("NO_COLOR");
    const char* term = std::getenv("TERM");
    if (no_color != nullptr && *no_color != '\0') return false;
    return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

}  // namespace

Messages::Messages(std::string tool)
    : tool_(std::move(tool)), journal_(is_journal()), color_(wants_color()) {}

void Messages::set_color(const std::string& when) {
    if (when != "auto") color_ = when == "always";
}

void Messages::write(Level level, const std::string& what) const {
    std::string line;
    if (journal_) line += level == Level::error ? "<3>" : level == Level::warning ? "<4>" : "<6>";
    if (color_ && level == Level::error) line += "\033[31m";
    line += tool_ + ": " + printable(what);
    if (color_ && level == Level::error) line += "\033[0m";
    line += '\n';
    // One write a line, so that the lines of several processes do not mix.
    const char* at = line.data();
    for (std::size_t left = line.size(); left > 0;) {
        const ssize_t n = ::write(STDERR_FILENO, at, left);
        if (n <= 0) return;
        at += n;
        left -= static_cast<std::size_t>(n);
    }
}

}  // namespace seautils::cli
