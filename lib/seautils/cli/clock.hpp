#ifndef SEAUTILS_CLI_CLOCK_HPP
#define SEAUTILS_CLI_CLOCK_HPP

#include "seautils/core/warp.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::cli {

/// What a tool takes the time from: --clock, or the environment's SEAUTILS_CLOCK.
///
/// | word | the time is |
/// |---|---|
/// | `system` | the system's, UTC (default) |
/// | `input` | that of the last record read: what ran once runs again the same |
/// | `warp:N,BOOT,SIM` | simulated, N times as fast as the system's (core/warp.hpp) |
class Clock {
public:
    Clock() = default;
    /// @throws DataError  none of these
    explicit Clock(std::string_view word);
    /// Stands still at a time (--time). @param utc_us  microseconds since 1970
    static Clock fixed(std::int64_t utc_us);

    /// Nanoseconds since 1970, UTC. With `input` 0 before the first record.
    std::int64_t now_ns() const;
    /// Nanoseconds on a clock that no one steps; only differences mean something. With `input` as
    /// now_ns().
    std::int64_t steady_ns() const;

    /// What another program is to be told, to take the time from the same clock.
    std::string word() const;

    bool is_input() const { return kind_ == Kind::input; }
    bool is_system() const { return kind_ == Kind::system; }
    /// With `input`: the time of a record. Time does not run backwards: an earlier one is ignored.
    void advance(std::int64_t utc_ns);

    /// The reading of CLOCK_BOOTTIME at which steady_ns() will be this.
    std::int64_t boot_ns_at_steady(std::int64_t steady_ns) const;
    /// The same for now_ns(); nothing where the system's clock, which can be stepped, decides.
    std::optional<std::int64_t> boot_ns_at(std::int64_t utc_ns) const;

private:
    enum class Kind { system, input, warp, fixed };
    Kind kind_ = Kind::system;
    WarpedClock warp_;
    std::int64_t ns_ = 0;  ///< input, fixed
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_CLOCK_HPP
