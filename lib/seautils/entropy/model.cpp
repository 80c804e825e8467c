#include "seautils/entropy/model.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace seautils::entropy {

namespace {

[[noreturn]] void refuse(const Model& model, const std::string& what) {
    throw ConfigError(fmt::format("arithmetic model {}: {}", quote(model.name), what));
}

void check_bounds(const Model& model) {
    const std::vector<double>& bound = model.value_bound;
    if (bound.size() != model.frequency.size() + 1) {
        refuse(model,
               fmt::format("{} bounds for {} frequencies, where there must be {}", bound.size(),
                           model.frequency.size(), model.frequency.size() + 1));
    }
    for (const double b : bound) {
        if (!std::isfinite(b)) refuse(model, fmt::format("bound '{}' is not finite", b));
    }
    const auto bad = std::adjacent_find(bound.begin(), bound.end(), std::greater_equal<>());
    if (bad != bound.end()) {
        refuse(model, fmt::format("bound '{}' does not exceed '{}' before it", bad[1], bad[0]));
    }
}

}  // namespace

std::uint64_t Model::total_frequency() const {
    std::uint64_t total = std::uint64_t{eof_frequency} + out_of_range_frequency;
    for (const std::uint32_t f : frequency) total += f;
    return total;
}

void check(const Model& model) {
    if (model.name.empty()) throw ConfigError("an arithmetic model has no name");
    if (model.frequency.empty()) refuse(model, "no frequency");
    const auto zero = std::find(model.frequency.begin(), model.frequency.end(), 0U);
    if (zero != model.frequency.end()) {
        refuse(model, fmt::format("frequency {} is 0", zero - model.frequency.begin()));
    }
    if (const std::uint64_t total = model.total_frequency(); total > max_total_frequency) {
        refuse(model, fmt::format("frequencies sum to {}, above {}", total, max_total_frequency));
    }
    check_bounds(model);
}

Symbol symbol_of(const Model& model, double value) {
    if (std::isnan(value)) throw DataError("'nan' is not a number");
    const std::vector<double>& bound = model.value_bound;
    if (value < bound.front() || value >= bound.back()) return out_of_range_symbol;
    const auto above = std::upper_bound(bound.begin(), bound.end(), value);
    const double a = above[-1];
    const double b = above[0];
    const double square = value * value;
    const bool nearer_a = std::abs(a * a - square) < std::abs(b * b - square);
    const auto index = static_cast<std::size_t>(above - bound.begin()) - (nearer_a ? 1 : 0);
    if (index == model.frequency.size()) return out_of_range_symbol;
    return first_value_symbol + static_cast<Symbol>(index);
}

double value_of(const Model& model, Symbol symbol) {
    if (symbol < first_value_symbol) return std::numeric_limits<double>::quiet_NaN();
    return model.value_bound[symbol - first_value_symbol];
}

Counts::Counts(const Model& model)
    : tree_(model.frequency.size() + first_value_symbol + 1),
      top_step_(std::bit_floor(static_cast<std::uint32_t>(tree_.size() - 1))),
      adaptive_(model.is_adaptive) {
    add(eof_symbol, model.eof_frequency);
    add(out_of_range_symbol, model.out_of_range_frequency);
    Symbol symbol = first_value_symbol;
    for (const std::uint32_t f : model.frequency) add(symbol++, f);
}

void Counts::add(Symbol symbol, std::uint32_t weight) {
    total_ += weight;
    for (std::size_t k = symbol + 1; k < tree_.size(); k += k & (~k + 1)) tree_[k] += weight;
}

std::uint32_t Counts::below(Symbol symbol) const {
    std::uint32_t sum = 0;
    for (std::size_t k = symbol; k > 0; k &= k - 1) sum += tree_[k];
    return sum;
}

Counts::Part Counts::part(Symbol symbol) const {
    const std::uint32_t begin = below(symbol);
    return {begin, below(symbol + 1) - begin};
}

Symbol Counts::find(std::uint32_t cumulative) const {
    std::uint32_t at = 0;
    for (std::uint32_t step = top_step_; step > 0; step /= 2) {
        if (at + step >= tree_.size() || tree_[at + step] > cumulative) continue;
        at += step;
        cumulative -= tree_[at];
    }
    return at;
}

void Counts::saw(Symbol symbol) {
    if (adaptive_ && total_ < max_total_frequency) add(symbol, 1);
}

}  // namespace seautils::entropy
