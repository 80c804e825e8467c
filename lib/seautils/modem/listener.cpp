#include "seautils/modem/listener.hpp"

#include "seautils/core/error.hpp"
#include "seautils/modem/fields.hpp"
#include "seautils/modem/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace seautils::modem {

namespace {

using record::Kind;
using record::ModemEvent;
using record::Range;
using record::Record;
using Records = std::vector<Record>;

constexpr std::chrono::seconds hold{2};  ///< from the last frame to the CACST that ends it
constexpr std::uint32_t most_frames = 8;
constexpr std::int64_t trusted_ns = 60'000'000'000;  ///< a modem's clock this far off is not set

/// Types of packets: 1 FSK, 2 FSK minipacket, 3 PSK, 4 PSK minipacket, 5 flexible.
bool is_minipacket(std::uint32_t type) { return type == 2 || type == 4; }

}  // namespace

void add_heard(Records& out, record::UtcTime time, std::uint32_t src, std::uint32_t dest) {
    ModemEvent e;
    e.event = ModemEvent::Event::heard;
    e.src = src;
    e.dest = dest;
    add(out, time, std::move(e));
}

bool Listener::take(const Sentence& s, std::uint64_t address, Moment now, Records& out) {
    switch (address) {
        case code("CARXD"):
            frame(read_received_frame(s), now, out);
            return true;
        case code("CACST"):
            statistics(s, now, out);
            return true;
        case code("CARXP"):
            finish(out);
            return true;
        case code("CAMSG"):
            lost_frame(read_complaint(s), now, out);
            return true;
        case code("CAMUA"):
            minipacket(read_mini(s), now, out);
            return true;
        case code("CARDP"):
        case code("CARFP"):
            flexible(read_flexible_packet(s), now, out);
            return true;
        case code("CAMPR"):
            ping_reply(read_ping(s), now, out);
            return true;
        case code("CACMR"):
            if (const auto ping = read_extended_ping(s)) ping_reply(*ping, now, out);
            return true;
        case code("CAMPA"): {
            const Ping ping = read_ping(s);
            finish(out);
            add_heard(out, now.utc, ping.src, ping.dest);
            return true;
        }
        case code("CACMA"):
            finish(out);
            if (const auto ping = read_extended_ping(s))
                add_heard(out, now.utc, ping->src, ping->dest);
            return true;
        case code("SNPDT"):
            lbl_ = Range::Method::lbl_remus;
            return true;
        case code("SNPNT"):
            lbl_ = Range::Method::lbl_narrowband;
            return true;
        case code("SNPGT"):
            lbl_ = Range::Method::lbl_coded;
            return true;
        case code("SNTTA"):
            travel_times(read_travel_times(s), now, out);
            return true;
        default:
            return false;
    }
}

void Listener::cycle(const Cycle& cycle, Moment now, Records& out) {
    reset(out);
    cycle_ = cycle;
    add_heard(out, now.utc, cycle.src, cycle.dest);
}

/// The first sign of a packet's content.
void Listener::begin(std::uint32_t src, std::uint32_t dest, Moment now, Records& out) {
    if (begun_ && (reception_.src != src || reception_.dest != dest)) finish(out);
    wake_ = now.after(hold);
    if (begun_) return;
    if (cycle_ && cycle_->src != src) {  // what was announced did not come
        cycle_.reset();
        reception_ = {};
    }
    begun_ = true;
    time_ = now.utc;
    reception_.src = src;
    reception_.dest = dest;
    if (!cycle_) return;
    reception_.rate = cycle_->rate;
    rate_known_ = true;
    reception_.ack_requested = cycle_->ack_requested;
}

void Listener::occupy(std::uint32_t index, std::string bytes) {
    seen_ |= 1U << index;
    if (reception_.frame.size() <= index) reception_.frame.resize(index + 1);
    reception_.frame[index] = std::move(bytes);
}

void Listener::frame(const ReceivedFrame& frame, Moment now, Records& out) {
    if (frame.frame >= most_frames)
        throw DataError(fmt::format("CARXD field 4: frame {} is above 8", frame.frame + 1));
    if (is_seen(frame.frame)) finish(out);  // the next packet: no CACST ended the last
    if (frame.bytes.empty()) {              // its sender left it unused
        if (cycle_ || begun_) seen_ |= 1U << frame.frame;
        return;
    }
    begin(frame.src, frame.dest, now, out);
    reception_.ack_requested = frame.ack_requested;
    occupy(frame.frame, frame.bytes);
}

std::optional<std::uint32_t> Listener::first_unseen() const {
    const auto index = static_cast<std::uint32_t>(std::countr_one(seen_));
    return index < most_frames ? std::optional(index) : std::nullopt;
}

void Listener::mark_bad(std::uint32_t index) {
    occupy(index, {});
    reception_.bad_frame.push_back(index);
}

/// A frame that was lost takes its place all the same, so that those behind it keep theirs.
void Listener::lost_frame(const Complaint& complaint, Moment now, Records& out) {
    const bool frame_lost = (complaint.bad_crc || complaint.timeout) && (cycle_ || begun_);
    if (!frame_lost) {
        add_event(out, now.utc, ModemEvent::Event::error, std::string(complaint.text));
        return;
    }
    const std::uint32_t src = begun_ ? reception_.src : cycle_->src;
    const std::uint32_t dest = begun_ ? reception_.dest : cycle_->dest;
    const std::uint32_t number = complaint.number.value_or(0);
    const bool named = number >= 1 && number <= most_frames && !is_seen(number - 1);
    const auto index = named ? std::optional(number - 1) : first_unseen();
    if (!index) return;
    begin(src, dest, now, out);
    mark_bad(*index);
}

/// Frames that neither came nor were complained of.
void Listener::mark_missing(std::uint32_t frames) {
    for (std::uint32_t k = 0; k < std::min(frames, most_frames); ++k) {
        if (!is_seen(k)) mark_bad(k);
    }
}

void Listener::statistics(const Sentence& s, Moment now, Records& out) {
    const bool timed = now.utc.ns != 0;  // a log may have no times
    const auto stats = receive_statistics(s, timed ? std::optional(now.utc) : std::nullopt);
    if (!begun_ && !cycle_) return;  // of an acknowledgement, or a ping
    const bool of_cycle =
        stats.packet_type ? is_minipacket(*stats.packet_type) : cycle_ && cycle_->rate == 0;
    const bool failed = stats.mode.value_or(0) != 0;
    if (!begun_ && of_cycle && !failed) {
        reception_.statistics.push_back(stats);
        return;
    }
    if (!begun_ && failed) begin(cycle_->src, cycle_->dest, now, out);
    if (begun_) {
        const std::uint32_t bad = stats.bad_frames.value_or(failed ? most_frames : 0);
        if (bad > reception_.bad_frame.size())
            mark_missing(stats.frames.value_or(cycle_ ? cycle_->frames : 0));
        if (stats.arrival && (!timed || std::abs(stats.arrival->ns - now.utc.ns) < trusted_ns))
            time_ = *stats.arrival;
        if (!rate_known_ && stats.rate) reception_.rate = *stats.rate;
        reception_.statistics.push_back(stats);
    }
    reset(out);
}

void Listener::minipacket(const Mini& mini, Moment now, Records& out) {
    reset(out);
    add_heard(out, now.utc, mini.src, mini.dest);
    begin(mini.src, mini.dest, now, out);
    reception_.kind = Kind::mini;
    reception_.mini = mini.value;
}

void Listener::flexible(const FlexiblePacket& packet, Moment now, Records& out) {
    reset(out);
    add_heard(out, now.utc, packet.src, packet.dest);
    begin(packet.src, packet.dest, now, out);
    reception_.rate = packet.rate;
    rate_known_ = true;
    reception_.ack_requested = false;
    if (!packet.good)
        mark_bad(0);
    else if (std::string payload = packet.payload(); !payload.empty())
        occupy(0, std::move(payload));
}

void Listener::leg(Range& range, std::uint32_t transponder, std::optional<double> time_s) const {
    if (!time_s) return;
    const double range_m = std::round(*time_s * sound_speed_mps_ * 1000) / 1000;
    range.leg.push_back({transponder, *time_s, range_m});
}

void Listener::ping_reply(const Ping& ping, Moment now, Records& out) {
    finish(out);
    if (!ping.one_way_travel_time_s) {
        add_event(out, now.utc, ModemEvent::Event::error,
                  fmt::format("{} answered a ping without a travel time", ping.src));
        return;
    }
    Range range;
    range.src = ping.dest;
    range.dest = ping.src;
    range.sound_speed_mps = sound_speed_mps_;
    leg(range, 0, ping.one_way_travel_time_s);
    add(out, now.utc, std::move(range));
}

void Listener::travel_times(const TravelTimes& times, Moment now, Records& out) {
    finish(out);
    Range range;
    range.method = lbl_;
    range.sound_speed_mps = sound_speed_mps_;
    for (std::uint32_t k = 0; k < times.one_way_s.size(); ++k) leg(range, k, times.one_way_s[k]);
    const auto time = time_of_day_ns(times.time_of_day);
    const auto utc = time ? nearest_day(*time, now.utc) : now.utc;
    add(out, std::abs(utc.ns - now.utc.ns) < trusted_ns ? utc : now.utc, std::move(range));
}

void Listener::finish(Records& out) {
    if (!begun_) return;
    add(out, time_, std::move(reception_));
    reception_ = {};
    cycle_.reset();
    begun_ = false;
    rate_known_ = false;
    seen_ = 0;
    wake_.reset();
}

void Listener::reset(Records& out) {
    finish(out);
    cycle_.reset();
    reception_ = {};
    seen_ = 0;
}

void Listener::tick(Moment now, Records& out) {
    if (wake_ && now.steady_ns >= *wake_) finish(out);
}

}  // namespace seautils::modem
