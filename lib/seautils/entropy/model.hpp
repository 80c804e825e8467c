#ifndef SEAUTILS_ENTROPY_MODEL_HPP
#define SEAUTILS_ENTROPY_MODEL_HPP

#include <cstdint>
#include <string>
#include <vector>

namespace seautils::entropy {

/// How often each value is expected: what both ends of an arithmetic code must agree on.
struct Model {
    std::string name;
    std::vector<std::uint32_t> frequency;  ///< weight of each of k values
    std::uint32_t eof_frequency = 1;       ///< weight of "no more values"; 0: no such symbol
    /// Weight of "none of these"; 0: no such symbol.
    std::uint32_t out_of_range_frequency = 0;
    std::vector<double> value_bound;  ///< k + 1 of them; symbol i stands for value_bound[i]
    bool is_adaptive = false;         ///< weights grow by 1 with each symbol coded

    std::uint64_t total_frequency() const;  ///< of all symbols, as stated here
};

/// The weights of a model may sum up to this, so that no symbol's share of the interval is empty.
inline constexpr std::uint32_t max_total_frequency = (1U << 30) - 1;

/// @throws ConfigError  no name; no value; a weight of 0; weights that sum to more than
///                      max_total_frequency; not one bound more than weights; bounds that are not
///                      finite or do not increase
void check(const Model& model);

/// A symbol is its place in the cumulative order: these two, then value 0, 1, …
using Symbol = std::uint32_t;
inline constexpr Symbol eof_symbol = 0;
inline constexpr Symbol out_of_range_symbol = 1;
inline constexpr Symbol first_value_symbol = 2;

/// The symbol that stands for a value: with neighbouring bounds a <= v < b it is a's if
/// |a² - v²| < |b² - v²|, else b's. Below the first bound, above the last one, or when it is the
/// last bound's (which has no weight): out_of_range_symbol.
/// @throws DataError  not a number
Symbol symbol_of(const Model& model, double value);

/// What a value's symbol stands for; a NaN for out_of_range_symbol and eof_symbol.
double value_of(const Model& model, Symbol symbol);

/// Cumulative weights of one model in one direction. A value: copy it to try something out. Of an
/// adaptive model, an encoder and a decoder each keep their own from message to message.
class Counts {
public:
    Counts() = default;
    /// @param model  checked
    explicit Counts(const Model& model);

    /// A symbol's part of the total: [below, below + weight) of [0, total).
    struct Part {
        std::uint32_t below, weight;
    };
    std::uint32_t total() const { return total_; }
    Part part(Symbol symbol) const;
    /// The symbol whose part holds `cumulative`, which is less than the total.
    Symbol find(std::uint32_t cumulative) const;

    /// Adds 1 to a symbol's weight if the model is adaptive. From max_total_frequency on the
    /// weights stay as they are, in both directions alike.
    void saw(Symbol symbol);

private:
    std::uint32_t below(Symbol symbol) const;
    void add(Symbol symbol, std::uint32_t weight);

    std::vector<std::uint32_t> tree_;  ///< Fenwick tree, from 1
    std::uint32_t total_ = 0;
    std::uint32_t top_step_ = 0;  ///< greatest power of 2 that is an index of the tree
    bool adaptive_ = false;
};

}  // namespace seautils::entropy

#endif  // SEAUTILS_ENTROPY_MODEL_HPP
