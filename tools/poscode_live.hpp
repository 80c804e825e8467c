// poscode encode over a link that loses packets: what is sent next depends on what arrived.
#ifndef SEAUTILS_TOOLS_POSCODE_LIVE_HPP
#define SEAUTILS_TOOLS_POSCODE_LIVE_HPP

#include "poscode_link.hpp"
#include "poscode_records.hpp"

#include "seautils/cli/loop.hpp"
#include "seautils/position/sender.hpp"

namespace seautils::tools {

struct LiveOptions {
    std::vector<std::string> feedback;
    std::string socket, state, every;
    std::optional<double> linger_s;
    bool history = false, newest = false, automatic = false;
    std::uint32_t ack_id = TrackIds().ack;

    void add(CLI::App& app) {
        app.add_option("--feedback", feedback,
                       "Read acknowledgements and slots from FIFO; may repeat")
            ->allow_extra_args(false)
            ->option_text("FIFO");
        app.add_option("--send", socket, "Hand packets to queue-sched --listen SOCKET")
            ->option_text("SOCKET");
        app.add_option("--state", state, "Keep what was sent, and what arrived, in FILE")
            ->option_text("FILE");
        auto* const all = app.add_flag("--history", history, "All positions arrive (default)");
        auto* const last = app.add_flag("--newest", newest, "Only the newest position is sent");
        auto* const both = app.add_flag("--auto", automatic, "One or the other, as many are lost");
        last->excludes(all)->excludes(both);
        both->excludes(all);
        app.add_option("--every", every, "While positions are missing, send so often, tau")
            ->check(thousandths_within(0.001, 86'400, "s"))
            ->option_text("SECONDS");
        app.add_option("--linger", linger_s,
                       "End so long after the end of the input, at the latest")
            ->check(CLI::Range(0.0, 1e6))
            ->option_text("SECONDS");
        app.add_option("--ack-id", ack_id, "Of acknowledgements: their id, 111")
            ->check(CLI::Range(0, 32'767))
            ->option_text("N");
    }

    bool is_live() const { return !feedback.empty() || !socket.empty(); }
    /// @throws Error(usage)
    void check() const {
        if (is_live()) return;
        if (!state.empty() || history || newest || automatic || !every.empty() || linger_s)
            throw Error(ExitCode::usage,
                        "options --state, --history, --newest, --auto, --every and --linger need "
                        "--feedback or --send");
    }
    position::LinkMode mode() const {
        return newest      ? position::LinkMode::newest
               : automatic ? position::LinkMode::automatic
                           : position::LinkMode::history;
    }
};

/// Makes a packet for each new sample, for each acknowledgement that leaves something to be sent, for
/// each own slot that begins, and every so often while something is not acknowledged. Before a packet
/// leaves it is in the state that it was made.
class LiveEncode {
public:
    LiveEncode(cli::Io& io, const EncodeOptions& options, const LiveOptions& live)
        : io_(io),
          options_(options),
          live_(live),
          ids_{options.id, live.ack_id},
          every_ns_(ns_of(live, options)),
          records_(io),
          loop_(io),
          reader_(options.track.reading(io.input_format)),
          state_(live.state),
          sender_(link(options, live),
                  *position::make_codec(options.track.codec_options(options.track.codec())),
                  *position::make_horizon()) {
        try {
            sampler_.emplace(options.track.sampling());
        } catch (const ConfigError& e) {
            throw Error(ExitCode::usage, e.what());
        }
        if (!live.socket.empty()) queue_.emplace(io, live.socket);
        state_.read(io, [this](const TrackStateFile::Kept& kept) {
            sender_.load(kept.end);
            known_until_ms_ = kept.time_ms;
            newest_ms_ = kept.time_ms;
        });
    }

    void run() {
        loop_.inputs(cli::Framing::lines, [this](std::string_view line) { fix(line); });
        loop_.on_inputs_ended([this] { inputs_ended(); });
        for (const std::string& fifo : live_.feedback)
            loop_.fifo(fifo, cli::Framing::lines, [this](std::string_view r) { heard(r); });
        loop_.on_wake([this] { wake(); });
        loop_.before_wait([this] { before_wait(); });
        is_due_ = sender_.pending() > 0;
        loop_.run();
        keep();
        if (sender_.pending() > 0)
            io_.warn(counted(sender_.pending(), "position") + " not acknowledged");
        if (sender_.dropped() > 0)
            io_.warn(counted(sender_.dropped(), "position") + " given up: too many were waiting");
    }

private:
    static std::int64_t ns_of(const LiveOptions& live, const EncodeOptions& options) {
        constexpr std::int64_t ns_per_ms = 1'000'000;
        return ns_per_ms * (live.every.empty() ? options.track.interval_ms()
                                               : thousandths(live.every, 0, 1e9, ""));
    }
    static position::LinkOptions link(const EncodeOptions& options, const LiveOptions& live) {
        position::LinkOptions link = link_options(options.track);
        link.mode = live.mode();
        return link;
    }

    void fix(std::string_view line) {
        const auto fix = reader_.read(line);
        if (!fix) return;
        for (const position::Sample& sample : sampler_->add(*fix)) take(sample);
    }

    /// After a restart the same fixes may be read again: those that were sampled are passed over.
    void take(const position::Sample& sample) {
        if (known_until_ms_ && sample.time_ms <= *known_until_ms_) return;
        known_until_ms_.reset();
        sender_.sample({sample.time_ms, sample.cell});
        newest_ms_ = sample.time_ms;
        is_due_ = true;
    }

    void heard(std::string_view bytes) {
        const record::Record& record = records_.read(bytes);
        const auto* slot = record.as<record::Slot>();
        if (slot != nullptr && slot->kind == record::Kind::data && slot->src == options_.src)
            is_due_ = true;
        take_parts(io_, record, ids_, ids_.ack, [this](std::uint32_t, std::string_view ack) {
            using enum position::Sender::Heard;
            const auto heard = sender_.acknowledge(ack);
            if (heard == restarted) io_.inform("the receiver lost what it knew: a new session");
            is_due_ = is_due_ || heard != nothing;
        });
    }

    void inputs_ended() {
        ended_ = true;
        if (live_.linger_s)
            end_ns_ = io_.clock.steady_ns() + static_cast<std::int64_t>(*live_.linger_s * 1e9);
    }

    void wake() {
        const std::int64_t now_ns = io_.clock.steady_ns();
        if (end_ns_ && now_ns >= *end_ns_) return loop_.stop();
        is_due_ = is_due_ || now_ns >= again_ns_;
    }

    /// What came without a pause goes into one packet.
    void before_wait() {
        if (std::exchange(is_due_, false)) send();
        const bool all_arrived = sender_.pending() == 0;
        if (ended_ && all_arrived) return loop_.stop();
        std::optional<std::int64_t> due = end_ns_;
        if (!all_arrived && (!due || again_ns_ < *due)) due = again_ns_;
        loop_.wake_at_steady(due);
    }

    void keep() const {
        if (state_.is_used()) state_.write({newest_ms_, sender_.save()});
    }

    void send() {
        const auto packet = sender_.packet(options_.max_bytes);
        again_ns_ = io_.clock.steady_ns() + every_ns_;
        keep();
        if (!packet) return;
        const record::Record record = track_message(io_.clock.now_ns(), ids_.packet, options_.src,
                                                    options_.dest, packet->bytes);
        queue_ ? queue_->send(record, records_.codec()) : records_.write(record);
    }

    cli::Io& io_;
    const EncodeOptions& options_;
    const LiveOptions& live_;
    TrackIds ids_;
    std::int64_t every_ns_;
    RecordIo records_;
    cli::Loop loop_;
    position::FixReader reader_;
    TrackStateFile state_;
    position::Sender sender_;
    std::optional<position::Sampler> sampler_;
    std::optional<QueueClient> queue_;
    std::int64_t newest_ms_ = -1;                 ///< of the last sample
    std::optional<std::int64_t> known_until_ms_;  ///< sampled before the restart
    bool is_due_ = false, ended_ = false;
    std::int64_t again_ns_ = 0;  ///< when the next packet goes at the latest
    std::optional<std::int64_t> end_ns_;
};

inline int encode_main(int argc, char** argv) {
    EncodeOptions options;
    LiveOptions live;
    cli::App app{"poscode encode",
                 "Pack a vehicle's track into packets of a few bits a fix.",
                 "  poscode encode --tau 10 --max-bytes 32 track.csv > packets.hex\n",
                 {.config = true, .clock = true}};
    app.input_formats(fix_formats);
    app.output_formats({"hex", "delimited", "message"});
    options.add(app.options());
    live.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) {
        live.check();
        if (live.is_live() && app.options().get_option("--format")->count() == 0)
            io.format = "message";
        if (live.is_live() && io.format != "message")
            throw Error(ExitCode::usage, "option --format: a live link takes messages only");
        if (live.is_live() && io.clock.is_input())
            throw Error(ExitCode::usage,
                        "a live link goes by a clock, not by the times of its input");
        if (live.is_live() && options.id == live.ack_id)
            throw Error(ExitCode::usage, "options --id and --ack-id are the same");
        if (live.is_live() && options.deltas_per_packet != 0)
            throw Error(ExitCode::usage,
                        "option --deltas-per-packet is for a stream that loses nothing");
        options.check(io.format == "message");
        live.is_live() ? LiveEncode(io, options, live).run() : Encode(io, options).run();
    });
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_LIVE_HPP
