#ifndef SEAUTILS_STREAM_OUTPUT_HPP
#define SEAUTILS_STREAM_OUTPUT_HPP

#include <cstddef>
#include <string>
#include <string_view>

namespace seautils::stream {

/// A buffered file descriptor for writing that loses nothing silently.
class Output {
public:
    explicit Output(int fd, std::size_t buffer_bytes = 1U << 16);
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    ~Output() = default;  ///< what is not flushed is dropped: call close()

    void write(std::string_view bytes);
    Output& operator<<(std::string_view bytes) {
        write(bytes);
        return *this;
    }
    Output& operator<<(char c) {
        write({&c, 1});
        return *this;
    }

    /// The buffer itself, to append to; call commit() after each record.
    std::string& buffer() { return buffer_; }
    void commit() {
        if (buffer_.size() >= limit_) flush();
    }

    /// Writes all that is buffered. @throws Error(io)  with the system's reason
    void flush();
    /// flush(), then closes the descriptor and checks that too (a full disk may only show here).
    void close();

private:
    int fd_;
    std::size_t limit_;
    std::string buffer_;
};

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_OUTPUT_HPP
