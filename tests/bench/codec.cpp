// The codec alone: a message to bytes and back. Time a message is the figure to look at.
#include "seautils/dccl/codec.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/pool.hpp"

#include "vehicle.pb.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <memory>

// protoc puts the options' classes into ::dccl.
namespace codec = seautils::dccl;
namespace schema = seautils::schema;

namespace {

/// A type, its codec, and one message in each form; `compiled` is of the class that protoc made.
struct Bench {
    Bench(const google::protobuf::Message& prototype, const std::string& text)
        : compiled(prototype.New()) {
        pool.load(SEAUTILS_SOURCE_DIR "/tests/bench/vehicle.proto");
        const auto& descriptor = pool.message(prototype.GetTypeName());
        program = codec::Program::compile(pool.layout(descriptor));
        codec::CodecOptions options;
        options.now_s = 1'700'000'000;
        coder = codec::Codec(std::move(options));
        coder.load(program);
        schema::read_text(text, pool, pool.layout(descriptor), values);
        message = pool.new_message(descriptor);
        schema::to_message(values, *message);
        compiled->ParseFromString(message->SerializeAsString());
        coder.encode(*program, values, bytes);
    }

    schema::Pool pool;
    std::shared_ptr<const codec::Program> program;
    codec::Codec coder;
    schema::Values values;
    std::unique_ptr<google::protobuf::Message> compiled, message;
    std::string bytes;
};

Bench& status() {
    static Bench bench(bench::Status::default_instance(),
                       "time_s: 1699999005.19 src: 3 dest: 30 x_m: 812.6 y_m: -94.6 depth_m: 37.2 "
                       "speed_mps: 1.16 heading_deg: 35.2 pitch_deg: -5.4 roll_deg: 5.6 "
                       "mission: TRANSIT battery_percent: 87 leak: false");
    return bench;
}

Bench& ctd() {
    static Bench bench = [] {
        std::string text = "time_us: 1700021604529286 ";
        for (int k = 0; k < 10; ++k) {
            text += "sample { depth_m: " + std::to_string(k * 9 + 3) + ".4 temperature_c: 12.3" +
                    std::to_string(k) + " salinity: 35.1" + std::to_string(k) +
                    " sound_speed_mps: 1500." + std::to_string(k) + " } ";
        }
        return Bench(bench::Ctd::default_instance(), text);
    }();
    return bench;
}

void encode_values(benchmark::State& state, Bench& (*bench)()) {
    Bench& b = bench();
    std::string out;
    for (auto _ : state) {
        out.clear();
        b.coder.encode(*b.program, b.values, out);
        benchmark::DoNotOptimize(out.data());
    }
    state.counters["bytes"] = static_cast<double>(out.size());
}

void decode_values(benchmark::State& state, Bench& (*bench)()) {
    Bench& b = bench();
    schema::Values values;
    for (auto _ : state) {
        b.coder.decode(b.bytes, values);
        benchmark::DoNotOptimize(values[0]);
    }
}

void encode_message(benchmark::State& state, Bench& (*bench)(), bool compiled) {
    Bench& b = bench();
    const google::protobuf::Message& message = compiled ? *b.compiled : *b.message;
    std::string out;
    for (auto _ : state) {
        out.clear();
        b.coder.encode(*b.program, message, out);
        benchmark::DoNotOptimize(out.data());
    }
    if (out != b.bytes) state.SkipWithError("not the same bytes");
}

void decode_message(benchmark::State& state, Bench& (*bench)(), bool compiled) {
    Bench& b = bench();
    const std::unique_ptr<google::protobuf::Message> message(
        (compiled ? b.compiled : b.message)->New());
    for (auto _ : state) {
        b.coder.decode(b.bytes, *message, *b.program);
        benchmark::DoNotOptimize(message.get());
    }
}

}  // namespace

// What the targets are stated for: from and to a message of a compiled class.
BENCHMARK_CAPTURE(encode_message, status, status, true);
BENCHMARK_CAPTURE(decode_message, status, status, true);
BENCHMARK_CAPTURE(encode_message, ctd, ctd, true);
BENCHMARK_CAPTURE(decode_message, ctd, ctd, true);
// The same where the class is known at run time only.
BENCHMARK_CAPTURE(encode_message, status_dynamic, status, false);
BENCHMARK_CAPTURE(decode_message, status_dynamic, status, false);
BENCHMARK_CAPTURE(encode_message, ctd_dynamic, ctd, false);
BENCHMARK_CAPTURE(decode_message, ctd_dynamic, ctd, false);
// The bits alone, from and to slots of values, as the tools work.
BENCHMARK_CAPTURE(encode_values, status, status);
BENCHMARK_CAPTURE(decode_values, status, status);
BENCHMARK_CAPTURE(encode_values, ctd, ctd);
BENCHMARK_CAPTURE(decode_values, ctd, ctd);

BENCHMARK_MAIN();
