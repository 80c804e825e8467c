// tdma-slot by the clock, and for a period at once.
#ifndef SEAUTILS_TOOLS_TDMA_LIVE_HPP
#define SEAUTILS_TOOLS_TDMA_LIVE_HPP

#include "record_io.hpp"
#include "tdma_options.hpp"

#include "seautils/cli/loop.hpp"
#include "seautils/stream/whole_file.hpp"
#include "seautils/tdma/ticker.hpp"

namespace seautils::tools {

/// Writes turns as records, or as lines of text.
class TdmaWriter {
public:
    TdmaWriter(cli::Io& io, const TdmaOptions& options)
        : io_(io), options_(options), rates_(options.rate_table()), is_text_(io.format == "text") {
        if (is_text_) io.format = "ndjson";  // RecordIo knows no other text
        records_.emplace(io);
    }

    /// @param written_ns  when the record is written
    void write(const tdma::Turn& turn, std::int64_t written_ns) {
        if (is_text_) return write_text(turn);
        record::Record record{{written_ns}, slot(turn)};
        records_->write(record);
        if (!initiates(turn) || is_filled_by_queue(turn)) return;
        record.kind = transmission(turn);
        records_->write(record);
    }

    RecordIo& records() { return *records_; }

private:
    bool initiates(const tdma::Turn& turn) const {
        if (options_.id == 0 || turn.slot.kind == tdma::Kind::blank) return false;
        return options_.id == (options_.polled() ? options_.master : turn.slot.src);
    }
    /// Else the transmission is complete as the slot says it, or is a poll.
    bool is_filled_by_queue(const tdma::Turn& turn) const {
        return turn.slot.kind == tdma::Kind::data && turn.slot.src == options_.id;
    }

    record::Slot slot(const tdma::Turn& turn) const;
    record::Transmission transmission(const tdma::Turn& turn) const;
    void write_text(const tdma::Turn& turn);

    cli::Io& io_;
    const TdmaOptions& options_;
    RateTable rates_;
    bool is_text_;
    std::optional<RecordIo> records_;
};

/// Whose turn it is: from the slots that were declared, or from those who were heard.
class TdmaTurns {
public:
    TdmaTurns(const cli::Io& io, const TdmaOptions& options) : io_(io), options_(options) {
        if (!options.discovers()) cycle_.emplace(options.cycle());
    }

    /// To be called before next(), when the time is known.
    void start(std::int64_t now_ns) {
        if (!options_.discovers()) return;
        const auto memory = remembered();
        if (memory)
            discovery_.emplace(options_.discovery(), *memory, now_ns);
        else
            discovery_.emplace(options_.discovery(), now_ns);
        saved_ = discovery_->memory();
    }
    tdma::Turn next(std::int64_t time_ns) const {
        return cycle_ ? cycle_->next(time_ns) : discovery_->next(time_ns);
    }

    /// @return whether next() says something else now
    bool hear(std::uint32_t src, std::int64_t time_ns);
    bool advance(std::int64_t time_ns);
    void clock_stepped(std::int64_t by_ns, std::int64_t now_ns) {
        if (discovery_) discovery_->clock_stepped(by_ns, now_ns);
    }
    /// Writes who is known to --state, where that changed.
    void save();

private:
    static constexpr std::size_t most_state_bytes = 1 << 16;
    std::optional<tdma::Memory> remembered() const;
    void say_known() const {
        io_.inform("known vehicles: " +
                   fmt::format("{}", fmt::join(discovery_->world().addresses(), " ")));
    }

    const cli::Io& io_;
    const TdmaOptions& options_;
    std::optional<tdma::Cycle> cycle_;
    std::optional<tdma::Discovery> discovery_;
    tdma::Memory saved_;
    bool cannot_save_ = false;
};

/// The schedule of a period, at once.
inline void write_period(TdmaTurns& turns, TdmaWriter& writer, const TdmaOptions& options) {
    const std::int64_t from_ns = parse_utc_ns(options.from);
    const std::int64_t to_ns = parse_utc_ns(options.to);
    const std::int64_t lead_ns = options.lead_ns();
    turns.start(from_ns);
    for (tdma::Turn turn = turns.next(from_ns); turn.start_ns < to_ns;
         turn = turns.next(turn.start_ns + 1))
        writer.write(turn, std::max<std::int64_t>(turn.start_ns - lead_ns, 0));
}

/// By the clock, until a signal; or until the inputs end, where there are any.
class TdmaLive {
public:
    TdmaLive(cli::Io& io, const TdmaOptions& options, TdmaTurns& turns, TdmaWriter& writer)
        : io_(io), options_(options), turns_(turns), writer_(writer), loop_(io) {
        loop_.on_wake([this] { wake(); });
        loop_.on_clock_step([this] { clock_stepped(); });
        loop_.before_wait([this] { turns_.save(); });
        const auto heard = [this](std::string_view bytes) { hear(bytes); };
        const cli::Framing framing = writer.records().framing();
        if (!options.feedback.empty()) loop_.fifo(options.feedback, framing, heard);
        if (!io.files.empty() || io.clock.is_input()) loop_.inputs(framing, heard);
    }

    void run() {
        if (!io_.clock.is_input()) start();
        loop_.run();
        turns_.save();
    }

private:
    void start() {
        const std::int64_t now_ns = io_.clock.now_ns();
        turns_.start(now_ns);
        ticker_.emplace([this](std::int64_t t) { return turns_.next(t); }, options_.lead_ns(),
                        now_ns);
        offset_ns_ = now_ns - io_.clock.steady_ns();
        loop_.wake_at(ticker_->due_ns());
    }

    void wake() {
        offset_ns_ = io_.clock.now_ns() - io_.clock.steady_ns();
        while (const auto handed = ticker_->take(io_.clock.now_ns())) {
            if (handed->is_missed)
                io_.warn(fmt::format("woke {} s late: the slot at {} is left out",
                                     static_cast<double>(handed->late_ns) / 1e9,
                                     format_utc_ns(handed->turn.start_ns)));
            else
                writer_.write(handed->turn, io_.clock.now_ns());
        }
        if (turns_.advance(io_.clock.now_ns())) ticker_->plan(io_.clock.now_ns());
        loop_.wake_at(ticker_->due_ns());
    }

    void clock_stepped() {
        const std::int64_t now_ns = io_.clock.now_ns();
        const std::int64_t by_ns = now_ns - io_.clock.steady_ns() - offset_ns_;
        offset_ns_ += by_ns;
        turns_.clock_stepped(by_ns, now_ns);
        ticker_->plan(now_ns);
        io_.warn(fmt::format("the clock was set {:.6f} s {}: it is {}, the next slot is at {}",
                             static_cast<double>(by_ns < 0 ? -by_ns : by_ns) / 1e9,
                             by_ns < 0 ? "back" : "forward", format_utc_ns(now_ns),
                             format_utc_ns(ticker_->due_ns() + options_.lead_ns())));
        loop_.wake_at(ticker_->due_ns());
    }

    /// A record that somebody else wrote: it tells the time with --clock input, and who spoke.
    void hear(std::string_view bytes) {
        const record::Record& record = writer_.records().read(bytes);
        come_to(record.time.ns);
        if (!options_.discovers()) return;
        const std::int64_t now_ns = io_.clock.now_ns();
        const std::int64_t heard_ns = record.time.ns == 0 ? now_ns : record.time.ns;
        bool is_new = false;
        for (const std::uint32_t src : speakers(record))
            is_new = turns_.hear(src, std::min(heard_ns, now_ns)) || is_new;
        if (!is_new) return;
        ticker_->plan(now_ns);
        loop_.wake_at(ticker_->due_ns());
    }

    void come_to(std::int64_t time_ns) {
        if (!io_.clock.is_input()) return;
        if (ticker_) return loop_.advance(time_ns);
        if (time_ns == 0) throw DataError("the first record has no time (--clock input)");
        io_.clock.advance(time_ns);
        start();
        loop_.advance(time_ns);  // a slot may begin right now
    }

    static std::vector<std::uint32_t> speakers(const record::Record& record);

    cli::Io& io_;
    const TdmaOptions& options_;
    TdmaTurns& turns_;
    TdmaWriter& writer_;
    cli::Loop loop_;
    std::optional<tdma::Ticker> ticker_;
    std::int64_t offset_ns_ = 0;  ///< of the clock from one that no one steps
};

inline record::Slot TdmaWriter::slot(const tdma::Turn& turn) const {
    record::Slot slot;
    slot.index = turn.index;
    slot.cycle = static_cast<std::uint32_t>(turn.cycle);
    slot.src = static_cast<std::uint32_t>(turn.slot.src);
    if (turn.slot.dest) slot.dest = static_cast<std::uint32_t>(*turn.slot.dest);
    slot.rate = static_cast<std::uint32_t>(turn.slot.rate);
    slot.kind = static_cast<record::Kind>(turn.slot.kind);
    slot.start.ns = turn.start_ns;
    slot.end.ns = turn.end_ns;
    if (turn.slot.kind == tdma::Kind::data) {
        const Rate& size = rates_.data(slot.rate);
        slot.frames = size.frames;
        slot.frame_bytes = size.frame_bytes;
    }
    if (options_.id != 0) slot.initiate = initiates(turn);
    return slot;
}

inline record::Transmission TdmaWriter::transmission(const tdma::Turn& turn) const {
    record::Transmission sent;
    // Unique over restarts for 24 days, and none of queue-sched's, which count on from the seconds
    // since 1970 at its start: they stay below until 2038.
    constexpr std::uint32_t ours = 0x8000'0000;
    sent.number = ours | static_cast<std::uint32_t>(turn.start_ns / 1'000'000 % ours);
    sent.src = static_cast<std::uint32_t>(turn.slot.src);
    sent.dest = static_cast<std::uint32_t>(turn.slot.dest.value_or(0));
    sent.rate = static_cast<std::uint32_t>(turn.slot.rate);
    sent.kind = static_cast<record::Kind>(turn.slot.kind);
    if (turn.slot.kind == tdma::Kind::mini) sent.mini = static_cast<std::uint32_t>(turn.slot.mini);
    sent.deadline = record::UtcTime{turn.end_ns};
    sent.slot_index = turn.index;
    return sent;
}

inline void TdmaWriter::write_text(const tdma::Turn& turn) {
    constexpr const char* names[] = {"data", "ping", "lbl", "mini", "blank"};
    const std::string dest = turn.slot.dest ? fmt::format("{}", *turn.slot.dest) : "*";
    std::string line = fmt::format("{}  {:>9} s  {:<5}", format_utc_ns(turn.start_ns),
                                   static_cast<double>(turn.end_ns - turn.start_ns) / 1e9,
                                   names[static_cast<std::size_t>(turn.slot.kind)]);
    if (turn.slot.kind != tdma::Kind::blank)
        line += fmt::format("  {:>2} to {:>2}  rate {}", turn.slot.src, dest, turn.slot.rate);
    io_.out << line << (initiates(turn) ? "  <\n" : "\n");
}

inline std::optional<tdma::Memory> TdmaTurns::remembered() const {
    if (options_.state.empty()) return std::nullopt;
    const auto text = stream::read_whole_file(options_.state, most_state_bytes);
    if (!text) return std::nullopt;
    try {
        return tdma::parse_memory(*text);
    } catch (const DataError& e) {
        io_.warn(options_.state + ": " + e.what() + ": nobody is known");
        return std::nullopt;
    }
}

inline bool TdmaTurns::hear(std::uint32_t src, std::int64_t time_ns) {
    if (!discovery_ || src > tdma::max_modem_id) return false;
    if (!discovery_->hear(static_cast<int>(src), time_ns)) return false;
    say_known();
    return true;
}

inline bool TdmaTurns::advance(std::int64_t time_ns) {
    if (!discovery_ || !discovery_->advance(time_ns)) return false;
    say_known();
    return true;
}

/// A file that cannot be written is no reason to fall silent.
inline void TdmaTurns::save() {
    if (options_.state.empty() || !discovery_) return;
    tdma::Memory memory = discovery_->memory();
    if (memory == saved_) return;
    try {
        stream::replace_file(options_.state, tdma::to_text(memory));
        cannot_save_ = false;
    } catch (const Error& e) {
        if (!cannot_save_) io_.warn(std::string(e.what()) + ": who is known is not kept");
        cannot_save_ = true;
    }
    saved_ = std::move(memory);
}

/// Whoever a record shows to be there.
inline std::vector<std::uint32_t> TdmaLive::speakers(const record::Record& record) {
    if (const auto* reception = record.as<record::Reception>()) return {reception->src};
    if (const auto* ack = record.as<record::Ack>()) return {ack->src};
    if (const auto* range = record.as<record::Range>()) return {range->src, range->dest};
    const auto* event = record.as<record::ModemEvent>();
    if (event != nullptr && event->event == record::ModemEvent::Event::heard)
        return {event->src.value_or(0)};
    return {};
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TDMA_LIVE_HPP
