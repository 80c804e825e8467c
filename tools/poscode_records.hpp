// Packets and acknowledgements of a track in records of the link, and what is kept over a restart.
#ifndef SEAUTILS_TOOLS_POSCODE_RECORDS_HPP
#define SEAUTILS_TOOLS_POSCODE_RECORDS_HPP

#include "record_io.hpp"

#include "seautils/core/text.hpp"
#include "seautils/position/state_bytes.hpp"
#include "seautils/stream/packet_socket.hpp"
#include "seautils/stream/whole_file.hpp"

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::tools {

/// What a queue knows them by, and a frame: ids of seautils.TrackPacket and seautils.TrackAck
/// (schemas/seautils/track.proto), or others that the queues are configured for.
struct TrackIds {
    std::uint32_t packet = 110, ack = 111;
};
inline constexpr std::size_t most_wrapped = 255;

/// The DCCL message: id, length and bytes. DCCL's variable bytes of at most 255 are these, so that
/// dccl-decode takes them out of a frame that other messages share.
/// Check value: id 110 and the bytes 01 02 03 04 make dc 04 01 02 03 04.
/// @throws DataError  more than 255 bytes
inline std::string wrapped(std::uint32_t id, std::string_view bytes) {
    if (bytes.size() > most_wrapped)
        throw DataError(fmt::format("{} bytes: a message holds 255", bytes.size()));
    std::string message;
    const std::uint32_t code = id < 128 ? id << 1 : id << 1 | 1;
    message += static_cast<char>(code & 255);
    if (id >= 128) message += static_cast<char>(code >> 8);
    message += static_cast<char>(bytes.size());
    message += bytes;
    return message;
}

/// The record that hands a packet or an acknowledgement to a queue. @throws DataError  as wrapped()
inline record::Record track_message(std::int64_t time_ns, std::uint32_t id, std::uint32_t src,
                                    std::uint32_t dest, std::string_view bytes) {
    record::Record record;
    record.time.ns = time_ns;
    record::Message message;
    message.id = id;
    message.src = src;
    message.dest = dest;
    message.created = record.time;
    message.data = wrapped(id, bytes);
    record.kind = std::move(message);
    return record;
}

/// The messages that a frame begins with, up to the first one that has neither id.
class TrackFrame {
public:
    explicit TrackFrame(std::string_view frame) : rest_(frame) {}

    struct Part {
        std::uint32_t id = 0;
        std::string_view bytes;
    };
    /// The next one; nothing: none of ours begins here.
    std::optional<Part> next(const TrackIds& ids) {
        const auto byte = [&](std::size_t k) -> std::uint32_t {
            return static_cast<unsigned char>(rest_[k]);
        };
        if (rest_.empty()) return {};
        const std::size_t id_bytes = (byte(0) & 1) == 0 ? 1 : 2;
        if (rest_.size() <= id_bytes) return {};
        const std::uint32_t id = (byte(0) | (id_bytes == 2 ? byte(1) << 8 : 0)) >> 1;
        const std::size_t size = byte(id_bytes);
        if ((id != ids.packet && id != ids.ack) || rest_.size() < id_bytes + 1 + size) return {};
        const Part part{id, rest_.substr(id_bytes + 1, size)};
        rest_.remove_prefix(id_bytes + 1 + size);
        return part;
    }
    /// What is left, but for zeros that fill a frame up.
    std::size_t left() const { return rest_.find_last_not_of('\0') + 1; }

private:
    std::string_view rest_;
};

/// Takes what has an id out of message records, and out of the frames of reception records.
/// @param take  gets who sent it (0: not said), and the bytes
inline void take_parts(cli::Io& io, const record::Record& record, const TrackIds& ids,
                       std::uint32_t wanted,
                       const std::function<void(std::uint32_t, std::string_view)>& take) {
    const auto frame = [&](std::uint32_t src, std::string_view bytes) {
        TrackFrame parts(bytes);
        while (const auto part = parts.next(ids))
            if (part->id == wanted) take(src, part->bytes);
        if (parts.left() > 0)
            io.inform(fmt::format("{} of other messages in a frame passed over",
                                  counted(parts.left(), "byte")));
    };
    if (const auto* message = record.as<record::Message>()) frame(message->src, message->data);
    const auto* heard = record.as<record::Reception>();
    if (heard == nullptr || heard->kind != record::Kind::data) return;
    for (const std::string& bytes : heard->frame) frame(heard->src, bytes);
}

/// Hands message records to a queue's socket. A queue that is not there, or refuses one, is as a link
/// that loses it: it is said once, and tried again with the next.
class QueueClient {
public:
    QueueClient(cli::Io& io, std::string path) : io_(io), path_(std::move(path)) {}

    void send(const record::Record& record, record::Codec& codec) {
        packet_.clear();
        codec.write(record, record::Form::ndjson, packet_);
        packet_.pop_back();
        try {
            if (!client_) client_.emplace(path_);
            const std::string answer = client_->ask(packet_, patience);
            say(answer == "ok" ? "" : "the queue refuses it: " + printable(answer, 200));
        } catch (const Error& e) {
            client_.reset();
            say(e.what());
        }
    }

private:
    static constexpr std::chrono::seconds patience{2};

    void say(const std::string& fault) {
        if (!fault.empty() && fault != said_) io_.warn(fault);
        said_ = fault;
    }

    cli::Io& io_;
    std::string path_, packet_, said_;
    std::optional<stream::PacketClient> client_;
};

/// The file of --state: what an end of the link was told to keep, and a time.
class TrackStateFile {
public:
    struct Kept {
        std::int64_t time_ms = -1;
        std::string end;  ///< Sender::save() or Receiver::save()
    };

    /// @param path  empty: nothing is kept
    explicit TrackStateFile(std::string path) : path_(std::move(path)) {}

    /// Calls `use` with what was kept. What cannot be used is as none: it is said, and the track
    /// begins anew. @throws Error(no_input)
    void read(const cli::Io& io, const std::function<void(const Kept&)>& use) const {
        if (path_.empty()) return;
        const auto bytes = stream::read_whole_file(path_, most_bytes);
        if (!bytes) return;
        try {
            position::StateReader in(*bytes, version);
            Kept kept;
            kept.time_ms = in.number(-1, INT64_MAX);
            kept.end = std::string(in.text());
            in.finish();
            use(kept);
        } catch (const DataError& e) {
            io.warn(path_ + ": " + e.what() + ": the track begins anew");
        }
    }

    /// It is on the disk when this returns. @throws Error(cannot_create), Error(io)
    void write(const Kept& kept) const {
        position::StateWriter out(version);
        out.number(kept.time_ms);
        out.text(kept.end);
        stream::replace_file(path_, out.finish(), stream::Sync::yes);
    }
    bool is_used() const { return !path_.empty(); }

private:
    static constexpr std::size_t most_bytes = std::size_t{64} << 20;
    static constexpr std::uint8_t version = 1;

    std::string path_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_RECORDS_HPP
