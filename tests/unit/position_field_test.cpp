// A position in a field: bits, bounds, and what becomes of it where messages are lost.
#include "seautils/position/field.hpp"

#include "seautils/core/error.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace seautils::position {
namespace {

LinkOptions link_of(unsigned check_bits = 16) {
    LinkOptions link;
    link.check_bits = check_bits;
    return link;
}

/// Reads a field from bits, and says how many it took.
struct Taken {
    std::string packet;
    std::size_t bits = 0;
};
Taken take(const entropy::BitString& bits, std::size_t max_bytes, unsigned check_bits) {
    entropy::BitReader in(bits.bytes(), bits.size());
    Taken taken;
    taken.packet = get_field([&in] { return in.get(); }, max_bytes, check_bits);
    taken.bits = in.position();
    return taken;
}

/// A vehicle that turns now and then.
std::vector<Fix> walk(int count) {
    std::vector<Fix> track;
    Fix fix{1'700'000'000'000, {*rc::gen::inRange(-1000, 1000), 0, -20}};
    int vx = 12, vy = 3;
    for (int k = 0; k < count; ++k) {
        track.push_back(fix);
        if (*rc::gen::inRange(0, 8) == 0) std::tie(vx, vy) = std::pair(-vy, vx);
        fix.time_ms += 10'000;
        fix.cell.x += vx + *rc::gen::inRange(-1, 2);
        fix.cell.y += vy + *rc::gen::inRange(-1, 2);
        fix.cell.z += *rc::gen::inRange(-1, 2);
    }
    return track;
}

}  // namespace

// The length's code: 5 bits to 15, 7 to 47, 9 to 111, 11 to 239.
TEST(PositionField, LengthTakesTheBitsThatThePageSays) {
    const std::pair<std::size_t, std::size_t> lengths[] = {{1, 5},  {15, 5},  {16, 7},   {47, 7},
                                                           {48, 9}, {111, 9}, {112, 11}, {239, 11}};
    for (const auto& [n, bits] : lengths) {
        entropy::BitString out;
        put_field(std::string(32, 'U'), n, 16, out);
        EXPECT_EQ(out.size(), bits + n + 16) << n;
    }
    EXPECT_EQ(most_field_bits(32, 16), 11U + 240 + 16 + 2);  // 240 begins the next class
}

TEST(PositionField, AnyPacketComesBackInExactlyItsBits) {
    EXPECT_TRUE(rc::check([] {
        const unsigned check_bits = *rc::gen::element(0U, 8U, 16U, 32U);
        const std::size_t n = *rc::gen::inRange<std::size_t>(1, 400);
        entropy::BitString packet, field;
        for (std::size_t b = 0; b < n; ++b) packet.put(*rc::gen::arbitrary<bool>());
        while (packet.size() % 8 != 0) packet.put(false);
        packet.put(*rc::gen::arbitrary<std::uint32_t>(), check_bits);
        put_field(packet.bytes(), n, check_bits, field);
        const std::size_t bits = field.size();
        for (int tail = *rc::gen::inRange(0, 9); tail > 0; --tail) field.put(true);
        const Taken taken = take(field, packet.bytes().size(), check_bits);
        RC_ASSERT(taken.packet == packet.bytes());
        RC_ASSERT(taken.bits == bits);
        RC_ASSERT(bits <= most_field_bits(packet.bytes().size(), check_bits));
    }));
}

TEST(PositionField, ZerosAreNoPacket) {
    entropy::BitString zeros;
    zeros.put(0, 40);
    const Taken taken = take(zeros, 26, 16);
    EXPECT_EQ(taken.packet, "");
    EXPECT_EQ(taken.bits, least_field_bits);
}

TEST(PositionField, WhatIsLongerThanAllowedIsRefused) {
    entropy::BitString ones, long_one;
    ones.put(~std::uint64_t{0}, 64);
    EXPECT_THROW(take(ones, 26, 16), DataError);
    put_field(std::string(27, 'x'), 193, 16, long_one);  // 26 bytes hold 192 and the check
    EXPECT_THROW(take(long_one, 26, 16), DataError);
    EXPECT_NO_THROW(take(long_one, 27, 16));
    entropy::BitString cut;
    cut.put(0b01111, 5);
    EXPECT_THROW(take(cut, 26, 16), DataError);
}

TEST(PositionField, EveryPositionOfTheAreaFitsTheBound) {
    EXPECT_TRUE(rc::check([] {
        const LinkOptions link = link_of(*rc::gen::element(8U, 16U));
        const std::size_t most = least_bytes(link);
        FieldSender sender(link, {});
        std::int64_t time_ms = 0;
        for (int k = *rc::gen::inRange(1, 6); k > 0; --k) {
            time_ms = *rc::gen::inRange<std::int64_t>(0, most_time_ms);
            const Fix fix{time_ms, {*rc::gen::element(-32'768, 0, 32'767), -32'768, 8'191}};
            entropy::BitString bits;
            sender.put(fix, most, bits);
            RC_ASSERT(bits.size() > least_field_bits);
            RC_ASSERT(bits.size() <= most_field_bits(most, link.check_bits));
        }
    }));
}

TEST(PositionField, OutsideOfTheAreaNothingIsPut) {
    FieldSender sender(link_of(), {});
    entropy::BitString bits;
    EXPECT_THROW(sender.put({1'000, {40'000, 0, 0}}, 26, bits), DataError);
    EXPECT_EQ(bits.size(), 0U);
}

// Lost, repeated, late and damaged messages, lost acknowledgements, restarts with and without state:
// each position is the one that was put into that message, or is absent.
TEST(PositionField, DecodedPositionsAreRightOrAbsent) {
    std::size_t decoded = 0;
    EXPECT_TRUE(rc::check([&decoded] {
        const LinkOptions link = link_of();
        const std::size_t most = least_bytes(link);
        auto sender = std::make_unique<FieldSender>(link, CodecOptions{});
        auto receiver = std::make_unique<Receiver>(make_field_receiver(link, {}));
        std::vector<std::pair<Fix, entropy::BitString>> messages;
        const auto arrive = [&](const Fix& fix, entropy::BitString bits) {
            const Taken taken = take(bits, most, link.check_bits);
            RC_ASSERT(taken.bits == bits.size());
            const Arrival arrival = receiver->packet(taken.packet);
            RC_ASSERT(arrival.fixes.size() <= 1U);
            for (const Fix& got : arrival.fixes) RC_ASSERT(got == fix);
            decoded += arrival.fixes.size();
            if (!arrival.ack.empty() && *rc::gen::inRange(0, 3) > 0)
                sender->acknowledge(arrival.ack);
        };
        for (const Fix& fix : walk(40)) {
            entropy::BitString bits;
            sender->put(fix, most, bits);
            messages.emplace_back(fix, bits);
            switch (*rc::gen::inRange(0, 16)) {
                case 0:
                case 1:
                case 2:
                    break;  // lost
                case 3: {
                    const auto& [old, again] =
                        messages[*rc::gen::inRange<std::size_t>(0, messages.size())];
                    arrive(old, again);
                    break;
                }
                case 4: {
                    const std::string state = receiver->save();
                    receiver = std::make_unique<Receiver>(make_field_receiver(link, {}));
                    if (*rc::gen::arbitrary<bool>()) receiver->load(state);
                    break;
                }
                case 5: {
                    const std::string state = sender->save();
                    sender = std::make_unique<FieldSender>(link, CodecOptions{});
                    sender->load(state);
                    break;
                }
                default:
                    arrive(fix, bits);
            }
        }
    }));
    EXPECT_GT(decoded, 1000U);
}

// Acknowledged each time, a vehicle at a steady speed costs a fraction of its full fix, and what was
// acknowledged is not sent again.
TEST(PositionField, CostsLittleOnceAcknowledged) {
    const LinkOptions link = link_of();
    FieldSender sender(link, {});
    Receiver receiver = make_field_receiver(link, {});
    std::size_t first = 0, last = 0;
    for (int k = 0; k < 60; ++k) {
        const Fix fix{1'700'000'000'000 + 10'000 * k, {12 * k, -3 * k, -20}};
        entropy::BitString bits;
        sender.put(fix, 26, bits);
        (k == 0 ? first : last) = bits.size();
        const Arrival arrival = receiver.packet(take(bits, 26, 16).packet);
        ASSERT_EQ(arrival.fixes, std::vector<Fix>{fix});
        EXPECT_EQ(sender.acknowledge(arrival.ack), Sender::Heard::advanced);
        entropy::BitString again;
        sender.put(fix, 26, again);
        EXPECT_EQ(again.size(), least_field_bits);
    }
    EXPECT_GT(first, 100U);            // the time of the start, 43 bits, and a fix of 46
    EXPECT_LE(last, 5U + 3 + 3 + 16);  // length, header, a delta that was expected, check
}

// Not yet acknowledged, the same position again is the same field.
TEST(PositionField, TheSamePositionIsNoNewOne) {
    FieldSender sender(link_of(), {});
    entropy::BitString once, twice;
    sender.put({5'000, {1, 2, 3}}, 26, once);
    sender.put({5'000, {1, 2, 3}}, 26, twice);
    EXPECT_EQ(once.bytes(), twice.bytes());
}

}  // namespace seautils::position
