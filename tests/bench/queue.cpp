// The queues alone: a push, a contest, a packet; messages into the spool. The load is 100,000
// messages in 1000 queues; memory is what malloc has given out, beyond the data.
#include "seautils/queue/scheduler.hpp"
#include "seautils/queue/spool.hpp"

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace {

namespace queue = seautils::queue;

constexpr std::uint32_t queue_count = 1000;
constexpr std::uint64_t message_count = 100'000;
constexpr std::size_t data_bytes = 32;

queue::Accepted message(std::uint64_t sequence, queue::Now now) {
    queue::Message m;
    m.queue = {static_cast<std::uint32_t>(sequence * 7919 % queue_count), 2};
    m.data.assign(data_bytes - sequence % 3, 'x');
    return queue::accept(std::move(m), sequence, now);
}

/// A scheduler with the whole load.
struct Load {
    Load() {
        queue::SchedulerOptions options;
        options.own_id = 1;
        options.queues.set("", "max_queue", "1000000");
        options.queues.set("", "ttl_s", "1000000");
        options.queues.set("", "blackout_time_s", "0");
        for (std::uint32_t id = 0; id < queue_count; ++id)
            options.queues.set(std::to_string(id), "value_base", std::to_string(1 + id % 17));
        scheduler = std::make_unique<queue::Scheduler>(std::move(options), now);
        for (; sequence < message_count; ++sequence) {
            now.steady_ns += 1000;
            scheduler->push(message(sequence, now), now);
        }
    }
    queue::Now now;
    std::uint64_t sequence = 0;
    std::unique_ptr<queue::Scheduler> scheduler;
};

void push(benchmark::State& state) {
    Load load;
    for (auto _ : state) {
        load.now.steady_ns += 1000;
        load.scheduler->push(message(load.sequence, load.now), load.now);
        ++load.sequence;
    }
}
BENCHMARK(push)->Iterations(100'000);

void contest(benchmark::State& state) {
    Load load;
    queue::Turn turn;
    for (auto _ : state) {
        load.now.steady_ns += 1'000'000'000;
        turn.arrival_ns = load.now.steady_ns;
        const auto packet = load.scheduler->fill(turn, load.now);
        load.scheduler->settle(packet->number, queue::Outcome::failed, load.now);
    }
}
BENCHMARK(contest);

/// Most queues are asked whether they have a message that fits, and have none.
void contest_where_little_fits(benchmark::State& state) {
    Load load;
    queue::Turn turn;
    turn.frame_bytes = data_bytes - 3;
    for (auto _ : state) {
        turn.arrival_ns = load.now.steady_ns;
        benchmark::DoNotOptimize(load.scheduler->fill(turn, load.now));
    }
}
BENCHMARK(contest_where_little_fits);

void packet_of_8_frames_of_256(benchmark::State& state) {
    Load load;
    queue::Turn turn{8, 256, {}, true, 0};
    for (auto _ : state) {
        load.now.steady_ns += 1'000'000'000;
        turn.arrival_ns = load.now.steady_ns;
        const auto packet = load.scheduler->fill(turn, load.now);
        state.counters["messages"] = static_cast<double>(packet->carried.size());
        load.scheduler->settle(packet->number, queue::Outcome::failed, load.now);
    }
}
BENCHMARK(packet_of_8_frames_of_256);

void memory(benchmark::State& state) {
    for (auto _ : state) {
        const std::size_t before = ::mallinfo2().uordblks;
        const Load load;
        const auto used = static_cast<double>(::mallinfo2().uordblks - before);
        state.counters["bytes_beyond_data"] =
            used / static_cast<double>(message_count) - static_cast<double>(data_bytes - 1);
    }
}
BENCHMARK(memory)->Iterations(1);

/// A spool in a folder of its own; TMPDIR says on which disk.
struct Disk {
    Disk() {
        std::string name = (std::filesystem::temp_directory_path() / "bench-XXXXXX").string();
        folder = ::mkdtemp(name.data());
        spool = std::make_unique<queue::Spool>(folder / "q.db", queue::Now{}, "bench");
    }
    ~Disk() {
        spool.reset();
        std::filesystem::remove_all(folder);
    }
    Disk(const Disk&) = delete;
    Disk& operator=(const Disk&) = delete;

    std::filesystem::path folder;
    std::unique_ptr<queue::Spool> spool;
};

void store(benchmark::State& state) {
    Disk disk;
    std::uint64_t sequence = 0;
    std::vector<queue::Accepted> batch;
    for (auto _ : state) {
        batch.clear();
        for (std::int64_t k = 0; k < state.range(0); ++k) batch.push_back(message(++sequence, {}));
        disk.spool->store(batch);
    }
    state.counters["messages/s"] =
        benchmark::Counter(static_cast<double>(sequence), benchmark::Counter::kIsRate);
}
BENCHMARK(store)->Arg(1)->Arg(100)->Arg(10'000)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
