#include "seautils/stream/whole_file.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace seautils::stream {

namespace {

constexpr mode_t file_mode = 0644;

[[noreturn]] void fail(ExitCode code, const std::string& path) {
    throw Error(code, path + ": " + std::strerror(errno));
}

struct File {
    explicit File(int opened) : fd(opened) {}
    ~File() {
        if (fd >= 0) ::close(fd);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    int fd;
};

void write_all(const File& file, std::string_view bytes, const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file.fd, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail(ExitCode::io, path);
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
}

/// A pipe or a device cannot be synced, and need not be.
void settle(const File& file, const std::string& path) {
    if (::fsync(file.fd) != 0 && errno != EINVAL && errno != ENOTSUP) fail(ExitCode::io, path);
}

/// The name is in the folder's own bytes.
void settle_name(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == path.npos ? "." : path.substr(0, slash + 1);
    const File file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (file.fd < 0) return;  // a folder that may be written to, but not read
    settle(file, folder);
}

constexpr std::size_t first_block = 64 * 1024;

std::string read_up_to(std::size_t most, int fd, const std::string& name) {
    std::string bytes;
    std::size_t used = 0;
    while (used < most) {
        // As much again as was there: a small file takes little memory, whatever it might have been.
        if (used == bytes.size()) bytes.resize(std::min(most, std::max(first_block, 2 * used)));
        const ssize_t n = ::read(fd, bytes.data() + used, bytes.size() - used);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail(ExitCode::no_input, name);
        if (n == 0) break;
        used += static_cast<std::size_t>(n);
    }
    bytes.resize(used);
    return bytes;
}

void refuse_beyond(std::size_t most, const std::string& bytes, const std::string& name) {
    constexpr std::size_t mebibyte = 1U << 20;
    if (bytes.size() <= most) return;
    throw ConfigError(
        name + ": longer than " +
        (most % mebibyte == 0 ? std::to_string(most / mebibyte) + " MiB" : counted(most, "byte")));
}

}  // namespace

std::optional<std::string> read_whole_file(const std::string& path, std::size_t most) {
    const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.fd < 0 && errno == ENOENT) return std::nullopt;
    if (file.fd < 0) fail(ExitCode::no_input, path);
    return read_up_to(most, file.fd, path);
}

std::string read_input_file(const std::string& path, std::size_t most) {
    std::optional<std::string> bytes = read_whole_file(path, most + 1);
    if (!bytes) throw Error(ExitCode::no_input, path + ": " + std::strerror(ENOENT));
    refuse_beyond(most, *bytes, path);
    return *std::move(bytes);
}

std::string read_input_descriptor(int fd, const std::string& name, std::size_t most) {
    std::string bytes = read_up_to(most + 1, fd, name);
    refuse_beyond(most, bytes, name);
    return bytes;
}

void replace_file(const std::string& path, std::string_view bytes, Sync sync) {
    const std::string beside = path + ".new";
    {
        const File file(
            ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, file_mode));
        if (file.fd < 0) fail(ExitCode::cannot_create, beside);
        write_all(file, bytes, beside);
        if (sync == Sync::yes) settle(file, beside);
    }
    if (::rename(beside.c_str(), path.c_str()) != 0) fail(ExitCode::cannot_create, path);
    if (sync == Sync::yes) settle_name(path);
}

}  // namespace seautils::stream
