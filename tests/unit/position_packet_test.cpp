#include "position_link.hpp"

#include "seautils/position/hash.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace seautils::position {
namespace {

std::string text(const entropy::BitString& bits) {
    std::string text;
    entropy::BitReader in(bits.bytes(), bits.size());
    while (in.left() > 0) text += in.get() ? '1' : '0';
    return text;
}

/// Without the spaces.
std::string operator""_bits(const char* text, std::size_t size) {
    std::string bits(text, size);
    std::erase(bits, ' ');
    return bits;
}

std::string header_text(const PacketHeader& header) {
    entropy::BitString bits;
    put(header, bits);
    return text(bits);
}

TEST(PositionPacket, HashIsOfSplitMix64) {
    EXPECT_EQ(hash("", 1), 0x910A2DEC89025CC1U);  // splitmix64.c, seed 1
    EXPECT_EQ(hash("A", 0), splitmix64(splitmix64(1) ^ 0x41));
}

// Written out by hand from the grammar in packet.hpp.
TEST(PositionPacket, HeadersAreAsTheGrammarSays) {
    PacketHeader next;
    next.ahead = 1, next.reference_bits = 1, next.reference = 1;
    EXPECT_EQ(header_text(next), "1 1"_bits);
    next.is_newest_full = true;
    EXPECT_EQ(header_text(next), "000000 01 1 1"_bits);

    PacketHeader window;
    window.ahead = window.count = 5, window.reference_bits = 3, window.reference = 6;
    EXPECT_EQ(header_text(window), "00101 110 0"_bits);
    PacketHeader jump = window;
    jump.kind = PacketKind::jump;
    EXPECT_EQ(header_text(jump), "00101 110 10"_bits);
    PacketHeader peek = window;
    peek.kind = PacketKind::peek, peek.count = 2;
    EXPECT_EQ(header_text(peek), "00101 110 11 011"_bits);
    jump.ahead = 64, jump.reference_bits = 7, jump.reference = 2;
    EXPECT_EQ(header_text(jump), "000000 1 0000001000000 0000010 10"_bits);
    PacketHeader part;
    part.kind = PacketKind::part, part.reference_bits = 4, part.reference = 9, part.count = 3;
    EXPECT_EQ(header_text(part), "000000 001 00100 1001 011"_bits);
    PacketHeader start;
    start.is_start = true, start.start_ms = 5, start.ahead = 1;
    EXPECT_EQ(header_text(start), "000000000000"_bits + std::string(40, '0') +
                                      "101"
                                      "1");
}

RC_GTEST_PROP(PositionPacket, AHeaderComesBack, ()) {
    PacketHeader header;
    header.kind =
        *rc::gen::element(PacketKind::window, PacketKind::jump, PacketKind::peek, PacketKind::part);
    if (header.kind == PacketKind::part) {
        header.ahead = 0;
        header.count = *rc::gen::inRange(1U, most_count + 1);
        header.reference_bits = *rc::gen::inRange(1U, ack_bits + 1);
    } else {
        header.ahead =
            *rc::gen::inRange(header.kind == PacketKind::window ? 1U : 2U, most_ahead + 1);
        header.is_start = *rc::gen::arbitrary<bool>();
        header.is_newest_full = header.is_start
                                    ? header.kind != PacketKind::window || header.ahead == 1
                                    : *rc::gen::arbitrary<bool>();
        header.start_ms = header.is_start ? *rc::gen::inRange<std::int64_t>(0, most_time_ms) : 0;
        header.count = header.kind == PacketKind::window ? header.ahead
                       : header.kind == PacketKind::jump ? 1
                                                         : *rc::gen::inRange(0U, most_count);
        header.reference_bits =
            header.is_start ? 0 : static_cast<unsigned>(std::bit_width(header.ahead));
    }
    header.reference = *rc::gen::inRange(0U, 1U << header.reference_bits);
    entropy::BitString bits;
    put(header, bits);
    entropy::BitReader in(bits.bytes(), bits.size());
    const PacketHeader back = get_packet_header(in);
    RC_ASSERT(in.left() == 0U);
    RC_ASSERT(back.kind == header.kind && back.ahead == header.ahead &&
              back.count == header.count && back.is_start == header.is_start &&
              back.is_newest_full == header.is_newest_full && back.start_ms == header.start_ms &&
              back.reference_bits == header.reference_bits && back.reference == header.reference);
}

RC_GTEST_PROP(PositionPacket, AFullFixComesBack, ()) {
    const LinkOptions options;
    const auto time = rc::gen::inRange<std::int64_t>(0, most_time_ms);
    const std::int64_t expected = *time;
    const Fix fix{*time,
                  {*rc::gen::inRange(options.least.x, options.most.x + 1),
                   *rc::gen::inRange(options.least.y, options.most.y + 1),
                   *rc::gen::inRange(options.least.z, options.most.z + 1)}};
    entropy::BitString bits;
    entropy::Encoder out(bits);
    put_full(fix, expected, options, out);
    out.finish();
    RC_ASSERT(bits.size() <= 6U + 44 + 46 + 2);
    entropy::BitReader in(bits.bytes(), bits.size());
    entropy::Decoder decoder(in);
    RC_ASSERT(get_full(expected, options, decoder) == fix);
}

// The example of seautils-poscode(5), put together by hand: zeros, start 1714521600000 in 43 bits, 1;
// no difference of time (000000), 10 + 32768 and -20 + 32768 in 16 bits, -5 + 8192 in 14; zeros.
TEST(PositionPacket, TheExampleOfTheManual) {
    LinkOptions options;
    options.check_bits = 0;
    Sender sender(options, LinearCodec(), *make_horizon());
    sender.sample({1'714'521'600'000, {10, -20, -5}});
    const auto packet = sender.packet(64);
    ASSERT_TRUE(packet);
    std::string hex;
    for (const char c : packet->bytes) {
        hex += "0123456789abcdef"[static_cast<unsigned char>(c) / 16];
        hex += "0123456789abcdef"[static_cast<unsigned char>(c) % 16];
    }
    EXPECT_EQ(hex, "00031e62e6e001020029ffb1ffb0");
}

TEST(PositionPacket, ANewerVersionIsNamed) {
    entropy::BitString bits;
    bits.put(0, 9);
    bits.put(packet_version + 1, 3);
    bits.put(0, 60);
    entropy::BitReader in(bits.bytes(), bits.size());
    try {
        get_packet_header(in);
        FAIL();
    } catch (const DataError& e) {
        EXPECT_STREQ(e.what(), "packet of version 1, newer than this program's 0");
    }
}

/// One in 2^n of other packets passes a check of n bits: here n = 8.
TEST(PositionPacket, TheCheckPassesAsFewAsItsBitsSay) {
    SplitMix64 random(1);
    unsigned passed = 0;
    for (int n = 0; n < 100'000; ++n) {
        std::string bytes(6, '\0');
        for (char& c : bytes) c = static_cast<char>(random.below(256));
        if (unseal(bytes, 17, 8)) ++passed;
    }
    EXPECT_NEAR(passed, 100'000 / 256.0, 5 * 20);  // five standard deviations
}

TEST(PositionPacket, OptionsOutOfRangeAreNamed) {
    LinkOptions options;
    options.check_bits = 12;
    EXPECT_THROW(check(options), ConfigError);
    options = {};
    options.least.x = options.most.x + 1;
    EXPECT_THROW(check(options), ConfigError);
    options = {};
    options.interval_ms = 0;
    EXPECT_THROW(check(options), ConfigError);
}

}  // namespace
}  // namespace seautils::position
