#include "seautils/propagation/rays.hpp"

#include "seautils/propagation/beam_intensity.hpp"
#include "seautils/propagation/beam_pressure.hpp"
#include "seautils/propagation/column_store.hpp"
#include "seautils/propagation/error_estimate.hpp"
#include "seautils/propagation/ray_fan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <numbers>
#include <thread>

namespace seautils::propagation {
namespace {

/// Beams are added in so many blocks, each on its own, then block to block: the sums are the same
/// whatever the number of threads. Fewer where the grid is large.
constexpr std::size_t most_blocks = 8;
std::size_t blocks_of(std::size_t cells) {
    return std::clamp<std::size_t>(4'000'000 / (cells + 1), 2, most_blocks);
}
/// At which beams are added.
std::size_t most_cells(const Receivers& receivers) {
    return receivers.range_m.size() * Depths::padded(receivers.depth_m.size());
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
    const std::size_t blocks = blocks_of(columns.cells_of_receivers());
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

/// Receivers of which columns are computed: some of a field's, none at range 0.
struct Part {
    Receivers receivers;
    std::vector<std::size_t> place;  ///< of each range in the field
};

/// All receivers but those of which `skip(range, its place)` says so.
template <class Skip>
Part part_of(const Receivers& receivers, const Skip& skip) {
    Part part;
    part.receivers.depth_m = receivers.depth_m;
    for (std::size_t k = 0; k < receivers.range_m.size(); ++k) {
        const double range_m = receivers.range_m[k];
        if (!(range_m > 0) || skip(range_m, k)) continue;
        part.receivers.range_m.push_back(range_m);
        part.place.push_back(k);
    }
    return part;
}

/// Calls set(depth, its place in the field) for the depths at a range that lie in the water.
template <class Set>
void for_each_wet(const Field& field, const Environment& environment, const RaySea& sea,
                  std::size_t range, const Set& set) {
    const double range_m = environment.receivers.range_m[range];
    const auto surface_m = static_cast<float>(sea.surface.depth_at(range_m));
    const auto bottom_m = static_cast<float>(sea.bottom.depth_at(range_m));
    for (std::size_t depth = 0; depth < field.depths; ++depth) {
        const auto depth_m = static_cast<float>(environment.receivers.depth_m[depth]);
        if (depth_m >= surface_m && depth_m <= bottom_m) set(depth, depth * field.ranges + range);
    }
}

void put_intensity(Field& field, const Environment& environment, const RaySea& sea,
                   std::size_t range, const float* intensity) {
    for_each_wet(field, environment, sea, range, [&](std::size_t depth, std::size_t to) {
        field.loss_db[to] = -10 * std::log10(intensity[depth]);
    });
}

void put_pressure(Field& field, const Environment& environment, const RaySea& sea,
                  std::size_t range, const std::complex<float>* pressure) {
    for_each_wet(field, environment, sea, range, [&](std::size_t depth, std::size_t to) {
        field.pressure[to] = pressure[depth];
        field.loss_db[to] = -10 * std::log10(std::norm(pressure[depth]));
    });
}

/// Where the error of a fan is looked at, over its reach: receivers go at least as far as the last.
constexpr double probe_shares[]{0.15, 0.3, 0.45, 0.6, 0.75};
float intensity_of(float intensity) { return intensity; }
float intensity_of(std::complex<float> pressure) { return std::norm(pressure); }

/// The error of 95 % of the cells, from the twins of probes: what a fan half as dense makes of them.
/// Next to folds, where most is amiss, a beam blurs an edge, and twice the blur is twice as wrong:
/// from half the fan to this one it is as far as from this one to the truth.
template <class Sums>
double estimated_error_db(const Columns& columns, const Sums& sums) {
    ErrorEstimate error;
    for (const std::size_t probe : columns.probes()) {
        const auto* fine = sums.column(probe);
        const auto* coarse = sums.column(columns.view(probe).twin);
        for (std::size_t k = 0; k < Columns::depths_of_probe; ++k)
            error.add(double{intensity_of(fine[k])}, double{intensity_of(coarse[k])});
    }
    return error.db();
}

std::vector<double> probes(double reach_m) {
    std::vector<double> out;
    for (const double share : probe_shares) out.push_back(share * reach_m);
    return out;
}

/// Receivers and title aside.
bool is_same_sea(const Environment& a, const Environment& b) {
    return a.frequency_hz == b.frequency_hz && a.source == b.source && a.water == b.water &&
           a.surface == b.surface && a.surface_line == b.surface_line && a.bottom == b.bottom &&
           a.bottom_depth_m == b.bottom_depth_m && a.bottom_line == b.bottom_line && a.fan == b.fan;
}

/// Threads aside.
bool are_same(const FieldOptions& a, const FieldOptions& b) {
    return a.sum == b.sum && a.beam == b.beam && a.least_amplitude == b.least_amplitude &&
           a.baffle_from_deg == b.baffle_from_deg && a.baffle_to_deg == b.baffle_to_deg;
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
    FieldOptions options;     ///< threads do not count
    double reach_m = 0;
    std::vector<std::string> remarks;
    RaySea sea;
    double spacing_rad = 0;
    std::vector<Launch> fan;
    std::vector<KeptRay> rays;  ///< as many; none before the sea comes again
    ColumnStore columns;
    std::map<double, double> error_db;  ///< estimated, by reach

    bool is_of(const Environment& e, const FieldOptions& o) const {
        return are_same(options, o) && is_same_sea(environment, e) &&
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
    auto now = std::make_unique<Kept>();
    now->environment = environment;
    now->environment.receivers = {};
    now->options = options;
    now->reach_m = reach_m(environment);
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

/// A field under way: what is to be computed of it, and of what.
struct RayFields::Work {
    Work(Kept& kept, const Environment& e, const FieldOptions& o, Part wanted)
        : known(kept),
          options(o),
          reach(reach_m(e)),
          is_estimated(kept.error_db.contains(reach)),
          part(std::move(wanted)),
          columns(kept.sea, part.receivers, o,
                  is_estimated ? std::vector<double>{} : probes(reach)),
          kind(beam_kind(e, o)) {
        kind.legs = legs_of_ray(beams());
    }

    std::size_t beams() const { return known.fan.size(); }

    /// All beams; what there is to say of them goes to the basis, and the estimate to what is known.
    template <class Sums, class Add>
    Sums add(Basis& basis, const Add& add_beam) const {
        Sums sums = add_beams(empty_sums<Sums>(known.sea, columns, kind), beams(), options.threads,
                              add_beam);
        if (sums.cut() > 0)
            basis.remarks.push_back(
                fmt::format("{} of {} rays ended after {} legs", sums.cut(), beams(), kind.legs));
        if (!is_estimated) known.error_db[reach] = estimated_error_db(columns, sums);
        return sums;
    }

    Kept& known;
    const FieldOptions& options;
    double reach;
    bool is_estimated;
    Part part;
    Columns columns;
    BeamKind kind;
};

Field RayFields::field(const Environment& environment, const FieldOptions& options) {
    Kept& known = kept(environment, options);
    Field field = empty_field(environment, options);
    field.basis.remarks = known.remarks;
    field.basis.beams = known.fan.size();
    drop();
    if (options.sum == Sum::coherent)
        add_pressures(known, environment, options, field);
    else
        add_intensities(known, environment, options, field);
    const auto error_db = known.error_db.find(reach_m(environment));
    if (error_db != known.error_db.end()) field.basis.estimated_error_db = error_db->second;
    return field;
}

void RayFields::add_pressures(Kept& known, const Environment& environment,
                              const FieldOptions& options, Field& field) {
    const Work work(known, environment, options,
                    part_of(environment.receivers, [](double, std::size_t) { return false; }));
    const auto sums = work.add<PressureSum>(
        field.basis, [&](PressureSum& sum, std::size_t k) { sum.add(known.fan[k], k % 2 == 0); });
    for (std::size_t k = 0; k < work.part.place.size(); ++k)
        put_pressure(field, environment, known.sea, work.part.place[k],
                     sums.column(work.columns.receivers()[k]));
}

/// Columns that are known are not computed again. They are kept where beams are summed in as many
/// blocks as they would be alone, and no earlier than rays are.
void RayFields::add_intensities(Kept& known, const Environment& environment,
                                const FieldOptions& options, Field& field) {
    const Receivers& receivers = environment.receivers;
    const bool keeps = !known.rays.empty() && known.error_db.contains(reach_m(environment)) &&
                       blocks_of(most_cells(receivers)) == most_blocks;
    if (keeps) known.columns.open(receivers.depth_m);
    Work work(known, environment, options, part_of(receivers, [&](double range_m, std::size_t at) {
                  const float* column = keeps ? known.columns.find(range_m) : nullptr;
                  if (column != nullptr) put_intensity(field, environment, known.sea, at, column);
                  return column != nullptr;
              }));
    if (work.part.place.empty()) return;
    if (!known.rays.empty()) work.kind.mark_every_m = work.reach / marks_of_ray;
    const std::size_t most_of_ray =
        known.rays.empty() ? 0 : most_legs_ / work.beams() - legs_of_empty_ray;
    const auto sums = work.add<IntensitySum>(field.basis, [&](IntensitySum& sum, std::size_t k) {
        if (known.rays.empty()) return sum.add(known.fan[k], k % 2 == 0);
        KeptRay& ray = known.rays[k];
        sum.add(known.fan[k], k % 2 == 0, ray);
        if (ray.size() > most_of_ray) ray.clear();
    });
    std::vector<float> column(field.depths);
    for (std::size_t k = 0; k < work.part.place.size(); ++k) {
        const std::size_t at = work.columns.receivers()[k];
        work.columns.at_receivers(at, sums.column(at), column.data());
        put_intensity(field, environment, known.sea, work.part.place[k], column.data());
        if (keeps && sums.cut() == 0)
            known.columns.put(work.part.receivers.range_m[k], column.data());
    }
}

Field ray_field(const Environment& environment, const FieldOptions& options) {
    check(environment);
    return RayFields(0).field(environment, options);
}

}  // namespace seautils::propagation
