// Hexadecimal text and lengths in front of records.
#include "seautils/core/error.hpp"
#include "seautils/stream/hex.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cctype>

namespace seautils::stream {
namespace {

std::string hex(std::string_view bytes) {
    std::string text;
    append_hex(text, bytes);
    return text;
}

std::string unhex(std::string_view text) {
    std::string bytes = "what was there before";
    from_hex(text, bytes);
    return bytes;
}

std::string refusal(std::string_view text) {
    try {
        return "taken: " + unhex(text);
    } catch (const DataError& e) {
        return e.what();
    }
}

}  // namespace

TEST(StreamHex, Base16OfRfc4648) {
    EXPECT_EQ(hex(""), "");
    EXPECT_EQ(hex("foobar"), "666f6f626172");  // section 10
    EXPECT_EQ(unhex("666F6F626172"), "foobar");
    EXPECT_EQ(unhex("666f6F626172"), "foobar");
    EXPECT_EQ(hex(std::string("\0\x7f\x80\xff", 4)), "007f80ff");
    EXPECT_EQ(unhex(""), "");
}

TEST(StreamHex, AppendsToWhatIsThere) {
    std::string text = "x=";
    append_hex(text, "\x01");
    append_hex(text, "\xfe");
    EXPECT_EQ(text, "x=01fe");
}

TEST(StreamHex, BlanksAround) {
    EXPECT_EQ(unhex(" \t0aff\t "), "\x0a\xff");
    EXPECT_EQ(unhex("  "), "");
    EXPECT_EQ(refusal("0a ff"), "' ' in column 3 is no hexadecimal digit");
    EXPECT_EQ(refusal("0a f f"), "' ' in column 3 is no hexadecimal digit");
}

TEST(StreamHex, RefusalsNameTheColumn) {
    EXPECT_EQ(refusal("0"), "an odd number of hexadecimal digits, 1");
    EXPECT_EQ(refusal("0g"), "'g' in column 2 is no hexadecimal digit");
    EXPECT_EQ(refusal("  0g"), "'g' in column 4 is no hexadecimal digit");
    EXPECT_EQ(refusal("g"), "'g' in column 1 is no hexadecimal digit");
    EXPECT_EQ(refusal("0x1f"), "'x' in column 2 is no hexadecimal digit");
    EXPECT_EQ(refusal(std::string_view("00\0\0", 4)),
              R"('\x00' in column 3 is no hexadecimal digit)");
}

TEST(StreamHex, EveryOtherByteIsRefusedAnywhere) {
    for (unsigned c = 0; c < 256; ++c) {
        const char digit = static_cast<char>(c);
        const bool good = std::isxdigit(static_cast<int>(c)) != 0;
        EXPECT_EQ(refusal(std::string{'a', digit, 'a', 'a'}).starts_with("taken"), good) << c;
        EXPECT_EQ(refusal(std::string{'a', 'a', digit, 'a'}).starts_with("taken"), good) << c;
    }
}

TEST(StreamHex, ReadsBackTheSame) {
    EXPECT_TRUE(rc::check("from_hex(append_hex(b)) is b", [](const std::string& bytes) {
        std::string text = hex(bytes);
        RC_ASSERT(text.size() == 2 * bytes.size());
        RC_ASSERT(unhex(text) == bytes);
        for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        RC_ASSERT(unhex(text) == bytes);
    }));
}

/// Protobuf's own reader of varints finds the length and the record.
TEST(StreamHex, ADelimitedRecordIsProtobufs) {
    for (const std::size_t size : {0U, 1U, 127U, 128U, 16383U, 16384U, 70000U}) {
        const std::string record(size, 'r');
        std::string bytes = "before";
        append_delimited(bytes, record);
        google::protobuf::io::ArrayInputStream array(bytes.data() + 6,
                                                     static_cast<int>(bytes.size()) - 6);
        google::protobuf::io::CodedInputStream in(&array);
        std::uint32_t length = 0;
        ASSERT_TRUE(in.ReadVarint32(&length));
        EXPECT_EQ(length, size);
        std::string read;
        ASSERT_TRUE(in.ReadString(&read, static_cast<int>(length)));
        EXPECT_EQ(read, record);
        EXPECT_EQ(in.CurrentPosition(), static_cast<int>(bytes.size()) - 6);
    }
}

}  // namespace seautils::stream
