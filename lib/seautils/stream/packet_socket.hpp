#ifndef SEAUTILS_STREAM_PACKET_SOCKET_HPP
#define SEAUTILS_STREAM_PACKET_SOCKET_HPP

#include <chrono>
#include <string>
#include <string_view>

namespace seautils::stream {

/// Listens on a Unix socket of packets (SOCK_SEQPACKET): one packet a record, kept apart by the
/// system. A socket that nobody listens on any more is replaced.
/// @return the descriptor, which does not wait
/// @throws Error(cannot_create)  in use, or cannot be made
int listen_packets(const std::string& path);

/// The other side: hands records over, one at a time, and waits for each answer.
class PacketClient {
public:
    /// @throws Error(unavailable)  nobody listens there
    explicit PacketClient(const std::string& path);
    ~PacketClient();
    PacketClient(const PacketClient&) = delete;
    PacketClient& operator=(const PacketClient&) = delete;

    /// Sends a record and returns the answer.
    /// @throws Error(try_again)    no answer in time
    /// @throws Error(unavailable)  the other side has gone
    std::string ask(std::string_view record, std::chrono::milliseconds patience);

private:
    std::string path_;
    int fd_;
};

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_PACKET_SOCKET_HPP
