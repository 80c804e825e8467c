#ifndef SEAUTILS_POSITION_HORIZON_HPP
#define SEAUTILS_POSITION_HORIZON_HPP

#include "seautils/entropy/coder.hpp"
#include "seautils/position/cell.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace seautils::position {

/// Codes where the vehicle is several intervals after the last position that both ends know,
/// without those between. As a Codec it knows only what it was told, in whole numbers, so that two
/// of the same kind that were told the same code alike on any machine; coding teaches it nothing.
class Horizon {
public:
    virtual ~Horizon() = default;
    virtual std::unique_ptr<Horizon> clone() const = 0;

    /// A position after which the vehicle's motion is not known.
    virtual void restart(const Cell& cell) = 0;
    /// The position one interval after the last one.
    virtual void learn(const Cell& next) = 0;
    /// The position `ahead` intervals after the last one, those between unknown; 2 to most_ahead.
    virtual void learn_ahead(std::uint32_t ahead, const Cell& cell) = 0;

    /// @param ahead  2 to most_ahead
    virtual void encode(std::uint32_t ahead, const Cell& cell, entropy::Encoder& out) const = 0;
    /// @throws DataError  the bits end, or lead beyond the limits of a Cell
    virtual Cell decode(std::uint32_t ahead, entropy::Decoder& in) const = 0;

    /// As those of Codec.
    virtual std::string save() const = 0;
    virtual void load(std::string_view state) = 0;
};

/// Longest step over positions that are not known, in intervals.
inline constexpr std::uint32_t most_ahead = 32'767;

/// Ours: MixModel of strides so long, made anew for each position that is coded, from the last 48 of
/// them; where positions are not known the vehicle went straight on. Keeps 512 positions (12 KB); coding
/// one takes up to 2 ms.
std::unique_ptr<Horizon> make_horizon();

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_HORIZON_HPP
