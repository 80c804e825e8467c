#ifndef SEAUTILS_SIM_SCENARIO_HPP
#define SEAUTILS_SIM_SCENARIO_HPP

#include "seautils/core/rate_table.hpp"
#include "seautils/sim/table.hpp"
#include "seautils/sim/track.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::sim {

constexpr unsigned rate_count = 7;  ///< of the Micro-Modem: 0 to 6

/// Micro-Modem 1 or 2.
enum class Generation { mm1, mm2 };

/// What lies between the modems. What a key of `[water]` is called stands in brackets.
struct WaterSpec {
    double sound_speed_mps = 1500;  ///< [sound_speed_mps] 1300 to 1700
    double max_range_m = std::numeric_limits<double>::infinity();  ///< [max_range_m] silent beyond
    Curve loss_by_range;           ///< [loss_by_range] `RANGE_M:PROBABILITY, …`; empty: none
    double loss = 0;               ///< [loss] probability that a packet is lost, whatever its range
    double bad_crc = 0;            ///< [bad_crc] probability that a frame is spoilt
    Curve tl_db;                   ///< [transmission_loss] CSV with range_m and tl_db; empty: none
    double source_level_db = 185;  ///< [source_level_db] re 1 µPa at 1 m
    double noise_db = 75;          ///< [noise_db] in the modem's band, re 1 µPa
    /// [threshold_db] `RATE:SNR, …` with a table of transmission loss: what a rate needs at least
    std::array<double, rate_count> threshold_db{3, 4, 6, 9, 10, 15, 4};
};

/// A modem. What a key of `[node NAME]` is called stands in brackets.
struct NodeSpec {
    std::string name;                         ///< of the terminal's link
    unsigned id = 0;                          ///< [id] 1 to 30: its SRC at first; no other's
    Generation generation = Generation::mm2;  ///< [modem] `mm1` or `mm2`
    std::string firmware;                     ///< [firmware] as CAREV says it
    Track track;  ///< [x_m, y_m, depth_m], [latitude_deg, longitude_deg, depth_m], or [track]
    double clock_offset_s = 0;   ///< [clock_offset_s] of its clock at the start, -86400 to 86400
    double clock_drift_ppm = 0;  ///< [clock_drift_ppm] it runs fast by so much, -1000 to 1000
    bool pps = true;  ///< [pps] it has a pulse each second: it takes over times at the next
    std::map<std::string, std::string> nvram;  ///< [nvram] `NAME:VALUE, …` beside the defaults
    std::vector<double>
        reboot_s;           ///< [reboot_s] it starts anew so long after the start; increasing
    double boot_s = 1;      ///< [boot_s] how long it is deaf then, 0 to 60
    unsigned baud = 19200;  ///< [baud] of its serial line, 1200 to 1000000
};

/// An acoustic transponder of a long baseline. Keys of `[transponder NAME]` in brackets.
struct TransponderSpec {
    std::string name;
    char letter = 0;             ///< [letter] A to D: answers REMUS interrogations; 0: does not
    unsigned query_hz = 0;       ///< [query_hz] narrowband: the frequency that it answers; 0: none
    unsigned reply_hz = 0;       ///< [reply_hz] narrowband: the frequency that it answers with
    double turn_around_ms = 50;  ///< [turn_around_ms] from hearing to answering, 0 to 10000
    Track track;                 ///< as a node's
};

/// A scenario: the sea, the modems in it, and when it begins.
struct Scenario {
    WaterSpec water;
    std::vector<NodeSpec> nodes;                ///< 1 to 30, in the order of the file
    std::vector<TransponderSpec> transponders;  ///< at most 16
    std::uint64_t seed = 0;                     ///< [seed of `[water]`] of all chance
    Time epoch = 0;   ///< [epoch of `[water]`] when it begins; default: `now`
    RateTable rates;  ///< [rates of `[water]`] frames, bytes and air times
};

/// Gives the text of a file that a scenario names.
using ReadFile = std::function<std::string(const std::string& file)>;

/// Reads a scenario: lines of `key = value` under `[water]`, `[nodes]` (what holds for all nodes
/// below it that do not say otherwise), `[node NAME]` and `[transponder NAME]`, comments from `#`.
///
/// @param name  of the file, for messages
/// @param now   the epoch where the file has none
/// @param read  reads the files of tracks, transmission loss and rates
/// @throws ConfigError  `FILE:LINE: what`, with the value quoted and the bound: an unknown section
///                      or key (proposes the nearest), a key that stands twice, a value out of its
///                      range, an id or a name that another has, no node, more than 1 MiB
Scenario parse_scenario(const std::string& name, std::string_view text, Time now,
                        const ReadFile& read);

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_SCENARIO_HPP
