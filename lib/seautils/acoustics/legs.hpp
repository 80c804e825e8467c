#ifndef SEAUTILS_ACOUSTICS_LEGS_HPP
#define SEAUTILS_ACOUSTICS_LEGS_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace seautils::acoustics {

/// Which way a sensor moved.
enum class Direction : std::uint8_t { none, dive, climb };

/// Scans `first` to before `end`, of one direction.
struct Leg {
    std::size_t first = 0, end = 0;
    Direction direction = Direction::none;
};

/// Finds dives and climbs in a sequence of depths: a leg ends at its deepest (highest) scan, as soon as
/// the sensor has come back from there by more than `turn_m`. A depth that is more
/// than half of that beyond both its neighbours counts as the nearer of them. Legs lie end to end.
class LegFinder {
public:
    explicit LegFinder(double turn_m) : turn_m_(turn_m) {}

    /// The next depth, in metres. @return a leg that has ended before it, counted from the first depth
    std::optional<Leg> add(double depth_m);
    /// What is left: the last legs, in order.
    std::vector<Leg> finish();

    /// Forgets the depths before that scan; what follows counts from there.
    void forget(std::size_t scans);

private:
    std::optional<Leg> judge(std::size_t at, double depth_m);
    std::optional<Leg> judge_without_direction(std::size_t at, double depth_m);
    Leg end_at(std::size_t end, Direction next);

    double turn_m_;
    Direction direction_ = Direction::none;
    std::size_t scans_ = 0, first_ = 0;
    double before_m_ = 0, last_m_ = 0;        ///< the two last depths
    double least_m_ = 0, most_m_ = 0;         ///< since first_
    std::size_t least_at_ = 0, most_at_ = 0;  ///< the scans where they were
};

}  // namespace seautils::acoustics

#endif  // SEAUTILS_ACOUSTICS_LEGS_HPP
