// Driver: what it does with a transmission, from the request to its result and acknowledgements.
#include "seautils/modem/driver.hpp"

#include "seautils/core/error.hpp"
#include "seautils/modem/statistics.hpp"

#include <fmt/format.h>

namespace seautils::modem {

namespace {

using record::Kind;
using record::Result;
using record::Slot;
using Form = Outgoing::Form;
using Outcome = record::Result::Outcome;

constexpr std::chrono::milliseconds statistics_wait{500};  ///< from CATXF to its CAXST
constexpr std::chrono::seconds lbl_margin{5};              ///< beyond the modem's own waiting

/// Packet types of minipackets: of FSK and PSK.
bool is_minipacket(const record::TransmitStatistics& s) {
    return s.packet_type == 2U || s.packet_type == 4U;
}

}  // namespace

void Driver::refuse(const record::Transmission& t, Outcome outcome, std::string why, Moment now) {
    Result r;
    r.transmission = t.number;
    r.outcome = outcome;
    r.why = std::move(why);
    add(out_.records, now.utc, std::move(r));
}

void Driver::transmit(const record::Transmission& t, Moment now) {
    tick(now);  // what is over by now is not in the way
    if (!ready_) return refuse(t, Outcome::failed, "the modem is not ready", now);
    if (active_) return refuse(t, Outcome::busy, "another transmission is under way", now);
    try {
        if (t.polled.value_or(false)) return answer_poll(t, now);
        if (poll_) return refuse(t, Outcome::busy, "the modem was polled", now);
        start(outgoing_of(t, options_), now);
    } catch (const DataError& e) {
        refuse(t, Outcome::refused, e.what(), now);
    }
}

void Driver::start(Outgoing outgoing, Moment now) {
    if (!in_time(outgoing, now)) {
        return refuse(outgoing.request, Outcome::late, "it would end behind its deadline", now);
    }
    dialog_.push(command_of(outgoing, options_, pad_even_));
    active_ = std::move(outgoing);
    awaited_.reset();
    asked_.reset();
    step(now);
}

bool Driver::in_time(const Outgoing& o, Moment now) const {
    if (!o.request.deadline) return true;
    return now.utc.ns + (o.sound + o.writing).count() <= o.request.deadline->ns;
}

/// The modem took it: from here on it is given up only when it takes too long.
void Driver::accepted(Moment now) {
    if (!active_) return;
    Outgoing& o = *active_;
    o.accepted = true;
    o.gives_up = now.after(o.sound + o.writing + options_.busy_margin);
    const auto& t = o.request;
    if (o.form == Form::ping) asked_ = Asked{t.number, t.dest, false};
    if (o.form == Form::lbl) {
        asked_ = Asked{t.number, t.dest, true};
        o.gives_up = now.after(o.sound + lbl_margin);
    }
    if (o.ack && o.form != Form::poll) awaited_ = Awaited{t.number, t.dest, (1U << o.frames) - 1};
}

/// A cycle that we did not begin: somebody speaks, or somebody wants us to.
void Driver::on_cycle(const Cycle& cycle, Moment now) {
    if (cycle.src != options_.id) {
        awaited_.reset();
        return listener_.cycle(cycle, now, out_.records);
    }
    if (active_) return;  // our own, heard once more
    const Rate& rate = options_.rates.data(cycle.rate);
    const unsigned frames = std::min(cycle.frames == 0 ? 1 : cycle.frames, rate.frames);
    poll_ = Poll{cycle, now.after(options_.poll_wait), {}};
    const auto sound = rate.packet_time(frames) + (cycle.ack_requested ? rate.ack : Rate::Time{});
    Slot slot;
    slot.src = cycle.src;
    slot.dest = cycle.dest;
    slot.rate = cycle.rate;
    slot.start = now.utc;
    slot.end = {now.utc.ns + std::chrono::nanoseconds(options_.poll_wait + sound).count()};
    slot.frames = frames;
    slot.frame_bytes = rate.frame_bytes;
    if (!cycle.ack_requested) slot.ack_requested = false;
    slot.polled = true;
    add(out_.records, now.utc, std::move(slot));
}

void Driver::answer_poll(const record::Transmission& t, Moment now) {
    if (!poll_) return refuse(t, Outcome::late, "no poll is waiting for data", now);
    Outgoing o = outgoing_of(t, options_);
    const Cycle& cycle = poll_->cycle;
    if (o.form != Form::cycle || t.dest != cycle.dest || t.rate != cycle.rate)
        throw DataError(
            fmt::format("the poll is for data to {} at rate {}", cycle.dest, cycle.rate));
    if (o.frames > cycle.frames)
        throw DataError(fmt::format("{} frames where the poll is for {}", o.frames, cycle.frames));
    if (!in_time(o, now)) return refuse(t, Outcome::late, "it would end behind its deadline", now);
    o.form = Form::answer;
    o.ack = cycle.ack_requested && cycle.dest != 0;
    o.has_cycle = false;  // the cycle has been announced
    active_ = std::move(o);
    accepted(now);
    const auto request = poll_->request;
    poll_.reset();
    if (request) provide(*request, now);
}

void Driver::on_data_request(const DataRequest& request, Moment now) {
    if (request.src != options_.id) return;
    if (poll_) {
        poll_->request = request;
        return;
    }
    if (active_ && !active_->accepted && active_->form == Form::cycle) {  // the echo was lost
        if (dialog_.outstanding(Command::Kind::transmission)) dialog_.pop();
        accepted(now);
    }
    provide(request, now);
}

/// Hands a frame over; an empty one where there is none, so that the modem does not wait.
void Driver::provide(const DataRequest& request, Moment now) {
    zero_based_ = zero_based_ || request.number == 0;
    const std::uint32_t index = request.number - (zero_based_ ? 0 : 1);
    const bool ours = active_ && active_->has_frames();
    const bool there = ours && index < active_->request.frame.size();
    const std::string_view frame = there ? active_->request.frame[index] : std::string_view();
    const bool fits = frame.size() <= request.bytes;
    const std::string body = compose_transmit_data(options_.id, request.dest, request.ack_requested,
                                                   fits ? frame : std::string_view());
    write(body, now);
    if (!ours) return;
    active_->given = std::max(active_->given, index + 1);
    active_->last_data = body;
    active_->data_tries = 1;
    if (!fits) {
        end(Outcome::failed,
            fmt::format("the modem asks for {} bytes of frame {}, which has {}", request.bytes,
                        index, frame.size()),
            now);
    }
}

/// CATXP and CATXF.
void Driver::on_sound(bool begins, Moment now) {
    listener_.finish(out_.records);
    if (!active_ || !active_->accepted || active_->ended) return;
    Outgoing& o = *active_;
    if (begins) {
        if (!o.first_sound) o.first_sound = now.steady_ns;
        return;
    }
    o.last_sound = now.steady_ns;
    if (o.announcing()) return;
    o.ended = true;
    if (o.told) return end(Outcome::sent, {}, now);
    o.gives_up = now.after(statistics_wait);
}

void Driver::on_transmit_statistics(const Sentence& s, Moment now) {
    const auto stats = transmit_statistics(s);
    if (!active_ || !active_->accepted) return;  // of an acknowledgement that the modem sent
    Outgoing& o = *active_;
    o.statistics.push_back(stats);
    if (const std::uint32_t mode = stats.mode.value_or(0); mode != 0)
        return end(Outcome::failed, std::string(transmit_fault(mode)), now);
    const bool of_cycle = (o.has_frames() && is_minipacket(stats)) || o.announcing();
    if (of_cycle) return;
    o.told = true;
    // CATXF follows packets of frames; others not always.
    if (o.ended || !o.has_frames()) end(Outcome::sent, {}, now);
}

/// A modem may report acknowledgements of others as its own: only what is awaited counts.
void Driver::on_acknowledgement(const Acknowledgement& a, Moment now) {
    const unsigned bit = a.frame < 8 ? 1U << a.frame : 0;
    if (awaited_ && now.steady_ns > awaited_->until) awaited_.reset();
    const bool ours = a.dest == options_.id && awaited_ && a.src == awaited_->dest;
    if (!ours || (awaited_->frames & bit) == 0)
        return add_heard(out_.records, now.utc, a.src, a.dest);
    awaited_->frames &= ~bit;
    record::Ack ack;
    ack.src = a.src;
    ack.dest = a.dest;
    ack.transmission = awaited_->number;
    ack.frame = {a.frame};
    add(out_.records, now.utc, std::move(ack));
}

/// Ranges that a transmission of ours asked for get its number, and us as who asked. They end it: the
/// sound has left.
void Driver::on_ranges(std::size_t first, Moment now) {
    bool any = false;
    for (std::size_t k = first; k < out_.records.size(); ++k) {
        auto* range = std::get_if<record::Range>(&out_.records[k].kind);
        if (range == nullptr) continue;
        any = true;
        const bool transponders = range->method != record::Range::Method::two_way_ping;
        if (transponders) range->src = options_.id;
        if (asked_ && asked_->transponders == transponders &&
            (transponders || range->dest == asked_->dest)) {
            range->transmission = asked_->number;
        }
        asked_.reset();
    }
    const bool asked =
        active_ && active_->accepted && (active_->form == Form::ping || active_->form == Form::lbl);
    if (any && asked) end(Outcome::sent, {}, now);
}

void Driver::poll_unanswered(Moment now) {
    const auto request = poll_->request;
    poll_.reset();
    if (request) provide(*request, now);
}

/// Gives up what takes too long.
void Driver::watch(Moment now) {
    if (poll_ && now.steady_ns >= poll_->until) poll_unanswered(now);
    if (!active_ || !active_->accepted || now.steady_ns < active_->gives_up) return;
    if (active_->ended) return end(Outcome::sent, {}, now);
    end(Outcome::failed,
        active_->form == Form::lbl ? "the modem told no travel times (SNTTA)"
                                   : "the modem did not say that it ended (CATXF)",
        now);
}

void Driver::end(Outcome outcome, std::string why, Moment now) {
    if (!active_) return;
    const Outgoing o = std::move(*active_);
    active_.reset();
    if (dialog_.outstanding(Command::Kind::transmission)) dialog_.pop();
    if (awaited_) awaited_->until = now.after(options_.ack_wait);
    Result r;
    r.transmission = o.request.number;
    r.outcome = outcome;
    r.why = std::move(why);
    r.statistics = o.statistics;
    if (o.first_sound && o.last_sound)
        r.air_time_s = static_cast<double>(*o.last_sound - *o.first_sound) / 1e9;
    add(out_.records, now.utc, std::move(r));
}

}  // namespace seautils::modem
