#include "seautils/entropy/arithmetic.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seautils::entropy {

namespace {

std::uint64_t ceil_bits(double bits) {
    return bits > 0 ? static_cast<std::uint64_t>(std::ceil(bits)) : 0;
}

}  // namespace

Symbol coded_symbol(const Model& model, double value, bool lenient) {
    const Symbol symbol = symbol_of(model, value);
    if (symbol != out_of_range_symbol || model.out_of_range_frequency > 0) return symbol;
    if (lenient) return require_eof(model);
    throw DataError(fmt::format("'{}' is outside {} to {} of arithmetic model {}", value,
                                model.value_bound.front(),
                                model.value_bound[model.frequency.size() - 1], quote(model.name)));
}

Symbol require_eof(const Model& model) {
    if (model.eof_frequency > 0) return eof_symbol;
    throw DataError(fmt::format("too few values, and arithmetic model {} has eof_frequency 0",
                                quote(model.name)));
}

std::uint64_t min_bits(const Model& model, std::uint32_t max_count) {
    if (model.is_adaptive) return 0;
    const double total = std::log2(static_cast<double>(model.total_frequency()));
    const std::uint32_t most =
        std::max(model.out_of_range_frequency, *std::ranges::max_element(model.frequency));
    const std::uint64_t full = ceil_bits(max_count * (total - std::log2(most)));
    if (model.eof_frequency == 0) return full;
    return std::min(full, ceil_bits(total - std::log2(model.eof_frequency)));
}

std::uint64_t max_bits(const Model& model, std::uint32_t max_count) {
    const double total = std::log2(static_cast<double>(model.total_frequency()));
    std::uint32_t least = *std::ranges::min_element(model.frequency);
    if (model.out_of_range_frequency > 0) least = std::min(least, model.out_of_range_frequency);
    const double rare = std::log2(least);
    const std::uint64_t full = ceil_bits(max_count * (total - rare));
    if (model.eof_frequency == 0 || max_count == 0) return full + 1;
    const double ended =
        max_count * total - (max_count - 1) * rare - std::log2(model.eof_frequency);
    return std::max(full, ceil_bits(ended)) + 1;
}

}  // namespace seautils::entropy
