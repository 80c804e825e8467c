// Acknowledgements of positions: lines of JSON as messages seautils.TrackAck are written in.
#ifndef SEAUTILS_TOOLS_DCCL_POSITION_ACKS_HPP
#define SEAUTILS_TOOLS_DCCL_POSITION_ACKS_HPP

#include "seautils/cli/io.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/stream/fifo.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace seautils::tools {

/// One end of the file or FIFO that they pass through. Never waits; what a FIFO has no room for is
/// dropped, as it may be lost on the way.
class PositionAcks {
public:
    /// @param path  empty: there are none
    PositionAcks(std::string path, cli::Io& io) : path_(std::move(path)), io_(io) {
        schema::Layout layout;
        layout.full_name = "seautils.TrackAck";
        schema::Field ack;
        ack.name = ack.json_name = "ack";
        ack.number = 2;
        ack.kind = schema::Kind::bytes;
        layout.fields = {ack};
        layout_ = &layouts_.add(std::move(layout));
    }
    ~PositionAcks() {
        if (fd_ >= 0) ::close(fd_);
    }
    PositionAcks(const PositionAcks&) = delete;
    PositionAcks& operator=(const PositionAcks&) = delete;

    /// Those that came since the last call; lines that are none are warned of and left out. A file
    /// that is not there yet has none.
    /// @throws Error(no_input)  cannot be opened or read
    void read(const std::function<void(const std::string& ack)>& each) {
        if (path_.empty() || !open(O_RDONLY)) return;
        char block[4096];
        ssize_t n = 0;
        while ((n = ::read(fd_, block, sizeof block)) > 0) {
            rest_.append(block, static_cast<std::size_t>(n));
            lines(each);
            if (rest_.size() > most_line) rest_.clear();
        }
        if (n < 0 && errno != EAGAIN && errno != EINTR)
            throw Error(ExitCode::no_input, path_ + ": " + std::strerror(errno));
    }

    /// @param dest  modem ID of the vehicle that sent the position; 0: not known
    /// @throws Error(cannot_create), Error(io)
    void write(std::uint32_t dest, std::string_view ack) {
        if (path_.empty()) return;
        // For reading too: so a FIFO without a reader keeps what it can.
        open(O_RDWR | O_APPEND | O_CREAT);
        std::string line = "{\"@dest\":" + std::to_string(dest) + ",\"ack\":\"";
        append_base64(line, ack);
        line += "\"}\n";
        if (!stream::try_write(fd_, line)) io_.inform(path_ + ": full, acknowledgement dropped");
    }

private:
    static constexpr std::size_t most_line = 65'536;

    /// False: there is no such file, and it is not to be made.
    bool open(int flags) {
        if (fd_ >= 0) return true;
        fd_ = ::open(path_.c_str(), flags | O_NONBLOCK | O_CLOEXEC, 0666);
        if (fd_ >= 0) return true;
        const bool makes = (flags & O_CREAT) != 0;
        if (!makes && errno == ENOENT) return false;
        throw Error(makes ? ExitCode::cannot_create : ExitCode::no_input,
                    path_ + ": " + std::strerror(errno));
    }

    void lines(const std::function<void(const std::string& ack)>& each) {
        for (std::size_t end; (end = rest_.find('\n')) != rest_.npos; rest_.erase(0, end + 1)) {
            const std::string line = rest_.substr(0, end);
            if (line.empty()) continue;
            try {
                // The reader may look at bytes behind the text.
                json_.read(std::string_view(line + std::string(64, '\0')).substr(0, end), *layout_,
                           values_, schema::Unknown::skip);
            } catch (const DataError& e) {
                io_.warn(path_ + ": no acknowledgement: " + e.what());
                continue;
            }
            if (values_[0].present) each(std::string(values_.text(values_[0])));
        }
    }

    std::string path_;
    cli::Io& io_;
    schema::LayoutSet layouts_;
    const schema::Layout* layout_ = nullptr;
    schema::JsonReader json_;
    schema::Values values_;
    std::string rest_;
    int fd_ = -1;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DCCL_POSITION_ACKS_HPP
