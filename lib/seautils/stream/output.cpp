#include "seautils/stream/output.hpp"

#include "seautils/core/error.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace seautils::stream {

namespace {

[[noreturn]] void fail(int error) {
    throw Error(ExitCode::io, std::string("write failed: ") + std::strerror(error));
}

}  // namespace

Output::Output(int fd, std::size_t buffer_bytes) : fd_(fd), limit_(buffer_bytes) {
    buffer_.reserve(limit_ + 4096);
}

void Output::write(std::string_view bytes) {
    buffer_ += bytes;
    commit();
}

void Output::flush() {
    std::size_t done = 0;
    while (done < buffer_.size()) {
        const ssize_t n = ::write(fd_, buffer_.data() + done, buffer_.size() - done);
        if (n >= 0) {
            done += static_cast<std::size_t>(n);
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            pollfd ready{fd_, POLLOUT, 0};
            ::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            const int error = errno;
            buffer_.clear();
            fail(error);
        }
    }
    buffer_.clear();
}

void Output::close() {
    flush();
    const int fd = fd_;
    fd_ = -1;
    // A second close of one descriptor would hit whatever has its number by then.
    if (fd >= 0 && ::close(fd) != 0 && errno != EINTR) fail(errno);
}

}  // namespace seautils::stream
