#ifndef SEAUTILS_MODEM_STATISTICS_HPP
#define SEAUTILS_MODEM_STATISTICS_HPP

#include "seautils/record/record.hpp"
#include "seautils/stream/nmea.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace seautils::modem {

/// What CACST says of a packet that was received, in all of its forms: without a version (26 to 29
/// fields, a time of day), and from version 6 on (a version first, a time with its date). Fields that
/// a firmware does not have are absent; when the packet timed out (mode 2) that may be all but the
/// mode.
///
/// @param near  the arrival's time of day is taken on the day that is nearest to this; absent: a
///              time of day alone gives no arrival
/// @throws DataError  a field that is no number, or outside of what record.proto says
///
/// Source: Goby3 and pyacomms, which name the second and third of the five shift fields in opposite
/// order (ours is Goby's). The unversioned firmware that ends with 28 fields writes noise and carrier
/// without the comma between them (`4125000` for 41 and 25000).
record::ReceiveStatistics receive_statistics(const stream::Sentence& cacst,
                                             std::optional<record::UtcTime> near);

/// What CAXST says of a packet that was sent: with a version first from 6 on, without one before.
/// @throws DataError
record::TransmitStatistics transmit_statistics(const stream::Sentence& caxst);

/// What CAXST means by a mode that is not 0, for people.
std::string_view transmit_fault(std::uint32_t mode);

/// The sentence's body for statistics: CACST of version 8, CAXST of version 7, as simulated modems
/// write them; what is absent is an empty field.
std::string compose(const record::ReceiveStatistics& statistics);
std::string compose(const record::TransmitStatistics& statistics);

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_STATISTICS_HPP
