#include "position_link.hpp"

#include "seautils/position/packet_filler.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace seautils::position {
namespace {

constexpr std::int64_t start_ms = 1'714'521'600'000, interval_ms = 10'000;

/// What a sender makes of each packet's positions when all arrives.
std::vector<std::string> sent(const std::vector<Fix>& fixes, const std::vector<Packet>& packets,
                              std::size_t max_bytes) {
    Link link{LinkOptions()};
    std::vector<std::string> bytes;
    std::size_t at = 0;
    for (const Packet& packet : packets) {
        for (std::uint32_t n = packet.positions; n > 0; --n) link.sample(fixes.at(at++));
        const auto same = link.sender.packet(max_bytes);
        bytes.push_back(same ? same->bytes : "nothing");
        link.sender.acknowledge(link.deliver(bytes.back()));
    }
    RC_ASSERT(at == fixes.size());
    RC_ASSERT(link.arrived.size() == fixes.size());
    RC_ASSERT(link.wrong == 0U);
    return bytes;
}

TEST(PositionFiller, LawPacketsAreThoseOfASenderWhoseEveryPacketArrives) {
    EXPECT_TRUE(rc::check("as by a sender", [] {
        const LinkOptions options;
        const auto max_bytes = *rc::gen::inRange<std::size_t>(least_bytes(options), 80);
        const auto most = *rc::gen::inRange<std::size_t>(0, 12);
        Walk walk(*rc::gen::arbitrary<std::uint64_t>());
        PacketFiller filler(options, LinearCodec(), LinearHorizon(), max_bytes, most);
        std::vector<Fix> fixes;
        std::vector<Packet> packets;
        std::int64_t time_ms = start_ms;
        for (int k = 0; k < 120; ++k) {
            fixes.push_back({time_ms, walk.next()});
            for (const Packet& packet : filler.add(fixes.back())) packets.push_back(packet);
            time_ms += walk.random().below(40) == 0 ? 7 * interval_ms : interval_ms;
        }
        for (const Packet& packet : filler.finish()) packets.push_back(packet);
        std::vector<std::string> bytes;
        for (const Packet& packet : packets) {
            RC_ASSERT(packet.bytes.size() <= max_bytes);
            RC_ASSERT(most == 0 || packet.positions <= most);
            bytes.push_back(packet.bytes);
        }
        RC_ASSERT(bytes == sent(fixes, packets, max_bytes));
    }));
}

}  // namespace
}  // namespace seautils::position
