#ifndef SEAUTILS_POSITION_PACKET_HEADER_HPP
#define SEAUTILS_POSITION_PACKET_HEADER_HPP

#include "seautils/entropy/bits.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace seautils::position {

enum class PacketKind : std::uint8_t {
    window,  ///< all positions after the reference up to the newest
    jump,    ///< the newest alone; what is sent next may build on it
    peek,    ///< the newest, and then as many after the reference as fit; the latter are built on
    part,    ///< positions after the reference, but not the newest: to a receiver, a window
};

/// How far ahead of what is known the newest position was of late: what is usual takes few bits. Follows
/// from what is known (TrackState::habit()).
struct Habit {
    bool jumps = false;      ///< one of the last 16 steps was over more than one interval
    unsigned rest_bits = 0;  ///< r, if so: about the logarithm of the mean

    unsigned most_zeros() const { return jumps ? 7 : 1; }
};

/// Where positions that share a coder end. They go on to the last byte of the packet; of those behind
/// which they might end there, `before` come before the last one.
struct PacketEnd {
    unsigned bits = 2;  ///< that this takes: 2, 5 or 20
    std::uint32_t before = 0;
};

/// What stands before the positions.
///
///     reference body                             the usual packet
///     0000000000000000 version:3 start:43 body   from nothing; start is the time of position 1 in ms
///
/// The reference: the 2 low bits of its number, if the check has 16 bits or more. Else gamma(c) and
/// the c low bits: c is what k, the newest's number less the reference's, has, so that they are
/// never ambiguous while packets keep their order: the receiver has nothing newer than what was sent,
/// and with what it acknowledged last, t, n <= t < n + 2^c; n is the only such number in (t - 2^c, t].
///
/// The body, with r and e by habit: e is 7 after jumps, else 1 (and r is 0).
///
///     q zeros, 1, rest:r      the newest alone, k = q * 2^r + rest + 1; q < e
///     e zeros 1 end           positions one after another
///     e zeros 01 gamma(k)     the newest alone, k intervals after the reference
///     e zeros 001 gamma(k) end       the newest, and then positions after the reference
///     e zeros 0001 gamma(k) 0        the newest alone, a full fix
///     e zeros 0001 gamma(k) 1 end    the newest, a full fix, and then positions
///
/// Elias' gamma code of k: one zero less than k has bits, and k. From nothing the newest is a full fix
/// without a word. End (PacketEnd): 00, 01, 10 for 0 to 2 before; 11 and 3 bits for 0 to 6; 11111 and 15
/// bits. They might end behind a position if what is put up to there, the coder ended, goes into the
/// last byte of what comes before the check.
struct PacketHeader {
    PacketKind kind = PacketKind::window;
    bool is_start = false;  ///< from nothing
    bool is_newest_full = false;
    std::int64_t start_ms = 0;  ///< is_start: of position 1
    Habit habit;
    std::uint32_t ahead = 1;  ///< k, 1 to most_ahead; of many one after another: 0 if just read
    bool is_reference_sized = false;  ///< c is said
    unsigned reference_bits = 2;
    std::uint32_t reference = 0;  ///< the low bits of its number
    PacketEnd end;                ///< of many
    std::uint32_t count =
        1;  ///< positions but for the newest of a peek; of many not read, but found

    /// Whether it is the newest position and nothing else.
    bool is_alone() const {
        return kind == PacketKind::jump || (kind == PacketKind::window && ahead == 1);
    }
};

inline constexpr unsigned ack_bits = 15;
inline constexpr std::uint32_t most_count = 32'767;
inline constexpr unsigned packet_version = 1;

void put(const PacketHeader& header, entropy::BitString& out);
std::size_t bits_of(const PacketHeader& header);

/// How the end is said of positions that share a coder.
/// @param front_bits  of the header without the end
/// @param ended       bits of the coder, if it ended behind each position that may be the last; these
PacketEnd end_of(std::size_t front_bits, std::span<const std::size_t> ended);

/// Which reference a packet says, if it is not one from nothing.
struct Reference {
    unsigned bits = 0;
    std::uint32_t low = 0;  ///< the low bits of its number
};
/// @return            nothing: from nothing
/// @throws DataError  the bits end
std::optional<Reference> get_reference(entropy::BitReader& in, unsigned check_bits);
/// What is behind it.
/// @param reference   as get_reference() said
/// @param habit       of that reference; of nothing: none
/// @throws DataError  the bits end, a number is out of its range, or another version, said so
PacketHeader get_packet_header(entropy::BitReader& in, const std::optional<Reference>& reference,
                               const Habit& habit);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_PACKET_HEADER_HPP
