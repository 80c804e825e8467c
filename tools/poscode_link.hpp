// poscode encode over a stream that loses nothing: a file or a pipe.
#ifndef SEAUTILS_TOOLS_POSCODE_LINK_HPP
#define SEAUTILS_TOOLS_POSCODE_LINK_HPP

#include "poscode_records.hpp"
#include "poscode_track.hpp"

#include "seautils/position/hash.hpp"
#include "seautils/position/receiver.hpp"
#include "seautils/position/sender.hpp"
#include "seautils/position/track_state.hpp"
#include "seautils/stream/hex.hpp"

#include <bit>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace seautils::tools {

/// A number for what LinkOptions do not hold of what both ends must say alike.
inline std::uint64_t agreed_number(const TrackOptions& track) {
    const position::CodecOptions codec = track.codec_options(track.codec());
    const position::Grid grid = track.grid();
    std::string text =
        fmt::format("{} {} {} {} {} {} {}", static_cast<int>(codec.kind),
                    static_cast<int>(codec.model), codec.speed_mmps, codec.small ? 1 : 0,
                    grid.resolution_mm, grid.resolution_z_mm, track.frame_text());
    for (const position::Cell& waypoint : codec.plan)
        text += fmt::format(" {} {} {}", waypoint.x, waypoint.y, waypoint.z);
    return position::hash(text, 0);
}

inline position::LinkOptions link_options(const TrackOptions& track) {
    position::LinkOptions options;
    const position::Grid grid = track.grid();
    options.interval_ms = track.interval_ms();
    options.least = grid.min;
    options.most = grid.max;
    options.agreed = agreed_number(track);
    return options;
}

struct EncodeOptions {
    TrackOptions track;
    std::uint32_t max_bytes = 32, deltas_per_packet = 0, id = TrackIds().packet, src = 0, dest = 0;

    void add(CLI::App& app) {
        track.add_codec(app);
        track.add_sampling(app);
        app.add_option("--max-bytes", max_bytes, "Fill packets up to this size, 32")
            ->option_text("N");
        app.add_option("--deltas-per-packet", deltas_per_packet,
                       "Send after so many positions, at the latest")
            ->option_text("N");
        app.add_option("--id", id, "Of message records: their id, 110")->option_text("N");
        app.add_option("--src", src, "Of message records: modem ID of this vehicle, 1 to 30")
            ->option_text("ID");
        app.add_option("--dest", dest, "Of message records: of the receiver, 0 to 30; 0: everybody")
            ->option_text("ID");
    }

    /// @throws Error(usage)
    void check(bool messages) const {
        const auto within = [](const char* option, std::uint64_t value, std::uint64_t least,
                               std::uint64_t most) {
            if (value < least || value > most)
                throw Error(ExitCode::usage, fmt::format("option {}: {} is outside {} to {}",
                                                         option, value, least, most));
        };
        within("--max-bytes", max_bytes, position::least_bytes(link_options(track)),
               messages ? most_wrapped : 2048);
        within("--deltas-per-packet", deltas_per_packet, 0, 1000);
        within("--id", id, 0, 32767);
        within("--src", src, 0, 30);
        within("--dest", dest, 0, 30);
        if (!messages && (id != TrackIds().packet || src != 0 || dest != 0))
            throw Error(ExitCode::usage, "options --id, --src and --dest are for --format message");
    }
};

/// Puts samples into packets as full as may be: knows from a trial what still fits. Each packet is
/// decoded at once, as the receiver will, so that the next one builds on it.
class PacketFiller {
public:
    explicit PacketFiller(const EncodeOptions& options)
        : options_(options),
          link_(link_options(options.track)),
          codec_(position::make_codec(options.track.codec_options(options.track.codec()))),
          horizon_(position::make_horizon()),
          sender_(link_, *codec_, *horizon_),
          receiver_(link_, *codec_, *horizon_) {}

    /// @return packets that are complete now, until the next call
    const std::vector<position::Packet>& add(const position::Sample& sample) {
        complete_.clear();
        const position::Fix fix{sample.time_ms, sample.cell};
        if (!state_) state_.emplace(link_, *codec_, *horizon_, fix.time_ms);
        if (!put(fix)) {
            send();
            put(fix);  // alone it fits: least_bytes()
        }
        waiting_.push_back(fix);
        if (waiting_.size() == options_.deltas_per_packet) send();
        return complete_;
    }
    /// The rest.
    const std::vector<position::Packet>& finish() {
        complete_.clear();
        if (!waiting_.empty()) send();
        return complete_;
    }

private:
    /// Whether it fits behind those that wait.
    bool put(const position::Fix& fix) {
        position::TrackState next(*state_);
        next.encode(next.step_to(fix, 1), coder_);
        const std::size_t bits = header_bits() + bits_.size() + coder_.ending_bits();
        const std::size_t most = 8 * options_.max_bytes - link_.check_bits;
        if (bits > most && !waiting_.empty()) return false;
        *state_ = std::move(next);
        return true;
    }

    std::size_t header_bits() const {
        position::PacketHeader header;
        header.is_start = !is_started_;
        header.ahead = static_cast<std::uint32_t>(waiting_.size() + 1);
        header.count = header.ahead;
        header.reference_bits = static_cast<unsigned>(std::bit_width(header.ahead));
        entropy::BitString bits;
        position::put(header, bits);
        return bits.size();
    }

    void send() {
        for (const position::Fix& fix : waiting_) sender_.sample(fix);
        auto packet = sender_.packet(options_.max_bytes);
        if (!packet || packet->positions != waiting_.size())
            throw std::logic_error("positions that should fit do not");
        const position::Arrival arrival = receiver_.packet(packet->bytes);
        if (arrival.fixes != waiting_)
            throw std::logic_error("what was decoded is not what was coded");
        if (sender_.acknowledge(arrival.ack) != position::Sender::Heard::advanced)
            throw std::logic_error("what was decoded is not acknowledged");
        complete_.push_back(std::move(*packet));
        waiting_.clear();
        bits_.clear();
        coder_ = entropy::Encoder(bits_);
        is_started_ = true;
    }

    const EncodeOptions& options_;
    position::LinkOptions link_;
    std::unique_ptr<position::Codec> codec_;
    std::unique_ptr<position::Horizon> horizon_;
    position::Sender sender_;
    position::Receiver receiver_;
    std::optional<position::TrackState> state_;  ///< behind those that wait
    bool is_started_ = false;
    std::vector<position::Fix> waiting_;
    entropy::BitString bits_;
    entropy::Encoder coder_{bits_};
    std::vector<position::Packet> complete_;
};

class Encode {
public:
    Encode(cli::Io& io, const EncodeOptions& options)
        : io_(io), options_(options), filler_(options) {}

    void run() {
        for_each_sample(io_, position::FixReader(options_.track.reading(io_.input_format)),
                        options_.track.sampling(),
                        [this](const position::Sample& sample) { write(filler_.add(sample)); });
        write(filler_.finish());
    }

private:
    void write(const std::vector<position::Packet>& packets) {
        for (const position::Packet& packet : packets) {
            if (io_.format == "message") {
                message(packet);
                continue;
            }
            std::string& out = io_.out.buffer();
            if (io_.format == "delimited")
                stream::append_delimited(out, packet.bytes);
            else {
                stream::append_hex(out, packet.bytes);
                out += '\n';
            }
            io_.out.commit();
        }
    }

    void message(const position::Packet& packet) {
        record::Record record;
        record.time.ns = packet.newest.time_ms * 1'000'000;
        record::Message message;
        message.id = options_.id;
        message.src = options_.src;
        message.dest = options_.dest;
        message.created = record.time;
        message.data = wrapped(options_.id, packet.bytes);
        record.kind = std::move(message);
        codec_.write(record, record::Form::ndjson, io_.out.buffer());
        io_.out.commit();
    }

    cli::Io& io_;
    const EncodeOptions& options_;
    PacketFiller filler_;
    record::Codec codec_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_LINK_HPP
