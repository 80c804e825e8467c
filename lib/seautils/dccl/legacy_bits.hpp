#ifndef SEAUTILS_DCCL_LEGACY_BITS_HPP
#define SEAUTILS_DCCL_LEGACY_BITS_HPP

#include <cstdint>
#include <string>
#include <string_view>

namespace seautils::dccl {

/// A frame of DCCL 1: this many bytes of header, which begin with CCL's identifier.
inline constexpr std::size_t legacy_header_bytes = 6;
inline constexpr std::uint32_t legacy_ccl_id = 0x20;
inline constexpr std::int64_t legacy_day_s = 86400;

/// Puts numbers behind each other, most significant bit first.
class MsbWriter {
public:
    void put(std::uint64_t value, unsigned bits) {
        for (unsigned k = bits; k > 0; --k) {
            if (bits_ % 8 == 0) bytes_ += '\0';
            const auto bit = static_cast<unsigned>(value >> (k - 1)) & 1U;
            bytes_.back() = static_cast<char>(static_cast<unsigned char>(bytes_.back()) |
                                              bit << (7 - bits_ % 8));
            ++bits_;
        }
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::size_t bits_ = 0;
};

/// Takes them out again. Bytes behind the end are zeros: the sender leaves them out.
class MsbReader {
public:
    explicit MsbReader(std::string_view bytes) : bytes_(bytes) {}
    std::uint64_t get(unsigned bits) {
        std::uint64_t value = 0;
        for (unsigned k = 0; k < bits; ++k, ++at_) {
            const unsigned byte =
                at_ / 8 < bytes_.size() ? static_cast<unsigned char>(bytes_[at_ / 8]) : 0U;
            value = value << 1 | (byte >> (7 - at_ % 8) & 1U);
        }
        return value;
    }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_LEGACY_BITS_HPP
