#include "seautils/propagation/pairs.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace seautils::propagation {

namespace {

/// Each receiver that no pair asked for is searched for paths in vain.
constexpr std::size_t most_cells_of_arrivals = 36;

/// Pairs by range.
std::vector<std::size_t> by_range(const std::vector<double>& range_m) {
    std::vector<std::size_t> order(range_m.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return range_m[a] < range_m[b]; });
    return order;
}

std::size_t place(const std::vector<double>& axis, double x) {
    return static_cast<std::size_t>(std::lower_bound(axis.begin(), axis.end(), x) - axis.begin());
}

PairBlock block_of(const Receivers& all, std::vector<std::size_t> pairs,
                   const std::set<double>& range_m, const std::set<double>& depth_m) {
    PairBlock block;
    block.receivers.depth_m.assign(depth_m.begin(), depth_m.end());
    block.receivers.range_m.assign(range_m.begin(), range_m.end());
    for (const std::size_t k : pairs)
        block.cells.push_back(place(block.receivers.depth_m, all.depth_m[k]) * range_m.size() +
                              place(block.receivers.range_m, all.range_m[k]));
    block.pairs = std::move(pairs);
    return block;
}

void add_remarks(Basis& basis, const Basis& other) {
    for (const std::string& remark : other.remarks)
        if (std::find(basis.remarks.begin(), basis.remarks.end(), remark) == basis.remarks.end())
            basis.remarks.push_back(remark);
    basis.estimated_error_db = std::max(basis.estimated_error_db, other.estimated_error_db);
}

}  // namespace

std::vector<PairBlock> blocks_of_pairs(const Receivers& all, std::size_t most_cells,
                                       bool with_ends) {
    const std::vector<std::size_t> order = by_range(all.range_m);
    std::set<double> ends;  // of what engines look at beside the receivers
    for (const std::size_t k : order)
        if (with_ends && ends.empty() && all.range_m[k] > 0) ends.insert(all.range_m[k]);
    if (with_ends && !order.empty()) ends.insert(all.range_m[order.back()]);
    std::vector<PairBlock> blocks;
    std::vector<std::size_t> pairs;
    std::set<double> ranges, depths;
    const auto close = [&] {
        ranges.insert(ends.begin(), ends.end());
        blocks.push_back(block_of(all, std::move(pairs), ranges, depths));
        pairs.clear();
        ranges.clear();
        depths.clear();
    };
    for (std::size_t k = 0; k < order.size();) {
        std::size_t end = k;
        std::set<double> column;
        for (; end < order.size() && all.range_m[order[end]] == all.range_m[order[k]]; ++end)
            column.insert(all.depth_m[order[end]]);
        const auto added = static_cast<std::size_t>(std::count_if(
            column.begin(), column.end(), [&](double z) { return !depths.contains(z); }));
        if (!pairs.empty() && (ranges.size() + 1) * (depths.size() + added) > most_cells) close();
        ranges.insert(all.range_m[order[k]]);
        depths.insert(column.begin(), column.end());
        for (; k < end; ++k) pairs.push_back(order[k]);
    }
    if (!pairs.empty()) close();
    return blocks;
}

Field field_at_pairs(const Environment& environment, PairCost cost,
                     const std::function<Field(const Environment&)>& grid_field) {
    Field field;
    field.depths = 1;
    field.ranges = environment.receivers.range_m.size();
    field.loss_db.resize(field.ranges);
    Environment there = environment;
    bool is_first = true;
    std::vector<PairBlock> blocks = blocks_of_pairs(environment.receivers, cost.most_cells, true);
    if (blocks.size() > cost.most_blocks)
        throw DataError(
            fmt::format("{} pairs of receivers need {} runs of this engine, more than "
                        "{} (rays can)",
                        field.ranges, blocks.size(), cost.most_blocks));
    for (PairBlock& block : blocks) {
        there.receivers = std::move(block.receivers);
        const Field grid = grid_field(there);
        if (is_first) field.basis = grid.basis;
        add_remarks(field.basis, grid.basis);
        is_first = false;
        if (!grid.pressure.empty()) field.pressure.resize(field.ranges);
        for (std::size_t k = 0; k < block.pairs.size(); ++k) {
            field.loss_db[block.pairs[k]] = grid.loss_db[block.cells[k]];
            if (!grid.pressure.empty())
                field.pressure[block.pairs[k]] = grid.pressure[block.cells[k]];
        }
    }
    return field;
}

std::vector<ReceiverArrivals> arrivals_at_pairs(
    const Environment& environment,
    const std::function<std::vector<ReceiverArrivals>(const Environment&)>& grid_arrivals) {
    std::vector<ReceiverArrivals> all(environment.receivers.range_m.size());
    Environment there = environment;
    for (PairBlock& block : blocks_of_pairs(environment.receivers, most_cells_of_arrivals, false)) {
        there.receivers = std::move(block.receivers);
        const std::vector<ReceiverArrivals> grid = grid_arrivals(there);
        for (std::size_t k = 0; k < block.pairs.size(); ++k)
            all[block.pairs[k]] = grid[block.cells[k]];
    }
    return all;
}

}  // namespace seautils::propagation
