// What is said of schemas that are correct and yet not what their authors think.
#include "seautils/dccl/lint.hpp"

#include "dccl_bench.hpp"
#include "seautils/schema/json.hpp"

namespace seautils::dccl {
namespace {

const std::string time_in_head =
    "required double time_s = 90 [(dccl.field) = { codec: \"dccl.time\" in_head: true }];";

/// The remarks on M, "kind field", in order; with what is said where `texts`.
std::vector<std::string> remarks(Bench& bench, bool texts = false) {
    std::vector<std::string> all;
    for (const Remark& r : lint(*bench.program())) {
        all.push_back(texts ? r.text : r.kind + " " + r.field);
    }
    return all;
}

std::vector<std::string> remarks_on(const std::string& fields, int number = 4) {
    Bench bench(version(number, time_in_head + fields));
    return remarks(bench);
}

using List = std::vector<std::string>;

TEST(DcclLint, CodesThatStandForNothing) {
    const auto field = [](const std::string& options) {
        return remarks_on("optional int32 v = 1 [(dccl.field) = { " + options + " }];");
    };
    EXPECT_EQ(field("min: -100 max: 1000"), List{"wasted-codes v"});  // 1102 of 2048
    EXPECT_EQ(field("min: 0 max: 1022"), List{});                     // 1023 and "not set"
    EXPECT_EQ(field("min: 0 max: 1023"), List{"wasted-codes v"}) << "one more than 10 bits";
    EXPECT_EQ(field("min: 0 max: 766"), List{"wasted-codes v"});  // 768 of 1024: three quarters
    EXPECT_EQ(field("min: 0 max: 767"), List{});
    EXPECT_EQ(field("min: 5 max: 5"), List{}) << "a bit cannot be saved";
}

TEST(DcclLint, TheWayOutIsStated) {
    Bench bench(
        version4(time_in_head +
                 "required int32 v = 1 [(dccl.field) = { min: -100 max: 1000 }];"
                 "optional float w = 2 [(dccl.field) = { min: 0 max: 12.8 precision: 1 }];"));
    // 2048 values from -100 end at 1947, 1024 at 923. 129 values and "not set" are 130; 255 of 0.1
    // end at 25.4, 127 at 12.6.
    const List texts = remarks(bench, true);
    ASSERT_EQ(texts.size(), 3U);  // 12.8 as a float is above 12.8, too
    EXPECT_EQ(texts[0],
              "uses 1101 of 2048 codes (11 bits): max 1947 fits for free, max 923 saves a bit");
    EXPECT_EQ(texts[1],
              "uses 130 of 256 codes (8 bits): max 25.4 fits for free, max 12.6 saves a bit");
}

TEST(DcclLint, WhatItSaysIsFreeIsFree) {
    for (const double max : {9.0, 40.0, 260.0, 1000.0, 33000.0}) {
        const auto with = [](double most) {
            Bench b(version4("optional int32 v = 1 [(dccl.field) = { min: 0 max: " +
                             std::to_string(most) + " }];"));
            return b.program()->body_max_bits();
        };
        const auto width = static_cast<unsigned>(with(max));
        const double free = std::ldexp(1.0, static_cast<int>(width)) - 2;
        EXPECT_EQ(with(free), width) << max;
        EXPECT_EQ(with(free + 1), width + 1) << max;
        EXPECT_EQ(with(free / 2 - 1), width - 1) << max;
    }
}

TEST(DcclLint, TimeInTheHeader) {
    const auto plain = [](const std::string& fields) {
        Bench bench(version4(fields));
        return remarks(bench);
    };
    EXPECT_EQ(plain("required bool b = 1;"), List{"no-time-in-header "});
    EXPECT_EQ(plain("required bool b = 1 [(dccl.field).in_head = true];"), List{}) << "no body";
    EXPECT_EQ(remarks_on("required bool b = 1;"), List{});
    EXPECT_EQ(plain("required bool b = 1; required uint32 seq = 2"
                    " [(dccl.field) = { min: 0 max: 65535 in_head: true }];"),
              List{})
        << "a sequence number will do";
}

TEST(DcclLint, HeaderLeavesThatAreLost) {
    const std::string fields =
        "message S { optional int32 q = 1 [(dccl.field) = { min: 0 max: 14 in_head: true }];"
        "  optional int32 r = 2 [(dccl.field) = { min: 0 max: 14 }]; } optional S sub = 1;";
    EXPECT_EQ(remarks_on(fields, 2), List{});
    EXPECT_EQ(remarks_on(fields, 3), List{"lost-field sub.q"});
    EXPECT_EQ(remarks_on(fields, 4), List{"lost-field sub.q"});
}

TEST(DcclLint, MessagesInTheOtherPartThanWhatIsAroundThem) {
    const auto fields = [](const char* outer, const char* inner) {
        return std::string(
                   "message L { required int32 q = 1 [(dccl.field) = { min: 0 max: 15 }]; }") +
               "message S { required L leg = 1 [(dccl.field).in_head = " + inner + "]; }" +
               "required S sub = 2 [(dccl.field).in_head = " + outer + "];";
    };
    for (const int v : {2, 3, 4}) {
        EXPECT_EQ(remarks_on(fields("true", "true"), v), List{}) << v;
        EXPECT_EQ(remarks_on(fields("true", "false"), v), List{"lost-field sub.leg.q"}) << v;
        EXPECT_EQ(remarks_on(fields("false", "true"), v), List{"lost-field sub.leg.q"}) << v;
    }
    Bench bench(version4(fields("false", "true")));
    EXPECT_NE(bench.refusal("sub { leg { q: 1 } }")
                  .find("sub.leg.q is inside of a message whose in_head"),
              std::string::npos);
    bench.options.lenient = true;
    EXPECT_EQ(bench.encode("sub { leg { q: 1 } }"), "02");
    EXPECT_EQ(bench.decode("02"), "sub { leg { } }");
}

TEST(DcclLint, FloatsThatCannotHoldTheirBound) {
    // As binary32, 0.7 is below itself, and 0.3 above.
    EXPECT_EQ(remarks_on("required float f = 1 [(dccl.field) = { min: 0 max: 0.7 precision: 1 }];"),
              List{});
    EXPECT_EQ(remarks_on("required float f = 1 [(dccl.field) = { min: 0 max: 0.3 precision: 1 }];"),
              List{"unreachable-bound f"});
    EXPECT_EQ(
        remarks_on("required double f = 1 [(dccl.field) = { min: 0 max: 0.3 precision: 1 }];"),
        List{});
    EXPECT_EQ(
        remarks_on("required float f = 1 [(dccl.field) = { min: -0.3 max: 0 precision: 1 }];"),
        List{"unreachable-bound f"});
}

TEST(DcclLint, IntegersInBrokenSteps) {
    const auto lost = [](const char* step, int value) {
        Bench b(version4(std::string("required int32 v = 1 [(dccl.field) = { min: 0 max: 30 ") +
                         step + " }];"));
        EXPECT_EQ(
            b.decode(b.encode("v: " + std::to_string(value))) != "v: " + std::to_string(value),
            !lint(*b.program()).empty() && lint(*b.program()).back().kind == "cut-values")
            << step;
        return !lint(*b.program()).empty() && lint(*b.program()).back().kind == "cut-values";
    };
    EXPECT_TRUE(lost("resolution: 2.5", 1));
    EXPECT_TRUE(lost("resolution: 0.3", 1));
    EXPECT_FALSE(lost("resolution: 0.5", 1));
    EXPECT_FALSE(lost("precision: 1", 7));
    EXPECT_FALSE(lost("resolution: 1", 7));
}

TEST(DcclLint, BoundsOffTheGrid) {
    EXPECT_EQ(
        remarks_on("required double v = 1 [(dccl.field) = { min: -0.75 max: 3.3 precision: 1 }];"),
        (List{"wasted-codes v", "bounds-off-grid v"}));
    EXPECT_EQ(
        remarks_on("required double v = 1 [(dccl.field) = { min: 0 max: 6.3 precision: 1 }];"),
        List{});
}

TEST(DcclLint, PrecisionOfIntegerTimes) {
    EXPECT_EQ(
        remarks_on("required int64 t = 1 [(dccl.field) = { codec: \"dccl.time\" precision: -6 }];"),
        List{"time-precision t"});
    EXPECT_EQ(remarks_on("required int64 t = 1 [(dccl.field).codec = \"dccl.time\"];"), List{});
}

TEST(DcclLint, BytesWhoseLengthIsLost) {
    const std::string fields =
        "required bytes b = 1 [(dccl.field).max_length = 4];"
        "optional bytes c = 2 [(dccl.field) = { max_length: 4 codec: \"dccl.default2\" }];";
    EXPECT_EQ(remarks_on(fields, 3), (List{"length-lost b", "length-lost c"}));
    EXPECT_EQ(remarks_on(fields, 4), List{"length-lost c"});
}

TEST(DcclLint, FramesOf32And64And256Bytes) {
    const auto texts = [](int bytes) {
        return remarks_on(
            "required bytes b = 1 [(dccl.field) = { codec: \"dccl.default3\" max_length: " +
                std::to_string(bytes) + " }];",
            3);
    };
    // One byte of identifier, 17 bits of time: 4 bytes of header.
    EXPECT_EQ(texts(28), List{"length-lost b"});
    EXPECT_EQ(texts(29), (List{"length-lost b", "over-mtu b"}));
    EXPECT_EQ(texts(60), (List{"length-lost b", "over-mtu b"}));
    EXPECT_EQ(texts(61), (List{"length-lost b", "over-mtu b", "over-mtu b"}));
    EXPECT_EQ(texts(253), (List{"length-lost b", "over-mtu b", "over-mtu b", "over-mtu b"}));
}

TEST(DcclLint, TypicalValuesCanBeSent) {
    Bench b(version4(
        time_in_head +
        "optional int32 i = 1 [(dccl.field) = { min: -7 max: 90 }];"
        "required float f = 2 [(dccl.field) = { min: 0 max: 0.3 precision: 1 }];"
        "optional string s = 3 [(dccl.field).max_length = 9];"
        "repeated uint32 r = 4 [(dccl.field) = { min: 0 max: 9 min_repeat: 2 max_repeat: 12 }];"
        "message S { required bool b = 1; oneof o { int32 x = 2 [(dccl.field) = { min: 0 max: 3 }];"
        "  bool y = 3; } } repeated S sub = 5 [(dccl.field).max_repeat = 8];"));
    schema::Values values, back;
    typical_values(*b.program(), 1'700'000'000, values);
    Codec codec(b.options);
    codec.load(b.program());
    std::string bytes, json;
    codec.encode(*b.program(), values, bytes);
    codec.set_now(1'700'000'000);
    codec.decode(bytes, back, b.program().get());
    schema::write_json(back, json);
    // Halfway between the bounds, rounded down: -7 + 48, 4 and 0.1.
    EXPECT_NE(json.find("\"i\":41,\"f\":0.1,"), std::string::npos) << json;
    EXPECT_NE(json.find("\"r\":[4,4,4]"), std::string::npos) << json;
    // A quarter of the repeats; half of the text; four bytes a number, eight the double.
    EXPECT_NE(json.find("\"s\":\"xxxxx\""), std::string::npos) << json;
    EXPECT_NE(json.find("\"sub\":[{\"b\":"), std::string::npos) << json;
    EXPECT_EQ(plain_bytes(values), 4U + 4 + 4 + 8 + 3 * 4 + 2 * 8) << json;
}

}  // namespace
}  // namespace seautils::dccl
