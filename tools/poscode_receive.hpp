// poscode decode: packets in, positions out, acknowledgements back.
#ifndef SEAUTILS_TOOLS_POSCODE_RECEIVE_HPP
#define SEAUTILS_TOOLS_POSCODE_RECEIVE_HPP

#include "poscode_link.hpp"
#include "poscode_records.hpp"

#include "seautils/position/fix_writer.hpp"

namespace seautils::tools {

struct DecodeOptions {
    TrackOptions track;
    std::string socket, acks, state;
    TrackIds ids;
    std::uint32_t src = 0, from = 0;

    void add(CLI::App& app) {
        track.add_codec(app);
        app.add_option("--send", socket, "Hand acknowledgements to queue-sched --listen SOCKET")
            ->option_text("SOCKET");
        app.add_option("--acks", acks, "Write acknowledgements into FIFO, as message records")
            ->option_text("FIFO");
        app.add_option("--state", state, "Keep what arrived in FILE")->option_text("FILE");
        app.add_option("--id", ids.packet, "Of packets in records: their id, 110")
            ->check(CLI::Range(0, 32'767))
            ->option_text("N");
        app.add_option("--ack-id", ids.ack, "Of acknowledgements: their id, 111")
            ->check(CLI::Range(0, 32'767))
            ->option_text("N");
        app.add_option("--src", src, "Of acknowledgements: modem ID of this node, 1 to 30")
            ->check(CLI::Range(1, 30))
            ->option_text("ID");
        app.add_option("--from", from, "Take only packets of records from this vehicle, 1 to 30")
            ->check(CLI::Range(1, 30))
            ->option_text("ID");
    }

    /// @throws Error(usage)
    void check() const {
        if (ids.packet == ids.ack)
            throw Error(ExitCode::usage, "options --id and --ack-id are the same");
    }
};

class Decode {
public:
    Decode(cli::Io& io, const DecodeOptions& options)
        : io_(io),
          options_(options),
          records_(io),
          receiver_(link_options(options.track),
                    *position::make_codec(options.track.codec_options(options.track.codec())),
                    *position::make_horizon()),
          state_(options.state),
          writer_(form(io.format), options.track.grid(), options.track.frame()) {
        if (!options.socket.empty()) queue_.emplace(io, options.socket);
        if (!options.acks.empty()) fifo_.emplace(options.acks);
        state_.read(io, [this](const TrackStateFile::Kept& kept) { receiver_.load(kept.end); });
    }

    void run() {
        writer_.header(io_.out.buffer());
        const bool binary = io_.input_format == "delimited";
        io_.for_each(binary ? cli::Framing::delimited : cli::Framing::lines,
                     [&](std::string_view record) { take(record); });
    }

private:
    static position::FixWriter::Form form(const std::string& name) {
        using Form = position::FixWriter::Form;
        return name == "csv" ? Form::csv : name == "delimited" ? Form::delimited : Form::ndjson;
    }

    void take(std::string_view bytes) {
        if (io_.input_format == "ndjson") return record(bytes);
        if (io_.input_format == "hex")
            stream::from_hex(bytes, bytes_);
        else
            bytes_ = io_.input_format == "base64" ? from_base64(bytes) : std::string(bytes);
        const std::string why = packet(bytes_, options_.from);
        if (!why.empty()) throw DataError(why);
    }

    /// On the air it is nothing strange that a packet comes too late to be of use.
    void record(std::string_view bytes) {
        const record::Record& record = records_.read(bytes);
        if (io_.clock.is_input()) io_.clock.advance(record.time.ns);
        take_parts(io_, record, options_.ids, options_.ids.packet,
                   [this](std::uint32_t src, std::string_view packet_bytes) {
                       if (options_.from != 0 && src != options_.from) return;
                       const std::string why = packet(packet_bytes, src);
                       if (!why.empty()) io_.inform(why);
                   });
    }

    /// Positions are written before it is kept that they are known, and that before it is said: a
    /// kill in between may repeat some, and loses none.
    /// @return why it was of no use; empty: it was
    std::string packet(std::string_view bytes, std::uint32_t src) {
        const position::Arrival arrival = receiver_.packet(bytes);
        for (const position::Fix& fix : arrival.fixes) {
            writer_.write(fix.time_ms, fix.cell, io_.out.buffer());
            io_.out.commit();
        }
        if (state_.is_used() || queue_ || fifo_) io_.out.flush();
        if (state_.is_used()) state_.write({-1, receiver_.save()});
        if (!arrival.ack.empty()) acknowledge(arrival.ack, src);
        return arrival.outcome == position::Arrival::Outcome::undecodable ? arrival.why : "";
    }

    void acknowledge(const std::string& ack, std::uint32_t dest) {
        if (!queue_ && !fifo_) return;
        const record::Record record =
            track_message(io_.clock.now_ns(), options_.ids.ack, options_.src, dest, ack);
        if (queue_) queue_->send(record, records_.codec());
        if (!fifo_) return;
        bytes_.clear();
        records_.codec().write(record, record::Form::ndjson, bytes_);
        fifo_->write(bytes_);
    }

    cli::Io& io_;
    const DecodeOptions& options_;
    RecordIo records_;
    position::Receiver receiver_;
    TrackStateFile state_;
    position::FixWriter writer_;
    std::optional<QueueClient> queue_;
    std::optional<stream::FeedbackFifo> fifo_;
    std::string bytes_;
};

inline int decode_main(int argc, char** argv) {
    DecodeOptions options;
    cli::App app{"poscode decode",
                 "Unpack the positions of packets.",
                 "  poscode decode --tau 10 --format csv packets.hex\n",
                 {.config = true, .clock = true}};
    app.input_formats({"hex", "delimited", "base64", "ndjson"});
    app.output_formats({"ndjson", "csv", "delimited"});
    options.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) {
        options.check();
        Decode(io, options).run();
    });
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_RECEIVE_HPP
