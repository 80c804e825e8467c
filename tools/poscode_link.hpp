// poscode encode over a stream that loses nothing: a file or a pipe.
#ifndef SEAUTILS_TOOLS_POSCODE_LINK_HPP
#define SEAUTILS_TOOLS_POSCODE_LINK_HPP

#include "poscode_records.hpp"
#include "poscode_track.hpp"

#include "seautils/position/hash.hpp"
#include "seautils/position/packet_filler.hpp"
#include "seautils/position/receiver.hpp"
#include "seautils/stream/hex.hpp"

#include <memory>
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

class Encode {
public:
    Encode(cli::Io& io, const EncodeOptions& options)
        : io_(io),
          options_(options),
          filler_(link_options(options.track),
                  *position::make_codec(options.track.codec_options(options.track.codec())),
                  *position::make_horizon(), options.max_bytes, options.deltas_per_packet) {}

    void run() {
        for_each_sample(io_, position::FixReader(options_.track.reading(io_.input_format)),
                        options_.track.sampling(), [this](const position::Sample& sample) {
                            write(filler_.add({sample.time_ms, sample.cell}));
                        });
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
        const record::Record record = track_message(packet.newest.time_ms * 1'000'000, options_.id,
                                                    options_.src, options_.dest, packet.bytes);
        codec_.write(record, record::Form::ndjson, io_.out.buffer());
        io_.out.commit();
    }

    cli::Io& io_;
    const EncodeOptions& options_;
    position::PacketFiller filler_;
    record::Codec codec_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_LINK_HPP
