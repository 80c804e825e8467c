// The format's worked examples, and a few more by hand.
#include "dccl_bench.hpp"

namespace seautils::dccl {
namespace {

/// Encodes to these bytes, and they decode to the same message, or to `back`.
void expect_both_ways(Bench& bench, const std::string& text, const std::string& hex,
                      const std::string& back = "") {
    EXPECT_EQ(bench.encode(text), to_hex(from_hex(hex)));
    EXPECT_EQ(bench.decode(hex), bench.message(back.empty() ? text : back)->ShortDebugString());
}

std::string message(const std::string& options, const std::string& fields) {
    return "message M { option (dccl.msg) = { max_bytes: 512 " + options + " }; " + fields + " }";
}

TEST(DcclSpec, DeclarationOrder) {
    // 170 * 2 + 1 = 0x155; z = 1010, then a = 11001000, then m: 10 + 200 * 2^4 + 1 * 2^12 = 0x1c8a
    Bench b(message("id: 170 codec_version: 4",
                    "required uint32 z = 9 [(dccl.field) = { min: 0 max: 15 }];"
                    "required uint32 a = 1 [(dccl.field) = { min: 0 max: 255 }];"
                    "required bool m = 4;"));
    expect_both_ways(b, "z: 10 a: 200 m: true", "5501 8a1c");
}

TEST(DcclSpec, Identifiers) {
    const std::pair<int, const char*> cases[] = {{0, "00"},     {5, "0a"},     {127, "fe"},
                                                 {128, "0101"}, {300, "5902"}, {32767, "ffff"}};
    for (const auto& [id, hex] : cases) {
        Bench b(message("codec_version: 4 id: " + std::to_string(id), ""));
        EXPECT_EQ(b.encode(""), hex);
    }
    Bench none(message("codec_version: 4 omit_id: true",
                       "required uint32 v = 1 [(dccl.field) = { min: 0 max: 1023 }];"));
    expect_both_ways(none, "v: 512", "0002");
    Bench five(message("codec_version: 4 id: 5", ""));
    EXPECT_NE(five.unreadable("0b00").find("identifier 5 stands in two bytes"), std::string::npos);
    EXPECT_NE(load_refusal(message("codec_version: 4 id: 32768", "")).find("32768"),
              std::string::npos);
    EXPECT_NE(load_refusal(message("codec_version: 4 id: -1", "")).find("-1"), std::string::npos);
}

TEST(DcclSpec, OptionalNumberHasACodeForUnset) {
    Bench b(message("id: 128 codec_version: 4",
                    "optional uint32 v = 1 [(dccl.field) = { min: 0 max: 254 }];"));
    expect_both_ways(b, "", "0101 00");
    expect_both_ways(b, "v: 128", "0101 81");
}

TEST(DcclSpec, Version2SplitsAMessageBetweenHeaderAndBody) {
    Bench b(message("id: 20 codec_version: 2",
                    "message Leg {"
                    "  required uint32 seq = 1 [(dccl.field) = { min: 0 max: 9 in_head: true }];"
                    "  required uint32 dist = 2 [(dccl.field) = { min: 0 max: 999 }]; }"
                    "required uint32 body1 = 1 [(dccl.field) = { min: 0 max: 100 }];"
                    "required uint32 src = 2 [(dccl.field) = { min: 0 max: 30 in_head: true }];"
                    "required Leg leg = 3;"
                    "required uint32 dest = 4 [(dccl.field) = { min: 0 max: 30 in_head: true }];"
                    "optional double tod = 5"
                    "  [(dccl.field) = { min: 0 max: 86400 precision: 0 in_head: true }];"));
    expect_both_ways(b, "body1: 50 src: 7 leg { seq: 9 dist: 123 } dest: 30 tod: 43200",
                     "28 27 7d 30 2a b2 3d 00");
    b.options.header_only = true;
    EXPECT_EQ(b.encode("body1: 50 src: 7 leg { seq: 9 dist: 123 } dest: 30 tod: 43200"),
              "28277d302a");
    EXPECT_EQ(b.decode("28277d302a"), "src: 7 leg { seq: 9 } dest: 30 tod: 43200");
}

TEST(DcclSpec, NegativeIntegersRoundTowardsZero) {
    // N = 102: 7 bits. -17 is taken as -10: (-10 + 500) / 10 + 1 = 50
    Bench b(
        message("id: 32 codec_version: 4",
                "optional int32 tens = 1 [(dccl.field) = { min: -500 max: 500 precision: -1 }];"));
    expect_both_ways(b, "tens: -17", "40 32", "tens: -10");
    expect_both_ways(b, "tens: 15", "40 35", "tens: 20");
    expect_both_ways(b, "tens: 504", "40 65", "tens: 500");  // rounding comes first
    EXPECT_NE(b.refusal("tens: 505"), "");
    Bench thousands(message("id: 1 codec_version: 4",
                            "required int64 v = 1 [(dccl.field) = { min: -2000000 max: 2000000 "
                            "precision: -3 }];"));
    EXPECT_EQ(thousands.decode(thousands.encode("v: -499500")), "v: -499000");
}

TEST(DcclSpec, RoundingErrorsOfDoublesCountInTheWidth) {
    Bench b(message("id: 43 codec_version: 4",
                    "required double a = 1 [(dccl.field) = { min: -56 max: -43.3 precision: 1 }];"
                    "required bool end = 2;"));
    EXPECT_EQ(b.program()->body_max_bits(), 9U);  // 128 values in 8 bits
    expect_both_ways(b, "a: -43.3 end: true", "56 7f01");
    EXPECT_EQ(b.decode(b.encode("a: -50.05 end: false")), "a: -50 end: false");
}

TEST(DcclSpec, FloatsAreComparedAsTheyAre) {
    Bench b(message("id: 1 codec_version: 3",
                    "required float p1 = 1 [(dccl.field) = { min: 0 max: 10.1 precision: 1 }];"));
    EXPECT_NE(b.refusal("p1: 10.1"), "") << "10.1f is above 10.1";
    b.options.lenient = true;
    expect_both_ways(b, "p1: 10.1", "02 00", "p1: 0");
}

const std::string texts =
    "required string s = 1 [(dccl.field).max_length = 8];"
    "optional string so = 2 [(dccl.field).max_length = 3];"
    "required bytes b = 3 [(dccl.field).max_length = 4];"
    "optional bytes bo = 4 [(dccl.field).max_length = 3];";
const std::string end_to_3 = "required uint32 end = 99 [(dccl.field) = { min: 0 max: 3 }];";
const std::string text_values =
    R"(s: "HELLO" so: "abc" b: "\000\001\377z" bo: "\377\377\377" end: 3)";

TEST(DcclSpec, TextOfVersion2) {
    Bench b(message("id: 60 codec_version: 2", texts + end_to_3));
    expect_both_ways(b, text_values, "78 05 48454c4c4f 03 616263 0001ff7a ffffff07");
}

TEST(DcclSpec, TextOfVersion4) {
    Bench b(message(
        "id: 62 codec_version: 4",
        texts +
            "optional string old3 = 5 [(dccl.field) = { max_length: 6 codec: \"dccl.default3\" }];"
            "optional string old2 = 6 [(dccl.field) = { max_length: 6 codec: \"dccl.default2\" }];"
            "optional bytes fixed3 = 7 [(dccl.field) = { max_length: 2 codec: \"dccl.default3\" "
            "}];" +
            end_to_3));
    expect_both_ways(b, text_values, "7c 8554c4c4f4f430b1310204fcebfdffff1f0006");
}

TEST(DcclSpec, EmptyTextIsUnsetBeforeVersion4) {
    for (const int v : {2, 3, 4}) {
        Bench b(version(v, "optional string s = 1 [(dccl.field).max_length = 7];"));
        EXPECT_EQ(b.decode(b.encode("s: \"\"")), v == 4 ? "s: \"\"" : "") << v;
    }
}

TEST(DcclSpec, RepeatedIsPaddedToTheLeast) {
    Bench b(message(
        "id: 72 codec_version: 4",
        "repeated int32 i = 1 [(dccl.field) = { min: 0 max: 10 min_repeat: 2 max_repeat: 5 }];"));
    expect_both_ways(b, "i: 1 i: 2", "90 8400");  // 00, 1000, 0100
    EXPECT_NE(b.refusal("i: 7").find("fewer than min_repeat 2"), std::string::npos);
    EXPECT_NE(b.refusal("i: 1 i: 1 i: 1 i: 1 i: 1 i: 1").find("more than max_repeat 5"),
              std::string::npos);
    b.options.lenient = true;
    EXPECT_EQ(b.decode(b.encode("i: 7")), "i: 7 i: 0");
}

const std::string nest =
    "message Inner { optional uint32 a = 1 [(dccl.field) = { min: 0 max: 6 }];"
    "  optional string t = 2 [(dccl.field).max_length = 3]; }"
    "message Mid { required Inner in = 1; optional Inner in_opt = 2; required bool f = 3; }"
    "required Mid m = 1; optional Mid mo = 2; repeated Inner r = 3 [(dccl.field).max_repeat = 2];" +
    end_to_3;

TEST(DcclSpec, NestedMessagesOfVersion3) {
    Bench b(message("id: 81 codec_version: 3", nest));
    expect_both_ways(b, "m { in { } f: true } end: 2", "a2 40 08");
}

TEST(DcclSpec, NestedMessagesOfVersion2) {
    Bench b(message("id: 80 codec_version: 2", nest));
    // `in` and the false that nobody sent: neither can be told from absent.
    expect_both_ways(b, "m { in { } f: true } end: 2", "a0 0000 40 00 00 00 00 00 20",
                     "m { f: true } mo { f: false } end: 2");
}

TEST(DcclSpec, OneofSelectorsComeFirst) {
    Bench b(message(
        "id: 90 codec_version: 4",
        "message Payload { oneof which { uint32 count = 1 [(dccl.field) = { min: 0 max: 100 }];"
        "    bool flag = 2; string word = 3 [(dccl.field).max_length = 5]; }"
        "  optional uint32 tail = 4 [(dccl.field) = { min: 0 max: 2 }]; }"
        "required uint32 first = 1 [(dccl.field) = { min: 0 max: 15 }];"
        "oneof command { double speed = 2 [(dccl.field) = { min: 0 max: 5 precision: 2 }];"
        "  double depth = 3 [(dccl.field) = { min: 0 max: 6000 precision: 0 }];"
        "  Payload load = 4; bytes raw = 5 [(dccl.field).max_length = 4]; }"
        "required uint32 hdr = 6 [(dccl.field) = { min: 0 max: 31 in_head: true }];"
        "oneof second { bool yes = 7; }"
        "optional Payload extra = 8; repeated Payload many = 9 [(dccl.field).max_repeat = 3];"));
    expect_both_ways(b, "first: 3 hdr: 9 speed: 2.55", "b4 09 31 ff 00");
    // Selectors 011 and 0, first 4 bits, then load: its selector 01, count 100 in 7 bits, tail 00
    expect_both_ways(b, "first: 3 hdr: 9 load { count: 100 }", "b4 09 33 91 01");
}

TEST(DcclSpec, PresenceCostsABitAndThenTheRequiredForm) {
    Bench b(message(
        "id: 100 codec_version: 3",
        "optional int32 i = 1 [(dccl.field) = { min: -100 max: 100 codec: \"dccl.presence\" }];"
        "required int32 r = 2 [(dccl.field) = { min: -100 max: 100 codec: \"dccl.presence\" }];"
        "optional bool b = 3 [(dccl.field).codec = \"dccl.presence\"];"));
    expect_both_ways(b, "r: 0", "c8 c800");
    // 1, then 1 + 100 = 101 in 8 bits; 100 in 8 bits; 1, 1: 1 | 101 << 1 | 100 << 9 | 3 << 17
    expect_both_ways(b, "i: 1 r: 0 b: true", "c8 cbc806");
}

TEST(DcclSpec, HeaderAlone) {
    Bench b(message(
        "id: 300 codec_version: 4",
        "enum Kind { DATA = 0; ACK = 1; NACK = 2; }"
        "optional uint32 body1 = 1 [(dccl.field) = { min: 0 max: 100 }];"
        "required Kind kind = 2 [(dccl.field).in_head = true];"
        "required uint64 stamp = 3 [(dccl.field) = { min: 0 max: 4294967295 in_head: true }];"
        "required string note = 4 [(dccl.field).max_length = 12];"
        "repeated uint32 hops = 5 [(dccl.field) = { min: 0 max: 14 min_repeat: 3 max_repeat: 3"
        "  in_head: true }];"));
    b.options.header_only = true;
    expect_both_ways(b, "kind: ACK stamp: 123456 hops: 3 hops: 4 hops: 5",
                     "59 02 01 89 07 00 0c 15");
}

TEST(DcclSpec, TimeIsTakenFromTheDay) {
    Bench b(version(3, "required double s = 1 [(dccl.field).codec = \"dccl.time\"];"));
    b.options.now_s = 1'700'000'000;
    EXPECT_EQ(b.program()->body_max_bits(), 17U);
    expect_both_ways(b, "s: 1700000000", "02 803801");  // 80000 = 0x13880
    // 86400 itself is a code: half a second before midnight rounds up to it.
    EXPECT_EQ(b.encode("s: 1700006399.5"), "02805101");
    b.options.now_s = 1'700'006'399;
    EXPECT_EQ(b.decode("02805101"), "s: 1700006400");
    // More than half a day from the receiver's clock is the next day's, or the last day's.
    b.options.now_s = 1'700'006'400;                   // midnight
    EXPECT_EQ(b.decode("02c0a800"), "s: 1700049600");  // noon: exactly half
    EXPECT_EQ(b.decode("02c1a800"), "s: 1699963201");
    EXPECT_NE(b.refusal("s: -1").find("s -1 "), std::string::npos);
    b.options.lenient = true;
    EXPECT_EQ(b.encode("s: -1"), "02000000");
}

TEST(DcclSpec, TimeOfIntegersIsInMicroseconds) {
    Bench b(version(
        4,
        "optional uint64 t = 1 [(dccl.field) = { codec: \"dccl.time\" precision: -4 num_days: 6 }];"
        "required int64 fine = 2 [(dccl.field) = { codec: \"_time\" precision: 0 }];"));
    b.options.now_s = 1'700'000'000;
    // 6 days in steps of 0.01 s: 51,840,001 codes and null, 26 bits; one day in microseconds: 37 bits
    EXPECT_EQ(b.program()->body_max_bits(), 26U + 37U);
    EXPECT_EQ(b.decode(b.encode("t: 1700000000016000 fine: 1700000000000001")),
              "t: 1700000000020000 fine: 1700000000000001");
}

TEST(DcclSpec, TimeWithAResolutionComesBackInWholeSeconds) {
    Bench b(version(
        4, "required double t = 1 [(dccl.field) = { codec: \"dccl.time\" resolution: 0.5 }];"));
    b.options.now_s = 1'700'000'000;
    const std::string frame = b.encode("t: 1700000000.75");
    EXPECT_EQ(frame, to_hex(from_hex("02 027102")));  // 160002 half seconds
    EXPECT_EQ(b.decode(frame), "t: 1700000001");
    EXPECT_EQ(b.decode(b.encode("t: 1700000000.5")), "t: 1700000001");
    b.options.full_time_resolution = true;
    EXPECT_EQ(b.decode(b.encode("t: 1700000000.5")), "t: 1700000000.5");
}

TEST(DcclSpec, StaticValuesAreReadAsStreamsDo) {
    Bench b(version(
        4,
        "required string s = 1 [(dccl.field) = { codec: \"dccl.static\" static_value: \"two "
        "words\" }];"
        "optional double d = 2 [(dccl.field) = { codec: \"_static\" static_value: \" -2.75e1x\" }];"
        "repeated uint32 r = 3 [(dccl.field) = { codec: \"dccl.static\" static_value: \"9\" "
        "max_repeat: 3 }];"));
    EXPECT_EQ(b.program()->body_max_bits(), 2U);  // the count
    expect_both_ways(b, "s: \"two\" r: 9 r: 9", "02 02", "s: \"two\" d: -27.5 r: 9 r: 9");
    EXPECT_NE(b.refusal("s: \"three\""), "");
}

TEST(DcclSpec, EncryptionTakesTheHeaderForItsNonce) {
    const std::string status =
        message("id: 122 codec_version: 4",
                "enum Mission { IDLE = 0; TRANSIT = 1; SURVEY = 2; LOITER = 3; RETURN = 4; ABORT = "
                "5; DOCKED = 6; }"
                "required double time = 1 [(dccl.field) = { codec: \"dccl.time\" in_head: true }];"
                "required uint32 src = 2 [(dccl.field) = { min: 0 max: 31 in_head: true }];"
                "required uint32 dest = 3 [(dccl.field) = { min: 0 max: 31 in_head: true }];"
                "required double x = 4 [(dccl.field) = { min: -10000 max: 10000 precision: 1 }];"
                "required double y = 5 [(dccl.field) = { min: -10000 max: 10000 precision: 1 }];"
                "required double z = 6 [(dccl.field) = { min: -6000 max: 0 precision: 1 }];"
                "required double speed = 7 [(dccl.field) = { min: -2 max: 10 precision: 2 }];"
                "required double heading = 8 [(dccl.field) = { min: 0 max: 360 precision: 1 }];"
                "optional double pitch = 9 [(dccl.field) = { min: -90 max: 90 precision: 1 }];"
                "optional double roll = 10 [(dccl.field) = { min: -180 max: 180 precision: 1 }];"
                "optional Mission mission = 11; optional uint32 battery = 12 [(dccl.field) = { "
                "min: 0 max: 100 }];"
                "optional bool leak = 13;");
    const std::string values =
        "time: 1700000000 src: 3 dest: 9 x: 450.5 y: -550.1 z: -100 speed: 1.25 heading: 359.9 "
        "pitch: -4.5 roll: 12.3 mission: SURVEY battery: 88 leak: false";
    const std::string sealed = "f480384702 b30613f11a2f29994bde80e50408";
    Bench b(status);
    b.options.now_s = 1'700'000'000;
    b.options.passphrase = "correct horse";
    expect_both_ways(b, values, sealed);
    b.options.skip_crypto_ids = {122};
    expect_both_ways(b, values, "f480384702 39988dc485675e9407c71ae12d1b");
}

TEST(DcclSpec, ArithmeticRunThatEndsAtOnce) {
    ProgramOptions options;
    add_model(
        "name: \"delta\" frequency: [1,5,20,60,20,5,1] eof_frequency: 4 "
        "out_of_range_frequency: 2 value_bound: [-3,-2,-1,0,1,2,3,4]",
        options.models);
    Bench b(
        message("id: 150 codec_version: 3",
                "repeated int32 v = 1 [(dccl.field) = { codec: \"dccl.arithmetic\" max_repeat: 8"
                "  [arithmetic] { model: \"delta\" } }];"
                "required uint32 end = 2 [(dccl.field) = { min: 0 max: 255 }];"),
        options);
    expect_both_ways(b, "end: 5", "2d01 a000");  // EOF: [0, 4/118) takes five zeros
}

TEST(DcclSpec, CclIdentifiers) {
    ProgramOptions ccl;
    ccl.id_codec = IdCodec::ccl;
    Bench wrapped(message("id: 14 codec_version: 4",
                          "required uint32 v = 1 [(dccl.field) = { min: 0 max: 1023 }];"),
                  ccl);
    expect_both_ways(wrapped, "v: 700", "20 1c bc02");
    Bench own(message("id: 213975088 codec_version: 2",  // 0x0cc10030
                      "required uint32 v = 1 [(dccl.field) = { min: 0 max: 255 }];"),
              ccl);
    expect_both_ways(own, "v: 7", "30 07");
    EXPECT_EQ(wrapped.program()->largest_bytes(), 4U);
    EXPECT_EQ(wrapped.program()->reported_max_size(), 5U);  // three bytes of identifier
    EXPECT_EQ(wrapped.program()->reported_min_size(), 3U);  // one
}

TEST(DcclSpec, OptionalOf2To32Minus1ValuesKeepsItsTopValue) {
    Bench b(
        version(4, "optional int32 v = 1 [(dccl.field) = { min: -2147483648 max: 2147483647 }];"));
    expect_both_ways(b, "v: 2147483647", "02 00000000 01");  // code 2^32 in 33 bits
    expect_both_ways(b, "v: -2147483648", "02 01000000 00");
}

TEST(DcclSpec, CodesAboveTheGreatestValueAreDecoded) {
    Bench b(version(4,
                    "required uint32 v = 1 [(dccl.field) = { min: 0 max: 100 }];"
                    "enum E { A = 5; B = 6; C = 7; } optional E e = 2; optional E f = 3;"));
    EXPECT_EQ(b.decode("02 ff 00"), "v: 127 e: A");  // 7 ones, e 01, f 00
    Bench e(version(4, "enum E { A = 5; B = 6; C = 7; } required E e = 1;"));
    EXPECT_EQ(e.decode("02 03"), "") << "no fourth: unset, though required";
}

TEST(DcclSpec, CountsAboveMaxRepeat) {
    Bench numbers(
        version(4, "repeated uint32 v = 1 [(dccl.field) = { min: 0 max: 1 max_repeat: 5 }];"));
    EXPECT_EQ(numbers.decode("02 ff 03"), "v: 1 v: 1 v: 1 v: 1 v: 1 v: 1 v: 1");
    Bench messages(version(4,
                           "message S { optional bool b = 1; } "
                           "repeated S s = 1 [(dccl.field).max_repeat = 5];"));
    EXPECT_NE(messages.unreadable("02 ff ffff").find("more than max_repeat 5"), std::string::npos);
}

TEST(DcclSpec, NativeValuesThatNoEncoderWrites) {
    // A bool is one byte of the header whatever it holds; it was read on into the body as a varint.
    Bench flag(version(4,
                       "required bool h = 1 [(dccl.field) = "
                       "{ codec: \"dccl.native_protobuf\" in_head: true }];"
                       "required uint32 v = 2 [(dccl.field) = { min: 0 max: 255 }];"));
    EXPECT_EQ(flag.decode("02 81 05"), "h: true v: 5");
    EXPECT_EQ(flag.decode("02 00 05"), "h: false v: 5");
    // protobuf takes the low 32 bits of a varint, 0xffffffff here, and then undoes the zigzag.
    Bench number(
        version(4, "required sint32 n = 1 [(dccl.field).codec = \"dccl.native_protobuf\"];"));
    EXPECT_EQ(number.decode("02 ffffffff0f"), "n: -2147483648");
    EXPECT_EQ(number.decode("02 ffffffff7f"), "n: -2147483648");
}

TEST(DcclSpec, PaddingBitsAreNotLookedAt) {
    Bench b(version(4, "required bool h = 1 [(dccl.field).in_head = true]; required bool v = 2;"));
    EXPECT_EQ(b.decode("02 ff fe"), "h: true v: false");
}

}  // namespace
}  // namespace seautils::dccl
