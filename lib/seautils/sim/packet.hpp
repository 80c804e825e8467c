#ifndef SEAUTILS_SIM_PACKET_HPP
#define SEAUTILS_SIM_PACKET_HPP

#include "seautils/sim/track.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::sim {

/// What a transmission through the water is.
enum class PacketKind {
    cycle,      ///< FSK minipacket that announces a rate 0 packet, or asks another for data
    data,       ///< frames; from rate 1 on with the announcement in it
    ack,        ///< frames that arrived
    ping,       ///< asks for a reply
    reply,      ///< the reply to a ping
    mini,       ///< 13 bits of the user's
    fdp,        ///< flexible data packet: a minipacket and frames
    lbl,        ///< an interrogation of transponders
    lbl_reply,  ///< what a transponder answers
};

/// `cycle`, `data`, … as Record.Acoustic.packet has it.
std::string_view name(PacketKind kind);

/// A transmission. Its header is what is said in it; who says it is the emitter's matter.
struct Packet {
    PacketKind kind = PacketKind::mini;
    unsigned src = 0, dest = 0;  ///< of the header: a cycle's src is who is to send data
    unsigned rate = 0;
    bool ack = false;                   ///< data: an acknowledgement is asked for
    unsigned frame_count = 0;           ///< data, cycle: frames announced
    std::vector<std::string> frames{};  ///< data: one for each; fdp: the minipacket, then frames
    unsigned value = 0;                 ///< mini: 13 bits; ack: a bit for each frame, 0 the lowest
    Time air = 0;                       ///< from the first sound to the last

    /// Bytes of all frames.
    std::size_t bytes() const;
    /// Whether it is keyed by frequency (FSK), not by phase (PSK).
    bool is_fsk() const { return rate == 0; }
    /// As CACST and CAXST have it: 1 FSK, 2 FSK mini, 3 PSK, 4 PSK mini, 5 FDP.
    unsigned type() const;
};

/// A packet as it came to a receiver.
struct Heard {
    const Packet* packet = nullptr;
    Time start = 0;  ///< its first sound arrived
    double range_m = 0;
    double closing_mps = 0;  ///< positive where source and receiver come closer
    double level_db = 0;     ///< received, re 1 µPa
    double snr_db = 0;
    std::vector<bool> bad_frame{};  ///< one for each frame of the packet; empty: all are good

    bool is_bad(std::size_t frame) const { return frame < bad_frame.size() && bad_frame[frame]; }
    unsigned bad_count() const;
};

/// Which transponders are interrogated: those of a letter, or of frequencies.
struct Interrogation {
    std::array<bool, 4> letters{};       ///< REMUS: A to D
    unsigned query_hz = 0;               ///< narrowband: 0: REMUS
    std::array<unsigned, 4> reply_hz{};  ///< narrowband: 0: not listened to
    Time length = 0;                     ///< of the interrogation
};

/// From the interrogation's first sound to each answer's first; none: no answer.
using Answers = std::array<std::optional<Time>, 4>;

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_PACKET_HPP
