#ifndef SEAUTILS_MODEM_MOMENT_HPP
#define SEAUTILS_MODEM_MOMENT_HPP

#include "seautils/record/record.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace seautils::modem {

/// Now, on two clocks: UTC is what turns and deadlines go by, and can be stepped; the other cannot,
/// and is what is waited by.
struct Moment {
    record::UtcTime utc;
    std::int64_t steady_ns = 0;  ///< since anything

    std::int64_t after(std::chrono::nanoseconds wait) const { return steady_ns + wait.count(); }
};

/// Puts a record of this kind at the end.
template <class Kind>
Kind& add(std::vector<record::Record>& records, record::UtcTime time, Kind kind) {
    records.push_back({time, std::move(kind)});
    return std::get<Kind>(records.back().kind);
}

/// An event with a text for people.
inline void add_event(std::vector<record::Record>& records, record::UtcTime time,
                      record::ModemEvent::Event event, std::string text) {
    record::ModemEvent e;
    e.event = event;
    e.text = std::move(text);
    add(records, time, std::move(e));
}

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_MOMENT_HPP
