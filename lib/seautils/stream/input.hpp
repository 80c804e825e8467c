#ifndef SEAUTILS_STREAM_INPUT_HPP
#define SEAUTILS_STREAM_INPUT_HPP

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::stream {

/// Reads a file, a pipe or a terminal in big blocks, and gives it out as lines, as records with
/// their length in front, or as it is. Memory is bounded by max_record, whatever comes.
class Input {
public:
    struct Options {
        std::size_t max_record = 1U << 20;
        bool follow = false;  ///< at the end of a file wait for more; open it again when replaced
        /// Called when the next read would have to wait: the place to flush what is buffered.
        std::function<void()> before_wait;
        /// False: where a read would wait, line() and record() give Got::wait instead; for callers
        /// that wait for several things at once.
        bool may_wait = true;
    };

    /// Takes over the descriptor. @param path  for --follow; empty where there is none
    Input(int fd, std::string path, Options options);
    ~Input();
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    enum class Got { record, too_long, end, wait };

    /// The next line, without `\n` or `\r\n`; a last line needs none. It stays until the next call,
    /// with at least 64 readable bytes behind it. A line above max_record is skipped whole.
    /// @throws Error(io)
    Got line(std::string_view& line);

    /// The next record of a length-delimited stream.
    /// @throws Error(data)  the record is cut short, or longer than max_record: nothing that
    ///                      follows can be found
    Got record(std::string_view& record);

    /// All bytes that are read and not consumed, after reading more; `ended` when no more come.
    std::string_view block(bool& ended);
    void consume(std::size_t bytes);
    bool full() const { return end_ - begin_ >= options_.max_record; }

    /// Lines or records given out (a skipped one counts), and the byte at which the last began; from
    /// the beginning again where the file was replaced.
    std::uint64_t count() const { return count_; }
    std::uint64_t offset() const { return offset_; }
    /// Bytes read in all.
    std::uint64_t bytes_read() const { return bytes_read_; }

    int descriptor() const { return fd_; }

private:
    bool fill();
    bool read_some(char* to, std::size_t room, std::size_t& got);
    bool wait_for_more();
    void begin_again();
    bool skip_line();
    std::string_view held() const { return {buffer_.data() + begin_, end_ - begin_}; }

    int fd_;
    std::string path_;
    Options options_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0, end_ = 0;
    std::size_t searched_ = 0;  ///< bytes of held() known to have no line end
    std::uint64_t count_ = 0, offset_ = 0, next_offset_ = 0, bytes_read_ = 0;
    bool ended_ = false;
    bool waits_ = false;     ///< the last read would have had to wait, and may not
    bool skipping_ = false;  ///< within a line that is too long
    bool replaced_ = false;  ///< the file that what is held came from has ended, another follows
};

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_INPUT_HPP
