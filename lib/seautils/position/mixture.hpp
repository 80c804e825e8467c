#ifndef SEAUTILS_POSITION_MIXTURE_HPP
#define SEAUTILS_POSITION_MIXTURE_HPP

#include "seautils/position/integer_math.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

/// Weighted sums of normal distributions, along one axis and over the plane. Lengths are in 1/256 of a
/// cell, from the last known position; weights are Q20.
namespace seautils::position {

inline constexpr std::size_t most_components = 48;
inline constexpr std::int32_t one_q20 = 1 << 20;
inline constexpr std::int32_t one_q24 = 1 << 24;
/// Where a mean may be, 2^20 cells to either side, and a standard deviation, 1/16 to 4096 cells.
inline constexpr std::int32_t most_mean = 1 << 28;
inline constexpr std::int32_t least_sd = 16;
inline constexpr std::int32_t most_sd = 1 << 20;

/// Lengths in 1/256 cell, within those bounds.
inline std::int32_t in_q8(std::int64_t cells) {
    return static_cast<std::int32_t>(clamp(cells * 256, -most_mean, most_mean));
}
inline std::int32_t scaled(std::int32_t length, std::int32_t scale_q8) {
    return static_cast<std::int32_t>(clamp(std::int64_t{length} * scale_q8 >> 8, 0, most_sd));
}

/// The boundary between a cell and the one above it.
inline std::int32_t upper_edge(std::int32_t cell) {
    return static_cast<std::int32_t>(
        clamp(std::int64_t{cell} * 256 + 128, -2 * most_mean, 2 * std::int64_t{most_mean}));
}

/// Along one axis. Weights sum up to at most one_q20.
class Mixture {
public:
    void clear() { size_ = 0; }
    std::size_t size() const { return size_; }
    /// What does not fit is left out, beyond most_components.
    void add(std::int32_t weight, std::int64_t mean, std::int64_t sd) {
        if (size_ == most_components) return;
        const auto s = static_cast<std::int32_t>(clamp(sd, least_sd, most_sd));
        weight_[size_] = weight;
        mean_[size_] = static_cast<std::int32_t>(clamp(mean, -most_mean, most_mean));
        reach_[size_] = s * 11 / 2;
        inverse_[size_] = (1 << 22) / s;
        ++size_;
    }

    /// Probability in Q24 of what is below an edge. Never falls when the edge rises.
    std::int32_t below(std::int32_t edge) const {
        std::int64_t sum = 0;
        for (std::size_t k = 0; k < size_; ++k)
            sum += std::int64_t{weight_[k]} * component_below(k, edge);
        return static_cast<std::int32_t>(sum >> 20);
    }
    std::int32_t component_below(std::size_t k, std::int32_t edge) const {
        const std::int32_t from_mean = edge - mean_[k];
        const std::int32_t reach = reach_[k];
        const std::int32_t near = from_mean < -reach  ? -reach
                                  : from_mean > reach ? reach
                                                      : from_mean;
        return normal_cdf_q24(near * inverse_[k] >> 8);
    }
    std::int32_t weight(std::size_t k) const { return weight_[k]; }
    std::int32_t mean(std::size_t k) const { return mean_[k]; }
    std::int32_t mean() const;  ///< of all
    std::int32_t probability_q24(std::int32_t cell) const {
        return below(upper_edge(cell)) - below(upper_edge(cell - 1));
    }

private:
    std::size_t size_ = 0;
    std::array<std::int32_t, most_components> weight_, mean_, reach_, inverse_;
};

/// How much each component of a mixture expected a cell, Q20, together at most 1.
std::array<std::int32_t, most_components> responsibility(const Mixture& m, std::int32_t cell);

/// Over the plane: y depends on x by a slope.
class PlaneMixture {
public:
    struct Component {
        std::int32_t weight;  ///< Q20
        Pair mean;            ///< 1/256 cell
        std::int32_t sd_x;    ///< of x
        std::int32_t slope;   ///< by how much y rises with x, Q14
        std::int32_t sd_y;    ///< of y where x is known
    };

    void clear() { size_ = 0; }
    std::size_t size() const { return size_; }
    void add(const Component& component) {
        if (size_ < most_components) components_[size_++] = component;
    }
    /// A normal distribution that is `along` wide in a direction and `across` beside it.
    void add(std::int32_t weight, Pair mean, std::int64_t along, std::int64_t across, Direction d);
    /// One that is as wide in all directions.
    void add(std::int32_t weight, Pair mean, std::int64_t sd) {
        const auto s = static_cast<std::int32_t>(clamp(sd, least_sd, most_sd));
        add({weight, mean, s, 0, s});
    }

    const Component& component(std::size_t k) const { return components_[k]; }

    Mixture along_x() const;
    /// Of y, where x is in this cell.
    Mixture along_y(std::int32_t cell_x) const;
    std::int32_t probability_q24(std::int32_t cell_x, std::int32_t cell_y) const;
    /// How much each component expected a cell, Q20; they sum up to at most 1. Nothing expected it:
    /// as they were weighted.
    std::array<std::int32_t, most_components> responsibility(std::int32_t cell_x,
                                                             std::int32_t cell_y) const;

private:
    /// Weights in proportion to what is expected of each, which is Q24.
    using Weights = std::array<std::int32_t, most_components>;
    Weights reweighted(const Weights& expected) const;
    Weights expected_x(std::int32_t cell_x) const;
    Weights expected(std::int32_t cell_x, std::int32_t cell_y) const;
    Mixture given(std::int32_t cell_x, const Weights& weights) const;

    std::size_t size_ = 0;
    std::array<Component, most_components> components_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_MIXTURE_HPP
