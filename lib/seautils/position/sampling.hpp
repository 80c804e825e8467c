#ifndef SEAUTILS_POSITION_SAMPLING_HPP
#define SEAUTILS_POSITION_SAMPLING_HPP

#include "seautils/position/grid.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace seautils::position {

/// Where the vehicle was, as its navigation says.
struct RawFix {
    std::int64_t time_us = 0;  ///< UTC since 1970, or since whatever the log counts from
    Place place;
};

/// One of an evenly spaced history of positions.
struct Sample {
    std::int64_t time_ms = 0;
    Cell cell;
    bool starts = false;  ///< the first, or the first after a gap

    friend bool operator==(const Sample&, const Sample&) = default;
};

/// Makes an evenly spaced history in whole cells of fixes at any times.
///
/// The first fix, and each that follows a gap, begins a grid of times: samples are at that fix (its
/// next whole millisecond) and every interval from there, so that a track that is evenly spaced
/// already comes through as it is, whatever its phase. A sample is complete, and is given, when the
/// first fix at its time or later is there; none lies behind the last fix of its run. It takes
/// constant memory.
class Sampler {
public:
    enum class Method {
        linear,   ///< on the straight line between the fixes on both sides
        nearest,  ///< where the fix nearest in time is; of two the earlier
    };
    struct Options {
        std::int64_t interval_ms = 10'000;  ///< 1 to 86,400,000
        std::int64_t gap_ms = 0;  ///< longer steps between fixes are gaps; 0: 1.5 intervals
        Method method = Method::linear;
        Grid grid;
    };
    static constexpr std::int64_t longest_gap = 1000;  ///< in intervals

    /// @throws ConfigError  a number out of its range, named; a gap shorter than an interval
    explicit Sampler(const Options& options);

    /// The samples that this fix makes complete, until the next call: at most one more than the
    /// intervals in a gap.
    ///
    /// A fix that is refused counts as not there. But a clock that was set back is believed when
    /// back_before_belief fixes in a row agree: a gap, and the track goes on from the last of them.
    /// @throws DataError  a time outside 0 to the year 2200, or not after that of the fix before; a
    ///                    place outside the area (cell_of)
    const std::vector<Sample>& add(const RawFix& fix);
    static constexpr int back_before_belief = 5;

private:
    void check_time(const RawFix& fix);
    void begin(const RawFix& fix);
    void sample(const RawFix& fix);
    Place at(std::int64_t time_us, const RawFix& fix) const;

    Options options_;
    std::int64_t interval_us_, gap_us_;
    std::optional<RawFix> last_;
    std::int64_t next_us_ = 0;  ///< when the next sample is
    bool starts_ = true;
    std::int64_t back_us_ = 0;  ///< of the last fix that was refused for its time
    int back_ = 0;              ///< how many of them agree
    std::vector<Sample> complete_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_SAMPLING_HPP
