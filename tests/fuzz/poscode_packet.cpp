// The receiving and the sending end of a track: any packets, acknowledgements and states.
// Input: a byte of choices, then pieces with their length before them. Without a check, so that what
// is in packets is reached.
#include "common.hpp"

#include "../unit/position_linear.hpp"
#include "seautils/position/receiver.hpp"
#include "seautils/position/sender.hpp"

#include <algorithm>

using namespace seautils;

namespace {

position::LinkOptions options_of(std::uint8_t choice) {
    position::LinkOptions options;
    options.check_bits = (choice & 1) != 0 ? 16 : 0;
    options.mode = static_cast<position::LinkMode>(choice / 2 % 3);
    return options;
}

/// What both ends say of a packet or an acknowledgement that is not theirs.
void feed(position::Receiver& receiver, position::Sender& sender, std::string_view piece) {
    const position::Arrival arrival = receiver.packet(piece);
    for (const position::Fix& fix : arrival.fixes) {
        fuzz::require(fix.time_ms >= 0 && fix.time_ms <= position::most_time_ms, "time in range");
        fuzz::require(position::in_limits(fix.cell), "position within limits");
    }
    fuzz::require(arrival.outcome != position::Arrival::Outcome::undecodable ||
                      (arrival.fixes.empty() && !arrival.why.empty()),
                  "what cannot be decoded brings nothing, and why is said");
    sender.acknowledge(piece);
    sender.acknowledge(arrival.ack);
    const auto packet = sender.packet(40);
    if (packet) fuzz::require(packet->bytes.size() <= 40, "a packet is no longer than it may be");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const position::LinkOptions options = options_of(data[0]);
    const auto horizon = position::make_horizon();
    position::Receiver receiver(options, position::LinearCodec(), *horizon);
    position::Sender sender(options, position::LinearCodec(), *horizon);
    std::string_view left = fuzz::view(data + 1, size - 1);
    for (std::int32_t n = 0; n < 64 && !left.empty(); ++n) {
        const std::size_t length =
            std::min<std::size_t>(static_cast<unsigned char>(left[0]), left.size() - 1);
        const std::string_view piece = left.substr(1, length);
        left.remove_prefix(1 + length);
        sender.sample({1'714'521'600'000 + std::int64_t{n} * 10'000, {n * 15, n * n, -n}});
        feed(receiver, sender, piece);
    }
    fuzz::accepted([&] { receiver.load(left); });
    fuzz::accepted([&] { sender.load(fuzz::view(data, size)); });
    // What is kept is what was: it says the same of the next packet.
    position::Receiver again(options, position::LinearCodec(), *horizon);
    again.load(receiver.save());
    const std::string_view last = fuzz::view(data, size);
    fuzz::require(again.packet(last).ack == receiver.packet(last).ack, "a state is whole");
    return 0;
}
