#include "seautils/tdma/survey.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace seautils::tdma {

namespace {

std::size_t check_size(std::size_t size, int first, int last) {
    const std::size_t pool = last < first ? 0 : static_cast<std::size_t>(last - first + 1);
    if (size < 1 || size > pool)
        throw DataError(fmt::format("{} of {} addresses is no set", size, pool));
    return pool;
}

std::optional<double> mean(std::uint64_t total, std::uint64_t count) {
    if (count == 0) return std::nullopt;
    return static_cast<double>(total) / static_cast<double>(count);
}

/// The first `size` of the pool, shuffled into place (Fisher and Yates).
std::vector<int> draw(std::size_t size, std::vector<int>& pool, SplitMix64& random) {
    for (std::size_t k = 0; k < size; ++k)
        std::swap(pool[k], pool[k + random.below(pool.size() - k)]);
    return {pool.begin(), pool.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace

void Summary::add(const Outcome& outcome) {
    ++runs;
    if (outcome.was_quiet) ++quiet;
    if (!outcome.succeeded) ++failed;
    if (outcome.is_proven) ++proven;
    longest_slots = std::max(longest_slots, outcome.known_slots);
    total_slots += outcome.known_slots;
    total_settled_slots += outcome.settled_slots;
}

void Summary::add(const Summary& other) {
    runs += other.runs;
    failed += other.failed;
    proven += other.proven;
    quiet += other.quiet;
    longest_slots = std::max(longest_slots, other.longest_slots);
    total_slots += other.total_slots;
    total_settled_slots += other.total_settled_slots;
}

std::optional<double> Summary::mean_slots() const { return mean(total_slots, runs - failed); }

std::optional<double> Summary::mean_settled_slots() const {
    return mean(total_settled_slots, runs - failed);
}

void survey(const std::vector<int>& addresses, const SurveyOptions& options, Summary& summary) {
    NetworkOptions own = options.network;
    for (std::uint64_t k = 0; k < options.runs; ++k) {
        own.seed = splitmix64(options.network.seed) ^ (options.first_run + k);
        Network network(addresses, options.start + k, own);
        summary.add(run(network, options.limit));
    }
}

void for_each_subset(std::size_t size, int first, int last,
                     const std::function<void(const std::vector<int>&)>& visit) {
    check_size(size, first, last);
    std::vector<int> set(size);
    std::iota(set.begin(), set.end(), first);
    for (;;) {
        visit(set);
        // The last member that can still grow does, and those behind it follow right after it.
        std::size_t k = size;
        while (k > 0 && set[k - 1] == last - static_cast<int>(size - k)) --k;
        if (k == 0) return;
        std::iota(set.begin() + static_cast<std::ptrdiff_t>(k - 1), set.end(), set[k - 1] + 1);
    }
}

std::uint64_t count_subsets(std::size_t size, int first, int last) {
    const std::size_t pool = check_size(size, first, last);
    std::uint64_t count = 1;
    for (std::size_t k = 1; k <= std::min(size, pool - size); ++k) {
        const std::uint64_t factor = pool - k + 1;
        if (count > std::numeric_limits<std::uint64_t>::max() / factor)
            return std::numeric_limits<std::uint64_t>::max();
        count = count * factor / k;
    }
    return count;
}

Summary survey_drawn(std::uint64_t count, std::size_t size, int first, int last,
                     const SurveyOptions& options) {
    std::vector<int> pool(check_size(size, first, last));
    std::iota(pool.begin(), pool.end(), first);
    SplitMix64 random(options.network.seed);
    Summary summary;
    SurveyOptions one = options;
    one.runs = 1;
    for (std::uint64_t k = 0; k < count; ++k) {
        one.start = 2 * random.below(std::uint64_t{5040} * options.network.excitation.coolness);
        one.first_run = k;
        survey(draw(size, pool, random), one, summary);
    }
    return summary;
}

}  // namespace seautils::tdma
