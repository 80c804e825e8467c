#ifndef SEAUTILS_POSITION_ANALOGS_HPP
#define SEAUTILS_POSITION_ANALOGS_HPP

#include "seautils/position/integer_math.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seautils::position {

/// What a situation looked like, 1/16 of a cell; those that a memory does not use are 0. The last two
/// change their sign where left and right are exchanged.
struct Features {
    static constexpr std::size_t most = 5;
    std::array<std::int32_t, most> value{};
};

/// The last situations and what came of each: the most similar ones tell what may come of the present
/// one. Forecasting by analogs: E. N. Lorenz, J. Atmos. Sci. 26(4), 636-646 (1969).
///
/// How far a situation is from the present one: the sum of the squared differences of the features,
/// cells², and 1/2048 for each situation since.
class Analogs {
public:
    static constexpr std::size_t most_found = 16;
    static constexpr std::int32_t most_feature = 8191;  ///< 512 cells; what is more counts as that
    static constexpr std::int32_t most_outcome = 1 << 27;  ///< the same
    struct Found {
        std::int32_t distance;  ///< 1/256 cell²
        Pair outcome;
    };

    Analogs() = default;
    /// @param capacity  situations that are kept, 1 to 4096
    /// @param features  how many are used, 1 to Features::most
    /// @param mirrored  whether each also stands for its mirror image (0.3 cells² further off), in which
    ///                  the features from `first_across` on and the outcome's y have the other sign
    Analogs(std::size_t capacity, std::size_t features, bool mirrored, std::size_t first_across);

    void remember(const Features& situation, Pair outcome);
    /// The nearest ones, the nearest first; equally near ones by age, the younger first.
    /// @param found  room for as many as are wanted, at most most_found
    /// @return       how many were found
    std::size_t find(const Features& situation, std::span<Found> found) const;

    std::size_t size() const { return size_; }

    template <class Archive>
    void archive(Archive& a) {
        a.count(size_, capacity_);
        a.count(next_, capacity_ - 1);
        for (auto& column : feature_)
            for (std::size_t k = 0; k < size_; ++k)
                a.number(column[k], -most_feature, most_feature);
        for (std::size_t k = 0; k < size_; ++k) {
            a.number(outcome_[k].x, -most_outcome, most_outcome);
            a.number(outcome_[k].y, -most_outcome, most_outcome);
        }
    }

private:
    void measure(const Features& situation, std::vector<std::int32_t>& distance,
                 bool mirrored) const;

    std::size_t capacity_ = 0, first_across_ = Features::most;
    bool mirrored_ = false;
    std::size_t size_ = 0, next_ = 0;
    std::vector<std::vector<std::int16_t>> feature_;
    std::vector<Pair> outcome_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_ANALOGS_HPP
