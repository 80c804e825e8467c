#ifndef SEAUTILS_CORE_RATE_TABLE_HPP
#define SEAUTILS_CORE_RATE_TABLE_HPP

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace seautils {

/// What a modem sends at one of its rates: the columns of schemas/seautils/micromodem.rates, which
/// says what each means and where it is from.
struct Rate {
    using Time = std::chrono::microseconds;

    unsigned rate = 0;         ///< 0 to 14
    unsigned frames = 1;       ///< most frames of a packet, 1 to 8
    unsigned frame_bytes = 1;  ///< most bytes of a frame, 1 to 2048
    Time packet{};             ///< of all frames
    Time probe{};              ///< before each packet
    Time cycle{};              ///< of a minipacket before it; 0: none
    Time ack{};                ///< of a minipacket after it; 0: none ever

    /// Sound of a packet of `n` frames, its probe included: in proportion to the frames.
    /// @throws std::out_of_range  n is not 1 to `frames`
    Time packet_time(unsigned n) const;

    /// All sound of one transmission: minipacket, packet, acknowledgement where it is asked for. The
    /// silences between them (propagation, serial line) are not in it.
    Time air_time(unsigned n, bool ack_requested) const;

    friend bool operator==(const Rate&, const Rate&) = default;
};

/// The rates of a modem.
class RateTable {
public:
    /// That of a WHOI Micro-Modem, as micromodem.rates has it.
    RateTable();

    /// Reads a table: a line `kind rate frames frame_bytes packet_s probe_s cycle_s ack_s` for each
    /// rate, in any order; blanks between the columns, comments from `#`.
    /// @param name  stands for the file in messages
    /// @throws ConfigError  `NAME:LINE: what`: a value out of range, a rate that comes twice, a line
    ///                      with other columns; no rate of kind data at all
    static RateTable parse(std::string_view text, const std::string& name);

    /// @throws DataError  names the rates that there are
    const Rate& data(unsigned rate) const;
    const Rate& flexible(unsigned rate) const;

    const std::vector<Rate>& all_data() const { return data_; }  ///< the lowest rate first
    const std::vector<Rate>& all_flexible() const { return flexible_; }

    friend bool operator==(const RateTable&, const RateTable&) = default;

private:
    std::vector<Rate> data_, flexible_;
};

/// Sound of a minipacket: a ping, its answer, an acknowledgement, 13 bits of a user's (DUNE: 0.90 s).
inline constexpr std::chrono::milliseconds minipacket_time{900};

}  // namespace seautils

#endif  // SEAUTILS_CORE_RATE_TABLE_HPP
