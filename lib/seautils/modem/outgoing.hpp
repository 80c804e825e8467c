#ifndef SEAUTILS_MODEM_OUTGOING_HPP
#define SEAUTILS_MODEM_OUTGOING_HPP

#include "seautils/modem/dialog.hpp"
#include "seautils/modem/options.hpp"
#include "seautils/record/record.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace seautils::modem {

/// A transmission under way: what is said to the modem for it, and how far it has come.
struct Outgoing {
    enum class Form : std::uint8_t {
        cycle,     ///< CCCYC of our own, then a frame for each CADRQ
        answer,    ///< data for a cycle that another began
        poll,      ///< CCCYC for another to send in
        flexible,  ///< CCTDP
        ping,      ///< CCMPC
        mini,      ///< CCMUC
        lbl,       ///< CCPDT, CCPNT, CCPGT
    };
    record::Transmission request;
    Form form = Form::cycle;
    unsigned frames = 0;                 ///< of the packet
    bool ack = false;                    ///< asked for, of somebody who can
    bool has_cycle = false;              ///< a minipacket of its own announces the packet
    std::chrono::nanoseconds sound{};    ///< all of it, an acknowledgement included
    std::chrono::nanoseconds writing{};  ///< of the frames over the serial line

    bool accepted = false;  ///< the modem took it
    bool ended = false;     ///< the last sound has left
    bool told = false;      ///< statistics of its packet came
    unsigned given = 0;     ///< frames handed over
    std::string last_data;  ///< CCTXD that is not echoed yet
    int data_tries = 0;
    std::int64_t gives_up = 0;                            ///< steady
    std::optional<std::int64_t> first_sound, last_sound;  ///< steady
    std::vector<record::TransmitStatistics> statistics;

    bool has_frames() const { return form == Form::cycle || form == Form::answer; }
    /// Whether the next CATXF is that of the minipacket before the packet.
    bool announcing() const { return has_cycle && given == 0; }
};

/// What a transmission comes to with this modem.
/// @throws DataError  it cannot be sent, with the reason: too many frames, too long, nothing to send,
///                    no such rate or address
Outgoing outgoing_of(const record::Transmission& t, const Options& options);

/// What is said for it. @param pad_even  flexible data of an odd length gets a zero behind it
Command command_of(const Outgoing& o, const Options& options, bool pad_even);

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_OUTGOING_HPP
