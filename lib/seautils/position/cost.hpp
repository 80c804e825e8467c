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
    std::uint64_t deltas = 0;      ///< positions that follow from those before
    std::uint64_t fulls = 0;       ///< at the start, after gaps, and where the codec cannot
    std::uint64_t delta_bits = 0;  ///< whole bits of the packets of deltas
    std::uint64_t full_bits = 0;   ///< of all full fixes (grid.hpp)
    /// Deltas by what they take, rounded to whole bits: their packet's bits, shared among them.
    std::vector<std::uint64_t> deltas_by_bits;

    double bits_per_delta() const {
        return deltas == 0 ? 0 : static_cast<double>(delta_bits) / static_cast<double>(deltas);
    }
    std::uint64_t bits_total() const { return delta_bits + full_bits; }
};

/// Positions in the bits of one codec.
struct CodedPositions {
    std::vector<Cell> cells;
    bool is_full = false;  ///< one, which a receiver is told otherwise: no bits
    entropy::BitString bits;
};

/// Codes a track and counts.
class CostMeter {
public:
    static constexpr std::uint32_t most_deltas = 1000;

    /// @param deltas_per_packet  1: Codec::encode_alone. More share an arithmetic coder and its
    ///                           ending; the last ones before a full fix are fewer
    /// @throws ConfigError  not 1 to most_deltas
    CostMeter(std::unique_ptr<Codec> codec, const Grid& grid, std::uint32_t deltas_per_packet);

    CostMeter(const CostMeter&) = delete;
    CostMeter& operator=(const CostMeter&) = delete;

    /// Appends what is complete now.
    void add(const Sample& sample, std::vector<CodedPositions>& out);
    /// The track ends here.
    void finish(std::vector<CodedPositions>& out);

    const Cost& cost() const { return cost_; }

private:
    void close_packet(std::vector<CodedPositions>& out);

    std::unique_ptr<Codec> codec_;
    unsigned full_bits_;
    std::uint32_t deltas_per_packet_;
    CodedPositions packet_;
    entropy::Encoder coder_;
    Cost cost_;
};

/// Decodes what a CostMeter coded, as a receiver would, and compares.
class CostCheck {
public:
    /// @param codec  as the meter's was at the beginning
    CostCheck(std::unique_ptr<Codec> codec, std::uint32_t deltas_per_packet)
        : codec_(std::move(codec)), alone_(deltas_per_packet == 1) {}

    /// @throws std::logic_error  it is something else, or takes other bits
    void check(const CodedPositions& packet);

private:
    std::unique_ptr<Codec> codec_;
    bool alone_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_COST_HPP
