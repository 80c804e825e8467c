#include "seautils/cli/source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace seautils::cli {

OpenedFile open_input(const std::string& file, bool text) {
    OpenedFile opened;
    opened.name = file == "-" ? "<stdin>" : file;
    opened.fd = file == "-" ? STDIN_FILENO : ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (opened.fd < 0 || ::fstat(opened.fd, &status) != 0)
        throw Error(ExitCode::no_input, opened.name + ": " + std::strerror(errno));
    if (S_ISDIR(status.st_mode)) throw Error(ExitCode::no_input, opened.name + ": Is a directory");
    opened.is_terminal = ::isatty(opened.fd) == 1;
    if (opened.is_terminal && !text)
        throw Error(ExitCode::usage, "binary input is not read from a terminal");
    opened.is_fifo = S_ISFIFO(status.st_mode);
    if (S_ISREG(status.st_mode)) opened.bytes = status.st_size;
    return opened;
}

std::string Source::place(Framing framing) const {
    if (framing == Framing::lines) return fmt::format("{}:{}: ", name_, input_.count());
    return fmt::format("{}:record {} (byte {}): ", name_, input_.count(), input_.offset());
}

}  // namespace seautils::cli
