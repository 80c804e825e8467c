#ifndef SEAUTILS_ENTROPY_ARITHMETIC_HPP
#define SEAUTILS_ENTROPY_ARITHMETIC_HPP

#include "seautils/entropy/model.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seautils::entropy {

/// Fewest and most bits that a run of at most `max_count` values takes, from the weights as the
/// model states them (an adaptive one may drift above the most).
std::uint64_t min_bits(const Model& model, std::uint32_t max_count);
std::uint64_t max_bits(const Model& model, std::uint32_t max_count);

/// The symbol that encode_run puts for a value.
/// @throws DataError  as symbol_of and encode_run say
Symbol coded_symbol(const Model& model, double value, bool lenient);

/// eof_symbol. @throws DataError  the model has none
Symbol require_eof(const Model& model);

namespace detail {

inline constexpr std::uint64_t top = 0xFFFFFFFF;
inline constexpr std::uint64_t quarter = std::uint64_t{1} << 30;
inline constexpr std::uint64_t half = 2 * quarter;

/// What is left of the interval of codes, 32 bits wide, both ends included.
struct Interval {
    std::uint64_t low = 0, high = top;

    std::uint64_t range() const { return high - low + 1; }
    /// One past the last code of the cumulative weight.
    std::uint64_t end(std::uint64_t cumulative, std::uint64_t total) const {
        return low + range() * cumulative / total;
    }
    void narrow(Counts::Part part, std::uint64_t total) {
        const std::uint64_t begin = end(part.below, total);
        high = end(std::uint64_t{part.below} + part.weight, total) - 1;
        low = begin;
    }
    /// Whether doubling is due, and if so what is to be subtracted before it.
    bool must_double(std::uint64_t& subtract) const {
        if (high < half)
            subtract = 0;
        else if (low >= half)
            subtract = half;
        else if (low >= quarter && high < half + quarter)
            subtract = quarter;
        else
            return false;
        return true;
    }
    /// Bits that end a run here, those of doublings that wait for the next bit among them.
    std::uint64_t ending_bits(std::uint64_t pending) const {
        if (low == 0 && high == top && pending == 0) return 0;
        return pending + (low == 0 || high == top ? 1 : 2);
    }
    void twice(std::uint64_t subtract) {
        low = (low - subtract) * 2;
        high = (high - subtract) * 2 + 1;
    }
};

class RunEncoder {
public:
    template <class PutBit>
    void symbol(Counts::Part part, std::uint32_t total, PutBit&& put) {
        interval_.narrow(part, total);
        for (std::uint64_t subtract = 0; interval_.must_double(subtract);) {
            if (subtract == quarter)
                ++pending_;
            else
                emit(subtract == half, put);
            interval_.twice(subtract);
        }
    }

    /// The fewest bits that pin a code within the interval, whatever follows them.
    template <class PutBit>
    void finish(PutBit&& put) {
        if (interval_.low == 0 && interval_.high == top && pending_ == 0) return;
        if (interval_.low == 0) return emit(false, put);
        if (interval_.high == top) return emit(true, put);
        ++pending_;
        emit(interval_.low >= quarter, put);
    }

    /// Bits that finish() would put now.
    std::uint64_t ending_bits() const { return interval_.ending_bits(pending_); }

private:
    template <class PutBit>
    void emit(bool bit, PutBit&& put) {
        put(bit);
        for (; pending_ > 0; --pending_) put(!bit);
    }

    Interval interval_;
    std::uint64_t pending_ = 0;  ///< bits that will be the opposite of the next one
};

class RunDecoder {
public:
    template <class GetBit>
    Symbol symbol(const Counts& counts, GetBit& get) {
        Symbol symbol = 0;
        part(
            counts.total(),
            [&](std::uint32_t cumulative) {
                symbol = counts.find(cumulative);
                return counts.part(symbol);
            },
            get);
        return symbol;
    }

    /// The part of the total that part_at(cumulative) gives; reads no more bits than it takes to be
    /// certain of it.
    template <class PartAt, class GetBit>
    Counts::Part part(std::uint64_t total, PartAt part_at, GetBit&& get) {
        for (;;) {
            const std::uint64_t cumulative =
                ((code_ - interval_.low + 1) * total - 1) / interval_.range();
            const Counts::Part part = part_at(static_cast<std::uint32_t>(cumulative));
            const std::uint64_t end = interval_.end(std::uint64_t{part.below} + part.weight, total);
            bool moved = false;
            while (!moved && code_ + unknown() >= end) moved = read(get);
            if (moved) continue;
            narrow(part, total);
            return part;
        }
    }

    /// Bits of the whole run, had it ended here: RunEncoder's and those of its finish().
    std::uint64_t ended_bits() const { return told_ + interval_.ending_bits(pending_); }

private:
    std::uint64_t unknown() const { return (std::uint64_t{1} << unknown_bits_) - 1; }

    template <class GetBit>
    bool read(GetBit& get) {
        --unknown_bits_;
        const bool bit = get();
        if (bit) code_ += std::uint64_t{1} << unknown_bits_;
        return bit;
    }

    void narrow(Counts::Part part, std::uint64_t total) {
        interval_.narrow(part, total);
        for (std::uint64_t subtract = 0; interval_.must_double(subtract);) {
            interval_.twice(subtract);
            code_ = (code_ - subtract) * 2;
            ++unknown_bits_;
            ++pending_;
            if (subtract == quarter) continue;
            told_ += pending_;
            pending_ = 0;
        }
    }

    Interval interval_;
    std::uint64_t code_ = 0;                ///< 32 bits; those not read yet are 0
    unsigned unknown_bits_ = 32;            ///< how many low bits have not been read
    std::uint64_t told_ = 0, pending_ = 0;  ///< bits that the encoder had put, and had not yet
};

}  // namespace detail

/// Codes the values of one run, the first `max_count` of them at most: value by value, then the
/// symbol for "no more" if there are fewer than `max_count`.
///
/// Witten, Neal and Cleary's coder with 32-bit codes (Communications of the ACM 30(6), 520-540,
/// 1987, doi:10.1145/214762.214771), integers only; ends with the fewest bits that the decoder
/// can do with. Check value: weights 1 5 20 60 20 5 1 of -3 to 3, EOF 4, out of range 2, eight
/// values at most: no values give 00000.
///
/// @param model      checked
/// @param counts     of that model; an adaptive one learns the run. After an exception it is to be
///                   thrown away, and so are the bits
/// @param max_count  at least 1; a single value has 1, an unset one is no values
/// @param put        put(bool), called for each bit in order
/// @param lenient    an out-of-range value of a model without out_of_range_frequency is coded as
///                   "no more", although more may follow that the decoder then takes for something
///                   else (so does the reference library); else it is refused
/// @throws DataError a value is NaN, or refused as above; the run needs "no more" and
///                   eof_frequency is 0
template <class PutBit>
void encode_run(const Model& model, Counts& counts, std::span<const double> values,
                std::uint32_t max_count, PutBit put, bool lenient = false) {
    detail::RunEncoder coder;
    const auto code = [&](Symbol symbol) {
        coder.symbol(counts.part(symbol), counts.total(), put);
        counts.saw(symbol);
    };
    const std::size_t count = values.size() < max_count ? values.size() : max_count;
    for (const double value : values.first(count)) code(coded_symbol(model, value, lenient));
    if (count < max_count) code(require_eof(model));
    coder.finish(put);
}

/// The inverse: reads exactly the bits that encode_run wrote, whatever follows them.
///
/// @param counts  the decoder's own, as they were before; to be thrown away after an exception
/// @param get     bool get(), called for each bit in order; it may throw when there are none left
/// @param values  cleared first; an out-of-range one is NaN
template <class GetBit>
void decode_run(const Model& model, Counts& counts, std::uint32_t max_count, GetBit get,
                std::vector<double>& values) {
    values.clear();
    detail::RunDecoder coder;
    while (values.size() < max_count) {
        const Symbol symbol = coder.symbol(counts, get);
        counts.saw(symbol);
        if (symbol == eof_symbol) return;
        values.push_back(value_of(model, symbol));
    }
}

}  // namespace seautils::entropy

#endif  // SEAUTILS_ENTROPY_ARITHMETIC_HPP
