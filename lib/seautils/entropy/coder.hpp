#ifndef SEAUTILS_ENTROPY_CODER_HPP
#define SEAUTILS_ENTROPY_CODER_HPP

#include "seautils/entropy/arithmetic.hpp"
#include "seautils/entropy/bits.hpp"

namespace seautils::entropy {

/// Arithmetic coder of symbols whose weights the caller states one by one; the coder of
/// encode_run, for those whose weights are no table.
///
/// The symbols between construction and finish() share one ending, of 1.06 bits on average
/// (T. Schneider's thesis, MIT/WHOI 2013, eq. 3.31): the fewest bits that name a code within the
/// last interval, whatever follows them.
class Encoder {
public:
    /// @param out  must outlive the encoder; bits are put behind those that it holds
    explicit Encoder(BitString& out) : out_(&out) {}

    /// @param part   a weight of at least 1 within the total
    /// @param total  at most max_total_frequency
    void symbol(Counts::Part part, std::uint32_t total) { coder_.symbol(part, total, put()); }
    /// @param one  probability of a 1, 1 to 65535, in 1/65536
    void bit(bool bit, std::uint32_t one) {
        symbol(bit ? Counts::Part{0, one} : Counts::Part{one, 65536 - one}, 65536);
    }
    /// Bits that finish() would put now, exactly: so that what still fits can be known beforehand.
    std::size_t ending_bits() const { return static_cast<std::size_t>(coder_.ending_bits()); }
    /// The encoder begins anew.
    void finish() {
        coder_.finish(put());
        coder_ = {};
    }

private:
    struct Put {
        BitString* out;
        void operator()(bool bit) const { out->put(bit); }
    };
    Put put() { return {out_}; }

    BitString* out_;
    detail::RunEncoder coder_;
};

/// The inverse. Never reads a bit behind those of finish().
class Decoder {
public:
    /// @param in  must outlive the decoder
    explicit Decoder(BitReader& in) : in_(&in) {}

    /// @param part_at  Counts::Part part_at(cumulative): the part that holds a number below total
    /// @return         that part
    /// @throws DataError  the bits end
    template <class PartAt>
    Counts::Part symbol(std::uint32_t total, PartAt part_at) {
        return coder_.part(total, part_at, [this] { return in_->get(); });
    }
    bool bit(std::uint32_t one) {
        const auto part = symbol(65536, [one](std::uint32_t at) {
            return at < one ? Counts::Part{0, one} : Counts::Part{one, 65536 - one};
        });
        return part.below == 0;
    }
    /// Bits that an Encoder of the symbols read so far has put when it has finished: so that where
    /// they end can be known by their bits.
    std::size_t ended_bits() const { return static_cast<std::size_t>(coder_.ended_bits()); }
    /// All symbols since the construction, or the last finish(), were read.
    void finish() { coder_ = {}; }

private:
    BitReader* in_;
    detail::RunDecoder coder_;
};

}  // namespace seautils::entropy

#endif  // SEAUTILS_ENTROPY_CODER_HPP
