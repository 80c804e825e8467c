#include "seautils/position/value_coder.hpp"

namespace seautils::position {

namespace {

constexpr std::int32_t least_mass = 32;     // of 2^24: what no model can exclude
constexpr std::int32_t most_input = 33219;  // 8.11, Q12
constexpr std::int32_t bias = 1229;         // 0.3, Q12

/// ln(yes / no) in Q12.
std::int32_t logit_q12(std::int32_t yes, std::int32_t no) {
    const auto log = [](std::int32_t v) {
        return std::int64_t{log2_q16(static_cast<std::uint64_t>(v) + least_mass)};
    };
    constexpr std::int64_t ln_2_q16 = 45426;
    return static_cast<std::int32_t>(
        clamp((log(yes) - log(no)) * ln_2_q16 >> 20, -most_input, most_input));
}

}  // namespace

ValueCoder::Column ValueCoder::column(std::int32_t edge) const {
    Column c{};
    for (std::size_t k = 0; k < size_; ++k) c[k] = models_[k]->below(edge);
    return c;
}

Mixer::Answer ValueCoder::answer(std::size_t kind, const Column& yes, const Column& all) const {
    Mixer::Inputs inputs{};
    for (std::size_t k = 0; k < size_; ++k)
        if (models_[k]->size() > 0) inputs[k] = logit_q12(yes[k], all[k] - yes[k]);
    inputs[size_] = bias;
    return mixer_.ask(inputs, kind, contexts_, fraction_);
}

ValueCoder::Tree ValueCoder::tree() const {
    Tree t{};
    const Column below = column(upper_edge(centre_ - 1)), until = column(upper_edge(centre_));
    t.centre = answer(0, minus(until, below), whole()).yes;
    t.above = answer(1, minus(whole(), until), minus(whole(), minus(until, below))).yes;
    Column up = until, down = below;
    for (std::int32_t d = 1; d <= singles; ++d) {
        const auto kind = static_cast<std::size_t>(d + 1), k = static_cast<std::size_t>(d - 1);
        const Column further_up = column(edge<1>(d)), further_down = column(edge<-1>(d));
        t.up[k] = answer(kind, minus(further_up, up), minus(whole(), up)).yes;
        t.down[k] = answer(kind, minus(down, further_down), down).yes;
        up = further_up;
        down = further_down;
    }
    return t;
}

}  // namespace seautils::position
