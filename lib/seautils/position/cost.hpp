#ifndef SEAUTILS_POSITION_COST_HPP
#define SEAUTILS_POSITION_COST_HPP

#include "seautils/position/codec.hpp"
#include "seautils/position/sampling.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace seautils::position {

/// What a track takes in one codec: positions coded, not estimated. Headers and checks of packets
/// are not in it.
struct Cost {
    std::uint64_t deltas = 0;  ///< positions that follow from those before
    std::uint64_t fulls = 0;   ///< at the start, after gaps, and where the codec cannot
    std::uint64_t packets = 0;
    std::uint64_t delta_bits = 0;  ///< whole bits of the packets of deltas
    std::uint64_t full_bits = 0;   ///< of all full fixes (grid.hpp)
    /// Deltas by what they take, rounded to whole bits: their packet's bits, shared among them.
    std::vector<std::uint64_t> deltas_by_bits;

    double bits_per_delta() const {
        return deltas == 0 ? 0 : static_cast<double>(delta_bits) / static_cast<double>(deltas);
    }
    std::uint64_t bits_total() const { return delta_bits + full_bits; }
};

/// Codes a track, decodes it with a second codec as a receiver does, and counts.
class CostMeter {
public:
    static constexpr std::uint32_t most_deltas = 1000;

    /// @param deltas_per_packet  1: Codec::encode_alone. More share an arithmetic coder and its
    ///                           ending; the last packet before a full fix holds fewer
    /// @throws ConfigError  not 1 to most_deltas; as make_codec
    CostMeter(const CodecOptions& codec, const Grid& grid, std::uint32_t deltas_per_packet);
    /// The same with a codec of any kind.
    CostMeter(std::unique_ptr<Codec> codec, const Grid& grid, std::uint32_t deltas_per_packet);

    /// @throws std::logic_error  what was decoded is not what was coded
    void add(const Sample& sample);
    /// The track ends here.
    const Cost& finish();

private:
    void full(const Cell& cell);
    void close_packet();
    void check_packet();

    std::unique_ptr<Codec> sender_, receiver_;
    unsigned full_bits_;
    std::uint32_t deltas_per_packet_;
    entropy::BitString bits_;
    std::unique_ptr<entropy::Encoder> coder_;
    std::vector<Cell> packet_;  ///< what is in bits_
    Cost cost_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_COST_HPP
