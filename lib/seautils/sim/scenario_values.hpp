#ifndef SEAUTILS_SIM_SCENARIO_VALUES_HPP
#define SEAUTILS_SIM_SCENARIO_VALUES_HPP

#include "seautils/sim/scenario.hpp"
#include "seautils/sim/table.hpp"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::sim {

// The values of a scenario's keys. Each throws a ConfigError that quotes the value and names the
// bound; `what` is the key.

constexpr std::size_t max_points = 10'000;  ///< of a curve

/// 0 to 1.
double probability(std::string_view what, std::string_view text);
unsigned whole(std::string_view what, std::string_view text, unsigned least, unsigned most,
               std::string_view unit = "");
/// `yes`, `true`, `no`, `false`.
bool yes_or_no(std::string_view what, std::string_view text);
/// `RANGE_M:PROBABILITY, …`
Curve loss_curve(std::string_view text);
/// `RATE:SNR_DB, …`; other rates keep theirs.
void set_thresholds(std::array<double, rate_count>& thresholds, std::string_view text);
/// `NAME:VALUE, …`; other names keep theirs.
void set_nvram(std::map<std::string, std::string>& nvram, std::string_view text);
/// Seconds, increasing, with commas between.
std::vector<double> reboot_times(std::string_view text);
/// `mm1` or `mm2`.
Generation generation(std::string_view text);
/// What a sentence can say in a field.
std::string firmware(std::string_view text);

/// Letters, digits, `-`, `_` and `.`, the first a letter or digit; at most 32: it becomes the name
/// of a link.
bool is_name(std::string_view name);

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_SCENARIO_VALUES_HPP
