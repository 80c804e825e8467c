#ifndef SEAUTILS_POSITION_PACKET_HPP
#define SEAUTILS_POSITION_PACKET_HPP

#include "seautils/entropy/coder.hpp"
#include "seautils/position/horizon.hpp"
#include "seautils/position/link_options.hpp"
#include "seautils/position/packet_header.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// What goes over the air: seautils-poscode(5) tells it with an example.
///
/// Positions of a session have numbers from 1. A packet says which positions its sender knows the
/// receiver to have (all up to the *reference*, in the way that it learnt them), and codes newer ones
/// from there: it can be decoded whatever became of the other packets. A packet is its header
/// (packet_header.hpp), the positions, zeros up to a full byte, and the check.
///
/// Positions. One alone that is no full fix: Codec::encode_alone() of the next one, or the horizon's
/// code. All others share one arithmetic coder: the newest of a peek as a full fix or by the horizon;
/// then one after another, each after whether it is a full fix (1 with chance 16/65536).
///
/// The check. Its seed is all that the receiver must have learnt up to the reference (session,
/// numbers, times, positions and how they follow each other) and what both agreed on. So it also finds
/// the reference: with 16 bits and more the header names but two bits of its number, and the receiver
/// looks which of the numbers that it acknowledged and that end so makes the check right.
namespace seautils::position {

/// One position as it follows from those before.
struct Step {
    std::uint32_t ahead = 1;  ///< intervals after the last known one; those between stay unknown
    bool is_full = false;     ///< coded as a full fix: at the start, after a gap, or because the
                              ///< codec cannot
    Fix fix;                  ///< without is_full its time follows from `ahead`
};

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

std::string encode_ack(const Ack& ack, std::uint64_t seed, unsigned check_bits);
/// @throws DataError  of another length
Ack peek_ack(std::string_view bytes, unsigned check_bits);

/// 15 bits that stand for a packet.
std::uint32_t digest(std::string_view packet);
/// A number for all of the options that both ends must agree on, and this version.
std::uint64_t agreed(const LinkOptions& options);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_PACKET_HPP
