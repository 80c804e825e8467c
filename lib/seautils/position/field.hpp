#ifndef SEAUTILS_POSITION_FIELD_HPP
#define SEAUTILS_POSITION_FIELD_HPP

#include "seautils/entropy/bits.hpp"
#include "seautils/position/receiver.hpp"
#include "seautils/position/sender.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

/// A packet (packet.hpp) of one position as a field of a larger message, which begins and ends at any
/// bit: without the zeros that fill its bytes, and with its length in front, so that who cannot
/// decode it finds what follows.
///
///     n   header and positions: n bits   check
///
/// n takes 5 bits up to 15 (0 0000 is no packet: not even a check follows), 7 up to 47, 9 up to 111,
/// 11 up to 239, and so on: as many ones as the class says, a zero, and what n is above the least of
/// its class in 4, 5, 6, … bits.
namespace seautils::position {

/// Bits of "no packet".
inline constexpr std::size_t least_field_bits = 5;
/// Bits of the longest field whose packet takes so many bytes; with the check.
std::size_t most_field_bits(std::size_t max_bytes, unsigned check_bits);

/// @param bits  Packet::bits of that packet
void put_field(std::string_view packet, std::size_t bits, unsigned check_bits,
               entropy::BitString& out);
/// The packet, as bytes that Receiver takes; empty: there is none.
/// @param next       the next bit
/// @throws DataError  longer than so many bytes
std::string get_field(const std::function<bool()>& next, std::size_t max_bytes,
                      unsigned check_bits);

/// The end that sends one vehicle's position in a field now and then: the newest one alone, from what
/// was acknowledged.
class FieldSender {
public:
    /// The mode of `link` does not matter. @throws ConfigError  options out of range
    FieldSender(LinkOptions link, const CodecOptions& codec);

    /// Puts the field with that position. The same position again is no new one; where it is
    /// acknowledged already there is nothing to send, and the field says so.
    /// @param max_bytes  at least least_bytes(link)
    /// @throws DataError  as Sender::sample(); nothing is put
    void put(const Fix& fix, std::size_t max_bytes, entropy::BitString& out);

    /// As those of Sender.
    Sender::Heard acknowledge(std::string_view ack) { return sender_.acknowledge(ack); }
    std::string save() const { return sender_.save(); }
    void load(std::string_view state) { sender_.load(state); }

private:
    unsigned check_bits_;
    Sender sender_;
    std::optional<Fix> last_;
};

/// The other end.
Receiver make_field_receiver(const LinkOptions& link, const CodecOptions& codec);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_FIELD_HPP
