#ifndef SEAUTILS_STREAM_PTY_HPP
#define SEAUTILS_STREAM_PTY_HPP

#include <string>
#include <string_view>

namespace seautils::stream {

/// A pseudo-terminal with a link that stays: what one side of a serial line would be, for programs
/// that open the other as a device. It lives on when they close it, and they may open it again. Bytes
/// for a device that nobody has opened are lost, as on a serial line; so are those that the last one
/// to close it left unread, when look() is called before somebody opens it anew.
class Pty {
public:
    /// Opens a pair, raw, and makes `link` point to the device; a link of that name is replaced, any
    /// other file is not.
    /// @throws Error(cannot_create)  names the link
    explicit Pty(std::string link);
    /// Takes the link away, where it still is this one's.
    ~Pty();
    Pty(const Pty&) = delete;
    Pty& operator=(const Pty&) = delete;

    /// To poll for bytes from the device, and then read().
    int descriptor() const { return master_; }
    /// To poll for programs that open or close it, and then look(); -1: the system does not tell.
    int changes() const { return changes_; }
    const std::string& link() const { return link_; }
    const std::string& device() const { return device_; }

    /// Appends what has come; does not wait.
    void read(std::string& bytes);
    /// Sends; false: the reader's buffer is full, and what did not fit is lost. Does not wait.
    bool write(std::string_view bytes);
    /// Notes who opened and closed the device.
    void look();
    /// Whether a program has it open; true where the system does not tell.
    bool is_open() const { return changes_ < 0 || readers_ > 0; }

private:
    void make();
    void make_link() const;
    void close_all();
    void closed();

    std::string link_, device_;
    int master_ = -1;
    int own_ = -1;  ///< the device itself, held so that it does not hang up
    int changes_ = -1;
    int readers_ = 0;
};

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_PTY_HPP
