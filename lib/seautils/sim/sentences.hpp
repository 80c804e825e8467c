#ifndef SEAUTILS_SIM_SENTENCES_HPP
#define SEAUTILS_SIM_SENTENCES_HPP

#include "seautils/sim/packet.hpp"
#include "seautils/sim/scenario.hpp"

#include <string>

namespace seautils::sim {

/// `hhmmss` of a clock.
std::string hhmmss(Time clock);
/// `2019-12-02T03:02:59Z`, whole seconds.
std::string iso8601(Time clock);
/// `yyyy,mm,dd,hh,mm,ss`, without leading zeros.
std::string calendar(Time clock);

/// The receive statistics of a packet: 29 fields (Micro-Modem 1), or with the version 6 and a date
/// in the time of arrival (Micro-Modem 2). Mode is 1 where a frame is spoilt.
/// @param arrival  of the first sound, by the modem's clock
std::string cacst(const Heard& heard, Generation generation, Time arrival, unsigned clock_mode);

/// The same where a packet came to nothing: mode 2, and nothing behind it.
std::string cacst_timeout(Generation generation);

/// The transmit statistics of a packet.
/// @param began  by the modem's clock
/// @param mode   0 good, 4 no data
std::string caxst(const Packet& packet, Generation generation, Time began, unsigned clock_mode,
                  unsigned mode);

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_SENTENCES_HPP
