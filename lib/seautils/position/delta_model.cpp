#include "seautils/position/delta_model.hpp"

#include "seautils/core/error.hpp"
#include "seautils/position/integer_math.hpp"

#include <algorithm>
#include <array>

namespace seautils::position {

namespace {

using entropy::Counts;
using entropy::Symbol;

std::uint32_t end_weight(std::size_t axis) { return axis == 0 ? 1 : 0; }

class CountedModel final : public DeltaModel {
public:
    CountedModel(std::int64_t bound, bool is_adaptive)
        : values_(static_cast<std::size_t>(2 * bound + 1)), is_adaptive_(is_adaptive) {
        for (std::size_t axis = 0; axis < counts_.size(); ++axis) {
            counts_[axis] = counts_of(axis, std::vector<std::uint32_t>(values_, 1));
        }
    }

    std::unique_ptr<DeltaModel> clone() const override {
        return std::make_unique<CountedModel>(*this);
    }
    std::uint32_t total(std::size_t axis) const override { return counts_[axis].total(); }
    Counts::Part part(std::size_t axis, Symbol symbol, std::int64_t) const override {
        return counts_[axis].part(symbol);
    }
    Symbol find(std::size_t axis, std::uint32_t cumulative, std::int64_t) const override {
        return counts_[axis].find(cumulative);
    }
    void learn(std::size_t axis, Symbol symbol) override { counts_[axis].saw(symbol); }

    void save(StateWriter& out) const override {
        if (!is_adaptive_) return;
        for (const Counts& counts : counts_) {
            for (std::size_t k = 0; k < values_; ++k) {
                const auto symbol = entropy::first_value_symbol + static_cast<Symbol>(k);
                out.number(counts.part(symbol).weight);
            }
        }
    }
    void load(StateReader& in) override {
        if (!is_adaptive_) return;
        for (std::size_t axis = 0; axis < counts_.size(); ++axis) {
            std::int64_t left = entropy::max_total_frequency - 1 - end_weight(axis);
            std::vector<std::uint32_t> weights(values_);
            for (std::uint32_t& weight : weights) {
                weight = static_cast<std::uint32_t>(in.number(1, left));
                left -= weight;
            }
            counts_[axis] = counts_of(axis, std::move(weights));
        }
    }

private:
    Counts counts_of(std::size_t axis, std::vector<std::uint32_t> weights) const {
        entropy::Model model;
        model.frequency = std::move(weights);
        model.eof_frequency = end_weight(axis);
        model.out_of_range_frequency = 1;
        model.is_adaptive = is_adaptive_;
        return Counts(model);
    }

    std::size_t values_;
    bool is_adaptive_;
    std::array<Counts, 3> counts_;
};

class GaussianModel final : public DeltaModel {
public:
    explicit GaussianModel(std::int64_t bound) : bound_(bound) {}

    std::unique_ptr<DeltaModel> clone() const override {
        return std::make_unique<GaussianModel>(*this);
    }
    std::uint32_t total(std::size_t axis) const override {
        return end_weight(axis) + 1 + parts + static_cast<std::uint32_t>(values());
    }
    Counts::Part part(std::size_t axis, Symbol symbol, std::int64_t deviation) const override {
        const std::uint32_t begin = below(axis, symbol, deviation);
        return {begin, below(axis, symbol + 1, deviation) - begin};
    }
    Symbol find(std::size_t axis, std::uint32_t cumulative, std::int64_t deviation) const override {
        Symbol least = 0;
        Symbol most = entropy::first_value_symbol + static_cast<Symbol>(values()) - 1;
        while (least < most) {
            const Symbol middle = least + (most - least + 1) / 2;
            if (below(axis, middle, deviation) <= cumulative)
                least = middle;
            else
                most = middle - 1;
        }
        return least;
    }
    void learn(std::size_t, Symbol) override {}
    void save(StateWriter&) const override {}
    void load(StateReader&) override {}

private:
    static constexpr std::uint32_t parts = 1 << 20;

    std::int64_t values() const { return 2 * bound_ + 1; }

    /// Weight of all symbols before this one.
    std::uint32_t below(std::size_t axis, Symbol symbol, std::int64_t deviation) const {
        if (symbol == entropy::eof_symbol) return 0;
        if (symbol == entropy::out_of_range_symbol) return end_weight(axis);
        const std::int64_t value = symbol - entropy::first_value_symbol;
        const std::int64_t least = mass_below(-bound_, deviation);
        const std::int64_t all = mass_below(bound_ + 1, deviation) - least;
        const std::int64_t share = (mass_below(value - bound_, deviation) - least) * parts / all;
        return end_weight(axis) + 1 + static_cast<std::uint32_t>(share + value);
    }
    /// Mass below the lower edge of a delta's cell, in 1/2^24.
    std::int64_t mass_below(std::int64_t delta, std::int64_t deviation) const {
        // Wider ones are level between the bounds, but for the steps of their table.
        const std::int64_t used = std::min(deviation, 2 * bound_ * 65536);
        const std::int64_t t_q14 = (2 * delta - 1) * (std::int64_t{1} << 29) / used;
        return normal_cdf_q24(static_cast<std::int32_t>(clamp(t_q14, -farthest, farthest)));
    }

    static constexpr std::int64_t farthest = 11 << 13;  ///< 5.5 deviations: the end of the table

    std::int64_t bound_;
};

}  // namespace

std::int64_t delta_bound(const CodecOptions& options) {
    const std::int64_t way_mm = options.speed_mmps * options.interval_ms / 1000;
    const std::int64_t bound_mm = std::max<std::int64_t>(50'000, 2 * way_mm);
    const std::int64_t cells = (bound_mm + options.resolution_mm / 2) / options.resolution_mm;
    return std::clamp<std::int64_t>(cells, 1, max_delta);
}

std::unique_ptr<DeltaModel> make_delta_model(CodecOptions::Model model, std::int64_t bound) {
    if (model == CodecOptions::Model::gaussian) return std::make_unique<GaussianModel>(bound);
    return std::make_unique<CountedModel>(bound, model == CodecOptions::Model::adaptive);
}

}  // namespace seautils::position
