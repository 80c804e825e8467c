// A model as another process, asked over pipes.
#ifndef SEAUTILS_TOOLS_DEPTH_PARTNER_HPP
#define SEAUTILS_TOOLS_DEPTH_PARTNER_HPP

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

extern char** environ;

namespace seautils::tools {

/// Runs a command without a shell; a line to its standard input is answered by a line on its standard output.
class Partner {
public:
    /// @param command  words parted by blanks
    Partner(std::string command, double timeout_s)
        : command_(std::move(command)), timeout_s_(timeout_s) {}
    ~Partner() { stop(); }
    Partner(const Partner&) = delete;
    Partner& operator=(const Partner&) = delete;

    bool runs() const { return pid_ > 0; }

    /// Starts it if it does not run. Whatever goes wrong, it is ended: what comes late is nobody's answer.
    /// @throws DataError  it cannot be started, ended, says nothing within the time, or endlessly much
    std::string ask(const std::string& line) {
        try {
            if (!runs()) start();
            const auto until = Clock::now() + std::chrono::duration<double>(timeout_s_);
            send(line + "\n", until);
            return receive(until);
        } catch (const DataError& e) {
            const std::string how = stop();
            throw DataError(fmt::format("model {}: {}{}", quote(command_), e.what(), how));
        }
    }

private:
    using Clock = std::chrono::steady_clock;
    using Until = std::chrono::time_point<Clock, std::chrono::duration<double>>;
    static constexpr std::size_t most_bytes = std::size_t{1} << 25;

    void start() {
        int to[2], from[2];
        // a socket, for writing to one whose other end is gone is no signal when it says so
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, to) != 0) fail("no socket");
        if (::pipe2(from, O_CLOEXEC) != 0) fail("no pipe");
        posix_spawn_file_actions_t streams;
        ::posix_spawn_file_actions_init(&streams);
        ::posix_spawn_file_actions_adddup2(&streams, to[1], 0);
        ::posix_spawn_file_actions_adddup2(&streams, from[1], 1);
        std::vector<std::string> words = split(command_);
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        const int fault =
            ::posix_spawnp(&pid_, arguments[0], &streams, nullptr, arguments.data(), environ);
        ::posix_spawn_file_actions_destroy(&streams);
        ::close(to[1]);
        ::close(from[1]);
        to_ = to[0];
        from_ = from[0];
        held_.clear();
        if (fault == 0) return;
        pid_ = -1;
        throw DataError(std::strerror(fault));
    }

    [[noreturn]] static void fail(const char* what) {
        throw DataError(fmt::format("{}: {}", what, std::strerror(errno)));
    }

    static std::vector<std::string> split(std::string_view text) {
        std::vector<std::string> words;
        for (std::size_t at = 0; (at = text.find_first_not_of(' ', at)) != text.npos;) {
            const std::size_t end = std::min(text.find(' ', at), text.size());
            words.emplace_back(text.substr(at, end - at));
            at = end;
        }
        return words;
    }

    /// Waits for room or for bytes.
    void wait(int fd, short events, Until until) const {
        for (;;) {
            const double left_s = std::chrono::duration<double>(until - Clock::now()).count();
            if (left_s <= 0) throw DataError(fmt::format("no answer within {:g} s", timeout_s_));
            pollfd p{fd, events, 0};
            const int n = ::poll(&p, 1, static_cast<int>(left_s * 1000) + 1);
            if (n > 0) return;
            if (n < 0 && errno != EINTR) fail("poll failed");
        }
    }

    void send(std::string_view bytes, Until until) {
        while (!bytes.empty()) {
            wait(to_, POLLOUT, until);
            const ssize_t n = ::send(to_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
            if (n < 0 && (errno == EAGAIN || errno == EINTR)) continue;
            if (n < 0) throw DataError("it does not listen");
            bytes.remove_prefix(static_cast<std::size_t>(n));
        }
    }

    std::string receive(Until until) {
        for (;;) {
            if (const std::size_t end = held_.find('\n'); end != held_.npos) {
                std::string line = held_.substr(0, end);
                held_.erase(0, end + 1);
                return line;
            }
            if (held_.size() > most_bytes)
                throw DataError(fmt::format("an answer of more than {} bytes", most_bytes));
            wait(from_, POLLIN, until);
            char block[65536];
            const ssize_t n = ::read(from_, block, sizeof block);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) throw DataError("it ended without an answer");
            held_.append(block, static_cast<std::size_t>(n));
        }
    }

    /// @return how it had ended by itself, in brackets
    std::string stop() {
        std::string how;
        if (pid_ > 0) {
            ::close(to_);
            ::close(from_);
            int status = 0;
            // one that is about to end by itself is let
            for (int k = 0; k < 20 && ::waitpid(pid_, &status, WNOHANG) == 0; ++k) {
                if (k == 19) {
                    ::kill(pid_, SIGKILL);
                    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
                    }
                    status = 0;
                    break;
                }
                ::usleep(5000);
            }
            if (WIFEXITED(status) && WEXITSTATUS(status) != 0)
                how = fmt::format(" (status {})", WEXITSTATUS(status));
            else if (WIFSIGNALED(status))
                how = fmt::format(" (signal {})", WTERMSIG(status));
        }
        pid_ = -1;
        return how;
    }

    std::string command_;
    double timeout_s_;
    pid_t pid_ = -1;
    int to_ = -1, from_ = -1;
    std::string held_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_PARTNER_HPP
