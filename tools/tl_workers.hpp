// Tasks of tl-model computed, by one thread or by several.
#ifndef SEAUTILS_TOOLS_TL_WORKERS_HPP
#define SEAUTILS_TOOLS_TL_WORKERS_HPP

#include "tl_answer.hpp"

#include "seautils/propagation/engine.hpp"
#include "seautils/propagation/pairs.hpp"
#include "seautils/propagation/rays.hpp"
#include "seautils/propagation/smooth.hpp"
#include "seautils/toolbox/external.hpp"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace seautils::tools {

/// What the library says of a field, by the name that requests and files have for it.
inline std::string in_words_of_requests(std::string what) {
    static constexpr std::pair<std::string_view, std::string_view> names[] = {
        {"surface_line", "altimetry"},
        {"bottom_line", "bathymetry"},
        {"water.mesh", "mesh"},
        {"water.profile", "profile"},
        {"water.absorption", "absorption"},
        {"water.density_gcm3", "water_density_gcm3"},
        {"fan.least_deg", "fan.min_deg"},
        {"fan.most_deg", "fan.max_deg"},
        {"source.pattern[", "beam pattern["},
    };
    for (const auto& [from, to] : names)
        if (what.starts_with(from)) return what.replace(0, from.size(), to);
    return what;
}

/// Computes tasks one after another. What it keeps from one to the next belongs here.
class TlComputer {
public:
    explicit TlComputer(toolbox::ExternalRun run) : run_(std::move(run)) {}

    /// No exception leaves it: what is wrong is in the result.
    TlResult compute(std::shared_ptr<const TlTask> task) noexcept {
        TlResult result;
        result.task = std::move(task);
        try {
            run(*result.task, result);
        } catch (const std::bad_alloc&) {
            result.error = "out of memory";
        } catch (const std::exception& e) {
            result.error = in_words_of_requests(e.what());
        }
        return result;
    }

private:
    static constexpr std::size_t smooth_depths = 5, smooth_ranges = 9;
    static constexpr std::size_t most_receivers = 20'000;

    void run(const TlTask& task, TlResult& result) {
        if (task.loss) {
            if (task.smooth && task.environment.receivers.pairs)
                throw DataError("smooth is for a grid of receivers, not for pairs");
            result.field = field_of(task);
            if (task.smooth) pg::smooth(result.field, smooth_depths, smooth_ranges);
        }
        if (!task.arrivals) return;
        pg::Environment there = task.environment;
        if (task.arrivals_at) there.receivers = *task.arrivals_at;
        const std::size_t n = there.receivers.count();
        if (n > most_receivers)
            throw DataError(
                fmt::format("arrivals at {} receivers are wanted, which is outside 1 to "
                            "{}",
                            n, most_receivers));
        pg::check(there);
        if (task.program.empty())
            result.arrivals = our_arrivals(there, task.options);
        else
            result.arrivals =
                external_arrivals(toolbox::parse_program(task.program), there, task.options, run_);
    }

    static std::vector<pg::ReceiverArrivals> our_arrivals(const pg::Environment& there,
                                                          const pg::FieldOptions& options) {
        if (!there.receivers.pairs) return ray_arrivals(there, options);
        return arrivals_at_pairs(
            there, [&](const pg::Environment& grid) { return ray_arrivals(grid, options); });
    }

    pg::Field field_of(const TlTask& task) {
        if (task.program.empty())
            return fields_.compute(task.environment, task.engine, task.options);
        pg::check(task.environment);
        return external_field(toolbox::parse_program(task.program), task.environment, task.options,
                              run_);
    }

    toolbox::ExternalRun run_;
    pg::FieldComputer fields_;
};

/// Results in the order of their tasks, whoever is ready first.
class TlWorkers {
public:
    /// @param jobs  1: computed as they are posted, without a thread
    TlWorkers(std::uint32_t jobs, const toolbox::ExternalRun& run) : run_(run), computer_(run) {
        for (std::uint32_t k = 0; jobs > 1 && k < jobs; ++k)
            threads_.emplace_back([this] { work(); });
    }
    ~TlWorkers() {
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        todo_.notify_all();
        for (std::thread& t : threads_) t.join();
    }
    TlWorkers(const TlWorkers&) = delete;
    TlWorkers& operator=(const TlWorkers&) = delete;

    /// A task, or a result that is there already.
    void post(TlResult given) {
        if (threads_.empty()) {
            if (given.error.empty()) given = computer_.compute(std::move(given.task));
            line_.push_back(std::make_unique<Place>(Place{std::move(given), State::done}));
            return;
        }
        const bool is_done = !given.error.empty();
        const std::lock_guard lock(mutex_);
        line_.push_back(
            std::make_unique<Place>(Place{std::move(given), is_done ? State::done : State::waits}));
        if (!is_done) queue_.push_back(line_.back().get());
        todo_.notify_one();
    }

    /// How many results have not been taken.
    std::size_t pending() const { return line_.size(); }
    std::size_t most_pending() const { return 4 * threads_.size(); }

    /// The oldest result, when it is ready. @pre pending() > 0
    TlResult take() {
        std::unique_lock lock(mutex_);
        done_.wait(lock, [this] { return line_.front()->state == State::done; });
        TlResult result = std::move(line_.front()->result);
        line_.pop_front();
        return result;
    }
    bool is_ready() {
        const std::lock_guard lock(mutex_);
        return !line_.empty() && line_.front()->state == State::done;
    }

private:
    enum class State { waits, done };
    struct Place {
        TlResult result;
        State state;
    };

    void work() {
        TlComputer computer(run_);
        std::unique_lock lock(mutex_);
        for (;;) {
            todo_.wait(lock, [this] { return ends_ || !queue_.empty(); });
            if (ends_) return;
            Place& place = *queue_.front();
            queue_.pop_front();
            lock.unlock();
            TlResult result = computer.compute(place.result.task);
            lock.lock();
            place.result = std::move(result);
            place.state = State::done;
            done_.notify_one();
        }
    }

    const toolbox::ExternalRun run_;
    std::mutex mutex_;
    std::condition_variable todo_, done_;
    std::deque<std::unique_ptr<Place>> line_;
    std::deque<Place*> queue_;
    bool ends_ = false;
    TlComputer computer_;
    std::vector<std::thread> threads_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_WORKERS_HPP
