#ifndef SEAUTILS_STREAM_SERIAL_LINE_HPP
#define SEAUTILS_STREAM_SERIAL_LINE_HPP

#include <string>
#include <string_view>

namespace seautils::stream {

/// A serial line to a device: a terminal of its own, or a serial server's `tcp:HOST:PORT`. Nothing
/// waits but the opening of a connection, two seconds at most.
///
/// A terminal is set to 8 bits, no parity, one stop bit, no flow control and no meaning of any byte;
/// RTS is put low (a Micro-Modem 2 garbles its words when it is high); it is ours alone as long as
/// all who open it lock it (flock), and what has come before is thrown away.
class SerialLine {
public:
    /// @param baud  one that the system knows: 300 … 115200 …; of no matter for tcp
    /// @throws Error(unavailable)  `DEVICE: why`, with what may help
    /// @throws Error(usage)        no such baud; tcp without a host or a port
    SerialLine(const std::string& device, unsigned baud);
    ~SerialLine();
    SerialLine(const SerialLine&) = delete;
    SerialLine& operator=(const SerialLine&) = delete;

    int fd() const { return fd_; }

    /// Appends what has come. @return false: the device has gone; lost() says why
    bool read(std::string& into);
    /// Writes what fits, and keeps the rest for the next call, which may be with nothing.
    /// @return false: the device has gone
    bool write(std::string_view bytes);
    /// Whether some of what was written has not left yet.
    bool pending() const { return !pending_.empty(); }
    const std::string& lost() const { return lost_; }

private:
    int fd_;
    std::string pending_, lost_;
};

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_SERIAL_LINE_HPP
