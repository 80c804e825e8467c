#include "seautils/stream/serial_line.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

namespace seautils::stream {

namespace {

constexpr int connect_ms = 2000;

struct Baud {
    unsigned bits_per_s;
    speed_t code;
};
constexpr std::array bauds = {
    Baud{300, B300},       Baud{600, B600},       Baud{1200, B1200},     Baud{2400, B2400},
    Baud{4800, B4800},     Baud{9600, B9600},     Baud{19200, B19200},   Baud{38400, B38400},
    Baud{57600, B57600},   Baud{115200, B115200}, Baud{230400, B230400}, Baud{460800, B460800},
    Baud{921600, B921600},
};

speed_t code_of(unsigned baud) {
    for (const Baud& b : bauds) {
        if (b.bits_per_s == baud) return b.code;
    }
    throw Error(ExitCode::usage, "baud " + std::to_string(baud) + " is none that the system knows");
}

[[noreturn]] void fail(const std::string& device, const std::string& why) {
    throw Error(ExitCode::unavailable, device + ": " + why);
}

[[noreturn]] void fail_by_errno(const std::string& device) {
    std::string why = std::strerror(errno);
    if (errno == EACCES) why += " (is the user in group dialout?)";
    if (errno == EWOULDBLOCK) why = "another program uses it";
    fail(device, why);
}

/// A descriptor that is closed again when what follows fails.
struct Closing {
    int fd;
    ~Closing() {
        if (fd >= 0) ::close(fd);
    }
    int release() { return std::exchange(fd, -1); }
};

void set_raw(int fd, const std::string& device, speed_t speed) {
    termios t{};
    if (::tcgetattr(fd, &t) != 0) fail(device, "is no terminal");
    ::cfmakeraw(&t);
    t.c_cflag |= CLOCAL | CREAD;
    t.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
    t.c_iflag &= ~static_cast<tcflag_t>(IXON | IXOFF | INPCK);
    t.c_cc[VMIN] = 1;
    t.c_cc[VTIME] = 0;
    ::cfsetispeed(&t, speed);
    ::cfsetospeed(&t, speed);
    if (::tcsetattr(fd, TCSANOW, &t) != 0) fail_by_errno(device);
    int rts = TIOCM_RTS;
    ::ioctl(fd, TIOCMBIC, &rts);  // a pseudo-terminal has none, and says so
    ::tcflush(fd, TCIOFLUSH);
}

int open_terminal(const std::string& device, unsigned baud) {
    const speed_t speed = code_of(baud);
    Closing line{::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    if (line.fd < 0) fail_by_errno(device);
    if (::flock(line.fd, LOCK_EX | LOCK_NB) != 0) fail_by_errno(device);
    set_raw(line.fd, device, speed);
    return line.release();
}

/// Connected to the address, or -1 with the reason in errno.
int connected(const addrinfo& address) {
    Closing line{::socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
    if (line.fd < 0) return -1;
    if (::connect(line.fd, address.ai_addr, address.ai_addrlen) == 0) return line.release();
    if (errno != EINPROGRESS) return -1;
    pollfd wait{line.fd, POLLOUT, 0};
    int error = ETIMEDOUT;
    socklen_t size = sizeof error;
    if (::poll(&wait, 1, connect_ms) == 1)
        ::getsockopt(line.fd, SOL_SOCKET, SO_ERROR, &error, &size);
    errno = error;
    return error == 0 ? line.release() : -1;
}

int open_connection(const std::string& device) {
    const std::string place = device.substr(4);
    const std::size_t colon = place.rfind(':');
    if (colon == place.npos || colon == 0 || colon + 1 == place.size())
        throw Error(ExitCode::usage, quote(device) + " is not of the form tcp:HOST:PORT");
    std::string host = place.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int error = ::getaddrinfo(host.c_str(), place.c_str() + colon + 1, &hints, &found);
    if (error != 0) fail(device, lower_first(::gai_strerror(error)));
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> all(found, ::freeaddrinfo);
    for (const addrinfo* a = found; a != nullptr; a = a->ai_next) {
        const int fd = connected(*a);
        if (fd >= 0) return fd;
    }
    fail_by_errno(device);
}

}  // namespace

SerialLine::SerialLine(const std::string& device, unsigned baud)
    : fd_(device.starts_with("tcp:") ? open_connection(device) : open_terminal(device, baud)) {}

SerialLine::~SerialLine() { ::close(fd_); }

bool SerialLine::read(std::string& into) {
    std::array<char, 4096> block;
    for (;;) {
        const ssize_t n = ::read(fd_, block.data(), block.size());
        if (n > 0) {
            into.append(block.data(), static_cast<std::size_t>(n));
            if (static_cast<std::size_t>(n) < block.size()) return true;
        } else if (n == 0) {
            lost_ = "hung up";
            return false;
        } else if (errno == EAGAIN) {
            return true;
        } else if (errno != EINTR) {
            lost_ = std::strerror(errno);
            return false;
        }
    }
}

bool SerialLine::write(std::string_view bytes) {
    pending_ += bytes;
    while (!pending_.empty()) {
        const ssize_t n =
            ::send(fd_, pending_.data(), pending_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        const ssize_t m =
            n < 0 && errno == ENOTSOCK ? ::write(fd_, pending_.data(), pending_.size()) : n;
        if (m > 0) {
            pending_.erase(0, static_cast<std::size_t>(m));
        } else if (errno == EAGAIN) {
            return true;
        } else if (errno != EINTR) {
            lost_ = std::strerror(errno);
            return false;
        }
    }
    return true;
}

}  // namespace seautils::stream
