#ifndef SEAUTILS_POSITION_JOINT_CODE_HPP
#define SEAUTILS_POSITION_JOINT_CODE_HPP

#include "seautils/entropy/bits.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seautils::position {

/// A Huffman code (D. A. Huffman, Proc. IRE 40(9), 1098-1101, 1952) of symbols with given weights. Equal
/// weights are joined by the symbols' order, and codes of one length are in that order: any machine
/// makes the same.
class JointCode {
public:
    /// @param weights  2 to 4096 of them, each 1 to 2^32; they sum up to at most 2^40
    explicit JointCode(const std::vector<std::uint64_t>& weights);

    void put(std::size_t symbol, entropy::BitString& out) const;
    /// @throws DataError  the bits end
    std::size_t get(entropy::BitReader& in) const;

private:
    std::vector<std::uint8_t> length_;  ///< bits of each symbol, at most 60
    std::vector<std::uint32_t> count_;  ///< symbols of each length
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_JOINT_CODE_HPP
