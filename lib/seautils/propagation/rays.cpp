#include "seautils/propagation/rays.hpp"

#include "seautils/propagation/beam_intensity.hpp"
#include "seautils/propagation/beam_pressure.hpp"
#include "seautils/propagation/ray_fan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <thread>

namespace seautils::propagation {
namespace {

/// Beams are added in so many blocks, each on its own, then block to block: the sums are the same
/// whatever the number of threads. Fewer where the grid is large.
std::size_t blocks_of(std::size_t cells) {
    return std::clamp<std::size_t>(4'000'000 / (cells + 1), 2, 8);
}

/// Runs work(block) for each block; the blocks are shared out to threads as they come free.
template <class Work>
void for_each_block(std::size_t blocks, std::uint32_t threads, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::vector<std::exception_ptr> failures(std::max<std::uint32_t>(threads, 1));
    const auto run = [&](std::size_t thread) {
        try {
            for (std::size_t block = next++; block < blocks; block = next++) work(block);
        } catch (...) {
            failures[thread] = std::current_exception();
        }
    };
    std::vector<std::thread> others;
    for (std::uint32_t k = 1; k < std::min<std::size_t>(threads, blocks); ++k)
        others.emplace_back(run, k);
    run(0);
    for (auto& thread : others) thread.join();
    for (const auto& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

/// All beams, added in blocks.
template <class Sums>
Sums add_beams(const RaySea& sea, const Columns& columns, const BeamKind& kind,
               const std::vector<Launch>& fan, std::uint32_t threads,
               std::vector<std::string>& remarks) {
    const std::size_t blocks = blocks_of(columns.cells());
    std::vector<Sums> sums;
    sums.reserve(blocks);
    for (std::size_t k = 0; k < blocks; ++k) sums.emplace_back(sea, columns, kind);
    for_each_block(blocks, threads, [&](std::size_t block) {
        for (std::size_t k = block; k < fan.size(); k += blocks) sums[block].add(fan[k]);
    });
    for (std::size_t k = 1; k < blocks; ++k) sums[0].add(sums[k]);
    if (sums[0].cut() > 0)
        remarks.push_back(
            fmt::format("{} of {} rays ended after {} legs", sums[0].cut(), fan.size(), kind.legs));
    return std::move(sums[0]);
}

/// A field with no values yet.
Field empty_field(const Environment& environment, const FieldOptions& options) {
    Field field;
    field.depths = environment.receivers.depth_m.size();
    field.ranges = environment.receivers.range_m.size();
    const std::size_t cells = field.depths * field.ranges;
    const float none = std::numeric_limits<float>::quiet_NaN();
    field.loss_db.assign(cells, none);
    if (options.sum == Sum::coherent) field.pressure.assign(cells, {none, none});
    return field;
}

/// Calls set(depth, its place in the field) for the depths of a column that lie in the water.
template <class Set>
void for_each_wet(const Field& field, const Environment& environment, const Columns& columns,
                  std::size_t column, const Set& set) {
    const std::size_t dry = field.ranges - columns.range_m().size();
    const float surface_m = columns.surface_m(column), bottom_m = columns.bottom_m(column);
    for (std::size_t k = 0; k < field.depths; ++k) {
        const auto depth_m = static_cast<float>(environment.receivers.depth_m[k]);
        if (depth_m >= surface_m && depth_m <= bottom_m) set(k, k * field.ranges + column + dry);
    }
}

void fill(Field& field, const Environment& environment, const Columns& columns,
          const IntensitySum& sum) {
    std::vector<float> intensity(field.depths);
    for (std::size_t column = 0; column < columns.range_m().size(); ++column) {
        columns.at_receivers(column, sum.column(column), intensity.data());
        for_each_wet(field, environment, columns, column, [&](std::size_t depth, std::size_t to) {
            field.loss_db[to] = -10 * std::log10(intensity[depth]);
        });
    }
}

void fill(Field& field, const Environment& environment, const Columns& columns,
          const PressureSum& sum) {
    for (std::size_t column = 0; column < columns.range_m().size(); ++column)
        for_each_wet(field, environment, columns, column, [&](std::size_t depth, std::size_t to) {
            field.pressure[to] = sum.column(column)[depth];
            field.loss_db[to] = -10 * std::log10(std::norm(field.pressure[to]));
        });
}

}  // namespace

Field ray_field(const Environment& environment, const FieldOptions& options) {
    check(environment);
    Field field = empty_field(environment, options);
    const RaySea sea = make_ray_sea(environment, field.basis.remarks);
    const Columns columns(sea, environment.receivers, options);
    const auto fan = make_fan(environment, sea, options);
    BeamKind kind = beam_kind(environment, options);
    kind.legs = legs_of_ray(fan.size());
    field.basis.beams = fan.size();
    const auto add = [&]<class Sums>() {
        return add_beams<Sums>(sea, columns, kind, fan, options.threads, field.basis.remarks);
    };
    if (options.sum == Sum::coherent)
        fill(field, environment, columns, add.template operator()<PressureSum>());
    else
        fill(field, environment, columns, add.template operator()<IntensitySum>());
    return field;
}

}  // namespace seautils::propagation
