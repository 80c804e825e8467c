#ifndef SEAUTILS_POSITION_PREDICTORS_HPP
#define SEAUTILS_POSITION_PREDICTORS_HPP

#include "seautils/position/analogs.hpp"
#include "seautils/position/mixture.hpp"
#include "seautils/position/motion.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

/// The models whose opinions are mixed. Each gives, of the motion so far, a mixture of normal
/// distributions of the next step, and learns from the step that came.
namespace seautils::position {

/// Errors along z, of the usual one: 0.5, 0.9, 1.7, 4.
inline constexpr std::array<std::int32_t, 4> depth_scales{128, 230, 435, 1024};
inline constexpr std::int64_t filter_rate_q8 = 13;  ///< of a filter's running mean square

/// Shares of some alternatives that are learnt: Q20, together 1.
template <std::size_t N>
class Shares {
public:
    Shares() { share_.fill(one_q20 / static_cast<std::int32_t>(N)); }
    std::int32_t operator[](std::size_t k) const { return share_[k]; }

    /// Moves them towards `seen` by rate / 65536, and keeps each above least / N.
    void follow(const std::array<std::int32_t, N>& seen, std::int32_t rate,
                std::int32_t least_q20) {
        for (std::size_t k = 0; k < N; ++k) {
            std::int64_t moved = share_[k] + ((std::int64_t{seen[k]} - share_[k]) * rate >> 16);
            moved -= moved * least_q20 >> 20;
            share_[k] = static_cast<std::int32_t>(moved) + least_q20 / static_cast<std::int32_t>(N);
        }
    }

    template <class Archive>
    void archive(Archive& a) {
        for (auto& s : share_) a.number(s, 0, one_q20);
    }

private:
    std::array<std::int32_t, N> share_;
};

/// The square of a length of 1/256 cell; more than 2^16 cells count as that.
inline std::int64_t square(std::int64_t length) {
    const std::int64_t v = clamp(length, -(1 << 24), 1 << 24);
    return v * v;
}

/// A running mean of squares of lengths of 1/256 cell.
class MeanSquare {
public:
    explicit MeanSquare(std::int64_t first = 1 << 16, std::int64_t least = 1 << 11)
        : value_(first), least_(least) {}
    /// @param rate_q8  weight of the new one
    void take(std::int64_t square, std::int64_t rate_q8) {
        const std::int64_t most = 9 * value_ + 19661;  // 0.3 cell²
        square = square > most ? most : square;
        value_ += (square - value_) * rate_q8 / 256;
        value_ = value_ < least_ ? least_ : value_;
    }
    /// Before anything is taken: lengths are so many times longer. At most 2^20 (factor 2^10).
    void widen(std::int64_t square_of_times) { value_ *= square_of_times; }
    std::int32_t root() const {
        return static_cast<std::int32_t>(square_root(static_cast<std::uint64_t>(value_)));
    }

    template <class Archive>
    void archive(Archive& a) {
        a.number(value_, least_, std::int64_t{1} << 48);
    }

private:
    std::int64_t value_, least_;
};

/// Over the plane, what a filter expects, with errors along and across of nine sizes.
class FilterModel {
public:
    PlaneMixture predict(const Motion& motion, Pair expected) const;
    void learn(const Motion& motion, Pair expected, const PlaneMixture& said, const Cell& step);
    void widen(std::int64_t square_of_times) {
        for (MeanSquare* m : {&along_, &across_, &first_}) m->widen(square_of_times);
    }

    template <class Archive>
    void archive(Archive& a) {
        a.all(along_, across_, first_, shares_);
    }

private:
    MeanSquare along_, across_, first_{225 << 16};
    Shares<9> shares_;
};

/// Where turns end: by 24 angles from the heading, straight on, and anywhere.
class TurnModel {
public:
    static constexpr std::size_t angles = 12, ends = 2 * angles + 2;
    TurnModel();
    PlaneMixture predict(const Motion& motion) const;
    void learn(const Motion& motion, const PlaneMixture& said, const Cell& step);

    template <class Archive>
    void archive(Archive& a) {
        for (auto& context : counts_)
            for (auto& c : context) a.number(c, 0, 1 << 28);
        for (auto& r : ratio_) a.number(r, 0, 1 << 20);
        a.number(speed_, 0, 1 << 28);
    }

private:
    std::array<std::array<std::int32_t, ends>, 12> counts_{};  ///< Q14
    std::array<std::int32_t, angles> ratio_{};  ///< of the step to the usual one, Q12
    std::int32_t speed_ = 0;                    ///< usual step, 1/256 cell
};

/// What came after similar situations.
class AnalogModel {
public:
    enum class Kind { path, innovation, world, place };

    AnalogModel(Kind kind, std::size_t capacity);
    /// Empty: nothing is known yet.
    PlaneMixture predict(const Motion& motion);
    void learn(const Motion& motion, const PlaneMixture& said, const Cell& step);
    void widen(std::int64_t square_of_times) { error_.widen(square_of_times); }

    template <class Archive>
    void archive(Archive& a) {
        a.all(memory_, error_, shares_);
    }

private:
    struct View {
        Features features;
        Direction frame;
        Pair base;  ///< where an outcome counts from, 1/256 cell
        bool usable;
    };
    View view(const Motion& motion) const;

    Kind kind_;
    Analogs memory_;
    MeanSquare error_{1 << 18};
    Shares<3> shares_;
};

/// Along z, what a filter expects, or the last value, with errors of four sizes.
class DepthModel {
public:
    Mixture predict(std::int32_t expected) const;
    void learn(std::int32_t expected, const Mixture& said, std::int32_t step);
    void widen(std::int64_t square_of_times) { error_.widen(square_of_times); }

    template <class Archive>
    void archive(Archive& a) {
        a.all(error_, shares_);
    }

private:
    MeanSquare error_;
    Shares<4> shares_;
};

/// Along z, what came after similar situations.
class DepthAnalogModel {
public:
    explicit DepthAnalogModel(std::size_t capacity) : memory_(capacity, 4, false, 4) {}
    Mixture predict(const Motion& motion);
    void learn(const Motion& motion, const Mixture& said, std::int32_t step);
    void widen(std::int64_t square_of_times) { error_.widen(square_of_times); }

    template <class Archive>
    void archive(Archive& a) {
        a.all(memory_, error_, shares_);
    }

private:
    static Features view(const Motion& motion);

    Analogs memory_;
    MeanSquare error_;
    Shares<3> shares_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_PREDICTORS_HPP
