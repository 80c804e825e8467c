#ifndef SEAUTILS_POSITION_VALUE_CODER_HPP
#define SEAUTILS_POSITION_VALUE_CODER_HPP

#include "seautils/position/cell.hpp"
#include "seautils/position/mixer.hpp"
#include "seautils/position/mixture.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace seautils::position {

/// What several models say of one value, and the questions that find it: is it the centre? above it?
/// one off, two off … six off? Then by ranges that double, and halving within.
class ValueCoder {
public:
    static constexpr std::int32_t singles =
        6;  ///< distances from the centre with questions of their own

    /// @param centre  1/256 cell
    ValueCoder(std::int32_t centre, Mixer& mixer, const Mixer::Contexts& contexts)
        : mixer_(mixer), contexts_(contexts), centre_((centre + 128) >> 8) {
        fraction_ = static_cast<std::size_t>((centre - centre_ * 256 + 128) * 9 >> 8);
    }
    void add(const Mixture& model) { models_[size_++] = &model; }

    std::int32_t centre() const { return centre_; }

    /// Asks until the value is found.
    /// @param  decide  bool decide(std::int32_t yes_q16, std::int32_t least, std::int32_t most): whether
    ///                 the value is from least to most, which is expected with a probability
    /// @param  learn   whether the mixer learns each answer
    /// @return         the value, or what is beyond every limit
    template <class Decide>
    std::int32_t find(Decide decide, bool learn = true) {
        const Column below = column(upper_edge(centre_ - 1)), until = column(upper_edge(centre_));
        if (ask(0, minus(until, below), whole(), centre_, centre_, decide, learn)) return centre_;
        const bool above = ask(1, minus(whole(), until), minus(whole(), minus(until, below)),
                               centre_ + 1, INT32_MAX, decide, learn);
        return above ? outwards<1>(until, decide, learn) : outwards<-1>(below, decide, learn);
    }

    /// The probabilities in Q16 of what find() asks first, nothing learnt: is it the centre, is it above,
    /// and for each side, is it 1, 2, … 6 off.
    struct Tree {
        std::int32_t centre, above;
        std::array<std::int32_t, singles> up, down;
    };
    Tree tree() const;

private:
    using Column = std::array<std::int32_t, Mixer::most_inputs>;  ///< a number of each model
    static constexpr std::int32_t beyond = 1 << 24;

    Column column(std::int32_t edge) const;
    static Column whole() {
        Column c;
        c.fill(one_q24);
        return c;
    }
    static Column minus(Column a, const Column& b) {
        for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
        return a;
    }
    Mixer::Answer answer(std::size_t kind, const Column& yes, const Column& all) const;

    template <class Decide>
    bool ask(std::size_t kind, const Column& yes, const Column& all, std::int32_t least,
             std::int32_t most, Decide& decide, bool learn) {
        const Mixer::Answer a = answer(kind, yes, all);
        const bool is = decide(a.yes, least, most);
        if (learn) mixer_.learn(a, is);
        return is;
    }

    /// The edge beyond the cell that is so far from the centre, on one side.
    template <int side>
    std::int32_t edge(std::int32_t distance) const {
        return upper_edge(side > 0 ? centre_ + distance : centre_ - distance - 1);
    }
    /// What lies between two edges of that side, the nearer one first.
    template <int side>
    static Column between(const Column& near, const Column& far) {
        return side > 0 ? minus(far, near) : minus(near, far);
    }

    /// @param near  what is below the edge of the centre's cell, on that side
    template <int side, class Decide>
    std::int32_t outwards(Column near, Decide& decide, bool learn) {
        std::int32_t least = 1, width = 1;
        for (std::size_t kind = 2; least < beyond; ++kind) {
            const std::int32_t most = least + width - 1;
            const Column far = column(edge<side>(most));
            const Column rest = between<side>(near, side > 0 ? whole() : Column{});
            if (ask(kind < 14 ? kind : 13, between<side>(near, far), rest, cell<side>(least, most),
                    cell<side>(most, least), decide, learn))
                return within<side>(least, most, near, far, decide, learn);
            near = far;
            least = most + 1;
            width = most < singles ? 1 : most == singles ? 4 : 2 * width;
        }
        return side * beyond;
    }

    template <int side, class Decide>
    std::int32_t within(std::int32_t least, std::int32_t most, Column near, Column far,
                        Decide& decide, bool learn) {
        while (least < most) {
            const std::int32_t middle = (least + most) / 2;
            const Column half = column(edge<side>(middle));
            if (ask(14, between<side>(half, far), between<side>(near, far),
                    cell<side>(middle + 1, most), cell<side>(most, middle + 1), decide, learn)) {
                least = middle + 1;
                near = half;
            } else {
                most = middle;
                far = half;
            }
        }
        return centre_ + side * least;
    }
    /// The lower one of two cells at these distances.
    template <int side>
    std::int32_t cell(std::int32_t if_above, std::int32_t if_below) const {
        return side > 0 ? centre_ + if_above : centre_ - if_below;
    }

    Mixer& mixer_;
    Mixer::Contexts contexts_;
    std::array<const Mixture*, Mixer::most_inputs> models_{};
    std::size_t size_ = 0;
    std::int32_t centre_ = 0;
    std::size_t fraction_ = 0;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_VALUE_CODER_HPP
