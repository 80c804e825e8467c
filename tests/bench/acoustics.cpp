// Sea water: the formulas for the speed of sound, and a cast of a CTD reduced, cleaned and binned.
#include "seautils/acoustics/profile.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace {

using namespace seautils::acoustics;

void speed(benchmark::State& state, SpeedFormula formula) {
    Water water{10, 35, 1000, 990, 45};
    for (auto _ : state) {
        water.temperature_c = water.temperature_c < 20 ? water.temperature_c + 0.001 : 2;
        benchmark::DoNotOptimize(sound_speed(formula, water).mps);
    }
}
BENCHMARK_CAPTURE(speed, chen_millero, SpeedFormula::chen_millero);
BENCHMARK_CAPTURE(speed, del_grosso, SpeedFormula::del_grosso);
BENCHMARK_CAPTURE(speed, mackenzie, SpeedFormula::mackenzie);
BENCHMARK_CAPTURE(speed, leroy, SpeedFormula::leroy);

/// A cast at 24 Hz and 1 m/s through a thermocline, with the ship's heave.
std::vector<Reading> cast(std::size_t scans) {
    std::vector<Reading> readings(scans);
    for (std::size_t k = 0; k < scans; ++k) {
        const double s = static_cast<double>(k) / 24;
        Reading& reading = readings[k];
        reading.line = k + 1;
        reading[Quantity::pressure_dbar] = 1 + s + 0.5 * std::sin(s);
        reading[Quantity::temperature_c] = 4 + 14 / (1 + std::exp((s - 60) / 15));
        reading[Quantity::salinity] = 35;
    }
    return readings;
}

void profile_of_cast(benchmark::State& state) {
    const std::vector<Reading> readings = cast(24 * 500);
    for (auto _ : state) {
        std::vector<Sample> samples;
        for (const Reading& reading : readings) {
            Sample sample;
            if (reduce(reading, Reduction(), sample) == Drop::none) samples.push_back(sample);
        }
        benchmark::DoNotOptimize(bin_samples(samples, Binning()).levels.size());
    }
    const auto scans = static_cast<double>(readings.size());
    state.counters["scan"] = benchmark::Counter(
        scans, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(profile_of_cast)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
