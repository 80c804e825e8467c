#ifndef SEAUTILS_PROPAGATION_PAIRS_HPP
#define SEAUTILS_PROPAGATION_PAIRS_HPP

#include "seautils/propagation/field.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace seautils::propagation {

/// Receivers that are pairs, as along a glider's track, computed by engines that know grids: neighbours in range are put
/// together in blocks, each a grid of their ranges and depths. Every block of losses also has the first range beyond 0 and
/// the last one of all, on which fans and modes hang. So n pairs cost about the square root of `most_cells` times their number,
/// and pairs of a grid of that size have the grid's values to the bit.

/// Pairs of a block: `receivers` as a grid, and where in it each pair lies.
struct PairBlock {
    Receivers receivers;
    std::vector<std::size_t> pairs;  ///< in the list of pairs
    std::vector<std::size_t> cells;  ///< of the grid, [depth][range], as many
};

/// @param pairs  any order, each as often as it likes
/// @param most_cells  1 or more; of a block, but for a range that has more depths, and for the two ranges added
/// @param with_ends  they are
std::vector<PairBlock> blocks_of_pairs(const Receivers& pairs, std::size_t most_cells,
                                       bool with_ends);

/// What a field at pairs may cost.
struct PairCost {
    std::size_t most_cells = 40'000;  ///< of a block
    std::size_t most_blocks = 100'000;
};

/// What is asked of a field: 1 depth, and a range for each pair, in their order.
/// @param environment  whose receivers are pairs
/// @param grid_field  computes the field of a grid
/// @throws DataError  they would be more blocks; and as grid_field does
Field field_at_pairs(const Environment& environment, PairCost cost,
                     const std::function<Field(const Environment&)>& grid_field);

/// Arrivals at each pair, in their order. @param grid_arrivals  computes those of a grid
std::vector<ReceiverArrivals> arrivals_at_pairs(
    const Environment& environment,
    const std::function<std::vector<ReceiverArrivals>(const Environment&)>& grid_arrivals);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_PAIRS_HPP
