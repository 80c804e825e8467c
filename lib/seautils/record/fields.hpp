// Which member of a struct is which field of record.proto: number, name, member, in its order.
// Read by codec.cpp alone; a test holds it against the file.
#ifndef SEAUTILS_RECORD_FIELDS_HPP
#define SEAUTILS_RECORD_FIELDS_HPP

#include "seautils/record/record.hpp"

#include <array>
#include <string_view>

namespace seautils::record {

/// The protobuf name of a struct or an enumeration, and the names of an enumeration's values.
template <class T>
struct Names;

#define SEAUTILS_RECORD_MESSAGE(TYPE, NAME)                             \
    template <>                                                         \
    struct Names<TYPE> {                                                \
        static constexpr std::string_view full_name = "seautils." NAME; \
    }
SEAUTILS_RECORD_MESSAGE(Message, "Record.Message");
SEAUTILS_RECORD_MESSAGE(Slot, "Record.Slot");
SEAUTILS_RECORD_MESSAGE(Transmission, "Record.Transmission");
SEAUTILS_RECORD_MESSAGE(Reception, "Record.Reception");
SEAUTILS_RECORD_MESSAGE(Ack, "Record.Ack");
SEAUTILS_RECORD_MESSAGE(Result, "Record.Result");
SEAUTILS_RECORD_MESSAGE(Drop, "Record.Drop");
SEAUTILS_RECORD_MESSAGE(Range, "Record.Range");
SEAUTILS_RECORD_MESSAGE(Range::Leg, "Record.Range.Leg");
SEAUTILS_RECORD_MESSAGE(Raw, "Record.Raw");
SEAUTILS_RECORD_MESSAGE(ModemEvent, "Record.ModemEvent");
SEAUTILS_RECORD_MESSAGE(Contest, "Record.Contest");
SEAUTILS_RECORD_MESSAGE(Contest::Candidate, "Record.Contest.Candidate");
SEAUTILS_RECORD_MESSAGE(QueueStats, "Record.QueueStats");
SEAUTILS_RECORD_MESSAGE(Acoustic, "Record.Acoustic");
SEAUTILS_RECORD_MESSAGE(ReceiveStatistics, "Record.ReceiveStatistics");
SEAUTILS_RECORD_MESSAGE(TransmitStatistics, "Record.TransmitStatistics");
#undef SEAUTILS_RECORD_MESSAGE

#define SEAUTILS_RECORD_ENUM(TYPE, NAME, ...)                                                \
    template <>                                                                              \
    struct Names<TYPE> {                                                                     \
        static constexpr std::string_view full_name = "seautils." NAME;                      \
        static constexpr std::array values = std::to_array<std::string_view>({__VA_ARGS__}); \
    }
SEAUTILS_RECORD_ENUM(Kind, "Record.Kind", "DATA", "PING", "LBL", "MINI", "BLANK");
SEAUTILS_RECORD_ENUM(Result::Outcome, "Record.Result.Outcome", "SENT", "LATE", "BUSY", "FAILED",
                     "REFUSED");
SEAUTILS_RECORD_ENUM(Drop::Reason, "Record.Drop.Reason", "EXPIRED", "OVERFLOW", "TOO_LARGE",
                     "REFUSED");
SEAUTILS_RECORD_ENUM(Range::Method, "Record.Range.Method", "TWO_WAY_PING", "LBL_REMUS",
                     "LBL_NARROWBAND", "LBL_CODED", "ONE_WAY");
SEAUTILS_RECORD_ENUM(Raw::Direction, "Record.Raw.Direction", "IN", "OUT");
SEAUTILS_RECORD_ENUM(ModemEvent::Event, "Record.ModemEvent.Event", "READY", "REBOOT",
                     "NOT_RESPONDING", "DEVICE_LOST", "DEVICE_BACK", "CLOCK_SET", "CONFIG_REFUSED",
                     "ERROR", "GAP", "HEARD");
SEAUTILS_RECORD_ENUM(Contest::Skip, "Record.Contest.Skip", "NONE", "EMPTY", "BLACKOUT", "SIZE",
                     "DEST", "ACK", "EXPIRING");
SEAUTILS_RECORD_ENUM(Acoustic::Outcome, "Record.Acoustic.Outcome", "RECEIVED", "COLLISION",
                     "HALF_DUPLEX", "OUT_OF_RANGE", "LOST", "BAD_CRC", "DEAF");
#undef SEAUTILS_RECORD_ENUM

/// Marks a std::string, or a list of them, as bytes.
struct BytesTag {};
constexpr BytesTag bytes;

/// Which struct is meant.
template <class T>
struct Of {};

template <class F>
void fields(Of<Message>, F&& f) {
    f(1, "id", &Message::id);
    f(2, "src", &Message::src);
    f(3, "dest", &Message::dest);
    f(4, "ack_requested", &Message::ack_requested);
    f(5, "created", &Message::created);
    f(6, "data", &Message::data, bytes);
    f(7, "type", &Message::type);
}

template <class F>
void fields(Of<Slot>, F&& f) {
    f(1, "index", &Slot::index);
    f(2, "cycle", &Slot::cycle);
    f(3, "src", &Slot::src);
    f(4, "dest", &Slot::dest);
    f(5, "rate", &Slot::rate);
    f(6, "kind", &Slot::kind);
    f(7, "start", &Slot::start);
    f(8, "end", &Slot::end);
    f(9, "frames", &Slot::frames);
    f(10, "frame_bytes", &Slot::frame_bytes);
    f(11, "ack_requested", &Slot::ack_requested);
    f(12, "polled", &Slot::polled);
    f(13, "initiate", &Slot::initiate);
}

template <class F>
void fields(Of<Transmission>, F&& f) {
    f(1, "number", &Transmission::number);
    f(2, "src", &Transmission::src);
    f(3, "dest", &Transmission::dest);
    f(4, "rate", &Transmission::rate);
    f(5, "ack_requested", &Transmission::ack_requested);
    f(6, "kind", &Transmission::kind);
    f(7, "frame", &Transmission::frame, bytes);
    f(8, "mini", &Transmission::mini);
    f(9, "deadline", &Transmission::deadline);
    f(10, "polled", &Transmission::polled);
    f(11, "slot_index", &Transmission::slot_index);
}

template <class F>
void fields(Of<Reception>, F&& f) {
    f(1, "src", &Reception::src);
    f(2, "dest", &Reception::dest);
    f(3, "rate", &Reception::rate);
    f(4, "ack_requested", &Reception::ack_requested);
    f(5, "kind", &Reception::kind);
    f(6, "frame", &Reception::frame, bytes);
    f(7, "bad_frame", &Reception::bad_frame);
    f(8, "mini", &Reception::mini);
    f(9, "statistics", &Reception::statistics);
}

template <class F>
void fields(Of<Ack>, F&& f) {
    f(1, "src", &Ack::src);
    f(2, "dest", &Ack::dest);
    f(3, "transmission", &Ack::transmission);
    f(4, "frame", &Ack::frame);
}

template <class F>
void fields(Of<Result>, F&& f) {
    f(1, "transmission", &Result::transmission);
    f(2, "outcome", &Result::outcome);
    f(3, "why", &Result::why);
    f(4, "statistics", &Result::statistics);
    f(5, "air_time_s", &Result::air_time_s);
}

template <class F>
void fields(Of<Drop>, F&& f) {
    f(1, "id", &Drop::id);
    f(2, "src", &Drop::src);
    f(3, "dest", &Drop::dest);
    f(4, "reason", &Drop::reason);
    f(5, "why", &Drop::why);
    f(6, "created", &Drop::created);
    f(7, "age_s", &Drop::age_s);
    f(8, "sends", &Drop::sends);
    f(9, "bytes", &Drop::bytes);
    f(10, "data", &Drop::data, bytes);
}

template <class F>
void fields(Of<Range::Leg>, F&& f) {
    f(1, "transponder", &Range::Leg::transponder);
    f(2, "one_way_travel_time_s", &Range::Leg::one_way_travel_time_s);
    f(3, "range_m", &Range::Leg::range_m);
}

template <class F>
void fields(Of<Range>, F&& f) {
    f(1, "src", &Range::src);
    f(2, "dest", &Range::dest);
    f(3, "method", &Range::method);
    f(4, "leg", &Range::leg);
    f(5, "sound_speed_mps", &Range::sound_speed_mps);
    f(6, "transmission", &Range::transmission);
}

template <class F>
void fields(Of<Raw>, F&& f) {
    f(1, "direction", &Raw::direction);
    f(2, "line", &Raw::line);
    f(3, "fault", &Raw::fault);
    f(4, "node", &Raw::node);
}

template <class F>
void fields(Of<ModemEvent>, F&& f) {
    f(1, "event", &ModemEvent::event);
    f(2, "text", &ModemEvent::text);
    f(3, "count", &ModemEvent::count);
    f(4, "src", &ModemEvent::src);
    f(5, "dest", &ModemEvent::dest);
}

template <class F>
void fields(Of<Contest::Candidate>, F&& f) {
    f(1, "id", &Contest::Candidate::id);
    f(2, "dest", &Contest::Candidate::dest);
    f(3, "priority", &Contest::Candidate::priority);
    f(4, "queued", &Contest::Candidate::queued);
    f(5, "skip", &Contest::Candidate::skip);
    f(6, "bytes", &Contest::Candidate::bytes);
}

template <class F>
void fields(Of<Contest>, F&& f) {
    f(1, "slot_index", &Contest::slot_index);
    f(2, "transmission", &Contest::transmission);
    f(3, "frame", &Contest::frame);
    f(4, "free_bytes", &Contest::free_bytes);
    f(5, "candidate", &Contest::candidate);
    f(6, "left_out", &Contest::left_out);
    f(7, "winner_id", &Contest::winner_id);
    f(8, "winner_dest", &Contest::winner_dest);
    f(9, "sends", &Contest::sends);
    f(10, "age_s", &Contest::age_s);
}

template <class F>
void fields(Of<QueueStats>, F&& f) {
    f(1, "id", &QueueStats::id);
    f(2, "dest", &QueueStats::dest);
    f(3, "queued", &QueueStats::queued);
    f(4, "bytes", &QueueStats::bytes);
    f(5, "under_way", &QueueStats::under_way);
    f(6, "accepted", &QueueStats::accepted);
    f(7, "sends", &QueueStats::sends);
    f(8, "delivered", &QueueStats::delivered);
    f(9, "returned", &QueueStats::returned);
    f(10, "expired", &QueueStats::expired);
    f(11, "overflowed", &QueueStats::overflowed);
    f(12, "refused", &QueueStats::refused);
    f(13, "oldest_age_s", &QueueStats::oldest_age_s);
    f(14, "mean_age_s", &QueueStats::mean_age_s);
}

template <class F>
void fields(Of<Acoustic>, F&& f) {
    f(1, "src", &Acoustic::src);
    f(2, "receiver", &Acoustic::receiver);
    f(3, "dest", &Acoustic::dest);
    f(4, "rate", &Acoustic::rate);
    f(5, "packet", &Acoustic::packet);
    f(6, "sent", &Acoustic::sent);
    f(7, "heard", &Acoustic::heard);
    f(8, "air_time_s", &Acoustic::air_time_s);
    f(9, "range_m", &Acoustic::range_m);
    f(10, "tl_db", &Acoustic::tl_db);
    f(11, "outcome", &Acoustic::outcome);
    f(12, "bytes", &Acoustic::bytes);
    f(13, "bad_frame", &Acoustic::bad_frame);
}

template <class F>
void fields(Of<ReceiveStatistics>, F&& f) {
    using S = ReceiveStatistics;
    f(1, "mode", &S::mode);
    f(2, "arrival", &S::arrival);
    f(3, "clock_mode", &S::clock_mode);
    f(4, "mfd_peak", &S::mfd_peak);
    f(5, "mfd_power_db", &S::mfd_power_db);
    f(6, "mfd_ratio", &S::mfd_ratio);
    f(7, "spl_db", &S::spl_db);
    f(8, "shf_again", &S::shf_again);
    f(9, "shf_ashift", &S::shf_ashift);
    f(10, "shf_ainp_shift", &S::shf_ainp_shift);
    f(11, "shf_amfd_shift", &S::shf_amfd_shift);
    f(12, "shf_p2b_db", &S::shf_p2b_db);
    f(13, "rate", &S::rate);
    f(14, "src", &S::src);
    f(15, "dest", &S::dest);
    f(16, "psk_error", &S::psk_error);
    f(17, "packet_type", &S::packet_type);
    f(18, "frames", &S::frames);
    f(19, "bad_frames", &S::bad_frames);
    f(20, "snr_rss_db", &S::snr_rss_db);
    f(21, "snr_in_db", &S::snr_in_db);
    f(22, "snr_out_db", &S::snr_out_db);
    f(23, "snr_symbols_db", &S::snr_symbols_db);
    f(24, "mse_db", &S::mse_db);
    f(25, "dqf", &S::dqf);
    f(26, "doppler_mps", &S::doppler_mps);
    f(27, "noise_db", &S::noise_db);
    f(28, "carrier_hz", &S::carrier_hz);
    f(29, "bandwidth_hz", &S::bandwidth_hz);
}

template <class F>
void fields(Of<TransmitStatistics>, F&& f) {
    using S = TransmitStatistics;
    f(1, "sent", &S::sent);
    f(2, "clock_mode", &S::clock_mode);
    f(3, "mode", &S::mode);
    f(4, "probe_length", &S::probe_length);
    f(5, "bandwidth_hz", &S::bandwidth_hz);
    f(6, "carrier_hz", &S::carrier_hz);
    f(7, "rate", &S::rate);
    f(8, "src", &S::src);
    f(9, "dest", &S::dest);
    f(10, "ack_requested", &S::ack_requested);
    f(11, "frames_expected", &S::frames_expected);
    f(12, "frames_sent", &S::frames_sent);
    f(13, "packet_type", &S::packet_type);
    f(14, "bytes", &S::bytes);
}

/// The kinds of a record: `f(number, name, Of<Kind>())`, in the order of Record::kind.
template <class F>
void kinds(F&& f) {
    f(2, "message", Of<Message>());
    f(3, "slot", Of<Slot>());
    f(4, "transmission", Of<Transmission>());
    f(5, "reception", Of<Reception>());
    f(6, "ack", Of<Ack>());
    f(7, "result", Of<Result>());
    f(8, "drop", Of<Drop>());
    f(9, "range", Of<Range>());
    f(10, "raw", Of<Raw>());
    f(11, "modem", Of<ModemEvent>());
    f(12, "contest", Of<Contest>());
    f(13, "queue", Of<QueueStats>());
    f(14, "acoustic", Of<Acoustic>());
}

}  // namespace seautils::record

#endif  // SEAUTILS_RECORD_FIELDS_HPP
