#include "seautils/toolbox/program.hpp"

#include "seautils/core/error.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <optional>

namespace seautils::toolbox {

namespace {

/// What the child needs, made before fork(): in it only plain system calls are made.
struct Command {
    std::vector<std::vector<char*>> argvs;
    std::string folder;
    rlim_t memory_bytes;
};

[[noreturn]] void become(const Command& command, int report) {
    const auto fail = [report](int why) {
        [[maybe_unused]] const ssize_t n = ::write(report, &why, sizeof why);
        ::_exit(127);
    };
    ::setpgid(0, 0);
    sigset_t none_wait;
    ::sigemptyset(&none_wait);
    ::sigprocmask(SIG_SETMASK, &none_wait, nullptr);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit memory{command.memory_bytes, command.memory_bytes};
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    if (::setrlimit(RLIMIT_AS, &memory) != 0 || ::chdir(command.folder.c_str()) != 0) fail(errno);
    const int null = ::open("/dev/null", O_RDWR);
    if (null < 0) fail(errno);
    for (int fd = 0; fd < 3; ++fd) ::dup2(null, fd);
    int why = ENOENT;
    for (const auto& argv : command.argvs) {
        ::execvp(argv[0], argv.data());
        if (errno != ENOENT) why = errno;
    }
    fail(why);
    ::_exit(127);
}

void sleep_ms(long ms) {
    timespec left{0, ms * 1'000'000};
    ::nanosleep(&left, nullptr);
}

/// Signals that would end the process.
sigset_t ending_signals() {
    sigset_t all;
    ::sigemptyset(&all);
    for (const int number : {SIGTERM, SIGINT, SIGHUP}) {
        struct sigaction action {};
        ::sigaction(number, nullptr, &action);
        if (action.sa_handler != SIG_IGN) ::sigaddset(&all, number);
    }
    return all;
}

/// One of them waits.
bool is_to_end() {
    const sigset_t ending = ending_signals();
    sigset_t waiting;
    ::sigemptyset(&waiting);
    ::sigpending(&waiting);
    for (const int number : {SIGTERM, SIGINT, SIGHUP})
        if (::sigismember(&waiting, number) == 1 && ::sigismember(&ending, number) == 1)
            return true;
    return false;
}

/// Its status when it has ended; nothing when its time is over, or the process is to end.
std::optional<int> wait_for(pid_t child, double seconds) {
    double waited_ms = 0;
    int status = 0;
    for (long pause_ms = 1;; pause_ms = std::min(2 * pause_ms, 20L)) {
        const pid_t ended = ::waitpid(child, &status, WNOHANG);
        if (ended == child) return status;
        if (ended < 0 && errno != EINTR) return std::nullopt;
        if (waited_ms >= seconds * 1000 || is_to_end()) return std::nullopt;
        sleep_ms(pause_ms);
        waited_ms += static_cast<double>(pause_ms);
    }
}

}  // namespace

PrivateFolder::PrivateFolder(const std::string& parent) : path_(parent + "/seautils-XXXXXX") {
    if (::mkdtemp(path_.data()) == nullptr)
        throw Error(ExitCode::cannot_create, parent + ": " + std::strerror(errno));
    const sigset_t ending = ending_signals();
    ::pthread_sigmask(SIG_BLOCK, &ending, &before_);
}

PrivateFolder::~PrivateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void run_program(const std::vector<std::string>& names, const std::vector<std::string>& arguments,
                 const std::string& folder, const ProgramLimits& limits) {
    std::vector<std::string> words = names;
    words.insert(words.end(), arguments.begin(), arguments.end());
    Command command{{}, folder, limits.memory_bytes};
    for (std::size_t k = 0; k < names.size(); ++k) {
        std::vector<char*>& argv = command.argvs.emplace_back();
        argv.push_back(words[k].data());
        for (std::size_t i = names.size(); i < words.size(); ++i) argv.push_back(words[i].data());
        argv.push_back(nullptr);
    }
    int report[2];
    if (::pipe2(report, O_CLOEXEC) != 0)
        throw Error(ExitCode::try_again, std::string("pipe: ") + std::strerror(errno));
    const pid_t child = ::fork();
    if (child == 0) become(command, report[1]);
    ::close(report[1]);
    if (child < 0) {
        ::close(report[0]);
        throw Error(ExitCode::try_again, std::string("fork: ") + std::strerror(errno));
    }
    int why = 0;
    const bool failed = ::read(report[0], &why, sizeof why) == static_cast<ssize_t>(sizeof why);
    ::close(report[0]);
    const std::optional<int> status = wait_for(child, failed ? 5 : limits.seconds);
    ::kill(-child, SIGKILL);  // what it started, and itself if its time is over
    if (!status) ::waitpid(child, nullptr, 0);
    const std::string& name = names.front();
    if (failed)
        throw Error(
            ExitCode::unavailable,
            name + ": " + (why == ENOENT ? "no such program is installed" : std::strerror(why)));
    if (!status && is_to_end())
        throw Error(ExitCode::try_again, name + " was ended, as this is to end");
    if (!status)
        throw Error(ExitCode::try_again,
                    fmt::format("{} did not end within {} s", name, limits.seconds));
    if (WIFSIGNALED(*status))
        throw DataError(fmt::format("{} was ended by signal {}", name, WTERMSIG(*status)));
    if (WEXITSTATUS(*status) != 0)
        throw DataError(fmt::format("{} ended with status {}", name, WEXITSTATUS(*status)));
}

}  // namespace seautils::toolbox
