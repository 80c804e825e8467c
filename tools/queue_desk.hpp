// What queue-sched does with each record: messages into the spool and the queues, turns into
// transmissions, acknowledgements and results back to the queues.
#ifndef SEAUTILS_TOOLS_QUEUE_DESK_HPP
#define SEAUTILS_TOOLS_QUEUE_DESK_HPP

#include "queue_records.hpp"
#include "record_io.hpp"

#include "seautils/cli/loop.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/queue/scheduler.hpp"
#include "seautils/queue/spool.hpp"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seautils::tools {

struct DeskOptions {
    queue::SchedulerOptions scheduler;
    std::string spool;  ///< path; empty: none
    bool explain = false;
};

class QueueDesk {
public:
    QueueDesk(cli::Io& io, cli::Loop& loop, DeskOptions options)
        : io_(io), loop_(loop), options_(std::move(options)), records_(io) {
        if (!io_.clock.is_input()) open();
    }

    cli::Framing framing() const { return records_.framing(); }

    /// From the inputs: what is not for the queues goes on to the next tool.
    void from_input(std::string_view bytes) {
        if (take(records_.read(bytes), {})) return;
        if (io_.clock.is_input())
            records_.pass_on(bytes);
        else
            keeps_up(records_.offer_on(bytes));
    }
    /// From the modem, back: what is not for the queues ends here.
    void from_feedback(std::string_view bytes) { take(records_.read(bytes), {}); }
    /// From an application, which is answered: `ok`, or `error: ` and why.
    void from_socket(std::string_view bytes, std::uint64_t client) {
        const record::Record& record = records_.read_packet(bytes);
        if (record.as<record::Message>() == nullptr)
            throw DataError("only messages are taken here, not " +
                            std::string(record::kind_name(record)));
        take(record, client);
    }

    /// Answers the turn that waits, and does what is due.
    void wake() {
        if (!scheduler_) return;
        commit();
        if (turn_) answer(*std::exchange(turn_, {}));
        scheduler_->advance(now());
        settle_changes();
        if (notes_since_ns_ && now().steady_ns >= *notes_since_ns_ + patience_ns) flush();
        set_alarm();
    }

    /// Makes safe what came: a batch is what came without a pause.
    void before_wait() {
        if (!scheduler_) return;
        records_.write_kept();
        commit();
        set_alarm();
    }

    void finish() {
        wake();
        if (!scheduler_) return;
        flush();
        std::uint64_t waiting = 0;
        for (const queue::QueueStats& s : scheduler_->stats(now()))
            waiting += s.queued - s.under_way;
        if (!spool_ && waiting > 0)
            io_.warn(counted(waiting, "message") + " still queued, and lost without --spool");
    }

    /// When all is said: a signal does not wait for a reader that does not come.
    void leave() {
        const std::size_t left = records_.leave(io_.ended_by == 0);
        if (left > 0) io_.warn(counted(left, "record") + " not read by anybody");
    }

    void write_stats() {
        if (!scheduler_) return;
        commit();
        for (const queue::QueueStats& s : scheduler_->stats(now())) write(to_record(s));
    }

private:
    struct Newcomer {
        queue::Message message;
        queue::Now came;
        std::optional<std::uint64_t> client;
    };

    static constexpr std::int64_t patience_ns = queue::QueueConfig::ns_per_s;
    static constexpr std::size_t batch = 1000;
    /// Keeps times that are UTC far from the ends of 64 bits.
    static constexpr std::int64_t origin_ns = 1'700'000'000 * queue::QueueConfig::ns_per_s;

    std::int64_t steady_origin_ns() const { return io_.clock.is_system() ? 0 : origin_ns; }
    queue::Now now() const {
        return {io_.clock.steady_ns() - steady_origin_ns(), io_.clock.now_ns() / 1000};
    }

    /// Names the run of the steady clock, for the spool.
    std::string boot() const {
        if (!io_.clock.is_system()) return "simulated";
        std::string id;
        std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), id);
        return id;
    }

    /// With --clock input there is no time before the first record.
    void open() {
        const queue::Now start = now();
        queue::SpoolContents held;
        if (!options_.spool.empty()) {
            spool_ = std::make_unique<queue::Spool>(options_.spool, start, boot());
            held = spool_->take_contents();
        }
        sequence_ = held.next_sequence;
        // Also without a spool, or with a new one, numbers differ from those of earlier runs.
        const auto seconds = static_cast<std::uint32_t>(start.utc_us / 1'000'000);
        options_.scheduler.first_transmission =
            std::max({held.next_transmission, seconds, std::uint32_t{1}});
        scheduler_ = std::make_unique<queue::Scheduler>(std::move(options_.scheduler), start);
        own_id_ = scheduler_->own_id();
        for (const auto& [key, last_ns] : held.last_ns) scheduler_->set_last(key, last_ns);
        for (queue::Accepted& message : held.messages) scheduler_->push(std::move(message), start);
        settle_changes();
    }

    /// False: the record is not for the queues.
    bool take(const record::Record& record, std::optional<std::uint64_t> client) {
        loop_.advance(record.time.ns);
        if (!scheduler_) {
            if (io_.clock.now_ns() == 0) throw DataError("no time, where --clock input takes it");
            open();
        }
        if (const auto* const message = record.as<record::Message>())
            newcomer(to_message(*message), client);
        else if (const auto* const slot = record.as<record::Slot>())
            return begin(*slot);
        else if (const auto* const ack = record.as<record::Ack>())
            acknowledge(*ack);
        else if (const auto* const result = record.as<record::Result>())
            settle(*result);
        else
            return false;
        return true;
    }

    void newcomer(queue::Message message, std::optional<std::uint64_t> client) {
        const queue::Now came = now();
        if (std::optional<queue::Drop> drop = scheduler_->check(message, came)) {
            answer(client, "error: " + drop->why);
            write(to_record(std::move(*drop), own_id_));
            return;
        }
        newcomers_.push_back({std::move(message), came, client});
        if (newcomers_.size() >= batch) return commit();
        if (!client) return;
        is_asked_ = true;
        set_alarm();
    }

    /// Stores the newcomers, queues them, and tells who sent them.
    void commit() {
        if (newcomers_.empty()) return;
        std::vector<Newcomer> all = std::exchange(newcomers_, {});
        is_asked_ = false;
        std::vector<queue::Accepted> accepted;
        for (Newcomer& one : all)
            accepted.push_back(queue::accept(std::move(one.message), sequence_++, one.came));
        const std::string fault = try_spool([&] { spool_->store(accepted); });
        if (fault.empty()) notes_since_ns_.reset();
        for (std::size_t k = 0; k < all.size(); ++k) {
            const std::string why = fault.empty() ? push(std::move(accepted[k]), all[k].came)
                                                  : refuse(accepted[k].message, fault);
            answer(all[k].client, why.empty() ? "ok" : "error: " + why);
        }
    }

    /// @return why it was dropped at once; empty: it was not
    std::string push(queue::Accepted message, queue::Now came) {
        const std::uint64_t sequence = message.sequence;
        scheduler_->push(std::move(message), came);
        return settle_changes(sequence);
    }

    std::string refuse(const queue::Message& message, const std::string& fault) {
        write(to_record(
            scheduler_->refuse(message, queue::DropReason::refused, "not stored: " + fault, now()),
            own_id_));
        return "not stored: " + fault;
    }

    void answer(std::optional<std::uint64_t> client, const std::string& text) {
        if (client) loop_.reply(*client, text);
    }

    /// Writes what was dropped, and notes what the spool need not keep.
    /// @return  why the message `sequence` was dropped, where it was
    std::string settle_changes(std::uint64_t sequence = 0) {
        queue::Changes changes = scheduler_->take_changes();
        std::string why;
        for (queue::Drop& drop : changes.drops) {
            if (drop.sequence == sequence) why = drop.why;
            write(to_record(std::move(drop), own_id_));
        }
        for (const std::uint64_t gone : changes.gone) note([&] { spool_->note_gone(gone); });
        return why;
    }

    /// A turn of this vehicle's for data, in which it may begin, is answered, by the newest one that
    /// waits. Where a master begins, the modem asks for the data when it comes to that.
    bool begin(const record::Slot& slot) {
        const bool ours = slot.src == own_id_ && slot.initiate.value_or(true);
        if (!ours || slot.kind != record::Kind::data) return false;
        check(slot);
        turn_ = slot;
        // Replayed, each turn is at its time; live, a newer one may be behind it already.
        if (io_.clock.is_input())
            wake();
        else
            set_alarm();
        return true;
    }

    static void check(const record::Slot& slot) {
        constexpr std::uint32_t most_frames = 8, most_bytes = 2048;
        if (slot.end.ns == 0) throw DataError("slot without its end");
        if (slot.frames < 1 || slot.frames > most_frames)
            throw DataError(fmt::format("slot: frames {} is outside 1 to 8", slot.frames));
        if (slot.frame_bytes < 1 || slot.frame_bytes > most_bytes / slot.frames) {
            throw DataError(fmt::format("slot: frame_bytes {} is outside 1 to {}", slot.frame_bytes,
                                        most_bytes / slot.frames));
        }
        if (slot.dest && *slot.dest > 30)
            throw DataError(fmt::format("slot: dest {} is outside 0 to 30", *slot.dest));
    }

    void answer(const record::Slot& slot) {
        constexpr std::int64_t longest_ns = 1'000'000'000 * queue::QueueConfig::ns_per_s;
        const queue::Now at = now();
        const std::int64_t left_ns = slot.end.ns - io_.clock.now_ns();
        if (left_ns <= 0) return;
        const queue::Turn turn{slot.frames, slot.frame_bytes, slot.dest,
                               slot.ack_requested.value_or(true),
                               at.steady_ns + std::min(left_ns, longest_ns)};
        std::vector<queue::Contest> contests;
        std::optional<queue::Packet> packet = scheduler_->fill(turn, at, explainer(contests));
        settle_changes();
        for (const queue::Contest& contest : contests) write_fitting(to_record(contest, slot));
        if (!packet) return;
        for (const queue::Carried& carried : packet->carried)
            note([&] { spool_->note_sent(carried, at); });
        try_spool([&] { spool_->reserve(packet->number + 1); });
        const std::uint32_t number = packet->number;
        if (write(to_record(std::move(*packet), slot))) return;
        // Nobody takes it: its messages come back at once.
        scheduler_->settle(number, queue::Outcome::busy, now());
        settle_changes();
    }

    /// Says once that whoever reads our output does not keep up.
    void keeps_up(bool taken) {
        if (!taken && !stuck_) io_.warn("standard output is full: what reads it does not keep up");
        stuck_ = !taken;
    }

    std::function<void(const queue::Contest&)> explainer(std::vector<queue::Contest>& contests) {
        if (!options_.explain) return {};
        return [&contests](const queue::Contest& contest) { contests.push_back(contest); };
    }

    /// An acknowledgement for somebody else is none.
    void acknowledge(const record::Ack& ack) {
        if (ack.dest != own_id_ && ack.dest != 0) return;
        commit();
        scheduler_->acknowledge(ack.src, ack.transmission, ack.frame, now());
        settle_changes();
        set_alarm();
    }

    void settle(const record::Result& result) {
        commit();
        scheduler_->settle(result.transmission, static_cast<queue::Outcome>(result.outcome), now());
        settle_changes();
        set_alarm();
    }

    /// False: a transmission that nobody takes. What else there is to say waits for its reader.
    template <class Kind>
    bool write(Kind&& kind) {
        record::Record record{{io_.clock.now_ns()}, std::forward<Kind>(kind)};
        if constexpr (std::is_same_v<std::decay_t<Kind>, record::Drop>) {
            try {
                return emit(record);
            } catch (const DataError&) {  // with its data it is too long
                std::get<record::Drop>(record.kind).data.clear();
            }
        }
        return emit(record);
    }

    /// Replayed, the reader is waited for; live it is not: the queues go on without it.
    bool emit(const record::Record& record) {
        if (io_.clock.is_input()) {
            records_.write(record);
            return true;
        }
        const bool may_be_late = record.as<record::Transmission>() == nullptr;
        const bool taken = may_be_late ? records_.keep(record) : records_.offer(record);
        keeps_up(taken && records_.kept() == 0);
        return taken;
    }

    /// With as many candidates as fit into a record, the best ones.
    void write_fitting(record::Contest contest) {
        const auto all = static_cast<std::uint32_t>(contest.candidate.size());
        for (;;) {
            const auto kept = static_cast<std::uint32_t>(contest.candidate.size());
            if (kept < all) contest.left_out = all - kept;
            try {
                write(contest);
                return;
            } catch (const DataError&) {
                contest.candidate.resize(std::min<std::size_t>(kept * 3 / 4, 60));
            }
        }
    }

    template <class Note>
    void note(Note&& take_note) {
        if (!spool_) return;
        take_note();
        if (!notes_since_ns_) notes_since_ns_ = now().steady_ns;
    }

    /// The spool's file may fail for a while (a full disk): said once, and tried again.
    /// @return  what is wrong; empty: nothing
    template <class Action>
    std::string try_spool(Action&& action) {
        if (!spool_) return {};
        try {
            action();
        } catch (const Error& e) {
            if (!failing_) io_.warn(e.what());
            failing_ = true;
            return e.what();
        }
        if (failing_) io_.warn("the spool can be written again");
        failing_ = false;
        return {};
    }

    void flush() {
        if (!spool_) return;
        const std::string fault = try_spool([&] { spool_->flush(); });
        notes_since_ns_.reset();
        if (!fault.empty()) notes_since_ns_ = now().steady_ns;
    }

    /// Whoever waits for an answer comes first: a turn, or an application, which may hang up
    /// after its packet and is answered before that is seen. Then what the queues wait for, and
    /// the spool.
    void set_alarm() {
        std::int64_t at_ns = scheduler_->next_event_ns();
        if (notes_since_ns_) at_ns = std::min(at_ns, *notes_since_ns_ + patience_ns);
        if (turn_ || is_asked_) at_ns = now().steady_ns;
        if (at_ns == std::numeric_limits<std::int64_t>::max()) return loop_.wake_at_steady({});
        loop_.wake_at_steady(at_ns + steady_origin_ns());
    }

    cli::Io& io_;
    cli::Loop& loop_;
    DeskOptions options_;
    RecordIo records_;
    std::unique_ptr<queue::Spool> spool_;
    std::unique_ptr<queue::Scheduler> scheduler_;
    std::uint32_t own_id_ = 0;
    std::uint64_t sequence_ = 1;
    std::vector<Newcomer> newcomers_;
    bool is_asked_ = false;  ///< some of them come from an application that waits
    std::optional<record::Slot> turn_;
    std::optional<std::int64_t> notes_since_ns_;  ///< since when the spool has something to be told
    bool stuck_ = false;
    bool failing_ = false;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_QUEUE_DESK_HPP
