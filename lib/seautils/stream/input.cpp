#include "seautils/stream/input.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace seautils::stream {

namespace {

constexpr std::size_t block_bytes = 1U << 16;
constexpr std::size_t padding_bytes = 64;
constexpr long follow_nanoseconds = 100'000'000;

bool would_wait(int fd) {
    pollfd ready{fd, POLLIN, 0};
    return ::poll(&ready, 1, 0) == 0;
}

}  // namespace

Input::Input(int fd, std::string path, Options options)
    : fd_(fd),
      path_(std::move(path)),
      options_(std::move(options)),
      buffer_(2 * block_bytes + padding_bytes) {}

Input::~Input() {
    if (fd_ > 2) ::close(fd_);
}

/// Reads more behind what is held; false at the end, also at that of a file that was replaced while
/// a piece of it was held: the next call reads on in its successor.
bool Input::fill() {
    if (ended_) return false;
    if (replaced_) count_ = next_offset_ = 0;
    replaced_ = false;
    if (begin_ > 0 && buffer_.size() - padding_bytes - end_ < block_bytes) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
    }
    if (buffer_.size() - padding_bytes - end_ < block_bytes) buffer_.resize(2 * buffer_.size());
    std::size_t got = 0;
    waits_ = !options_.may_wait && would_wait(fd_);
    if (waits_) return false;
    if (!read_some(buffer_.data() + end_, buffer_.size() - padding_bytes - end_, got)) {
        ended_ = !replaced_;
        return false;
    }
    end_ += got;
    bytes_read_ += got;
    return true;
}

bool Input::read_some(char* to, std::size_t room, std::size_t& got) {
    for (;;) {
        if (options_.before_wait && would_wait(fd_)) options_.before_wait();
        const ssize_t n = ::read(fd_, to, room);
        if (n > 0) {
            got = static_cast<std::size_t>(n);
            return true;
        }
        if (n == 0) {
            if (!options_.follow || !wait_for_more() || replaced_) return false;
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            pollfd ready{fd_, POLLIN, 0};
            ::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            throw Error(ExitCode::io, std::string("read failed: ") + std::strerror(errno));
        }
    }
}

/// A tenth of a second at the end of a file. Takes up its successor when the file was replaced, and
/// begins again when it was cut.
bool Input::wait_for_more() {
    if (options_.before_wait) options_.before_wait();
    const timespec pause{0, follow_nanoseconds};
    ::nanosleep(&pause, nullptr);
    struct stat open {};
    struct stat named {};
    const bool is_named = ::stat(path_.c_str(), &named) == 0;
    if (path_.empty() || ::fstat(fd_, &open) != 0 || !S_ISREG(open.st_mode)) return !path_.empty();
    const off_t at = ::lseek(fd_, 0, SEEK_CUR);
    if (at < open.st_size) return true;  // the last words of a file that may be replaced already
    if (is_named && (named.st_ino != open.st_ino || named.st_dev != open.st_dev)) {
        const int fd = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
        if (fd < 0) return true;
        ::close(fd_);
        fd_ = fd;
        begin_again();
    } else if (at > open.st_size) {
        ::lseek(fd_, 0, SEEK_SET);
        begin_again();
    }
    return true;
}

/// What is held of the old file, a line without its end perhaps, is not joined to the new one.
void Input::begin_again() {
    if (begin_ == end_)
        count_ = next_offset_ = 0;
    else
        replaced_ = true;
}

Input::Got Input::line(std::string_view& line) {
    for (;;) {
        if (skipping_) return skip_line() ? Got::too_long : Got::wait;
        const std::string_view bytes = held();
        const void* found = searched_ < bytes.size() ? std::memchr(bytes.data() + searched_, '\n',
                                                                   bytes.size() - searched_)
                                                     : nullptr;
        const bool last = found == nullptr && (ended_ || (replaced_ && !bytes.empty()));
        if (last && bytes.empty()) return Got::end;
        if (found != nullptr || last) {
            const std::size_t length =
                last ? bytes.size()
                     : static_cast<std::size_t>(static_cast<const char*>(found) - bytes.data());
            const std::size_t taken = last ? length : length + 1;
            line = bytes.substr(0, length);
            if (line.ends_with('\r')) line.remove_suffix(1);
            begin_ += taken;
            searched_ = 0;
            ++count_;
            offset_ = next_offset_;
            next_offset_ += taken;
            return line.size() > options_.max_record ? Got::too_long : Got::record;
        }
        searched_ = bytes.size();
        if (bytes.size() > options_.max_record + 1) {
            ++count_;
            offset_ = next_offset_;
            skipping_ = true;
            continue;
        }
        if (!fill() && waits_) return Got::wait;
    }
}

/// Drops everything up to the next line end, in the room of one block. False: it has to wait.
bool Input::skip_line() {
    for (;;) {
        const std::string_view bytes = held();
        const std::size_t end = bytes.find('\n');
        const std::size_t taken = end == bytes.npos ? bytes.size() : end + 1;
        begin_ += taken;
        next_offset_ += taken;
        searched_ = 0;
        skipping_ = end == bytes.npos && (fill() || waits_);
        if (!skipping_) return true;
        if (waits_) return false;
    }
}

Input::Got Input::record(std::string_view& record) {
    offset_ = next_offset_;
    std::uint64_t length = 0;
    std::size_t at = 0;
    for (unsigned shift = 0;; shift += 7) {
        while (at == held().size()) {
            if (fill()) {
                if (at == 0) offset_ = next_offset_;
                continue;
            }
            if (waits_) return Got::wait;
            if (at == 0) return Got::end;
            ++count_;
            throw Error(ExitCode::data, "the stream ends within the length of a record");
        }
        const auto byte = static_cast<unsigned char>(held()[at++]);
        length |= std::uint64_t{byte & 0x7fU} << shift;
        if (byte < 0x80) break;
        if (shift >= 28) {
            ++count_;
            throw Error(ExitCode::data, "no length of a record stands here");
        }
    }
    ++count_;
    if (length > options_.max_record) {
        throw Error(ExitCode::data, "record of " + counted(length, "byte") + " is longer than " +
                                        counted(options_.max_record, "byte") + " (--max-record)");
    }
    while (held().size() - at < length) {
        if (!fill()) {
            if (waits_) {
                --count_;
                return Got::wait;
            }
            throw Error(ExitCode::data, "the stream ends after " +
                                            std::to_string(held().size() - at) +
                                            " of the record's " + counted(length, "byte"));
        }
    }
    record = held().substr(at, length);
    begin_ += at + length;
    next_offset_ += at + length;
    return Got::record;
}

std::string_view Input::block(bool& ended) {
    if (!full()) fill();
    ended = ended_;
    offset_ = next_offset_;
    return held();
}

void Input::consume(std::size_t bytes) {
    bytes = std::min(bytes, end_ - begin_);
    begin_ += bytes;
    next_offset_ += bytes;
}

}  // namespace seautils::stream
