#ifndef SEAUTILS_DCCL_BITS_HPP
#define SEAUTILS_DCCL_BITS_HPP

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::dccl {

namespace detail {
inline std::uint64_t little_endian(std::uint64_t x) {
    return std::endian::native == std::endian::big ? __builtin_bswap64(x) : x;
}
inline std::uint64_t low_mask(unsigned bits) {
    return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}
}  // namespace detail

/// Puts numbers into a string of bits, least significant bit first: bit k of the stream is bit
/// k mod 8 of byte k / 8. Works in 64-bit words in a buffer that is kept from message to message.
class BitWriter {
public:
    /// Empties it.
    void reset() {
        word_ = 0;
        filled_ = 0;
        at_ = 0;
    }

    /// The low `bits` (0 to 64) of `value`; higher ones are ignored.
    void put(std::uint64_t value, unsigned bits) {
        value &= detail::low_mask(bits);
        word_ |= value << filled_;
        const unsigned end = filled_ + bits;
        if (end < 64) {
            filled_ = end;
            return;
        }
        if (at_ + 1 >= words_.size()) words_.resize(2 * words_.size());
        words_[at_++] = detail::little_endian(word_);
        word_ = filled_ == 0 ? 0 : value >> (64 - filled_);
        filled_ = end - 64;
    }

    void put_zeros(std::size_t bits) {
        for (; bits > 64; bits -= 64) put(0, 64);
        put(0, static_cast<unsigned>(bits));
    }

    void put_bytes(std::string_view bytes) {
        for (const char c : bytes) put(static_cast<unsigned char>(c), 8);
    }

    std::size_t bits() const { return at_ * 64 + filled_; }

    /// Appends all bits, filled up with zeros to whole bytes.
    void append_to(std::string& out) {
        const std::size_t bytes = (bits() + 7) / 8;
        words_[at_] = detail::little_endian(word_);
        out.append(reinterpret_cast<const char*>(words_.data()), bytes);
    }

private:
    std::vector<std::uint64_t> words_ = std::vector<std::uint64_t>(64);
    std::uint64_t word_ = 0;
    unsigned filled_ = 0;  ///< bits in word_, 0 to 63
    std::size_t at_ = 0;   ///< whole words written
};

/// There are fewer bits left than a field takes.
struct OutOfBits {
    std::size_t wanted, left;
};

/// Takes numbers from a string of bits; never reads behind its end.
class BitReader {
public:
    BitReader() = default;
    explicit BitReader(std::string_view bytes) : bytes_(bytes) {}

    /// The next `bits` (0 to 64). @throws OutOfBits
    std::uint64_t get(unsigned bits) {
        if (bits > left()) throw OutOfBits{bits, left()};
        const std::size_t byte = at_ / 8;
        const unsigned shift = at_ % 8;
        at_ += bits;
        std::uint64_t word = load(byte) >> shift;
        if (shift + bits > 64) {
            word |= std::uint64_t{static_cast<unsigned char>(bytes_[byte + 8])} << (64 - shift);
        }
        return word & detail::low_mask(bits);
    }

    void skip(std::size_t bits) {
        if (bits > left()) throw OutOfBits{bits, left()};
        at_ += bits;
    }

    /// @param to  room for `count` bytes
    void get_bytes(char* to, std::size_t count) {
        if (count * 8 > left()) throw OutOfBits{count * 8, left()};
        for (std::size_t k = 0; k < count; ++k) to[k] = static_cast<char>(get(8));
    }

    std::size_t bits_read() const { return at_; }
    std::size_t bytes_touched() const { return (at_ + 7) / 8; }
    std::size_t left() const { return bytes_.size() * 8 - at_; }

private:
    std::uint64_t load(std::size_t byte) const {
        std::uint64_t word = 0;
        const std::size_t rest = bytes_.size() - byte;
        if (rest >= 8) {
            std::memcpy(&word, bytes_.data() + byte, 8);
            return detail::little_endian(word);
        }
        if (bytes_.size() >= 8 && rest > 0) {
            std::memcpy(&word, bytes_.data() + bytes_.size() - 8, 8);
            return detail::little_endian(word) >> (64 - 8 * rest);
        }
        for (std::size_t k = 0; k < rest; ++k) {
            word |= std::uint64_t{static_cast<unsigned char>(bytes_[byte + k])} << (8 * k);
        }
        return word;
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_BITS_HPP
