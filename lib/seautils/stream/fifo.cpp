#include "seautils/stream/fifo.hpp"

#include "seautils/core/error.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace seautils::stream {

namespace {

constexpr mode_t fifo_mode = 0660;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw Error(ExitCode::cannot_create, path + ": " + why);
}

}  // namespace

int open_fifo(const std::string& path) {
    if (::mkfifo(path.c_str(), fifo_mode) != 0 && errno != EEXIST) fail(path, std::strerror(errno));
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0 && !S_ISFIFO(status.st_mode))
        fail(path, "exists and is no FIFO");
    const int fd = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) fail(path, std::strerror(errno));
    return fd;
}

bool try_write(int fd, std::string_view record) {
    for (;;) {
        // A pipe that polls writable has room for PIPE_BUF bytes.
        pollfd room{fd, POLLOUT, 0};
        if (::poll(&room, 1, 0) == 0) return false;
        const ssize_t n = ::write(fd, record.data(), record.size());
        if (n == static_cast<ssize_t>(record.size())) return true;
        if (n >= 0) throw Error(ExitCode::io, "write failed: only a part was written");
        if (errno == EAGAIN || errno == EWOULDBLOCK) return false;
        if (errno != EINTR)
            throw Error(ExitCode::io, std::string("write failed: ") + std::strerror(errno));
    }
}

FeedbackFifo::~FeedbackFifo() {
    if (fd_ >= 0) ::close(fd_);
}

bool FeedbackFifo::write(std::string_view record) {
    const bool written = try_write(fd_, record);
    if (!written) ++dropped_;
    return written;
}

}  // namespace seautils::stream
