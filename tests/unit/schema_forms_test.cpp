// Our JSON, text and binary forms are protobuf's: held against its own printers and parsers over
// random messages with every kind of field.
#include "fuzz/rich.hpp"

#include "seautils/core/error.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"

#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <limits>

namespace seautils::schema {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using nlohmann::json;

template <class Int>
Int any_int() {
    using Limits = std::numeric_limits<Int>;
    return *rc::gen::weightedOneOf<Int>(
        {{3, rc::gen::arbitrary<Int>()},
         {1, rc::gen::element<Int>(Limits::min(), Limits::max(), Int{0}, static_cast<Int>(-1))}});
}

double any_double() {
    switch (*rc::gen::inRange(0, 4)) {
        case 0:
            return *rc::gen::element(0.0, -0.0, 5e-324, 2.2250738585072014e-308,
                                     1.7976931348623157e308, 0.1, 1e21, 1e22, 123456789012345680.0,
                                     1e-7, 9007199254740993.0,
                                     std::numeric_limits<double>::infinity(),
                                     -std::numeric_limits<double>::infinity(), std::nan(""));
        case 1:
            return *rc::gen::inRange(-100000, 100000) / 100.0;
        default:
            return std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
    }
}

float any_float() {
    if (*rc::gen::inRange(0, 3) == 0)
        return static_cast<float>(*rc::gen::inRange(-10000, 10000)) / 100.0F;
    const auto x = std::bit_cast<float>(*rc::gen::arbitrary<std::uint32_t>());
    return std::isnan(x) ? std::numeric_limits<float>::quiet_NaN()
                         : x;  // one NaN is as good as another
}

/// Text of every width of UTF-8, with what JSON and the text format must escape.
std::string any_text() {
    static const std::vector<std::string> pieces{"a",
                                                 "Z",
                                                 "\"",
                                                 "\\",
                                                 "/",
                                                 "\n",
                                                 "\t",
                                                 "\b",
                                                 "\f",
                                                 "\r",
                                                 std::string(1, '\0'),
                                                 "\x1f",
                                                 "\x7f",
                                                 "é",
                                                 "✓",
                                                 "\xe2\x80\xa8",
                                                 "😀",
                                                 "<",
                                                 "'",
                                                 " "};
    std::string text;
    for (int n = *rc::gen::inRange(0, 8); n > 0; --n) text += *rc::gen::elementOf(pieces);
    return text;
}

/// Sets a field, or adds an element to a repeated one; `depth` more levels are allowed.
void set(Message& m, const FieldDescriptor* f, int depth, bool groups);

/// @param groups  protobuf's JSON cannot carry them
void fill(Message& m, int depth, bool groups) {
    const auto* d = m.GetDescriptor();
    for (int k = 0; k < d->field_count(); ++k) {
        const FieldDescriptor* f = d->field(k);
        const bool message = f->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
        if (message && depth == 0) continue;
        if (f->type() == FieldDescriptor::TYPE_GROUP && !groups) continue;
        if (*rc::gen::inRange(0, message ? 5 : 3) != 0) continue;
        const int count = f->is_repeated() ? *rc::gen::inRange(1, 4) : 1;
        for (int n = 0; n < count; ++n) set(m, f, depth, groups);
    }
}

void set(Message& m, const FieldDescriptor* f, int depth, bool groups) {
    const auto* r = m.GetReflection();
    const bool list = f->is_repeated();
    const auto put = [&](auto one, auto add, auto value) {
        list ? (r->*add)(&m, f, value) : (r->*one)(&m, f, value);
    };
    using R = google::protobuf::Reflection;
    switch (f->cpp_type()) {
        case FieldDescriptor::CPPTYPE_BOOL:
            return put(&R::SetBool, &R::AddBool, *rc::gen::arbitrary<bool>());
        case FieldDescriptor::CPPTYPE_INT32:
            return put(&R::SetInt32, &R::AddInt32, any_int<std::int32_t>());
        case FieldDescriptor::CPPTYPE_INT64:
            return put(&R::SetInt64, &R::AddInt64, any_int<std::int64_t>());
        case FieldDescriptor::CPPTYPE_UINT32:
            return put(&R::SetUInt32, &R::AddUInt32, any_int<std::uint32_t>());
        case FieldDescriptor::CPPTYPE_UINT64:
            return put(&R::SetUInt64, &R::AddUInt64, any_int<std::uint64_t>());
        case FieldDescriptor::CPPTYPE_FLOAT:
            return put(&R::SetFloat, &R::AddFloat, any_float());
        case FieldDescriptor::CPPTYPE_DOUBLE:
            return put(&R::SetDouble, &R::AddDouble, any_double());
        case FieldDescriptor::CPPTYPE_ENUM: {
            const auto* e = f->enum_type();
            return put(&R::SetEnumValue, &R::AddEnumValue,
                       e->value(*rc::gen::inRange(0, e->value_count()))->number());
        }
        case FieldDescriptor::CPPTYPE_STRING: {
            std::string text = any_text();
            if (f->type() == FieldDescriptor::TYPE_BYTES) text += "\xff\xc0";
            return list ? r->AddString(&m, f, text) : r->SetString(&m, f, text);
        }
        case FieldDescriptor::CPPTYPE_MESSAGE:
            return fill(list ? *r->AddMessage(&m, f) : *r->MutableMessage(&m, f), depth - 1,
                        groups);
    }
}

/// A random message, its layout, and its values as reflection sees them.
struct Sample {
    explicit Sample(bool groups = false) : layout(fuzz::rich().layout(*rc::gen::inRange(0U, 2U))) {
        message = fuzz::rich().pool.new_message(*layout.descriptor);
        fill(*message, 3, groups);
        from_message(*message, layout, values);
    }
    std::unique_ptr<Message> other() const {
        return fuzz::rich().pool.new_message(*layout.descriptor);
    }

    const Layout& layout;
    std::unique_ptr<Message> message;
    Values values;
};

bool same(const Message& a, const Message& b) {
    google::protobuf::util::MessageDifferencer differencer;
    google::protobuf::util::DefaultFieldComparator comparator;
    comparator.set_treat_nan_as_equal(true);
    differencer.set_field_comparator(&comparator);
    std::string difference;
    differencer.ReportDifferencesToString(&difference);
    const bool equal = differencer.Compare(a, b);
    RC_LOG() << difference;
    return equal;
}

std::string printed(const Message& message, bool original_names) {
    google::protobuf::util::JsonPrintOptions options;
    options.preserve_proto_field_names = original_names;
    std::string text;
    EXPECT_TRUE(google::protobuf::util::MessageToJsonString(message, &text, options).ok());
    return text;
}

void read(const std::string& text, const Layout& layout, Values& values) {
    static JsonReader reader;
    const std::string padded = text + std::string(64, '\0');
    reader.read(std::string_view(padded).substr(0, text.size()), layout, values);
}

}  // namespace

/// It sees in ours what it sees in its own (which in proto3 is no -0: its parser drops the sign).
TEST(SchemaForms, ProtobufReadsOurJson) {
    EXPECT_TRUE(rc::check("write_json", [] {
        const Sample sample;
        std::string text;
        write_json(sample.values, text);
        const auto ours = sample.other();
        const auto theirs = sample.other();
        RC_LOG() << text;
        RC_ASSERT(google::protobuf::util::JsonStringToMessage(text, ours.get()).ok());
        RC_ASSERT(google::protobuf::util::JsonStringToMessage(printed(*sample.message, true),
                                                              theirs.get())
                      .ok());
        RC_ASSERT(same(*theirs, *ours));
    }));
}

namespace {

/// Numbers as binary32 too: of a float protobuf writes nine digits, we the fewest that tell it.
bool same_document(const json& a, const json& b) {
    if (a.is_number() && b.is_number()) {
        return a.get<double>() == b.get<double>() || a.get<float>() == b.get<float>();
    }
    if (a.type() != b.type() || a.size() != b.size()) return false;
    if (!a.is_structured()) return a == b;
    for (auto x = a.begin(), y = b.begin(); x != a.end(); ++x, ++y) {
        if (a.is_object() && x.key() != y.key()) return false;
        if (!same_document(*x, *y)) return false;
    }
    return true;
}

}  // namespace

TEST(SchemaForms, OurJsonIsProtobufsJson) {
    EXPECT_TRUE(rc::check("write_json, as documents", [] {
        const Sample sample;
        std::string text;
        write_json(sample.values, text);
        const std::string theirs = printed(*sample.message, true);
        RC_LOG() << text << "\n" << theirs << "\n";
        const bool equal_documents = same_document(json::parse(text), json::parse(theirs));
        RC_ASSERT(equal_documents);
    }));
}

TEST(SchemaForms, WeReadProtobufsJson) {
    EXPECT_TRUE(rc::check("JsonReader", [] {
        const Sample sample;
        for (const bool original_names : {true, false}) {
            Values values;
            const std::string theirs = printed(*sample.message, original_names);
            RC_LOG() << theirs << "\n";
            read(theirs, sample.layout, values);
            RC_ASSERT(equal(sample.values, values));
        }
    }));
}

TEST(SchemaForms, OurBinaryFormIsProtobufs) {
    EXPECT_TRUE(rc::check("write_binary, read_binary", [] {
        const Sample sample(true);
        std::string bytes;
        write_binary(sample.values, bytes);
        RC_LOG() << sample.message->ShortDebugString();
        RC_ASSERT(bytes == sample.message->SerializeAsString());
        Values values;
        read_binary(bytes, sample.layout, values);
        RC_ASSERT(equal(sample.values, values));
        // Cut anywhere, it is refused or ends between two fields: never read beyond.
        const auto cut =
            static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(bytes.size()) + 1));
        try {
            read_binary(std::string_view(bytes).substr(0, cut), sample.layout, values);
        } catch (const DataError&) {
        }
    }));
}

TEST(SchemaForms, OurTextIsProtobufs) {
    EXPECT_TRUE(rc::check("write_text, read_text", [] {
        const Sample sample(true);
        std::string text;
        write_text(sample.values, text);
        RC_ASSERT(text.find('\n') == std::string::npos);
        const auto back = sample.other();
        RC_ASSERT(google::protobuf::TextFormat::ParseFromString(text, back.get()));
        RC_ASSERT(same(*sample.message, *back));
        google::protobuf::TextFormat::Printer printer;
        printer.SetSingleLineMode(true);
        std::string theirs;
        printer.PrintToString(*sample.message, &theirs);
        Values values;
        read_text(theirs, fuzz::rich().pool, sample.layout, values);
        RC_ASSERT(equal(sample.values, values));
    }));
}

namespace {

bool protobuf_takes(const std::string& text) {
    const auto message = fuzz::rich().pool.new_message(*fuzz::rich().two->descriptor);
    return google::protobuf::util::JsonStringToMessage(text, message.get()).ok();
}

bool we_take(const std::string& text) {
    Values values;
    try {
        read(text, *fuzz::rich().two, values);
        return true;
    } catch (const DataError& e) {
        EXPECT_LT(std::string(e.what()).size(), 300U);
        return false;
    }
}

}  // namespace

TEST(SchemaForms, WhatProtobufsParserRefusesWeRefuse) {
    for (const char* bad : {"[]",
                            "1",
                            "null",
                            "{",
                            R"({"on":tru})",
                            R"({"i32":2147483648})",
                            R"({"i32":1.5})",
                            R"({"u32":-1})",
                            R"({"u64":18446744073709551616})",
                            R"({"i64":"9223372036854775808"})",
                            R"({"i32":""})",
                            R"({"i32":" 1"})",
                            R"({"i32":+1})",
                            R"({"twofold":1e999})",
                            R"({"single":1e39})",
                            R"({"name":1})",
                            R"({"name":"\ud800"})",
                            R"({"raw":"!"})",
                            R"({"state":"NOPE"})",
                            R"({"sub_message":1})",
                            R"({"nobody":1})",
                            R"({"first":1,"second":""})",
                            R"({"on":true}{)",
                            R"({"on":true} x)",
                            "{\"name\":\"\xff\"}"}) {
        EXPECT_FALSE(we_take(bad)) << bad;
        EXPECT_FALSE(protobuf_takes(bad)) << bad;
    }
}

TEST(SchemaForms, WeAreStricterWhereProtobufGuesses) {
    for (const char* bad : {R"({"name":"\x"})", "{\"name\":\"a\nb\"}", R"({"list":1})",
                            R"({"list":[1,null]})", R"({"list":[[1]]})", R"({"subs":{}})",
                            "{on:true}", "{'on':true}", R"({"on":true,})", R"({"list":[1,]})"}) {
        EXPECT_FALSE(we_take(bad)) << bad;
        EXPECT_TRUE(protobuf_takes(bad)) << bad << ": move it to the test above";
    }
}

TEST(SchemaForms, NestingIsBounded) {
    const Layout& two = *fuzz::rich().two;
    const auto nested = [](int levels) {
        std::string text;
        for (int k = 0; k < levels; ++k) text += "{\"sub_message\":";
        return text + "{}" + std::string(static_cast<std::size_t>(levels), '}');
    };
    Values values;
    EXPECT_NO_THROW(read(nested(31), two, values));
    EXPECT_THROW(read(nested(32), two, values), DataError);
    EXPECT_THROW(read(nested(100000), two, values), DataError);
}

}  // namespace seautils::schema
