#ifndef SEAUTILS_POSITION_PACKET_HPP
#define SEAUTILS_POSITION_PACKET_HPP

#include "seautils/entropy/coder.hpp"
#include "seautils/position/horizon.hpp"
#include "seautils/position/link_options.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// What goes over the air: seautils-poscode(5) tells it with an example.
///
/// Positions of a session have numbers from 1. A packet says which positions its sender knows the
/// receiver to have (all up to the *reference*, in the way that it learnt them), and codes newer ones
/// from there: it can be decoded whatever became of the other packets.
///
/// Which reference. A packet with the newest position says how many intervals that is ahead of the
/// reference, k, in Elias' gamma code, and then the c low bits of the reference's number, where 2^c
/// is the power of two above k. They are never ambiguous: the receiver has nothing newer than what
/// was sent, so that what it acknowledged last, t, has n <= t <= n + k < n + 2^c, and n is the only
/// number of its kind within (t - 2^c, t]. Packets that were overtaken by newer ones may mean
/// another number; they, and those of another session, fail the check.
///
/// The check. Its seed is all that the receiver must have learnt up to the reference (session,
/// numbers, times, positions and how they follow each other) and what both agreed on.
namespace seautils::position {

/// One position as it follows from those before.
struct Step {
    std::uint32_t ahead = 1;  ///< intervals after the last known one; those between stay unknown
    bool is_full = false;     ///< coded as a full fix: at the start, after a gap, or because the
                              ///< codec cannot
    Fix fix;                  ///< without is_full its time follows from `ahead`
};

enum class PacketKind : std::uint8_t {
    window,  ///< all positions after the reference up to the newest
    jump,    ///< the newest alone; what is sent next may build on it
    peek,    ///< the newest, and then as many after the reference as fit; the latter are built on
    part,    ///< positions after the reference, but not the newest
};

/// What stands before the positions.
///
///     gamma(k)  reference: c bits  form       k = 1 to 63: the usual packet
///     000000 1  gamma(k)  reference  form     k from 64 on
///     000000 01  gamma(k)  reference  form    the newest position is a full fix
///     000000 001  gamma(c)  reference: c bits  gamma(m)                a part, of m positions
///     000000 000  version:3  start:43  gamma(k)  form                  from nothing; start is the
///                                             time of position 1 in ms
///
/// Elias' gamma code of k: one zero less than k has bits, and k. Form, if k > 1: 0 window, 10 jump,
/// 11 gamma(m + 1) peek with m positions behind the newest. From nothing the newest is a full fix in
/// a jump or a peek, or if k = 1.
///
/// Then positions. The next one alone: Codec::encode_alone(); else all share one arithmetic coder:
/// the newest of a jump or a peek as a full fix or by the horizon; each of a window, a part or behind
/// a newest one says first whether it is a full fix (1 with chance 16/65536).
struct PacketHeader {
    PacketKind kind = PacketKind::window;
    bool is_start = false;  ///< from nothing
    bool is_newest_full = false;
    std::int64_t start_ms = 0;    ///< is_start: of position 1
    std::uint32_t ahead = 1;      ///< k, 1 to most_ahead; of a part: 0
    unsigned reference_bits = 0;  ///< c
    std::uint32_t reference = 0;  ///< the low bits of its number
    std::uint32_t count = 1;  ///< positions: window k, jump 1, peek m, part m; at most most_count
};

inline constexpr std::uint32_t most_count = 32'767;
inline constexpr unsigned packet_version = 0;

void put(const PacketHeader& header, entropy::BitString& out);
/// @throws DataError  the bits end, a number is out of its range, or another version, said so
PacketHeader get_packet_header(entropy::BitReader& in);

/// A full fix in the arithmetic coder: the difference of its time from what was expected (length
/// of the zigzag number in 6 bits, and its bits), and x, y, z from the corner of the area in the
/// fewest bits that hold its size. A coder takes 50-odd bits for an area of 65 km by 16 km depth.
void put_full(const Fix& fix, std::int64_t expected_ms, const LinkOptions& options,
              entropy::Encoder& out);
/// @throws DataError  as above, or outside of the area
Fix get_full(std::int64_t expected_ms, const LinkOptions& options, entropy::Decoder& in);

/// Bytes in which any position fits as a full fix, whatever the time and the header: packets of fewer
/// may never carry some position. 27 with the default options.
std::size_t least_bytes(const LinkOptions& options);

/// Fills the bits with zeros so that the check ends with the last byte, and puts it.
/// @param seed  what the receiver must have learnt (TrackState::mark()), or for a start agreed()
std::string seal(const entropy::BitString& bits, std::uint64_t seed, unsigned check_bits);
/// The bits before the check; nothing: it is another one.
std::optional<entropy::BitReader> unseal(std::string_view bytes, std::uint64_t seed,
                                         unsigned check_bits);
/// Those bits, whatever the check. @throws DataError  shorter than the check
entropy::BitReader unsealed(std::string_view bytes, unsigned check_bits);

/// What a receiver says back, sealed as a packet is: 2 bytes and the check.
///
///     0  number:15   all is known up to this position, in the way that the seed says
///     1  digest:15   a packet could not be decoded, and none will be: begin anew
struct Ack {
    bool is_lost = false;
    std::uint32_t number = 0;  ///< low 15 bits of the position's number, or digest of the packet
};

inline constexpr unsigned ack_bits = 15;
std::string encode_ack(const Ack& ack, std::uint64_t seed, unsigned check_bits);
/// @throws DataError  of another length
Ack peek_ack(std::string_view bytes, unsigned check_bits);

/// 15 bits that stand for a packet.
std::uint32_t digest(std::string_view packet);
/// A number for all of the options that both ends must agree on, and this version.
std::uint64_t agreed(const LinkOptions& options);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_PACKET_HPP
