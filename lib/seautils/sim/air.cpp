#include "seautils/sim/air.hpp"

namespace seautils::sim {

namespace {

Time flexible_time(const Rate& rate, std::size_t bytes) {
    const std::size_t full = std::size_t{rate.frames} * rate.frame_bytes;
    const Rate::Time data =
        rate.packet * static_cast<Rate::Time::rep>(bytes) / static_cast<Rate::Time::rep>(full);
    return std::chrono::nanoseconds(rate.probe + data).count();
}

}  // namespace

Time air_time(const RateTable& rates, const Packet& packet) {
    switch (packet.kind) {
        case PacketKind::lbl:
        case PacketKind::lbl_reply:
            return packet.air;
        case PacketKind::fdp:
            return flexible_time(rates.flexible(packet.rate), packet.bytes());
        case PacketKind::data:
            return std::chrono::nanoseconds(rates.data(packet.rate).packet_time(packet.frame_count))
                .count();
        default:
            return std::chrono::nanoseconds(minipacket_time).count();
    }
}

}  // namespace seautils::sim
