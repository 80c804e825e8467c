#include "seautils/stream/pty.hpp"

#include "seautils/core/error.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace seautils::stream {

namespace {

[[noreturn]] void fail(const std::string& link, const char* what) {
    throw Error(ExitCode::cannot_create, link + ": " + what + ": " + std::strerror(errno));
}

/// Bytes as they are: no echo, no line editing, no change of line ends.
void make_raw(int fd) {
    termios settings{};
    ::tcgetattr(fd, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(fd, TCSANOW, &settings);
}

bool is_link_to(const std::string& link, const std::string& device) {
    std::array<char, 256> target{};
    const ssize_t length = ::readlink(link.c_str(), target.data(), target.size());
    return length > 0 &&
           std::string_view(target.data(), static_cast<std::size_t>(length)) == device;
}

}  // namespace

Pty::Pty(std::string link) : link_(std::move(link)) {
    try {
        make();
        make_link();
    } catch (const Error&) {
        close_all();
        throw;
    }
}

Pty::~Pty() {
    if (is_link_to(link_, device_)) ::unlink(link_.c_str());
    close_all();
}

void Pty::make() {
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0)
        fail(link_, "no pseudo-terminal");
    std::array<char, 128> name{};
    if (::ptsname_r(master_, name.data(), name.size()) != 0) fail(link_, "no pseudo-terminal");
    device_ = name.data();
    own_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (own_ < 0) fail(link_, "no pseudo-terminal");
    make_raw(own_);
    changes_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (changes_ >= 0 && ::inotify_add_watch(changes_, device_.c_str(), IN_OPEN | IN_CLOSE) < 0) {
        ::close(changes_);
        changes_ = -1;
    }
}

/// Under another name first, so that whoever waits for the link never misses it.
void Pty::make_link() const {
    struct stat status {};
    if (::lstat(link_.c_str(), &status) == 0 && !S_ISLNK(status.st_mode))
        throw Error(ExitCode::cannot_create, link_ + ": exists and is no link");
    const std::string fresh = link_ + ".new";
    ::unlink(fresh.c_str());
    if (::symlink(device_.c_str(), fresh.c_str()) != 0 ||
        ::rename(fresh.c_str(), link_.c_str()) != 0)
        fail(link_, "no link");
}

void Pty::close_all() {
    for (const int fd : {master_, own_, changes_})
        if (fd >= 0) ::close(fd);
}

void Pty::read(std::string& bytes) {
    std::array<char, 4096> block{};
    for (;;) {
        const ssize_t got = ::read(master_, block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return;
        bytes.append(block.data(), static_cast<std::size_t>(got));
    }
}

bool Pty::write(std::string_view bytes) {
    look();
    if (!is_open()) return true;
    while (!bytes.empty()) {
        const ssize_t sent = ::write(master_, bytes.data(), bytes.size());
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

void Pty::look() {
    if (changes_ < 0) return;
    alignas(inotify_event) std::array<char, 4096> block;
    for (;;) {
        const ssize_t got = ::read(changes_, block.data(), block.size());
        if (got <= 0) return;
        for (ssize_t at = 0; at < got;) {
            inotify_event event;
            std::memcpy(&event, block.data() + at, sizeof event);
            if ((event.mask & IN_OPEN) != 0) ++readers_;
            if ((event.mask & IN_CLOSE) != 0) closed();
            at += static_cast<ssize_t>(sizeof event) + static_cast<ssize_t>(event.len);
        }
    }
}

void Pty::closed() {
    if (readers_ > 0) --readers_;
    if (readers_ == 0) ::tcflush(own_, TCIFLUSH);
}

}  // namespace seautils::stream
