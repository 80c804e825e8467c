// The codecs of a track: time a position, coded and decoded in packets of eight.
#include "seautils/position/codec.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace seautils;
using position::Cell;
using position::CodecOptions;

/// Legs of 15 m an interval with a turn in twenty, one cell of noise; every position can be coded.
std::vector<Cell> legs() {
    std::vector<Cell> walk;
    std::uint32_t state = 1;
    const auto below = [&](std::uint32_t end) {
        state = state * 1664525U + 1013904223U;
        return static_cast<std::int32_t>((state >> 16) % end);
    };
    constexpr std::int32_t way[][2] = {{15, 0}, {12, 9}, {0, 15}, {-12, 9}, {-15, 0}, {0, -15}};
    Cell at;
    std::size_t leg = 0;
    for (int k = 0; k < 4000; ++k) {
        if (below(20) == 0) leg = (leg + 1) % std::size(way);
        at = {at.x + way[leg][0] + below(3) - 1, at.y + way[leg][1] + below(3) - 1,
              at.z + below(3) - 1};
        walk.push_back(at);
    }
    return walk;
}

void packets_of_eight(benchmark::State& state, CodecOptions::Kind kind, CodecOptions::Model model) {
    static const std::vector<Cell> walk = legs();
    CodecOptions options;
    options.kind = kind;
    options.model = model;
    std::size_t total_bits = 0;
    for (auto _ : state) {
        const auto sender = position::make_codec(options);
        sender->restart(walk[0]);
        const auto receiver = sender->clone();
        total_bits = 0;
        for (std::size_t at = 1; at + 8 <= walk.size(); at += 8) {
            entropy::BitString bits;
            entropy::Encoder out(bits);
            for (std::size_t k = 0; k < 8; ++k) sender->encode(walk[at + k], out);
            out.finish();
            total_bits += bits.size();
            entropy::BitReader reader(bits.bytes(), bits.size());
            entropy::Decoder in(reader);
            for (std::size_t k = 0; k < 8; ++k) {
                if (receiver->decode(in) != walk[at + k])
                    return state.SkipWithError("not the same");
            }
        }
    }
    const auto positions = static_cast<double>((walk.size() - 1) / 8 * 8);
    state.counters["position"] = benchmark::Counter(
        positions, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["bits"] = static_cast<double>(total_bits) / positions;
}

using Kind = CodecOptions::Kind;
using Model = CodecOptions::Model;

}  // namespace

BENCHMARK_CAPTURE(packets_of_eight, fixed_uniform, Kind::fixed, Model::uniform);
BENCHMARK_CAPTURE(packets_of_eight, fixed_gaussian, Kind::fixed, Model::gaussian);
BENCHMARK_CAPTURE(packets_of_eight, fixed_adaptive, Kind::fixed, Model::adaptive);
BENCHMARK_CAPTURE(packets_of_eight, kalman_uniform, Kind::kalman, Model::uniform);
BENCHMARK_CAPTURE(packets_of_eight, kalman_gaussian, Kind::kalman, Model::gaussian);
BENCHMARK_CAPTURE(packets_of_eight, kalman_adaptive, Kind::kalman, Model::adaptive);
BENCHMARK_CAPTURE(packets_of_eight, mix, Kind::mix, Model::adaptive);

BENCHMARK_MAIN();
