#ifndef SEAUTILS_RECORD_RECORD_HPP
#define SEAUTILS_RECORD_RECORD_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// What flows between the tools of the link, as plain structs: schemas/seautils/record.proto says
/// what each field means, its unit, its range and who sets it. Names and order are the same there.
///
/// A field that is std::optional is absent where nothing is said; an empty text or list is absent
/// too; everything else is always written, and what is absent reads as its first value here.
namespace seautils::record {

/// Nanoseconds since 1970-01-01T00:00:00Z, without leap seconds; a google.protobuf.Timestamp.
struct UtcTime {
    std::int64_t ns = 0;
    friend auto operator<=>(const UtcTime&, const UtcTime&) = default;
};

enum class Kind : std::int32_t { data, ping, lbl, mini, blank };

struct Message {
    std::uint32_t id = 0, src = 0, dest = 0;
    std::optional<bool> ack_requested;
    std::optional<UtcTime> created;
    std::string data;  ///< bytes
    std::string type;
};

struct Slot {
    std::uint32_t index = 0, cycle = 0, src = 0;
    std::optional<std::uint32_t> dest;
    std::uint32_t rate = 0;
    Kind kind = Kind::data;
    UtcTime start, end;
    std::uint32_t frames = 0, frame_bytes = 0;
    std::optional<bool> ack_requested, polled, initiate;
};

struct Transmission {
    std::uint32_t number = 0, src = 0, dest = 0, rate = 0;
    bool ack_requested = false;
    Kind kind = Kind::data;
    std::vector<std::string> frame;  ///< bytes
    std::optional<std::uint32_t> mini;
    std::optional<UtcTime> deadline;
    std::optional<bool> polled;
    std::optional<std::uint32_t> slot_index;
};

struct ReceiveStatistics {
    std::optional<std::uint32_t> mode;
    std::optional<UtcTime> arrival;
    std::optional<std::uint32_t> clock_mode;
    std::optional<std::int32_t> mfd_peak, mfd_power_db, mfd_ratio, spl_db, shf_again, shf_ashift,
        shf_ainp_shift, shf_amfd_shift, shf_p2b_db;
    std::optional<std::uint32_t> rate, src, dest, psk_error, packet_type, frames, bad_frames;
    std::optional<std::int32_t> snr_rss_db;
    std::optional<double> snr_in_db, snr_out_db, snr_symbols_db, mse_db;
    std::optional<std::int32_t> dqf;
    std::optional<double> doppler_mps, noise_db, carrier_hz, bandwidth_hz;
};

struct TransmitStatistics {
    std::optional<UtcTime> sent;
    std::optional<std::uint32_t> clock_mode, mode, probe_length;
    std::optional<double> bandwidth_hz, carrier_hz;
    std::optional<std::uint32_t> rate, src, dest;
    std::optional<bool> ack_requested;
    std::optional<std::uint32_t> frames_expected, frames_sent, packet_type, bytes;
};

struct Reception {
    std::uint32_t src = 0, dest = 0, rate = 0;
    std::optional<bool> ack_requested;
    Kind kind = Kind::data;
    std::vector<std::string> frame;  ///< bytes
    std::vector<std::uint32_t> bad_frame;
    std::optional<std::uint32_t> mini;
    std::vector<ReceiveStatistics> statistics;
};

struct Ack {
    std::uint32_t src = 0, dest = 0, transmission = 0;
    std::vector<std::uint32_t> frame;
};

struct Result {
    enum class Outcome : std::int32_t { sent, late, busy, failed, refused };
    std::uint32_t transmission = 0;
    Outcome outcome = Outcome::sent;
    std::string why;
    std::vector<TransmitStatistics> statistics;
    std::optional<double> air_time_s;
};

struct Drop {
    enum class Reason : std::int32_t { expired, overflow, too_large, refused };
    std::uint32_t id = 0, src = 0, dest = 0;
    Reason reason = Reason::expired;
    std::string why;
    std::optional<UtcTime> created;
    std::optional<double> age_s;
    std::uint32_t sends = 0, bytes = 0;
    std::string data;  ///< bytes
};

struct Range {
    enum class Method : std::int32_t {
        two_way_ping,
        lbl_remus,
        lbl_narrowband,
        lbl_coded,
        one_way
    };
    struct Leg {
        std::uint32_t transponder = 0;
        double one_way_travel_time_s = 0;
        std::optional<double> range_m;
    };
    std::uint32_t src = 0, dest = 0;
    Method method = Method::two_way_ping;
    std::vector<Leg> leg;
    std::optional<double> sound_speed_mps;
    std::optional<std::uint32_t> transmission;
};

struct Raw {
    enum class Direction : std::int32_t { in, out };
    Direction direction = Direction::in;
    std::string line, fault, node;
};

struct ModemEvent {
    enum class Event : std::int32_t {
        ready,
        reboot,
        not_responding,
        device_lost,
        device_back,
        clock_set,
        config_refused,
        error,
        gap,
        heard
    };
    Event event = Event::ready;
    std::string text;
    std::optional<std::uint32_t> count, src, dest;
};

struct Contest {
    enum class Skip : std::int32_t { none, empty, blackout, size, dest, ack, expiring };
    struct Candidate {
        std::uint32_t id = 0, dest = 0;
        double priority = 0;
        std::uint32_t queued = 0;
        Skip skip = Skip::none;
        std::optional<std::uint32_t> bytes;
    };
    std::optional<std::uint32_t> slot_index;
    std::uint32_t transmission = 0, frame = 0, free_bytes = 0;
    std::vector<Candidate> candidate;
    std::optional<std::uint32_t> left_out, winner_id, winner_dest, sends;
    std::optional<double> age_s;
};

struct QueueStats {
    std::uint32_t id = 0, dest = 0, queued = 0, bytes = 0, under_way = 0, accepted = 0, sends = 0,
                  delivered = 0, returned = 0, expired = 0, overflowed = 0, refused = 0;
    std::optional<double> oldest_age_s, mean_age_s;
};

struct Acoustic {
    enum class Outcome : std::int32_t {
        received,
        collision,
        half_duplex,
        out_of_range,
        lost,
        bad_crc,
        deaf
    };
    std::uint32_t src = 0, receiver = 0, dest = 0, rate = 0;
    std::string packet;
    UtcTime sent;
    std::optional<UtcTime> heard;
    double air_time_s = 0, range_m = 0;
    std::optional<double> tl_db;
    Outcome outcome = Outcome::received;
    std::uint32_t bytes = 0;
    std::vector<std::uint32_t> bad_frame;
};

/// A time, and one thing that happened; std::monostate: a kind that this version does not know.
struct Record {
    UtcTime time;
    std::variant<std::monostate, Message, Slot, Transmission, Reception, Ack, Result, Drop, Range,
                 Raw, ModemEvent, Contest, QueueStats, Acoustic>
        kind;

    /// The kind, or nullptr when it is another.
    template <class T>
    const T* as() const {
        return std::get_if<T>(&kind);
    }
};

}  // namespace seautils::record

#endif  // SEAUTILS_RECORD_RECORD_HPP
