#ifndef SEAUTILS_POSITION_LINK_OPTIONS_HPP
#define SEAUTILS_POSITION_LINK_OPTIONS_HPP

#include "seautils/position/cell.hpp"

#include <cstddef>
#include <cstdint>

namespace seautils::position {

/// A position with its time, UTC, in milliseconds since 1970 (0 to 2^43 - 1: until 2248).
struct Fix {
    std::int64_t time_ms = 0;
    Cell cell;

    friend bool operator==(const Fix&, const Fix&) = default;
};

inline constexpr std::int64_t most_time_ms = (std::int64_t{1} << 43) - 1;

/// What is sent when not everything that is new fits, or arrives.
enum class LinkMode {
    history,    ///< every position arrives in the end; the newest one never waits for an older one
    newest,     ///< the latest position as cheaply as possible; others may never arrive
    automatic,  ///< history while more than every second packet is acknowledged; newest when fewer
                ///< than every third is
};

/// What both ends of a link agree on (LinkMode: only the sender cares).
struct LinkOptions {
    std::int64_t interval_ms = 10'000;     ///< between positions, 1 to 86,400,000
    Cell least{-32'768, -32'768, -8'192};  ///< the operating area, both corners included: what a
    Cell most{32'767, 32'767, 8'191};      ///< full fix costs
    unsigned check_bits = 16;  ///< of a packet and of an acknowledgement: 0, 8, 16, 24 or 32
    std::uint64_t agreed = 0;  ///< number that stands for all else they agree on (codec, datum, …)
    LinkMode mode = LinkMode::history;
    std::size_t most_pending = 32'000;  ///< positions that a sender keeps for later, 2 to 32,000
};

/// @throws ConfigError  a value out of its range, named
void check(const LinkOptions& options);

/// Whether a full fix can carry it. False: it is no position of this link.
bool in_area(const Cell& cell, const LinkOptions& options);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_LINK_OPTIONS_HPP
