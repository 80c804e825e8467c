#ifndef SEAUTILS_SIM_NVRAM_HPP
#define SEAUTILS_SIM_NVRAM_HPP

#include "seautils/sim/scenario.hpp"

#include <map>
#include <string>
#include <string_view>

namespace seautils::sim {

/// The settings that a modem keeps over a restart, by name. Micro-Modem 1 has names of three
/// capitals or digits and whole numbers; Micro-Modem 2 also has dotted names with any value.
class Nvram {
public:
    explicit Nvram(const NodeSpec& spec);

    /// Whether a modem of this generation could have such a setting.
    bool knows(std::string_view name) const;

    /// Sets it. A value that it cannot take (SRC outside 0 to 127, no whole number for a name of
    /// three) is not taken: what was set before stays. `ALL` with 0 sets all as they came.
    void set(std::string_view name, std::string_view value);

    /// Its value; `0` where it was never set.
    std::string_view get(std::string_view name) const;
    int number(std::string_view name) const;

    /// Those set and those with a default, in the order of their names.
    const std::map<std::string, std::string, std::less<>>& all() const { return values_; }

    static bool is_dotted(std::string_view name) { return name.find('.') != name.npos; }

private:
    Generation generation_;
    std::map<std::string, std::string, std::less<>> factory_, values_;
};

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_NVRAM_HPP
