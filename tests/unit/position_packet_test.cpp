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

// Written out by hand from the grammar in packet_header.hpp.
TEST(PositionPacket, HeadersAreAsTheGrammarSays) {
    PacketHeader next;
    next.reference = 1;
    EXPECT_EQ(header_text(next), "01 1"_bits);
    next.is_newest_full = true;
    EXPECT_EQ(header_text(next), "01 0 0001 1 0"_bits);

    PacketHeader window;
    window.ahead = window.count = 5, window.reference = 2, window.end = {2, 1};
    EXPECT_EQ(header_text(window), "10 0 1 01"_bits);
    window.end = {5, 6};
    EXPECT_EQ(header_text(window), "10 0 1 11110"_bits);
    window.end = {20, 7};
    EXPECT_EQ(header_text(window), "10 0 1 11111 000000000000111"_bits);
    window.kind = PacketKind::part, window.end = {2, 0};
    EXPECT_EQ(header_text(window), "10 0 1 00"_bits);

    PacketHeader jump;
    jump.kind = PacketKind::jump, jump.ahead = 5, jump.reference = 2;
    EXPECT_EQ(header_text(jump), "10 0 01 00101"_bits);
    jump.habit = {true, 1};  // 5 - 1 = 2 * 2 + 0
    EXPECT_EQ(header_text(jump), "10 001 0"_bits);
    jump.ahead = 14;  // 6 * 2 + 1
    EXPECT_EQ(header_text(jump), "10 0000001 1"_bits);
    jump.ahead = 15;
    EXPECT_EQ(header_text(jump), "10 0000000 01 0001111"_bits);
    PacketHeader peek = jump;
    peek.kind = PacketKind::peek, peek.habit = {}, peek.ahead = 5, peek.end = {2, 2};
    EXPECT_EQ(header_text(peek), "10 0 001 00101 10"_bits);
    peek.is_newest_full = true;
    EXPECT_EQ(header_text(peek), "10 0 0001 00101 1 10"_bits);

    PacketHeader sized;  // where no check finds the reference
    sized.is_reference_sized = true, sized.reference_bits = 4, sized.reference = 9;
    EXPECT_EQ(header_text(sized), "00100 1001 1"_bits);
    PacketHeader start;
    start.is_start = true, start.start_ms = 5;
    EXPECT_EQ(header_text(start), "0000000000000000 001"_bits + std::string(40, '0') + "101" + "1");
}

// What is put ends at bits 20, 25, 30 … from a header of 10 bits without the 2 of the end: at 32, 37,
// 42. Three positions take 6 bytes, the last of 41 to 48: none other ends there. Two take 5, the last
// of 33 to 40. With ends at 29 and 31 (41, 43), two end in the sixth.
TEST(PositionPacket, WhereManyEndIsSaidByTheLastByte) {
    const auto said = [](std::vector<std::size_t> ended) {
        const PacketEnd end = end_of(10, ended);
        return std::pair{end.bits, end.before};
    };
    EXPECT_EQ(said({20, 25, 30}), std::pair(2U, 0U));
    EXPECT_EQ(said({20, 25}), std::pair(2U, 0U));
    EXPECT_EQ(said({20, 29, 31}), std::pair(2U, 1U));
    EXPECT_EQ(said({20, 29, 29, 31}), std::pair(2U, 2U));
    // Three before: said in 5 bits, which move all by 3 (44, 44, 44, 46): the same byte.
    EXPECT_EQ(said({20, 29, 29, 29, 31}), std::pair(5U, 3U));
    // With 5 bits the last one is alone in the next byte (48, 48, 48, 49).
    EXPECT_EQ(said({20, 33, 33, 33, 34}), std::pair(5U, 0U));
    EXPECT_EQ(said(std::vector<std::size_t>(9, 30)), std::pair(20U, 8U));
}

RC_GTEST_PROP(PositionPacket, AHeaderComesBack, ()) {
    PacketHeader header;
    header.kind = *rc::gen::element(PacketKind::window, PacketKind::jump, PacketKind::peek);
    header.is_start = *rc::gen::arbitrary<bool>();
    if (!header.is_start && *rc::gen::arbitrary<bool>())
        header.habit = {true, *rc::gen::inRange(0U, 13U)};
    header.ahead = *rc::gen::inRange(header.kind == PacketKind::window ? 1U : 2U, most_ahead + 1);
    if (header.kind != PacketKind::window || header.ahead == 1)
        header.is_newest_full = header.is_start || *rc::gen::arbitrary<bool>();
    header.start_ms = header.is_start ? *rc::gen::inRange<std::int64_t>(0, most_time_ms) : 0;
    if (!header.is_alone())
        header.end = *rc::gen::element(PacketEnd{2, 2}, PacketEnd{5, 6}, PacketEnd{20, 32'000});
    const unsigned check_bits = *rc::gen::element(8U, 16U);
    header.is_reference_sized = check_bits == 8;
    if (header.is_reference_sized) header.reference_bits = *rc::gen::inRange(1U, 16U);
    header.reference = header.is_start ? 0 : *rc::gen::inRange(0U, 1U << header.reference_bits);
    entropy::BitString bits;
    put(header, bits);
    entropy::BitReader in(bits.bytes(), bits.size());
    const auto reference = get_reference(in, check_bits);
    RC_ASSERT(reference.has_value() == !header.is_start);
    if (reference)
        RC_ASSERT(reference->bits == header.reference_bits && reference->low == header.reference);
    const PacketHeader back = get_packet_header(in, reference, header.habit);
    RC_ASSERT(in.left() == 0U);
    RC_ASSERT(back.kind == header.kind && back.is_alone() == header.is_alone());
    RC_ASSERT(back.ahead == header.ahead ||
              !(header.is_alone() || header.kind == PacketKind::peek));
    RC_ASSERT(back.is_start == header.is_start && back.is_newest_full == header.is_newest_full);
    RC_ASSERT(back.start_ms == header.start_ms);
    RC_ASSERT(back.end.bits == header.end.bits && back.end.before == header.end.before);
}

TEST(PositionPacket, FourZerosAreOfNoKind) {
    const std::string bytes("\x01", 1);  // reference 00, body 0 0000, 1
    entropy::BitReader in(bytes);
    const auto reference = get_reference(in, 16);
    ASSERT_TRUE(reference);
    EXPECT_THROW(get_packet_header(in, reference, {}), DataError);
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

// The example of seautils-poscode(5), put together by hand: 16 zeros, 001, start 1714521600000 in 43
// bits, 1;
// no difference of time (000000), 10 + 32768 and -20 + 32768 in 16 bits, -5 + 8192 in 14; zeros.
TEST(PositionPacket, TheExampleOfTheManual) {
    LinkOptions options;
    options.check_bits = 0;
    Sender sender(options, LinearCodec(), LinearHorizon());
    sender.sample({1'714'521'600'000, {10, -20, -5}});
    const auto packet = sender.packet(64);
    ASSERT_TRUE(packet);
    std::string hex;
    for (const char c : packet->bytes) {
        hex += "0123456789abcdef"[static_cast<unsigned char>(c) / 16];
        hex += "0123456789abcdef"[static_cast<unsigned char>(c) % 16];
    }
    EXPECT_EQ(hex, "0000263cc5cdc002040053ff63ff60");
}

TEST(PositionPacket, ANewerVersionIsNamed) {
    entropy::BitString bits;
    bits.put(0, 16);
    bits.put(packet_version + 1, 3);
    bits.put(0, 60);
    entropy::BitReader in(bits.bytes(), bits.size());
    const auto reference = get_reference(in, 16);
    ASSERT_FALSE(reference);
    try {
        get_packet_header(in, reference, {});
        FAIL();
    } catch (const DataError& e) {
        EXPECT_STREQ(e.what(), "packet of version 2, newer than this program's 1");
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
