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
/// @param add  adds beam k to sums
template <class Sums, class Add>
Sums add_beams(std::vector<Sums> sums, std::size_t beams, std::uint32_t threads, const Add& add) {
    const std::size_t blocks = sums.size();
    for_each_block(blocks, threads, [&](std::size_t block) {
        for (std::size_t k = block; k < beams; k += blocks) add(sums[block], k);
        sums[block].finish();
    });
    for (std::size_t k = 1; k < blocks; ++k) sums[0].add(sums[k]);
    return std::move(sums[0]);
}

template <class Sums>
std::vector<Sums> empty_sums(const RaySea& sea, const Columns& columns, const BeamKind& kind) {
    const std::size_t blocks = blocks_of(columns.cells());
    std::vector<Sums> sums;
    sums.reserve(blocks);
    for (std::size_t k = 0; k < blocks; ++k) sums.emplace_back(sea, columns, kind);
    return sums;
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

/// Receivers and title aside.
bool is_same_sea(const Environment& a, const Environment& b) {
    return a.frequency_hz == b.frequency_hz && a.source == b.source && a.water == b.water &&
           a.surface == b.surface && a.surface_line == b.surface_line && a.bottom == b.bottom &&
           a.bottom_depth_m == b.bottom_depth_m && a.bottom_line == b.bottom_line && a.fan == b.fan;
}

/// Seas that are kept; profiles of a few instances come by turns.
constexpr std::size_t most_seas = 8;
/// What a ray without a leg takes, in legs.
constexpr std::size_t legs_of_empty_ray = 5;
constexpr double marks_of_ray = 24;

}  // namespace

/// A sea and a fan, and what is known of the fan's rays.
struct RayFields::Kept {
    Environment environment;  ///< without receivers
    Sum sum;
    Beam beam;
    double reach_m;
    std::vector<std::string> remarks;
    RaySea sea;
    double spacing_rad;
    std::vector<Launch> fan;
    std::vector<KeptRay> rays;  ///< as many; none before the sea comes again

    bool is_of(const Environment& e, const FieldOptions& o) const {
        return sum == o.sum && beam == o.beam && is_same_sea(environment, e) &&
               (sea.strip_edge_m.size() == 2 || reach_m == propagation::reach_m(e)) &&
               spacing_rad == fan_spacing_rad(e, sea, o);
    }
    std::size_t legs() const {
        std::size_t all = legs_of_empty_ray * rays.size();
        for (const KeptRay& ray : rays) all += ray.size();
        return all;
    }
};

RayFields::RayFields(std::size_t legs) : most_legs_(legs) {}
RayFields::~RayFields() = default;

/// What is known of the sea, found or made, and put first.
RayFields::Kept& RayFields::kept(const Environment& environment, const FieldOptions& options) {
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& kept) {
        return kept->is_of(environment, options);
    });
    if (found != kept_.end()) {
        std::rotate(kept_.begin(), found, found + 1);
        Kept& again = *kept_.front();
        const std::size_t beams = again.fan.size();
        if (options.sum != Sum::coherent && 2 * legs_of_empty_ray * beams <= most_legs_)
            again.rays.resize(beams);
        return again;
    }
    auto now = std::make_unique<Kept>(
        Kept{environment, options.sum, options.beam, reach_m(environment), {}, {}, 0, {}, {}});
    now->environment.receivers = {};
    now->sea = make_ray_sea(environment, now->remarks);
    now->spacing_rad = fan_spacing_rad(environment, now->sea, options);
    now->fan = make_fan(environment, now->sea, options);
    kept_.insert(kept_.begin(), std::move(now));
    return *kept_.front();
}

/// What was used least lately is more than can be kept, beside the first.
void RayFields::drop() {
    std::size_t seas = 1, legs = most_legs_ / 2;
    while (seas < std::min(kept_.size(), most_seas) && (legs += kept_[seas]->legs()) <= most_legs_)
        ++seas;
    kept_.resize(seas);
}

Field RayFields::field(const Environment& environment, const FieldOptions& options) {
    Kept& known = kept(environment, options);
    const RaySea& sea = known.sea;
    const std::size_t beams = known.fan.size();
    Field field = empty_field(environment, options);
    field.basis.remarks = known.remarks;
    field.basis.beams = beams;
    const Columns columns(sea, environment.receivers, options);
    BeamKind kind = beam_kind(environment, options);
    kind.legs = legs_of_ray(beams);
    const auto fill_from = [&](const auto& sums) {
        if (sums.cut() > 0)
            field.basis.remarks.push_back(
                fmt::format("{} of {} rays ended after {} legs", sums.cut(), beams, kind.legs));
        fill(field, environment, columns, sums);
    };
    drop();
    if (options.sum == Sum::coherent) {
        const auto add = [&](PressureSum& sums, std::size_t k) { sums.add(known.fan[k]); };
        fill_from(
            add_beams(empty_sums<PressureSum>(sea, columns, kind), beams, options.threads, add));
        return field;
    }
    if (!known.rays.empty()) kind.mark_every_m = reach_m(environment) / marks_of_ray;
    const std::size_t most_of_ray = known.rays.empty() ? 0 : most_legs_ / beams - legs_of_empty_ray;
    const auto add = [&](IntensitySum& sums, std::size_t k) {
        if (known.rays.empty()) return sums.add(known.fan[k]);
        KeptRay& ray = known.rays[k];
        sums.add(known.fan[k], ray);
        if (ray.size() > most_of_ray) ray.clear();
    };
    fill_from(add_beams(empty_sums<IntensitySum>(sea, columns, kind), beams, options.threads, add));
    return field;
}

Field ray_field(const Environment& environment, const FieldOptions& options) {
    check(environment);
    return RayFields(0).field(environment, options);
}

}  // namespace seautils::propagation
