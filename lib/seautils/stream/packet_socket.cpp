#include "seautils/stream/packet_socket.hpp"

#include "seautils/core/error.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace seautils::stream {

namespace {

constexpr int waiting_clients = 64;
constexpr std::size_t longest_answer = 4096;

[[noreturn]] void fail(ExitCode code, const std::string& path, const std::string& why) {
    throw Error(code, path + ": " + why);
}

sockaddr_un address_of(const std::string& path, ExitCode code) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path)
        fail(code, path,
             "the path of a socket has 1 to " + std::to_string(sizeof address.sun_path - 1) +
                 " bytes");
    std::memcpy(address.sun_path, path.data(), path.size());
    return address;
}

int open_socket(const std::string& path, ExitCode code) {
    const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    if (fd < 0) fail(code, path, std::strerror(errno));
    return fd;
}

/// Removes a socket that nobody listens on; what is in use, or no socket, stays.
void remove_left_over(const std::string& path, const sockaddr_un& address) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return;
    if (!S_ISSOCK(status.st_mode)) fail(ExitCode::cannot_create, path, "exists and is no socket");
    const int fd = open_socket(path, ExitCode::cannot_create);
    const bool used =
        ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    ::close(fd);
    if (used) fail(ExitCode::cannot_create, path, "somebody listens there already");
    ::unlink(path.c_str());
}

}  // namespace

int listen_packets(const std::string& path) {
    const sockaddr_un address = address_of(path, ExitCode::cannot_create);
    remove_left_over(path, address);
    const int fd = open_socket(path, ExitCode::cannot_create);
    if (::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(fd, waiting_clients) != 0 || ::fcntl(fd, F_SETFL, O_NONBLOCK) != 0) {
        const int error = errno;
        ::close(fd);
        fail(ExitCode::cannot_create, path, std::strerror(error));
    }
    return fd;
}

PacketClient::PacketClient(const std::string& path)
    : path_(path), fd_(open_socket(path, ExitCode::unavailable)) {
    const sockaddr_un address = address_of(path, ExitCode::unavailable);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
    const int error = errno;
    ::close(fd_);
    fail(ExitCode::unavailable, path, std::strerror(error));
}

PacketClient::~PacketClient() { ::close(fd_); }

std::string PacketClient::ask(std::string_view record, std::chrono::milliseconds patience) {
    if (::send(fd_, record.data(), record.size(), MSG_NOSIGNAL) < 0)
        fail(ExitCode::unavailable, path_, std::strerror(errno));
    pollfd answer{fd_, POLLIN, 0};
    int ready = 0;
    do {
        ready = ::poll(&answer, 1, static_cast<int>(patience.count()));
    } while (ready < 0 && errno == EINTR);
    if (ready == 0) fail(ExitCode::try_again, path_, "no answer in time");
    std::string text(longest_answer, '\0');
    const ssize_t n = ::recv(fd_, text.data(), text.size(), 0);
    if (n <= 0) fail(ExitCode::unavailable, path_, "the other side has gone");
    text.resize(static_cast<std::size_t>(n));
    return text;
}

}  // namespace seautils::stream
