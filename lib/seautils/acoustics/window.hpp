#ifndef SEAUTILS_ACOUSTICS_WINDOW_HPP
#define SEAUTILS_ACOUSTICS_WINDOW_HPP

#include "seautils/acoustics/legs.hpp"
#include "seautils/acoustics/sample.hpp"

#include <functional>
#include <span>
#include <vector>

namespace seautils::acoustics {

/// Which samples make one profile.
enum class Split : std::uint8_t {
    window,  ///< those of a time
    leg,     ///< those of a dive, or of a climb
    cast,    ///< all
};

struct Windowing {
    Split split = Split::window;
    std::int64_t window_ns = 1'800'000'000'000;  ///< 1 ns to 100 years
    /// How often a window is due, counted from its first sample; 0: after each sample.
    std::int64_t every_ns = 1'800'000'000'000;
    double turn_m = 10;  ///< by how much the sensor comes back where a leg ends

    static constexpr std::size_t most_samples = 4'000'000;
};

/// Samples in, profiles due out, in the order of their coming; memory is that of one window. A window
/// is due when the first sample behind its time has come; samples without a time belong to the window
/// of those before them. After a pause longer than a window, or when time steps back by more than one,
/// what is held is due at once, and windows are counted anew.
class Windows {
public:
    /// @param due  gets the samples of a profile, and which way they went
    using Due = std::function<void(std::span<const Sample> samples, Direction direction)>;
    Windows(const Windowing& how, Due due) : how_(how), due_(std::move(due)), legs_(how.turn_m) {}

    /// @throws DataError  more than most_samples in one profile: they are forgotten
    void add(const Sample& sample);
    /// What is held is due.
    void end();

private:
    void add_to_window(const Sample& sample);
    void add_to_leg(const Sample& sample);
    void hold(const Sample& sample);
    void emit();
    void leave(std::int64_t before_ns);
    std::span<const Sample> held() const { return std::span(samples_).subspan(begin_); }

    Windowing how_;
    Due due_;
    LegFinder legs_;
    std::vector<Sample> samples_;
    std::size_t begin_ = 0;  ///< of what is held
    bool fresh_ = false;     ///< something has come since the last was due
    std::int64_t boundary_ns_ = no_time, last_ns_ = no_time;
};

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_WINDOW_HPP
