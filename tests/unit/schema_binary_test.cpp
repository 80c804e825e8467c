// The binary form, byte by byte: what the encoding's definition calls well formed is read as protobuf
// reads it, and what is not is refused at its byte.
#include "fuzz/rich.hpp"

#include "seautils/core/error.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"

#include <google/protobuf/stubs/logging.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace seautils::schema {
namespace {

const Layout& two() { return *fuzz::rich().two; }
const Layout& three() { return *fuzz::rich().three; }

std::string varint(std::uint64_t x) {
    std::string bytes;
    for (; x >= 0x80; x >>= 7) bytes += static_cast<char>((x & 0x7f) | 0x80);
    return bytes + static_cast<char>(x);
}

/// A field's tag: its number and a wire type of the definition.
std::string tag(std::uint64_t number, unsigned type) { return varint(number << 3 | type); }

std::string counted(const std::string& bytes) { return varint(bytes.size()) + bytes; }

std::string operator""_b(const char* text, std::size_t size) { return {text, size}; }

std::string read(const std::string& bytes, const Layout& layout = two()) {
    Values values;
    std::string text;
    try {
        read_binary(bytes, layout, values);
        write_json(values, text);
    } catch (const DataError& e) {
        return e.what();
    }
    return text;
}

bool is_refused(const std::string& bytes, const Layout& layout = two()) {
    return read(bytes, layout).starts_with("byte ");
}

/// What protobuf's parser sees; empty where it refuses.
std::string theirs(const std::string& bytes, const Layout& layout) {
    const auto message = fuzz::rich().pool.new_message(*layout.descriptor);
    const google::protobuf::LogSilencer silence;  // it prints of texts that are not UTF-8
    if (!message->ParsePartialFromString(bytes)) return {};
    Values values;
    from_message(*message, layout, values);
    std::string text;
    write_json(values, text);
    return text;
}

}  // namespace

TEST(SchemaBinary, ExamplesOfTheDefinition) {
    // protobuf.dev, Encoding: 150 in field 1 is 08 96 01; -2 as int32 takes ten bytes.
    EXPECT_EQ(read("\x10\x96\x01"_b), R"({"i32":150})");
    EXPECT_EQ(read("\x10\xfe\xff\xff\xff\xff\xff\xff\xff\xff\x01"_b), R"({"i32":-2})");
    EXPECT_EQ(read("\x30\x01\x38\x02"_b), R"({"s32":-1,"s64":"1"})");
    EXPECT_EQ(read("\x72\x07testing"_b), R"({"name":"testing"})");
    EXPECT_EQ(read("\x8a\x01\x03\x10\x96\x01"_b), R"({"sub_message":{"i32":150}})");
    EXPECT_EQ(read("\x92\x01\x06\x03\x8e\x02\x9e\xa7\x05"_b), R"({"list":[3,270,86942]})");
    EXPECT_EQ(read(""), "{}");
}

TEST(SchemaBinary, NumbersAreCutToTheirType) {
    EXPECT_EQ(read(tag(2, 0) + varint(0x1ffffffffULL)), R"({"i32":-1})");
    EXPECT_EQ(read(tag(4, 0) + varint(0x100000007ULL)), R"({"u32":7})");
    EXPECT_EQ(read(tag(1, 0) + varint(1ULL << 63)), R"({"on":true})");
    EXPECT_EQ(read(tag(6, 0) + varint(0x100000002ULL)), R"({"s32":1})");
    EXPECT_EQ(read(tag(6, 0) + varint(0xffffffff)), R"({"s32":-2147483648})");
    EXPECT_EQ(read(tag(7, 0) + varint(~0ULL)), R"({"s64":"-9223372036854775808"})");
}

TEST(SchemaBinary, OverlongVarints) {
    EXPECT_EQ(read("\x10\x81\x80\x80\x00"_b), R"({"i32":1})");
    EXPECT_EQ(read("\x90\x80\x00\x05"_b), R"({"i32":5})");  // a tag in more bytes than it takes
    EXPECT_EQ(read("\x28"_b + std::string(9, '\xff') + "\x01"),
              R"({"u64":"18446744073709551615"})");
    EXPECT_EQ(read("\x28"_b + std::string(10, '\xff') + "\x01"),
              "byte 11: a varint of more than ten bytes");
    EXPECT_TRUE(is_refused(std::string(10, '\x80') + "\x01"));
}

TEST(SchemaBinary, WhatIsCutIsRefusedAtItsByte) {
    EXPECT_EQ(read("\x10"_b), "byte 1: the message is cut short");
    EXPECT_EQ(read("\x10\x80"_b), "byte 2: the message is cut short");
    EXPECT_EQ(read("\x80"_b), "byte 1: the message is cut short");
    EXPECT_EQ(read("\x45\x01\x02\x03"_b), "byte 1: the message is cut short");  // fixed32
    EXPECT_EQ(read("\x69\x01\x02\x03"_b), "byte 1: the message is cut short");  // double
    EXPECT_EQ(read("\x72\x05test"_b), "byte 2: the message is cut short");      // string
    EXPECT_EQ(read("\x8a\x01\x04\x10\x96\x01"_b), "byte 3: the message is cut short");
    EXPECT_TRUE(is_refused("\x8a\x01\x02\x10\x96\x01"_b));  // the number goes beyond its message
    EXPECT_TRUE(is_refused("\x72\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01"_b));
    EXPECT_TRUE(is_refused("\xc3\x01\x08\x01"_b));  // a group without its end
}

TEST(SchemaBinary, TagsThatAreNone) {
    EXPECT_EQ(read("\x00\x01"_b), "byte 1: not a field's tag");  // field 0
    EXPECT_EQ(read("\x07"_b), "byte 1: not a field's tag");
    EXPECT_EQ(read("\x16\x01"_b), "byte 1: not a wire type");
    EXPECT_EQ(read("\x17\x01"_b), "byte 1: not a wire type");
    EXPECT_TRUE(is_refused(varint(std::uint64_t{1} << 35) + "\x01"));
    EXPECT_EQ(read("\x14"_b), "byte 1: the end of a group that was not begun");
}

TEST(SchemaBinary, UnknownFieldsAreSkipped) {
    const std::string on = "\x08\x01"_b;
    for (const std::string& unknown :
         {tag(999, 0) + varint(~0ULL), tag(999, 1) + "12345678", tag(999, 2) + counted("abc"),
          tag(999, 5) + "1234", tag(999, 3) + tag(999, 4),
          tag(999, 3) + tag(5, 0) + "\x01" + tag(6, 3) + tag(6, 4) + tag(999, 4),
          tag(536870911, 0) + "\x01"}) {
        EXPECT_EQ(read(unknown + on), R"({"on":true})");
        EXPECT_EQ(read(on + unknown), R"({"on":true})");
        EXPECT_EQ(theirs(unknown + on, two()), R"({"on":true})");
    }
    EXPECT_TRUE(is_refused(tag(999, 3) + tag(998, 4)));
    EXPECT_TRUE(is_refused(tag(999, 3) + on));
}

TEST(SchemaBinary, AWrongWireTypeIsAnUnknownField) {
    EXPECT_EQ(read(tag(2, 5) + "1234" + tag(1, 0) + "\x01"), R"({"on":true})");
    EXPECT_EQ(read(tag(14, 0) + "\x05" + tag(1, 0) + "\x01"), R"({"on":true})");
    EXPECT_EQ(read(tag(17, 3) + tag(17, 4) + tag(1, 0) + "\x01"), R"({"on":true})");
    EXPECT_EQ(read(tag(24, 2) + counted("\x08\x01") + tag(1, 0) + "\x01"), R"({"on":true})");
}

TEST(SchemaBinary, PackedAndUnpackedAreBothRead) {
    const std::string packed = tag(18, 2) + counted("\x01\x02");
    const std::string unpacked = tag(18, 0) + "\x03";
    EXPECT_EQ(read(packed + unpacked + packed), R"({"list":[1,2,3,1,2]})");
    EXPECT_EQ(read(tag(19, 0) + "\x04"), R"({"packed_list":["2"]})");
    EXPECT_EQ(read(tag(18, 2) + counted("")), "{}");
    EXPECT_EQ(read(tag(23, 2) + counted(std::string(8, '\0') + std::string(8, '\0'))),
              R"({"doubles":[0,0]})");
    EXPECT_TRUE(is_refused(tag(23, 2) + counted("1234567")));  // a part of a number
    EXPECT_TRUE(is_refused(tag(18, 2) + counted("\x80")));
}

TEST(SchemaBinary, TheLastValueCounts) {
    EXPECT_EQ(read(tag(2, 0) + "\x01" + tag(2, 0) + "\x02"), R"({"i32":2})");
    EXPECT_EQ(read(tag(14, 2) + counted("one") + tag(14, 2) + counted("two")), R"({"name":"two"})");
    // Sub-messages are merged, lists are joined.
    EXPECT_EQ(read(tag(17, 2) + counted("\x10\x01\x08\x01") + tag(17, 2) + counted("\x10\x02")),
              R"({"sub_message":{"on":true,"i32":2}})");
    // Of a oneof, the last member alone is left.
    EXPECT_EQ(read(tag(25, 0) + "\x01" + tag(26, 2) + counted("x")), R"({"second":"eA=="})");
    EXPECT_EQ(read(tag(26, 2) + counted("x") + tag(25, 0) + "\x01"), R"({"first":1})");
    EXPECT_EQ(
        read(tag(27, 2) + counted("\x08\x01") + tag(25, 0) + "\x01" + tag(27, 2) + counted("")),
        R"({"third":{}})");
    // In proto3 a default counts as unset, but not in a oneof or with `optional`.
    EXPECT_EQ(read("\x10\x05\x10\x00"_b, three()), "{}");
    EXPECT_EQ(read(tag(17, 0) + "\0"_b + tag(18, 0) + "\0"_b, three()), R"({"maybe":0,"first":0})");
}

TEST(SchemaBinary, EnumeratorsThatAreNotDeclared) {
    EXPECT_EQ(read(tag(16, 0) + "\x02" + tag(16, 0) + "\x07"), R"({"state":"RUN"})");
    EXPECT_EQ(read(tag(22, 0) + "\x07" + tag(22, 0) + "\x02"), R"({"states":["RUN"]})");
    EXPECT_EQ(read(tag(22, 2) + counted("\x07\x02\x09")), R"({"states":["RUN"]})");
    EXPECT_EQ(read(tag(11, 0) + "\x07", three()), R"({"mode":7})");  // open
}

TEST(SchemaBinary, TextsMustBeUtf8) {
    EXPECT_EQ(read(tag(14, 2) + counted("\xff")), "byte 3: a string that is not UTF-8");
    EXPECT_EQ(read(tag(15, 2) + counted("\xff")), R"({"raw":"/w=="})");
    EXPECT_TRUE(is_refused(tag(20, 2) + "\x02" + counted("\xed\xa0\x80")));
}

TEST(SchemaBinary, NestingIsBounded) {
    const auto nested = [](int levels) {
        std::string bytes;
        for (int k = 0; k < levels; ++k) bytes = tag(17, 2) + counted(bytes);
        return bytes;
    };
    EXPECT_FALSE(is_refused(nested(31)));
    EXPECT_TRUE(is_refused(nested(32)));
    EXPECT_TRUE(is_refused(nested(3000)));
    const auto groups = [](std::size_t levels) {
        std::string bytes;
        for (std::size_t k = 0; k < levels; ++k) bytes += tag(999, 3);
        return bytes;
    };
    EXPECT_EQ(read(groups(100'000)).substr(read(groups(100'000)).find(':')),
              ": nested deeper than 32 messages");
}

TEST(SchemaBinary, ARecordOfManyValuesIsRefusedInBoundedRoom) {
    Values values;
    const std::string packed = tag(18, 2) + counted(std::string(1'000'000, '\x01'));
    EXPECT_THROW(read_binary(packed, two(), values), DataError);
    std::string subs;
    for (int k = 0; k < 100'000; ++k) subs += tag(21, 2) + "\0"_b;
    EXPECT_THROW(read_binary(subs, two(), values), DataError);
}

/// Fields of every kind of flaw, in any order: where protobuf takes them, both see the same.
TEST(SchemaBinary, AnyFieldsInAnyOrderMeanTheSameToProtobuf) {
    int taken = 0;
    EXPECT_TRUE(rc::check("fields", [&] {
        const Layout& layout = *rc::gen::arbitrary<bool>() ? two() : three();
        std::string bytes;
        for (int n = *rc::gen::inRange(0, 12); n > 0; --n) {
            const auto number = *rc::gen::inRange<std::uint64_t>(1, 30);
            const unsigned type = *rc::gen::element(0U, 0U, 1U, 2U, 2U, 5U);
            bytes += tag(number, type);
            const std::string some = *rc::gen::container<std::string>(
                rc::gen::elementOf("\x01\x02\x05\x08\x10\x7f\x80"_b));
            if (type == 0) bytes += varint(*rc::gen::arbitrary<std::uint64_t>());
            if (type == 1) bytes += "12345678";
            if (type == 2) bytes += counted(some);
            if (type == 5) bytes += "1234";
        }
        const std::string us = read(bytes, layout);
        const std::string them = theirs(bytes, layout);
        RC_LOG() << us << '\n' << them;
        if (us.starts_with("byte ") && us.find("UTF-8") != us.npos) return;  // proto2: not checked
        RC_ASSERT(us.starts_with("byte ") == them.empty());
        if (!them.empty()) RC_ASSERT(us == them);
        taken += them.empty() ? 0 : 1;
    }));
    EXPECT_GT(taken, 20);
}

}  // namespace seautils::schema
