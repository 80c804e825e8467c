#ifndef SEAUTILS_MODEM_OPTIONS_HPP
#define SEAUTILS_MODEM_OPTIONS_HPP

#include "seautils/core/rate_table.hpp"
#include "seautils/modem/sentences.hpp"

#include <chrono>
#include <optional>
#include <vector>

namespace seautils::modem {

/// Which set of commands a modem knows: the first sets its clock with CCCLK, the second with CCTMS.
enum class Generation : std::uint8_t { unknown, first, second };

/// What transponders are asked with, and how.
struct Lbl {
    enum class Kind : std::uint8_t { remus, narrowband, coded };
    Kind kind = Kind::remus;
    double max_range_m = 1000;                ///< to the farthest transponder, 1 to 20000
    unsigned turnaround_ms = 50;              ///< from its hearing to its answer, 0 to 10000 (TAT)
    unsigned transponders = 0xf;              ///< remus: bit k, transponder k of A to D is asked
    unsigned transmit_hz = 26000;             ///< narrowband, coded: of the question
    unsigned transmit_ms = 5;                 ///< narrowband: its length
    unsigned receive_ms = 5;                  ///< narrowband: length of the answers
    std::vector<unsigned> receive_hz{25000};  ///< of the answers: 1 to 4; coded: one
    unsigned code_bits = 7;                   ///< coded: length of the code
    unsigned transmit_code = 0;               ///< coded: the question's
    std::vector<unsigned> receive_codes;      ///< coded: of the answers, at most 4
    unsigned bandwidth_hz = 4000;             ///< coded

    /// Milliseconds that the modem waits: there and back at 1500 m/s, and the turnaround.
    unsigned timeout_ms() const;
};

/// How a Driver deals with its modem.
struct Options {
    unsigned id = 1;                ///< the modem's address, 1 to 30 (SRC)
    std::vector<Setting> settings;  ///< written in this order, and expected to be echoed
    Generation generation = Generation::unknown;  ///< unknown: as its revision says
    bool reset_settings = false;    ///< all settings to the modem's defaults first (CCCFG,ALL,0)
    bool reset = true;              ///< start the modem anew (CCMSC) after the settings
    bool query = false;             ///< ask for all settings when it is ready
    double sound_speed_mps = 1500;  ///< 1300 to 1700
    RateTable rates;
    Lbl lbl;
    bool flexible = false;            ///< send data as flexible data packets (CCTDP)
    unsigned baud = 19200;            ///< of the serial line: what writing the frames takes
    std::optional<unsigned> gateway;  ///< address behind a Hydroid gateway buoy
    /// For the data of a polled cycle; when it is over the modem is told that there is none.
    std::chrono::milliseconds poll_wait{2000};
    /// From the end of a transmission, how long its acknowledgements may take. What comes later, or
    /// after another's cycle was heard, acknowledges somebody else: a Micro-Modem 1 says of each
    /// acknowledgement that it overhears that it is for itself.
    std::chrono::milliseconds ack_wait{10000};
    /// Beyond its air time, until a transmission that does not end is given up.
    std::chrono::milliseconds busy_margin{12000};
    bool raw = false;  ///< a record of each line

    /// @throws DataError  names what cannot be
    void check() const;
};

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_OPTIONS_HPP
