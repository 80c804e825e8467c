#ifndef SEAUTILS_STREAM_FIFO_HPP
#define SEAUTILS_STREAM_FIFO_HPP

#include <cstdint>
#include <string>
#include <string_view>

namespace seautils::stream {

/// Opens a FIFO for reading and writing, so that it has neither an end nor a first reader to wait
/// for; makes it where there is none. Never waits.
/// @return the descriptor, which is the caller's to close
/// @throws Error(cannot_create)  cannot be made or opened, or is something else
int open_fifo(const std::string& path);

/// Writes a record of at most 4096 bytes (PIPE_BUF) to a FIFO, pipe, file or terminal with one
/// write, which no other writer's mixes with, and which never waits.
/// @return false: there is no room now, nothing was written
/// @throws Error(io)  with the system's reason
bool try_write(int fd, std::string_view record);

/// The writing end of a feedback: what its reader has no room for is dropped and counted.
class FeedbackFifo {
public:
    explicit FeedbackFifo(const std::string& path) : fd_(open_fifo(path)) {}
    ~FeedbackFifo();
    FeedbackFifo(FeedbackFifo&& other) noexcept : fd_(other.fd_), dropped_(other.dropped_) {
        other.fd_ = -1;
    }
    FeedbackFifo& operator=(FeedbackFifo&&) = delete;

    /// False: dropped.
    bool write(std::string_view record);
    std::uint64_t dropped() const { return dropped_; }

private:
    int fd_;
    std::uint64_t dropped_ = 0;
};

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_FIFO_HPP
