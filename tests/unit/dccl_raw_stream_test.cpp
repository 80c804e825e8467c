// Messages back to back, with bytes lost and bytes between.
#include "seautils/dccl/raw_stream.hpp"

#include "seautils/core/error.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace seautils::dccl {
namespace {

/// What a stream of schemas/seautils gave: the types in order, and what was refused where.
class Reading {
public:
    Reading() : types_({SEAUTILS_SOURCE_DIR "/schemas/seautils/command.proto"}, {}, {}, {}) {}

    /// Frames of WinchControl (id 107: 2 * 107 is 0xd6), 3 bytes each.
    std::string frame(unsigned dest) const { return {'\xd6', static_cast<char>(dest), '\x01'}; }

    /// Gives the stream in pieces of `step` bytes, as a pipe would.
    void read(std::string_view bytes, std::size_t step) {
        RawStream stream(
            types_,
            [&](std::string_view rest) {
                const TypeSet::Decoded decoded = types_.decode(rest, values_);
                names.push_back(decoded.type->name);
                return decoded.bytes;
            },
            [&](std::uint64_t offset, const std::string& what) {
                refused.push_back(std::to_string(offset) + ": " + what);
            });
        std::size_t taken = 0;
        for (std::size_t end = step;; end += step) {
            const bool ended = end >= bytes.size();
            const std::string_view held = bytes.substr(taken, std::min(end, bytes.size()) - taken);
            taken += stream.take(held, taken, ended);
            if (ended) break;
        }
        EXPECT_EQ(taken, bytes.size());
    }

    std::vector<std::string> names, refused;

private:
    TypeSet types_;
    schema::Values values_;
};

}  // namespace

TEST(DcclRawStream, MessagesComeWhereverTheBytesAreCut) {
    for (std::size_t step = 1; step < 12; ++step) {
        Reading reading;
        reading.read(reading.frame(1) + reading.frame(2) + reading.frame(3), step);
        EXPECT_EQ(reading.names.size(), 3U);
        EXPECT_TRUE(reading.refused.empty());
    }
}

TEST(DcclRawStream, NoiseIsSkippedAndCounted) {
    for (std::size_t step = 1; step < 12; ++step) {
        Reading reading;
        reading.read(reading.frame(1) + "\x03\x05\x07" + reading.frame(2), step);
        EXPECT_EQ(reading.names.size(), 2U);
        ASSERT_EQ(reading.refused.size(), 2U);
        EXPECT_TRUE(reading.refused[0].starts_with("3: ")) << reading.refused[0];
        EXPECT_EQ(reading.refused[1], "3: 3 bytes skipped: no message begins there");
    }
}

TEST(DcclRawStream, ACutMessageAtTheEndIsRefused) {
    Reading reading;
    reading.read(reading.frame(1) + "\xd6", 5);
    EXPECT_EQ(reading.names.size(), 1U);
    ASSERT_EQ(reading.refused.size(), 2U);
    EXPECT_TRUE(reading.refused[0].starts_with("3: ")) << reading.refused[0];
    EXPECT_EQ(reading.refused[1], "3: 1 byte skipped: no message begins there");
}

TEST(DcclRawStream, WhereRefusingThrowsReadingEnds) {
    TypeSet types({SEAUTILS_SOURCE_DIR "/schemas/seautils/command.proto"}, {}, {}, {});
    RawStream stream(
        types, [](std::string_view) -> std::size_t { throw DataError("no"); },
        [](std::uint64_t, const std::string&) { throw std::runtime_error("stop"); });
    EXPECT_THROW(stream.take("abc", 0, true), std::runtime_error);
}

TEST(DcclRawStream, AMessageOfNoBytesDoesNotGoOnForEver) {
    const std::string path = ::testing::TempDir() + "no_bytes.proto";
    std::ofstream(path)
        << "syntax = \"proto2\"; import \"dccl/option_extensions.proto\"; message M {"
           " option (dccl.msg) = { omit_id: true max_bytes: 8 codec_version: 4 };"
           " required uint32 a = 1 [(dccl.field) = { min: 3 max: 3 }]; }";
    TypeSet types({path}, {}, {}, {});
    schema::Values values;
    int messages = 0;
    const auto decode = [&](std::string_view bytes) {
        if (++messages > 9) throw std::runtime_error("for ever");
        return types.decode(bytes, values).bytes;
    };
    decode_record(types, "", decode, false);
    decode_record(types, std::string(2, '\0'), decode, false);
    EXPECT_EQ(messages, 2);
    EXPECT_THROW(decode_record(types, "\xff", decode, false), DataError);
    decode_record(types, "\xff", decode, true);
    EXPECT_EQ(messages, 4);
    std::vector<std::string> refused;
    RawStream stream(types, decode,
                     [&](std::uint64_t, const std::string& what) { refused.push_back(what); });
    EXPECT_EQ(stream.take("\xff\xff", 0, true), 2U);
    EXPECT_EQ(messages, 5);
    EXPECT_EQ(refused, (std::vector<std::string>{"the message takes no bytes",
                                                 "2 bytes skipped: no message begins there"}));
}

TEST(DcclRawStream, AnyBytesAreTakenToTheEnd) {
    EXPECT_TRUE(rc::check("raw", [](const std::string& bytes) {
        Reading reading;
        reading.read(bytes, 1 + bytes.size() / 3);
    }));
}

}  // namespace seautils::dccl
