// The text format: read by protobuf's parser, with faults placed; written on one line as protobuf's
// printer writes it.
#include "fuzz/rich.hpp"

#include "seautils/core/error.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

namespace seautils::schema {
namespace {

const Layout& two() { return *fuzz::rich().two; }

Values read(const std::string& text, const Layout& layout = two()) {
    Values values;
    read_text(text, fuzz::rich().pool, layout, values);
    return values;
}

std::string refusal(const std::string& text) {
    try {
        std::string json;
        write_json(read(text), json);
        return "taken: " + json;
    } catch (const DataError& e) {
        return e.what();
    }
}

std::string written(const Values& values) {
    std::string text;
    write_text(values, text);
    return text;
}

std::string printed(const std::string& text) {
    const auto message = fuzz::rich().pool.new_message(*two().descriptor);
    EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, message.get()));
    google::protobuf::TextFormat::Printer printer;
    printer.SetSingleLineMode(true);
    std::string out;
    printer.PrintToString(*message, &out);
    if (out.ends_with(' ')) out.pop_back();
    return out;
}

}  // namespace

TEST(SchemaText, ReadsWhatPeopleWrite) {
    const std::string json =
        R"(taken: {"on":true,"i32":-5,"twofold":1.5,"name":"a\"b","state":"RUN",)"
        R"("sub_message":{"u32":7},"list":[1,2,3],"names":["x","y"]})";
    EXPECT_EQ(refusal("on: true i32: -5 twofold: 1.5 name: \"a\\\"b\" state: RUN "
                      "sub_message { u32: 7 } list: [1, 2, 3] names: \"x\" names: \"y\""),
              json);
    EXPECT_EQ(refusal("on: true,\ni32: -0x5;\ntwofold: 1.5 # half\nname: 'a' \"\\\"b\"\nstate: 2\n"
                      "sub_message: < u32: 0x7 >\nlist: 1\nlist: 2\nlist: 3\nnames: ['x', 'y']\n"),
              json);
    EXPECT_EQ(refusal(""), "taken: {}");
    EXPECT_EQ(refusal(" \n# nothing\n"), "taken: {}");
}

TEST(SchemaText, FaultsArePlaced) {
    EXPECT_EQ(refusal("on: maybe"),
              "column 10: invalid value for boolean field \"on\". Value: \"maybe\"");
    EXPECT_EQ(refusal("\n\n  zzz: 1").substr(0, 18), "line 3 column 6: m");
    EXPECT_NE(refusal("zzz: 1").find("zzz"), std::string::npos);
    for (const char* bad : {"i32: 2147483648",
                            "u32: -1",
                            "i32: 1.5",
                            "i32: 99999999999999999999",
                            "state: NOPE",
                            "name: 1",
                            "name: \"a",
                            "sub_message {",
                            "sub_message { } }",
                            "i32 5",
                            "i32:",
                            ": 5",
                            "i32: 1 i32: 2",
                            "first: 1 second: \"x\"",
                            "list: [1, 2",
                            "{}",
                            "[x]: 1",
                            "on: true x",
                            "on: \"true\"",
                            "name: \"\\xff\\",
                            "sub_message: 5"}) {
        const std::string what = refusal(bad);
        EXPECT_FALSE(what.starts_with("taken")) << bad << ' ' << what;
        EXPECT_EQ(what.find('\n'), std::string::npos);
        EXPECT_LT(what.size(), 400U);
        EXPECT_NE(what.find("column "), std::string::npos) << what;
    }
    EXPECT_LT(refusal(std::string(100'000, 'x')).size(), 400U);
    EXPECT_LT(refusal(std::string(100'000, '\0')).size(), 400U);
}

TEST(SchemaText, NestingIsBounded) {
    const auto nested = [](std::size_t levels) {
        std::string text;
        for (std::size_t k = 0; k < levels; ++k) text += "sub_message {";
        return text + std::string(levels, '}');
    };
    EXPECT_TRUE(refusal(nested(31)).starts_with("taken"));
    EXPECT_FALSE(refusal(nested(32)).starts_with("taken"));
    EXPECT_FALSE(refusal(nested(100'000)).starts_with("taken"));
    EXPECT_LT(refusal(nested(100'000)).size(), 400U);
    const std::string lists(100'000, '[');
    EXPECT_FALSE(refusal("list: " + lists).starts_with("taken"));
}

TEST(SchemaText, WritesAsProtobufsPrinterDoes) {
    for (const char* text :
         {"",
          "on: true",
          "on: false i32: -1 i64: -9223372036854775808 u64: 18446744073709551615",
          "name: \"\\n\\t\\r\\\\\\\"\\'\"",
          "name: \"a\\001\\177b\"",
          "raw: \"\\000\\377\\200\"",
          "state: STOP states: RUN states: IDLE",
          "sub_message { }",
          "subs { on: true } subs { }",
          "sub_message { sub_message { i32: 1 } }",
          "list: 1 list: 2",
          "packed_list: -1",
          "single: 1.5 twofold: 0.25",
          "twofold: inf",
          "twofold: -inf",
          "twofold: nan",
          "single: 0.1 twofold: 0.1",
          "Grp { g: 1 }",
          "first: 0",
          "second: \"\"",
          "third { }",
          "far_away: 1 i32: 2"}) {
        EXPECT_EQ(written(read(text)), printed(text)) << text;
    }
    // Characters beyond ASCII are escaped, which every reader takes.
    EXPECT_EQ(written(read("name: \"é\"")), "name: \"\\303\\251\"");
}

TEST(SchemaText, ProtosOfVersionThree) {
    const Layout& three = *fuzz::rich().three;
    EXPECT_EQ(written(read("i32: 0 name: \"\" maybe: 0 first: 0", three)), "maybe: 0 first: 0");
    EXPECT_EQ(written(read("mode: 7", three)), "mode: 7");
    EXPECT_EQ(written(read("mode: FAST modes: [SLOW, 9]", three)),
              "mode: FAST modes: SLOW modes: 9");
}

}  // namespace seautils::schema
