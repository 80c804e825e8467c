// Conditions on the wire: which bits they take away, add, and move. Bits are worked out by hand.
#include "dccl_bench.hpp"

namespace seautils::dccl {
namespace {

const std::string state = "enum State { IDLE = 1; RUN = 2; FAULT = 3; } required State state = 1;";
const std::string end = "required uint32 end = 90 [(dccl.field) = { min: 0 max: 15 }];";

std::string number(const std::string& label, const std::string& conditions,
                   const std::string& bounds = "min: 0 max: 15") {
    return label + " uint32 v = 2 [(dccl.field) = { " + bounds + " dynamic_conditions { " +
           conditions + " } }];";
}

TEST(DcclDynamic, OmittedFieldsTakeNoBits) {
    for (const int v : {3, 4}) {
        Bench b(version(v, state + number("required", "omit_if: \"this.state == 'IDLE'\"") + end));
        // state 2 bits, v 4 bits, end 4 bits
        EXPECT_EQ(b.encode("state: RUN v: 5 end: 9"), "025502");  // 01 0101 1001
        EXPECT_EQ(b.decode("025502"), "state: RUN v: 5 end: 9");
        EXPECT_EQ(b.decode("0224"), "state: IDLE end: 9");  // 00 1001
        EXPECT_NE(
            b.refusal("state: IDLE v: 5 end: 9").find("v is set although its condition omits it"),
            std::string::npos);
        b.options.lenient = true;
        EXPECT_EQ(b.encode("state: IDLE v: 5 end: 9"), "0224");
    }
}

TEST(DcclDynamic, Version2KnowsOnlyBoundsOfSingleFields) {
    Bench b(version(2, state + number("optional", "omit_if: \"true\"", "min: 0 max: 14") + end));
    EXPECT_EQ(b.encode("state: RUN v: 5 end: 9"), "025902");  // 01, code 6, 9
    Bench r(
        version(2, state + number("optional", "required_if: \"true\"", "min: 0 max: 14") + end));
    EXPECT_EQ(r.encode("state: RUN v: 5 end: 9"), "025902");
    Bench m(version(2, state + number("required", "max: \"3\"") + end));
    EXPECT_EQ(m.encode("state: RUN v: 3 end: 9"), "029d");  // 01, 2 bits 11, 9
}

TEST(DcclDynamic, RequiredFieldsHaveNoCodeForUnset) {
    for (const int v : {3, 4}) {
        Bench b(
            version(v, state + number("optional", "required_if: \"this.state == 'RUN'\"") + end));
        // RUN: 16 codes, 4 bits. Else 17, 5 bits.
        EXPECT_EQ(b.encode("state: RUN v: 15 end: 9"), "027d02");  // 01 1111 1001
        EXPECT_EQ(b.decode("027d02"), "state: RUN v: 15 end: 9");
        EXPECT_EQ(b.encode("state: IDLE v: 15 end: 9"), "02c004");  // 00, 16 in 5 bits, 1001
        EXPECT_EQ(b.decode("02c004"), "state: IDLE v: 15 end: 9");
        EXPECT_EQ(b.decode(b.encode("state: RUN end: 9")), "state: RUN v: 0 end: 9")
            << "the minimum";
        EXPECT_EQ(b.decode(b.encode("state: IDLE end: 9")), "state: IDLE end: 9");
    }
}

TEST(DcclDynamic, OnlyIfIsBoth) {
    Bench b(version4(state + number("optional", "only_if: \"this.state == 'RUN'\"") + end));
    EXPECT_EQ(b.encode("state: RUN v: 15 end: 9"), "027d02");
    EXPECT_EQ(b.encode("state: IDLE end: 9"), "0224");
    Bench o(version4(
        state + number("optional", "only_if: \"true\" omit_if: \"this.state == 'IDLE'\"") + end));
    EXPECT_EQ(o.encode("state: IDLE end: 9"), "0224") << "omit_if wins over only_if";
}

TEST(DcclDynamic, EveryCodecHasItsRequiredForm) {
    // R of state RUN: 2 bits of state before, nothing behind.
    const auto bits = [](const std::string& field, int v) {
        Bench b(version(v, state + field));
        const auto size = [&](const std::string& text) { return b.encode(text).size() / 2 - 1; };
        return std::pair(size("state: RUN"), size("state: IDLE"));
    };
    const auto conditional = [](const std::string& type, const std::string& options) {
        return "enum E { A = 1; B = 2; C = 3; D = 4; } optional " + type +
               " v = 2 [(dccl.field) = { " + options +
               " dynamic_conditions { required_if: \"this.state == 'RUN'\" } }];";
    };
    using Sizes = std::pair<std::size_t, std::size_t>;
    EXPECT_EQ(bits(conditional("bytes", "max_length: 3"), 4), Sizes(1, 1));  // 2 bits of length; 1
    EXPECT_EQ(bits(conditional("bytes", "max_length: 3"), 3), Sizes(4, 1));  // 24 bits; 1
    EXPECT_EQ(bits(conditional("string", "max_length: 255"), 4), Sizes(2, 1));  // 8; 1
    EXPECT_EQ(bits(conditional("string", "max_length: 255"), 3), Sizes(2, 2));  // 8 either way
    EXPECT_EQ(bits(conditional("double", "codec: \"dccl.time\" num_days: 6"), 4),
              Sizes(3, 3));  // 20 bits: 518401 and 518402 codes
    EXPECT_EQ(bits(conditional("sfixed64", "codec: \"dccl.native_protobuf\""), 4), Sizes(9, 1));
    EXPECT_EQ(bits(conditional("int64", "codec: \"dccl.presence\" min: 0 max: 127"), 4),
              Sizes(2, 1));
    Bench flag(version4(state + conditional("bool", "") + end));
    EXPECT_EQ(flag.encode("state: RUN v: true end: 9"), "024d");   // 01 1 1001
    EXPECT_EQ(flag.encode("state: IDLE v: true end: 9"), "0298");  // 00 10 1001
    EXPECT_EQ(flag.decode("024d"), "state: RUN v: true end: 9");
    Bench e(version4(state + conditional("E", "") + end));
    EXPECT_EQ(e.encode("state: RUN v: D end: 9"), "029d");     // 01 11 1001
    EXPECT_EQ(e.encode("state: IDLE v: D end: 9"), "023001");  // 00 100 1001
    EXPECT_EQ(e.decode("023001"), "state: IDLE v: D end: 9");
}

TEST(DcclDynamic, BoundsMoveWidthAndOffset) {
    for (const int v : {2, 3, 4}) {
        Bench b(version(v,
                        "required int32 base = 1 [(dccl.field) = { min: 0 max: 1000 }];"
                        "required int32 near = 2 [(dccl.field) = { min: -100 max: 1100 "
                        "  dynamic_conditions { min: \"(this.base or 0) - 4\" max: \"(this.base or "
                        "0) + 3\" } }];" +
                            end));
        // base 10 bits; 8 values in 3 bits; end
        EXPECT_EQ(b.program()->body_max_bits(), 10U + 11 + 4) << "static bounds";
        const std::string hex = b.encode("base: 500 near: 499 end: 9");
        EXPECT_EQ(hex, to_hex(from_hex("02 f4 2d 01")));  // 0111110100, 3 = 011, 1001
        EXPECT_EQ(b.decode(hex), "base: 500 near: 499 end: 9");
        EXPECT_NE(b.refusal("base: 500 near: 504 end: 9").find("near 504 is outside 496 to 503"),
                  std::string::npos);
    }
}

TEST(DcclDynamic, ScriptsDoNotLeaveTheStaticBounds) {
    Bench b(
        version4("required int32 base = 1 [(dccl.field) = { min: -2000 max: 2047 }];"
                 "required int32 v = 2 [(dccl.field) = { min: 0 max: 100 "
                 "  dynamic_conditions { min: \"this.base\" max: \"this.base + 7\" } }];"));
    EXPECT_EQ(b.decode(b.encode("base: 93 v: 100")), "base: 93 v: 100");
    EXPECT_EQ(b.decode(b.encode("base: 500 v: 100")), "base: 500 v: 100") << "100 to 100";
    EXPECT_EQ(b.decode(b.encode("base: -500 v: 0")), "base: -500 v: 0") << "0 to 0";
    EXPECT_NE(b.refusal("base: 500 v: 99"), "");
}

TEST(DcclDynamic, BoundsAreOnTheGridOfAResolution) {
    const auto with = [](const std::string& step) {
        return version4(
            "required int32 base = 1 [(dccl.field) = { min: 0 max: 100 }];"
            "required double v = 2 [(dccl.field) = { min: 0 max: 100 " +
            step + "  dynamic_conditions { max: \"this.base / 4\" } }];");
    };
    Bench resolution(with("resolution: 0.5"));
    EXPECT_EQ(resolution.decode(resolution.encode("base: 6 v: 1.5")), "base: 6 v: 1.5");
    EXPECT_NE(resolution.refusal("base: 5 v: 1")
                  .find("dynamic bound 1.25 is no multiple of resolution 0.5"),
              std::string::npos);
    EXPECT_NE(resolution.unreadable("02 85"), "");
    Bench precision(with("precision: 1"));  // the same with a precision is the author's affair
    EXPECT_EQ(precision.decode(precision.encode("base: 5 v: 1.2")), "base: 5 v: 1.2");
    Bench none(
        version4("required int32 base = 1 [(dccl.field) = { min: 0 max: 100 }];"
                 "required int32 v = 2 [(dccl.field) = { min: 0 max: 100 "
                 "  dynamic_conditions { min: \"this.base\" max: \"5\" } }];"));
    EXPECT_NE(none.refusal("base: 6 v: 5").find("enclose nothing"), std::string::npos);
}

TEST(DcclDynamic, ElementsAreAskedOneByOne) {
    Bench b(
        version4("repeated uint32 v = 1 [(dccl.field) = { min: 0 max: 15 max_repeat: 6 "
                 "  dynamic_conditions { omit_if: \"this_index % 2 == 0\" } }];" +
                 end));
    b.options.lenient = true;
    // Count 3 bits (4), then the first and third: 5 and 7; the others take no bits.
    const std::string hex = b.encode("v: 5 v: 6 v: 7 v: 8 end: 9");
    EXPECT_EQ(hex, to_hex(from_hex("02 ac 4b")));  // 100, 0101, 0111, 1001
    EXPECT_EQ(b.decode(hex), "v: 5 v: 7 end: 9");
    b.options.lenient = false;
    EXPECT_NE(b.refusal("v: 5 v: 6 end: 9").find("v[1]"), std::string::npos);
}

TEST(DcclDynamic, ElementsOfVersion2TooTakeNoBits) {
    Bench b(version(2,
                    "repeated uint32 v = 1 [(dccl.field) = { min: 0 max: 14 max_repeat: 3 "
                    "  dynamic_conditions { omit_if: \"this_index == 2\" } }];" +
                        end));
    b.options.lenient = true;
    EXPECT_EQ(b.encode("v: 5 v: 6 v: 7 end: 9"), to_hex(from_hex("02 86 09")));  // 6, 8, 9
    EXPECT_EQ(b.decode("02 86 09"), "v: 5 v: 7 end: 9");
}

const std::string child =
    "message Child { required bool has = 1;"
    "  optional uint32 v = 2 [(dccl.field) = { min: 0 max: 15 dynamic_conditions { only_if: "
    "\"this.has\" } }];"
    "  optional uint32 w = 3 [(dccl.field) = { min: 0 max: 15 dynamic_conditions { only_if: "
    "\"root.sel == 2\" } }]; }"
    "required uint32 sel = 1 [(dccl.field) = { min: 0 max: 3 }];";

TEST(DcclDynamic, ThisIsTheInnermostMessage) {
    for (const int v : {3, 4}) {
        Bench b(version(
            v,
            child + "required Child c = 2; repeated Child r = 3 [(dccl.field).max_repeat = 3];"));
        const std::string text =
            "sel: 2 c { has: true v: 3 w: 4 } r { has: false w: 5 } r { has: true v: 6 w: 7 }";
        // 10 | 1 0011 0100 | 10 | 0 0101 | 1 0110 0111
        EXPECT_EQ(b.encode(text), to_hex(from_hex("02 1e 52 b5 03"))) << v;
        EXPECT_EQ(b.decode("02 1e 52 b5 03"), b.message(text)->ShortDebugString());
        EXPECT_EQ(b.decode(b.encode("sel: 1 c { has: false }")), "sel: 1 c { has: false }");
    }
}

TEST(DcclDynamic, SubMessagesCanBeOmitted) {
    Bench b(
        version4("message S { required uint32 q = 1 [(dccl.field) = { min: 0 max: 15 }]; }"
                 "required bool on = 1; optional S s = 2 [(dccl.field) = { dynamic_conditions {"
                 "  omit_if: \"not this.on\" } }];" +
                 end));
    EXPECT_EQ(b.encode("on: true s { q: 5 } end: 9"),
              to_hex(from_hex("02 57 02")));                             // 1 1 0101 1001
    EXPECT_EQ(b.encode("on: true end: 9"), to_hex(from_hex("02 25")));   // 1 0 1001
    EXPECT_EQ(b.encode("on: false end: 9"), to_hex(from_hex("02 12")));  // 0 1001
    for (const char* text : {"on: true s { q: 5 } end: 9", "on: true end: 9", "on: false end: 9"}) {
        EXPECT_EQ(b.decode(b.encode(text)), b.message(text)->ShortDebugString());
    }
    EXPECT_NE(load_refusal(
                  version4("message S {} required bool on = 1; optional S s = 2 [(dccl.field) = {"
                           " dynamic_conditions { required_if: \"this.on\" } }];"))
                  .find("asks about what it decides on"),
              std::string::npos);
}

TEST(DcclDynamic, AHeaderFieldCanDecideOnTheBody) {
    Bench b(
        version4("optional uint32 v = 1 [(dccl.field) = { min: 0 max: 15 dynamic_conditions {"
                 "  only_if: \"this.kind == 1\" } }];"
                 "required uint32 kind = 2 [(dccl.field) = { min: 0 max: 3 in_head: true }];" +
                 end));
    EXPECT_EQ(b.encode("v: 5 kind: 1 end: 9"), to_hex(from_hex("02 01 95")));
    EXPECT_EQ(b.decode("02 01 95"), "v: 5 kind: 1 end: 9");
    EXPECT_EQ(b.decode("02 02 09"), "kind: 2 end: 9");
}

TEST(DcclDynamic, MembersOfOneofs) {
    Bench b(version4(state +
                     "oneof o { uint32 x = 2 [(dccl.field) = { min: 0 max: 15 dynamic_conditions {"
                     " max: \"3\" } }]; bool y = 3; }" +
                     end));
    EXPECT_EQ(b.encode("state: RUN x: 3 end: 9"),
              to_hex(from_hex("02 75 02")));  // 01, 01, 11, 1001
    EXPECT_EQ(b.decode("02 75 02"), "state: RUN x: 3 end: 9");
}

TEST(DcclDynamic, SizesAreThoseOfTheStaticBounds) {
    Bench b(version4(state + number("required", "omit_if: \"true\"") + end));
    EXPECT_EQ(b.program()->body_max_bits(), 10U);
    EXPECT_EQ(b.program()->body_min_bits(), 4U) << "a condition resets the running minimum";
}

TEST(DcclDynamic, WhatAScriptGetsWrongIsSaidOfItsField) {
    Bench b(version4(state + number("required", "omit_if: \"this.nothing.more\"") + end));
    EXPECT_TRUE(b.refusal("state: RUN v: 1 end: 9").starts_with("v "))
        << b.refusal("state: RUN v: 1 end: 9");
    EXPECT_TRUE(b.unreadable("02 55 02").starts_with("v "));
    EXPECT_NE(load_refusal(version4(state + number("required", "omit_if: \"this.\"") + end)), "");
}

}  // namespace
}  // namespace seautils::dccl
