#ifndef SEAUTILS_POSITION_PACKING_HPP
#define SEAUTILS_POSITION_PACKING_HPP

#include "seautils/position/packet.hpp"
#include "seautils/position/track_state.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// How a packet is put together: common to Sender and PacketFiller.
namespace seautils::position {

/// A packet, and what it costs.
struct Packet {
    std::string bytes;
    PacketKind kind = PacketKind::window;
    bool is_start = false;        ///< it can be decoded by a receiver that knows nothing
    std::uint32_t positions = 0;  ///< in it
    Fix newest;                   ///< the newest of them
    std::size_t header_bits = 0;  ///< of the header
    std::size_t bits = 0;         ///< of header and positions; without check and filling
};

/// @throws DataError  outside of the area or of the time's range
void check(const Fix& fix, const LinkOptions& options);

/// Says in the header which reference is meant: that of `known`, of which the newest position that was
/// sent is `most` ahead.
void set_reference(PacketHeader& header, const TrackState& known, std::uint64_t most,
                   const LinkOptions& options);

/// @param known  the reference: the packet's check vouches for it
/// @param bits   header and positions
Packet packed(const PacketHeader& header, const entropy::BitString& bits, const TrackState& known,
              const Fix& newest, const LinkOptions& options);

/// Positions that share one arithmetic coder, each of which is coded once: the last one, if it does
/// not fit, is taken back.
class RunCoder {
public:
    /// @param from  what is known before the first of them
    explicit RunCoder(const TrackState& from) : state_(from) {}
    RunCoder(const RunCoder&) = delete;
    RunCoder& operator=(const RunCoder&) = delete;

    /// The newest position, before all others; it is not learnt.
    void put_newest(const Step& newest);
    /// The next position; learns it. @return  how it follows
    Step put(const Fix& fix);
    /// Takes back the bits of the last put(); at most once after each. state() has learnt it all the same.
    void take_back();

    /// Says in the header that it ends behind what was put last.
    /// @return  bits of header and positions
    std::size_t say_end(PacketHeader& header) const;
    TrackState& state() { return state_; }  ///< behind all positions that were put
    /// Ends the coder, and puts its bits behind those of `out`. Nothing can be put any more.
    void finish(entropy::BitString& out);

private:
    void note_end() { ended_.push_back(bits_.size() + coder_.ending_bits()); }

    TrackState state_;
    entropy::BitString bits_, bits_before_;
    entropy::Encoder coder_{bits_}, coder_before_{bits_};
    std::vector<std::size_t> ended_;  ///< its bits, had it ended behind each position
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_PACKING_HPP
