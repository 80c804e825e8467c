#ifndef SEAUTILS_ENTROPY_BITS_HPP
#define SEAUTILS_ENTROPY_BITS_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace seautils::entropy {

/// Bits in order, the first one the most significant of the first byte; the last byte is filled up
/// with zeros. A value.
class BitString {
public:
    void put(bool bit) {
        if (size_ % 8 == 0) bytes_ += '\0';
        if (bit) bytes_.back() = static_cast<char>(bytes_.back() | (0x80 >> (size_ % 8)));
        ++size_;
    }
    /// The `width` low bits of a number, the most significant first; width 0 to 64.
    void put(std::uint64_t value, unsigned width) {
        while (width > 0) put((value >> --width & 1) != 0);
    }
    void clear() {
        bytes_.clear();
        size_ = 0;
    }
    std::size_t size() const { return size_; }           ///< bits
    const std::string& bytes() const { return bytes_; }  ///< (size() + 7) / 8 of them

private:
    std::string bytes_;
    std::size_t size_ = 0;
};

/// Reads bits in the order of BitString.
class BitReader {
public:
    /// @param bytes  must outlive the reader
    explicit BitReader(std::string_view bytes) : BitReader(bytes, bytes.size() * 8) {}
    /// @param bits  how many of them there are
    BitReader(std::string_view bytes, std::size_t bits) : bytes_(bytes), end_(bits) {}

    /// @throws DataError  none is left
    bool get() {
        if (at_ == end_) none_left();
        const bool bit = (static_cast<unsigned char>(bytes_[at_ / 8]) << (at_ % 8) & 0x80) != 0;
        ++at_;
        return bit;
    }
    /// A number of `width` bits, 0 to 64. @throws DataError  fewer are left
    std::uint64_t get(unsigned width) {
        std::uint64_t value = 0;
        for (; width > 0; --width) value = value * 2 + (get() ? 1 : 0);
        return value;
    }
    std::size_t position() const { return at_; }     ///< bits read
    std::size_t left() const { return end_ - at_; }  ///< bits not read yet

private:
    [[noreturn]] static void none_left();

    std::string_view bytes_;
    std::size_t at_ = 0, end_;
};

}  // namespace seautils::entropy

#endif  // SEAUTILS_ENTROPY_BITS_HPP
