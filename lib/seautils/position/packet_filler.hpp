#ifndef SEAUTILS_POSITION_PACKET_FILLER_HPP
#define SEAUTILS_POSITION_PACKET_FILLER_HPP

#include "seautils/position/packing.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace seautils::position {

/// Packs a track for a link that loses nothing: each packet builds on all those before it, and is as
/// full as may be. They are the packets of a Sender (sender.hpp) that is given just these positions
/// for each, and hears of its arrival before the next; but here each position is coded only once.
class PacketFiller {
public:
    /// @param codec, horizon  as made
    /// @param max_bytes       of a packet with its check, at least least_bytes()
    /// @param most_positions  in a packet; 0: as many as fit, at most options.most_pending
    /// @throws ConfigError    options out of range
    PacketFiller(const LinkOptions& options, const Codec& codec, const Horizon& horizon,
                 std::size_t max_bytes, std::size_t most_positions);
    // What is known points to the options.
    PacketFiller(const PacketFiller&) = delete;
    PacketFiller& operator=(const PacketFiller&) = delete;

    /// The next position. @return  packets that are complete now, until the next call
    /// @throws DataError  outside of the area or of the time's range; nothing is changed
    const std::vector<Packet>& add(const Fix& fix);
    /// The rest.
    const std::vector<Packet>& finish();

private:
    bool put(const Fix& fix);
    PacketHeader header(std::size_t count) const;
    void send();

    LinkOptions options_;
    std::unique_ptr<Codec> codec_;
    std::unique_ptr<Horizon> horizon_;
    std::size_t most_bits_, most_positions_;
    std::optional<TrackState> known_;   ///< before the packet
    std::optional<RunCoder> run_;       ///< the packet so far
    std::optional<TrackState> behind_;  ///< what is known behind `waiting_`, where it was kept
    std::vector<Fix> waiting_;          ///< in the packet
    std::vector<Packet> complete_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_PACKET_FILLER_HPP
