#include "seautils/sim/packet.hpp"

#include <algorithm>

namespace seautils::sim {

std::string_view name(PacketKind kind) {
    constexpr std::array<std::string_view, 9> names{"cycle", "data", "ack", "ping",     "reply",
                                                    "mini",  "fdp",  "lbl", "lbl_reply"};
    return names.at(static_cast<std::size_t>(kind));
}

std::size_t Packet::bytes() const {
    std::size_t sum = 0;
    for (const std::string& frame : frames) sum += frame.size();
    return sum;
}

unsigned Packet::type() const {
    if (kind == PacketKind::fdp) return 5;
    if (kind == PacketKind::data) return is_fsk() ? 1 : 3;
    return kind == PacketKind::ack && !is_fsk() ? 4 : 2;
}

unsigned Heard::bad_count() const {
    return static_cast<unsigned>(std::count(bad_frame.begin(), bad_frame.end(), true));
}

}  // namespace seautils::sim
