#ifndef SEAUTILS_POSITION_MIXER_HPP
#define SEAUTILS_POSITION_MIXER_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace seautils::position {

/// Joins what several models say of a yes-or-no question into one probability, and learns whom to
/// believe: three networks of one layer in the logistic domain, each with weights for its own context,
/// a fourth that joins them, and a table that corrects its answer. After M. Mahoney, "Adaptive weighing
/// of context models for lossless data compression", Florida Tech CS-2005-16 (2005).
class Mixer {
public:
    static constexpr std::size_t most_inputs = 10;  ///< the bias included
    static constexpr std::size_t networks = 3;
    static constexpr std::size_t kinds = 15;     ///< of questions
    static constexpr std::size_t fractions = 9;  ///< places within a cell that an answer depends on

    /// What the models say: logits of "yes", Q12; 0 of a model that has no opinion.
    using Inputs = std::array<std::int32_t, most_inputs>;
    using Contexts = std::array<std::size_t, networks>;

    /// One question and its answer, kept to learn from.
    struct Answer {
        std::size_t kind = 0, cell = 0;
        Contexts set{};
        Inputs inputs{};
        std::array<std::int32_t, networks> logit{};  ///< of each network, Q12
        std::int32_t joined = 0;                     ///< probability before the table, Q16
        std::int32_t above_q8 = 0;                   ///< place between two cells of the table
        std::int32_t yes = 0;                        ///< the probability, 13 to 65523, Q16
    };

    Mixer() = default;
    /// @param inputs    how many of Inputs are used, the bias included
    /// @param contexts  how many each network has
    Mixer(std::size_t inputs, const Contexts& contexts);

    /// @param context   of each network, below its count
    /// @param fraction  0 to fractions - 1
    Answer ask(const Inputs& inputs, std::size_t kind, const Contexts& context,
               std::size_t fraction) const;
    void learn(const Answer& answer, bool yes);

    template <class Archive>
    void archive(Archive& a) {
        for (auto& network : networks_) {
            for (auto& w : network.weight) a.number(w, -most_weight, most_weight);
            for (auto& s : network.seen) a.number(s);
        }
        for (auto& w : joining_) a.number(w, -most_weight, most_weight);
        for (auto& p : corrected_) a.number(p, 1, 65535);
    }

private:
    struct Network {
        std::vector<std::int32_t> weight;  ///< inputs of each set of weights, Q16
        std::vector<std::uint16_t> seen;   ///< how often each set has learnt
    };
    static constexpr std::int32_t most_weight = 1 << 22;
    static constexpr std::size_t steps = 24;  ///< of the table, of 0.7 each

    std::size_t inputs_ = 0;
    std::array<Network, networks> networks_;
    std::vector<std::int32_t> joining_;     ///< weights of the three, of each kind, Q16
    std::vector<std::uint16_t> corrected_;  ///< probabilities of each kind, fraction and step, Q16
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_MIXER_HPP
