#include "seautils/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace seautils::cli {

namespace {

using namespace std::chrono_literals;

void write_error(const std::string& text) {
    const ssize_t ignored = ::write(STDERR_FILENO, text.data(), text.size());
    static_cast<void>(ignored);  // a progress line that is lost does no harm
}

}  // namespace

Progress::Progress(std::string name, std::uint64_t size_bytes)
    : name_(std::move(name)),
      size_bytes_(size_bytes),
      next_(std::chrono::steady_clock::now() + 2s),
      terminal_(::isatty(STDERR_FILENO) == 1) {}

void Progress::update(std::uint64_t done_bytes) {
    if (!terminal_ || size_bytes_ == 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + 200ms;
    write_error(fmt::format("\r\033[K{}: {} %", name_, done_bytes * 100 / size_bytes_));
    shown_ = true;
}

void Progress::clear() {
    if (shown_) write_error("\r\033[K");
    shown_ = false;
}

}  // namespace seautils::cli
