// Rays: the loss on a grid, and the paths to a few receivers.
#include "seautils/propagation/engine.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace seautils::propagation;

std::vector<double> evenly(double from, double to, int count) {
    std::vector<double> out;
    for (int k = 0; k < count; ++k) out.push_back(from + (to - from) * k / (count - 1));
    return out;
}

/// A summer shelf at a modem's carrier, 109 by 200 receivers.
Environment shelf() {
    Environment sea;
    sea.frequency_hz = 25120;
    sea.source.depth_m = 30;
    sea.receivers = {evenly(1, 109, 109), evenly(10, 2000, 200)};
    sea.water.profile = {{0, 1535},    {8, 1534.8},  {10, 1534},   {12, 1532.2}, {14, 1529.5},
                         {17, 1525},   {20, 1520.5}, {23, 1516.6}, {26, 1513.8}, {30, 1511.6},
                         {35, 1510.5}, {45, 1509.6}, {60, 1509.2}, {80, 1509.4}, {110, 1509.9}};
    sea.water.absorption = {AbsorptionModel::francois_garrison, 14, 38, 8.1, 50, 0};
    sea.bottom = {BoundaryKind::half_space, 1650, 0, 1.77, 1.1, 0, 0, {}};
    sea.bottom_depth_m = 110;
    return sea;
}

/// Up a beach, through a front: bathymetry and speeds depend on range; 119 by 200 receivers.
Environment beach() {
    Environment sea;
    sea.frequency_hz = 3500;
    sea.source.depth_m = 12;
    sea.receivers = {evenly(0.5, 59.5, 119), evenly(20, 4000, 200)};
    sea.water.mesh = SpeedMesh{{0, 1500, 3000},
                               {0, 10, 20, 35, 60},
                               {1522, 1523, 1524.5, 1521.5, 1522.6, 1524.2, 1516, 1518.5, 1523,
                                1512, 1514, 1521.5, 1511, 1512.5, 1521}};
    sea.water.absorption.model = AbsorptionModel::thorp;
    sea.bottom = {BoundaryKind::half_space, 1700, 0, 1.95, 0.8, 0, 0, {}};
    sea.bottom_line = Line{false, {0, 800, 1600, 2600, 3600, 4000}, {60, 58, 46, 30, 14, 6}};
    return sea;
}

void loss(benchmark::State& state, const Environment& sea, Sum sum) {
    FieldOptions options;
    options.sum = sum;
    options.threads = static_cast<std::uint32_t>(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(ray_field(sea, options));
    state.counters["cells"] = benchmark::Counter(
        static_cast<double>(sea.receivers.depth_m.size() * sea.receivers.range_m.size()),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void arrivals(benchmark::State& state, Environment sea) {
    sea.receivers = {{10, 40, 80}, {300, 1000, 1900}};
    std::size_t paths = 0;
    for (auto _ : state) {
        paths = 0;
        for (const auto& receiver : ray_arrivals(sea, {})) paths += receiver.arrivals.size();
    }
    state.counters["paths"] = static_cast<double>(paths);
}

/// A window of 19 ranges that moves, as receivers that come nearer do; the sea stays. By 13 m all of
/// them are new; by a step of 10 m of the grid one is.
void window(benchmark::State& state, Environment sea, double step_m, double width_m) {
    FieldComputer fields;
    double from_m = 1800;
    for (auto _ : state) {
        sea.receivers.range_m = evenly(from_m, from_m + width_m, 19);
        from_m = from_m > 40 ? from_m - step_m : 1800;
        benchmark::DoNotOptimize(fields.compute(sea, Engine::rays, {}));
    }
}

/// The whole grid, each time under another profile.
void profile_changes(benchmark::State& state, Environment sea) {
    FieldComputer fields;
    for (auto _ : state) {
        sea.water.profile[3].sound_speed_mps += 1e-3;
        benchmark::DoNotOptimize(fields.compute(sea, Engine::rays, {}));
    }
}

BENCHMARK_CAPTURE(window, shelf_moves, shelf(), 13, 176)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(window, beach_moves, beach(), 13, 176)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(window, shelf_slides, shelf(), 10, 180)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(profile_changes, shelf, shelf())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(loss, shelf_incoherent, shelf(), Sum::incoherent)
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(loss, shelf_coherent, shelf(), Sum::coherent)
    ->Arg(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(loss, beach_incoherent, beach(), Sum::incoherent)
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(arrivals, shelf, shelf())->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
