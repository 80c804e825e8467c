// A decision: the window of losses that is met, the utility of each depth, and the depth within limits.
#include "seautils/plan/acomms_depth.hpp"
#include "seautils/plan/limits.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace {

using namespace seautils::plan;

/// 109 depths at 200 ranges of spherical spreading, with rays' focus in it.
LossField losses() {
    LossField field;
    for (int k = 1; k <= 109; ++k) field.depth_m.push_back(k);
    for (int k = 1; k <= 200; ++k) field.range_m.push_back(10 * k);
    for (const double z : field.depth_m)
        for (const double r : field.range_m)
            field.loss_db.push_back(
                static_cast<float>(20 * std::log10(r) + 6 * std::cos(z * r / 4000)));
    return field;
}

void decision(benchmark::State& state, std::size_t instances) {
    const std::vector<LossField> fields(instances, losses());
    const Limits limits{.most_depth_m = 90, .excluded = {{20, 30}}};
    double from_m = 1800;
    for (auto _ : state) {
        const AcommsCurve curve = acomms_curve(fields, {from_m, from_m + 176}, {});
        benchmark::DoNotOptimize(choose_depth(curve.objective, limits, {25, 110}));
        from_m = from_m > 40 ? from_m - 13 : 1800;
    }
}

BENCHMARK_CAPTURE(decision, one_profile, 1);
BENCHMARK_CAPTURE(decision, five_profiles, 5);

}  // namespace

BENCHMARK_MAIN();
