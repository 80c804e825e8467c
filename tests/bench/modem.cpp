// A modem's lines: sentences a second, and lines of a log a second up to its records.
#include "seautils/modem/replay.hpp"
#include "seautils/stream/nmea.hpp"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace {

using namespace seautils;

/// A packet received, one sent and acknowledged, a ping: as a log has them.
std::vector<std::string> dialogue() {
    const std::string frame(64, '5');
    std::vector<std::string> bodies = {
        "CACFG,SRC,1",
        "CARXP,2",
        "CACYC,0,2,1,1,0,3",
        "CARXD,2,1,0,1," + frame + frame,
        "CARXD,2,1,0,2," + frame,
        "CARXD,2,1,0,3,",
        "CACST,6,0,20240501120010.1234,0,1000,40,200,150,1,2,3,4,5,1,2,1,0,3,3,0,150,20,15,10,-9,"
        "200,"
        "0.1,5,25000,5000",
        "CACYC,0,1,2,0,1,1",
        "CATXP,4",
        "CATXF,4",
        "CADRQ,204511,1,2,1,32,1",
        "CATXD,1,2,1," + frame,
        "CATXP,32",
        "CATXF,32",
        "CAXST,6,20240501,120003.0000,0,0,200,4000,25000,0,1,2,1,1,1,1,32",
        "CARXP,1",
        "CAACK,2,1,1,1",
        "CAMPC,1,2",
        "CAMPR,2,1,0.2501",
        "CAREV,120010,AUV,2.0.27087",
        "CATMQ,2024-05-01T12:00:10Z,RTC,RTC"};
    std::vector<std::string> lines;
    for (const std::string& body : bodies) lines.push_back(stream::sentence(body));
    return lines;
}

void Sentences(benchmark::State& state) {
    const auto lines = dialogue();
    stream::Sentence sentence;
    std::size_t bytes = 0, count = 0;
    for (auto _ : state) {
        for (const std::string& line : lines) {
            benchmark::DoNotOptimize(stream::parse_sentence(line, sentence));
            benchmark::DoNotOptimize(sentence.fields());
            bytes += line.size();
        }
        count += lines.size();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(count));
    state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
}
BENCHMARK(Sentences);

/// @param prefix  before each line
void replayed(benchmark::State& state, const std::string& prefix) {
    auto lines = dialogue();
    for (std::string& line : lines) line = prefix + line;
    modem::Replay replay({}, 1500, false);
    std::vector<record::Record> records;
    std::size_t count = 0;
    for (auto _ : state) {
        for (const std::string& line : lines) {
            replay.line(line, records);
            benchmark::DoNotOptimize(records.data());
            records.clear();
        }
        count += lines.size();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(count));
}

void ReplayPlain(benchmark::State& state) { replayed(state, ""); }
BENCHMARK(ReplayPlain);

void ReplayTimed(benchmark::State& state) { replayed(state, "2024-05-01 12:00:10.123456 [rx] "); }
BENCHMARK(ReplayTimed);

}  // namespace

BENCHMARK_MAIN();
