#include "seautils/position/mixer.hpp"

#include "seautils/position/integer_math.hpp"

namespace seautils::position {

namespace {

constexpr std::int32_t most_logit = 12 << 12;
constexpr std::int32_t first_weight = 78643;     // 1.2, shared among the inputs
constexpr std::int32_t step_q12 = 2867;          // 0.7
constexpr std::int32_t learning_rate = 590;      // 0.009
constexpr std::int32_t joining_rate = 131;       // 0.002
constexpr std::int32_t correcting_rate = 5243;   // 0.08
constexpr std::int32_t corrected_share = 22938;  // 0.35
constexpr std::uint16_t most_seen = 65535;

std::int32_t bounded(std::int64_t v, std::int32_t most) {
    return static_cast<std::int32_t>(clamp(v, -most, most));
}

/// Moves a weight by rate * error * input: Q16, Q16 and Q12.
void move(std::int32_t& weight, std::int64_t rate, std::int64_t error, std::int64_t input,
          std::int32_t most_weight) {
    weight = bounded(weight + round_shift(rate * error * input, 28), most_weight);
}

}  // namespace

Mixer::Mixer(std::size_t inputs, const Contexts& contexts) : inputs_(inputs) {
    for (std::size_t n = 0; n < networks; ++n) {
        networks_[n].weight.assign(contexts[n] * kinds * inputs,
                                   first_weight / static_cast<std::int32_t>(inputs - 1));
        networks_[n].seen.assign(contexts[n] * kinds, 0);
    }
    joining_.assign(kinds * networks, 65536 / 3);
    for (std::size_t k = 0; k < kinds * fractions; ++k) {
        for (std::size_t s = 0; s <= steps; ++s) {
            const auto logit =
                (static_cast<std::int32_t>(s) - static_cast<std::int32_t>(steps) / 2) * step_q12;
            corrected_.push_back(
                static_cast<std::uint16_t>(clamp(probability_q16(logit), 1, 65535)));
        }
    }
}

Mixer::Answer Mixer::ask(const Inputs& inputs, std::size_t kind, const Contexts& context,
                         std::size_t fraction) const {
    Answer a;
    a.kind = kind;
    a.inputs = inputs;
    std::int64_t joined = 0;
    for (std::size_t n = 0; n < networks; ++n) {
        a.set[n] = context[n] * kinds + kind;
        const std::int32_t* const weight = &networks_[n].weight[a.set[n] * inputs_];
        std::int64_t sum = 0;
        for (std::size_t k = 0; k < inputs_; ++k) sum += std::int64_t{weight[k]} * inputs[k];
        a.logit[n] = bounded(sum >> 16, most_logit);
        joined += std::int64_t{joining_[kind * networks + n]} * a.logit[n];
    }
    const std::int32_t logit = bounded(joined >> 16, most_logit);
    a.joined = probability_q16(logit);
    constexpr std::int32_t edge = static_cast<std::int32_t>(steps) / 2 * step_q12;
    const std::int32_t at = bounded(logit, edge - 1) + edge;
    a.cell = (kind * fractions + fraction) * (steps + 1) + static_cast<std::size_t>(at / step_q12);
    a.above_q8 = at % step_q12 * 256 / step_q12;
    const std::int32_t low = corrected_[a.cell], high = corrected_[a.cell + 1];
    const std::int32_t corrected = low + ((high - low) * a.above_q8 >> 8);
    a.yes = static_cast<std::int32_t>(clamp(
        a.joined + ((corrected - a.joined) * std::int64_t{corrected_share} >> 16), 13, 65523));
    return a;
}

void Mixer::learn(const Answer& a, bool yes) {
    const std::int32_t truth = yes ? 65536 : 0;
    const std::int32_t joined_error = truth - a.joined;
    for (std::size_t n = 0; n < networks; ++n) {
        std::uint16_t& seen = networks_[n].seen[a.set[n]];
        const std::int64_t rate = learning_rate + learning_rate * 120 / (20 + seen);
        const std::int32_t error = truth - probability_q16(a.logit[n]);
        std::int32_t* const weight = &networks_[n].weight[a.set[n] * inputs_];
        for (std::size_t k = 0; k < inputs_; ++k)
            move(weight[k], rate, error, a.inputs[k], most_weight);
        if (seen < most_seen) ++seen;
        move(joining_[a.kind * networks + n], joining_rate, joined_error, a.logit[n], most_weight);
    }
    const std::size_t nearest = a.cell + (a.above_q8 >= 128 ? 1 : 0);
    std::uint16_t& p = corrected_[nearest];
    p = static_cast<std::uint16_t>(
        clamp(p + ((truth - p) * std::int64_t{correcting_rate} >> 16), 16, 65520));
}

}  // namespace seautils::position
