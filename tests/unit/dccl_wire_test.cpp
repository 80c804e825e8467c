// The wire format by examples whose bits can be followed by hand; the same bytes were made with the
// reference library (DCCL 4.2.0).
#include "seautils/core/error.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/models.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/pool.hpp"
#include "seautils/stream/hex.hpp"

#include <gtest/gtest.h>

namespace seautils::dccl {
namespace {

constexpr const char* imports = R"(
    syntax = "proto2";
    import "dccl/option_extensions.proto";
    import "dccl/arithmetic/protobuf/arithmetic_extensions.proto";
)";

/// One message type M, its messages as text and its frames as hexadecimal.
class Wire {
public:
    explicit Wire(const std::string& schema, const ProgramOptions& program_options = {},
                  CodecOptions options = {}) {
        pool_.load_text("example.proto", imports + schema);
        layout_ = &pool_.layout(pool_.message("M"));
        program = Program::compile(*layout_, program_options);
        options.now_s = 1'700'000'000;
        codec = Codec(std::move(options));
        codec.load(program);
    }

    std::string encode(const std::string& text) {
        schema::Values values;
        std::string bytes, hex;
        schema::read_text(text, pool_, *layout_, values);
        codec.encode(*program, values, bytes);
        stream::append_hex(hex, bytes);
        return hex;
    }

    std::string decode(const std::string& hex) {
        schema::Values values;
        std::string bytes, text;
        stream::from_hex(hex, bytes);
        EXPECT_EQ(codec.decode(bytes, values).bytes, bytes.size());
        schema::write_text(values, text);
        return text;
    }

    /// Both directions, where what comes back is what went in.
    void expect(const std::string& text, const std::string& hex) {
        EXPECT_EQ(encode(text), hex) << text;
        EXPECT_EQ(decode(hex), text) << hex;
    }

    std::shared_ptr<const Program> program;
    Codec codec;

private:
    schema::Pool pool_;
    const schema::Layout* layout_ = nullptr;
};

}  // namespace

TEST(DcclWire, FieldsComeInTheOrderOfDeclaration) {
    Wire wire(R"(message M { option (dccl.msg) = { id: 170 max_bytes: 32 codec_version: 4 };
        required uint32 z = 9 [(dccl.field) = { min: 0 max: 15 }];
        required uint32 a = 1 [(dccl.field) = { min: 0 max: 255 }]; required bool m = 5; })");
    // 170 * 2 + 1 = 0x0155; 10 + (200 << 4) + (1 << 12) = 0x1c8a
    EXPECT_EQ(wire.encode("z: 10 a: 200 m: true"), "55018a1c");
    EXPECT_EQ(wire.decode("55018a1c"), "a: 200 m: true z: 10");
}

TEST(DcclWire, IdentifiersFrom128TakeTwoBytesAndZeroMeansUnset) {
    Wire wire(R"(message M { option (dccl.msg) = { id: 128 max_bytes: 32 codec_version: 4 };
        optional uint32 v = 1 [(dccl.field) = { min: 0 max: 254 }]; })");
    wire.expect("", "010100");
    wire.expect("v: 128", "010181");
}

TEST(DcclWire, Version2PutsHeaderLeavesOfSubMessagesIntoTheHeader) {
    Wire wire(R"(message M { option (dccl.msg) = { id: 20 max_bytes: 32 codec_version: 2 };
        message Leg {
          required uint32 seq = 1 [(dccl.field) = { min: 0 max: 15 in_head: true }];
          required uint32 dist = 2 [(dccl.field) = { min: 0 max: 1000 }]; }
        required uint32 body1 = 1 [(dccl.field) = { min: 0 max: 100 }];
        required uint32 src = 2 [(dccl.field) = { min: 0 max: 31 in_head: true }];
        required Leg leg = 3;
        required uint32 dest = 4 [(dccl.field) = { min: 0 max: 31 in_head: true }];
        optional uint32 tod = 5 [(dccl.field) = { min: 0 max: 86400 in_head: true }]; })");
    // header: 7, 9, 30 and 43201 in 5, 4, 5 and 17 bits; body: 50 and 123 in 7 and 10
    wire.expect("body1: 50 src: 7 leg { seq: 9 dist: 123 } dest: 30 tod: 43200",
                "28277d302ab23d00");
}

TEST(DcclWire, NumbersSnapToTheirStepTowardsZeroForNegativeHalves) {
    Wire wire(R"(message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
        optional int32 tens = 1 [(dccl.field) = { min: -500 max: 500 precision: -1 }]; })");
    // -17 is -10 on the grid: (-10 + 500) / 10 + 1 = 50 in 7 bits
    EXPECT_EQ(wire.encode("tens: -17"), "0232");
    EXPECT_EQ(wire.decode("0232"), "tens: -10");
}

TEST(DcclWire, RoundingErrorsOfDoublesCountForTheWidth) {
    Wire wire(R"(message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
        required double a = 1 [(dccl.field) = { min: -56 max: -43.3 precision: 1 }]; })");
    EXPECT_EQ(wire.program->body_max_bits(), 8U);  // 128 values
    wire.expect("a: -43.3", "027f");
}

TEST(DcclWire, TextsOfVersions2And4) {
    const std::string fields = R"( };
        required string s = 1 [(dccl.field).max_length = 8];
        optional string so = 2 [(dccl.field).max_length = 3];
        required bytes b = 3 [(dccl.field).max_length = 4];
        optional bytes bo = 4 [(dccl.field).max_length = 3];
        required uint32 end = 5 [(dccl.field) = { min: 0 max: 3 }]; })";
    const std::string text = R"(s: "HELLO" so: "abc" b: "\000\001\377z" bo: "\377\377\377" end: 3)";
    Wire two("message M { option (dccl.msg) = { id: 60 max_bytes: 64 codec_version: 2" + fields);
    two.expect(text, "780548454c4c4f036162630001ff7affffff07");
    Wire four("message M { option (dccl.msg) = { id: 62 max_bytes: 64 codec_version: 4" + fields);
    // 4 bits 5, HELLO; a presence bit, 2 bits 3, abc; 3 bits 4, four bytes; the same as abc: 133 bits,
    // and 3 at bits 5 and 6 of the last byte.
    four.expect(text, "7c8554c4c4f4f430b1310204fcebfdffff7f");
}

TEST(DcclWire, RepeatsCountFromTheirMinimumAndArePadded) {
    CodecOptions lenient;
    lenient.lenient = true;
    Wire wire(R"(message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
        repeated uint32 i = 1 [(dccl.field) = { min: 0 max: 10 min_repeat: 2 max_repeat: 5 }]; })",
              {}, lenient);
    // 2 - 2 in 2 bits, then 1 and 2 in 4 bits each
    wire.expect("i: 1 i: 2", "028400");
    EXPECT_EQ(wire.decode(wire.encode("i: 7")), "i: 7 i: 0");
}

TEST(DcclWire, StrictlyTooFewElementsAreRefused) {
    Wire wire(R"(message M { option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
        repeated uint32 i = 1 [(dccl.field) = { min: 0 max: 10 min_repeat: 2 max_repeat: 5 }]; })");
    EXPECT_THROW(wire.encode("i: 7"), DataError);
    EXPECT_THROW(wire.encode("i: 7 i: 7 i: 7 i: 7 i: 7 i: 7"), DataError);
    EXPECT_THROW(wire.encode("i: 7 i: 11"), DataError);
}

TEST(DcclWire, TheSelectorOfAOneofComesFirst) {
    Wire wire(R"(message M { option (dccl.msg) = { id: 90 max_bytes: 32 codec_version: 4 };
        required uint32 first = 1 [(dccl.field) = { min: 0 max: 15 }];
        oneof command {
          double speed = 2 [(dccl.field) = { min: 0 max: 5 precision: 2 }];
          bool stop = 3; bool go = 4; bool turn = 5; }
        oneof second { bool extra = 6; }
        required uint32 hdr = 7 [(dccl.field) = { min: 0 max: 15 in_head: true }]; })");
    // header 9; command 1 of 4 in 3 bits, second none in 1, first 3 in 4, speed 255 in 9: 0xff31
    EXPECT_EQ(wire.encode("first: 3 speed: 2.55 hdr: 9"), "b40931ff00");
    EXPECT_EQ(wire.decode("b40931ff00"), "first: 3 speed: 2.55 hdr: 9");
}

TEST(DcclWire, TimesAreOfTheDay) {
    Wire wire(R"(message M { option (dccl.msg) = { id: 110 max_bytes: 32 codec_version: 4 };
        required double s = 1 [(dccl.field).codec = "dccl.time"]; })");
    // 1700000000 is 80000 s into its day: 0x13880 in 17 bits
    wire.expect("s: 1700000000", "dc803801");
    // The nearest day to the clock: half a day back and forth.
    EXPECT_EQ(wire.decode(wire.encode("s: 1699956801")), "s: 1699956801");
    EXPECT_EQ(wire.decode(wire.encode("s: 1700043199")), "s: 1700043199");
}

TEST(DcclWire, BodiesAreEncryptedByTheirHeader) {
    const std::string schema =
        R"(message M { option (dccl.msg) = { id: 122 max_bytes: 32 codec_version: 4 };
        required double time = 1 [(dccl.field) = { codec: "dccl.time" in_head: true }];
        required uint32 src = 2 [(dccl.field) = { min: 0 max: 31 in_head: true }];
        required uint32 dest = 3 [(dccl.field) = { min: 0 max: 31 in_head: true }];
        required uint32 n = 4 [(dccl.field) = { min: 0 max: 255 }]; })";
    CodecOptions secret;
    secret.passphrase = "correct horse";
    Wire clear(schema);
    Wire wire(schema, {}, secret);
    const std::string text = "time: 1700000000 src: 3 dest: 9 n: 0";
    EXPECT_EQ(clear.encode(text), "f48038470200");
    // The first byte of AES-256 with the key SHA-256("correct horse") over SHA-256(f480384702)[0..15]
    EXPECT_EQ(wire.encode(text).substr(0, 10), "f480384702");
    EXPECT_NE(wire.encode(text), clear.encode(text));
    EXPECT_EQ(wire.decode(wire.encode(text)), text);
}

TEST(DcclWire, ARunOfNoValuesIsTheIntervalOfItsEnd) {
    ProgramOptions options;
    add_model(R"(name: "delta" frequency: [1, 5, 20, 60, 20, 5, 1] eof_frequency: 4
                 out_of_range_frequency: 2 value_bound: [-3, -2, -1, 0, 1, 2, 3, 4])",
              options.models);
    Wire wire(R"(message M { option (dccl.msg) = { id: 150 max_bytes: 32 codec_version: 4 };
        repeated int32 v = 1 [(dccl.field) = { codec: "dccl.arithmetic" max_repeat: 8 [arithmetic] { model: "delta" } }];
        required uint32 end = 2 [(dccl.field) = { min: 0 max: 255 }]; })",
              options);
    // [0, 4/118) in five bits 0, then 5 in 8 bits
    wire.expect("end: 5", "2d01a000");
}

TEST(DcclWire, CclPutsItsByteInFront) {
    ProgramOptions options;
    options.id_codec = IdCodec::ccl;
    Wire wire(R"(message M { option (dccl.msg) = { id: 14 max_bytes: 16 codec_version: 4 };
        required uint32 v = 1 [(dccl.field) = { min: 0 max: 1023 }]; })",
              options);
    wire.expect("v: 700", "201cbc02");
}

}  // namespace seautils::dccl
