#ifndef SEAUTILS_TDMA_SURVEY_HPP
#define SEAUTILS_TDMA_SURVEY_HPP

#include "seautils/tdma/network.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace seautils::tdma {

/// What many runs came to.
struct Summary {
    std::uint64_t runs = 0;
    std::uint64_t failed = 0;               ///< not everybody knew everybody when the run ended
    std::uint64_t proven = 0;               ///< of these: never will
    std::uint64_t quiet = 0;                ///< runs in whose first two slots nothing got through
    std::uint64_t longest_slots = 0;        ///< until everybody knew everybody
    std::uint64_t total_slots = 0;          ///< the same, summed over the runs that did not fail
    std::uint64_t total_settled_slots = 0;  ///< until all took turns again, likewise

    void add(const Outcome& outcome);
    void add(const Summary& other);
    /// Until everybody knew everybody, over the runs that did not fail; none: all failed.
    std::optional<double> mean_slots() const;
    std::optional<double> mean_settled_slots() const;
};

struct SurveyOptions {
    NetworkOptions network;         ///< each run has its own random numbers, made from the seed
    std::uint64_t start = 0;        ///< slot at which the vehicles start
    std::uint64_t runs = 1;         ///< of each set, from slots start, start + 1, …
    std::uint64_t limit = 100'000;  ///< slots of a run at most
    std::uint64_t first_run = 0;  ///< number of the first run, which decides on its random numbers
};

/// Runs one set of vehicles.
void survey(const std::vector<int>& addresses, const SurveyOptions& options, Summary& summary);

/// Calls `visit` for each set of `size` of the numbers `first` to `last`, in lexical order.
/// @throws DataError  `size` is outside 1 to their number
void for_each_subset(std::size_t size, int first, int last,
                     const std::function<void(const std::vector<int>&)>& visit);

/// How many sets that are; 2^64 - 1 where it is more.
std::uint64_t count_subsets(std::size_t size, int first, int last);

/// Runs `count` sets of `size` of the addresses `first` to `last`, each drawn at random, as is the
/// even slot at which it starts; start, runs and first_run of the options have no say.
/// @throws DataError  `size` is outside 1 to the number of addresses
/// Check value: sets of 3 of 1 to 127, C = 3, p_collide = 0.75: 24.606 % are quiet (figure 2.11).
Summary survey_drawn(std::uint64_t count, std::size_t size, int first, int last,
                     const SurveyOptions& options);

}  // namespace seautils::tdma

#endif  // SEAUTILS_TDMA_SURVEY_HPP
