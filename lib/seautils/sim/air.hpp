#ifndef SEAUTILS_SIM_AIR_HPP
#define SEAUTILS_SIM_AIR_HPP

#include "seautils/core/rate_table.hpp"
#include "seautils/sim/packet.hpp"

namespace seautils::sim {

/// How long a packet sounds: data as the table has it by their frames, flexible data the probe and a
/// share of the table's full packet by their bytes, an interrogation and its answer their own, all
/// others a minipacket.
/// @throws DataError  the table does not have the packet's rate
Time air_time(const RateTable& rates, const Packet& packet);

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_AIR_HPP
