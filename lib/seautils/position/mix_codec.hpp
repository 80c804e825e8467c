#ifndef SEAUTILS_POSITION_MIX_CODEC_HPP
#define SEAUTILS_POSITION_MIX_CODEC_HPP

#include "seautils/position/codec.hpp"
#include "seautils/position/joint_code.hpp"
#include "seautils/position/mix_model.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::position {

/// Our codec: filters, turns and the memory of similar situations say what comes next, a mixer learns
/// whom to believe, and the answers to yes-or-no questions are coded. z is coded first, then x, then y
/// given x. A position alone takes a Huffman code over the three together, for few bits are lost so to
/// whole ones; what is far from all that was expected is coded in detail behind it.
///
/// No position within the limits is out of range; far ones cost one or two bits an octave. Only before
/// the first restart() can_encode() is false.
///
/// A codec takes 50 µs for a position among several, 0.6 ms for one alone, and keeps 126 KB (82 KB
/// with `small`, for up to 0.05 bit a position).
class MixCodec : public Codec {
public:
    explicit MixCodec(const CodecOptions& options);

    std::unique_ptr<Codec> clone() const override { return std::make_unique<MixCodec>(*this); }
    void restart(const Cell& cell) override;
    bool can_encode(const Cell& next) const override { return started_ && in_limits(next); }
    void encode(const Cell& next, entropy::Encoder& out) override;
    std::optional<Cell> decode(entropy::Decoder& in) override;
    void learn(const Cell& next) override;
    void learn_ahead(std::uint32_t ahead, const Cell& from, const Cell& to) override;
    void encode_alone(const Cell& next, entropy::BitString& out) override;
    std::optional<Cell> decode_alone(entropy::BitReader& in) override;
    std::string save() const override;
    void load(std::string_view state) override;

private:
    /// Where a value is known to be, both ends included.
    struct Range {
        std::int32_t least = INT32_MIN, most = INT32_MAX;

        bool within(std::int32_t from, std::int32_t to) const {
            return from <= least && most <= to;
        }
        /// Whether it is not known if the value is from one to the other.
        bool open(std::int32_t from, std::int32_t to) const {
            return !within(from, to) && from <= most && least <= to;
        }
    };
    using Ranges = std::array<Range, 3>;  ///< x, y, z
    static Ranges exactly(const Cell& step);
    static Range range_of(std::size_t klass, std::int32_t centre);

    /// Finds a step by questions about each axis, learns it, and moves on.
    /// @param decide  as ValueCoder::find(), with the axis (0 x, 1 y, 2 z) before
    /// @throws DataError  it leads beyond the limits of a Cell
    template <class Decide>
    Cell follow(MixModel::Forecast& f, Decide decide);
    /// Of all steps near the centres of the axes, and one for each way to be far from them.
    JointCode joint_code(MixModel::Forecast& f);
    /// What one of its symbols says of each axis.
    Ranges said_by(MixModel::Forecast& f, std::size_t symbol);
    Cell step_to(const Cell& next) const;

    std::size_t capacity_;
    bool started_ = false;
    Motion motion_;
    MixModel model_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_MIX_CODEC_HPP
