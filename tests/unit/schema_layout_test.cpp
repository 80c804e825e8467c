// Layouts, the flat form of message types, and Values, the flat form of messages: their limits, and that
// what was found stays found.
#include "fuzz/rich.hpp"

#include "seautils/core/error.hpp"
#include "seautils/schema/values.hpp"

#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace seautils::schema {
namespace {

const Layout& two() { return *fuzz::rich().two; }

std::uint32_t index_of(const char* name) { return static_cast<std::uint32_t>(two().find(name)); }

}  // namespace

TEST(SchemaLayout, FieldsStandInTheOrderOfTheirDeclaration) {
    for (const Layout* layout : {&two(), fuzz::rich().three}) {
        const auto& descriptor = *layout->descriptor;
        ASSERT_EQ(layout->fields.size(), static_cast<std::size_t>(descriptor.field_count()));
        for (int k = 0; k < descriptor.field_count(); ++k) {
            const Field& f = layout->fields[static_cast<std::size_t>(k)];
            const auto& d = *descriptor.field(k);
            EXPECT_EQ(f.name, d.name());
            EXPECT_EQ(f.number, d.number());
            EXPECT_EQ(f.repeated, d.is_repeated());
            EXPECT_EQ(f.packed, d.is_packed());
            EXPECT_EQ(f.has_presence, d.has_presence());
            EXPECT_EQ(f.kind == Kind::message, d.message_type() != nullptr);
            EXPECT_EQ(f.kind == Kind::enumeration, d.enum_type() != nullptr);
        }
    }
}

TEST(SchemaLayout, FieldsAreFoundByNameAndNumberWhateverTheHint) {
    EXPECT_TRUE(rc::check("find", [] {
        const auto hint = *rc::gen::inRange(0U, 40U);
        for (std::uint32_t k = 0; k < two().fields.size(); ++k) {
            const Field& f = two().fields[k];
            RC_ASSERT(two().find(f.name, hint) == static_cast<std::int32_t>(k));
            RC_ASSERT(two().find(f.json_name, hint) == static_cast<std::int32_t>(k));
            RC_ASSERT(two().find_number(f.number, hint) == static_cast<std::int32_t>(k));
        }
        RC_ASSERT(two().find("", hint) == -1);
        RC_ASSERT(two().find("subMessag", hint) == -1);
        RC_ASSERT(two().find_number(0, hint) == -1);
        RC_ASSERT(two().find_number(99'999, hint) == -1);
        RC_ASSERT(two().find_number(-1, hint) == -1);
    }));
}

TEST(SchemaLayout, ANameGoesBeforeAnotherFieldsCamelCase) {
    Pool pool;
    pool.load_text("t.proto",
                   "syntax = \"proto2\"; message M { optional int32 a_b = 1 [json_name = \"x\"]; "
                   "optional int32 x = 2 [json_name = \"y\"]; }");
    const Layout& layout = pool.layout(pool.message("M"));
    EXPECT_EQ(layout.find("x"), 1);
    EXPECT_EQ(layout.find("a_b"), 0);
    EXPECT_EQ(layout.find("y"), 1);
}

TEST(SchemaLayout, EnumeratorsWithAliases) {
    Pool pool;
    pool.load_text("t.proto",
                   "syntax = \"proto2\"; message M { optional E e = 1; } "
                   "enum E { option allow_alias = true; HIGH = 7; ZERO = 0; TOP = 7; LOW = -3; }");
    const EnumLayout& e = *pool.layout(pool.message("M")).fields[0].enumeration;
    EXPECT_EQ(e.find(7)->name, "HIGH");  // the one declared first
    EXPECT_EQ(e.find("TOP")->number, 7);
    EXPECT_EQ(e.find(-3)->name, "LOW");
    EXPECT_EQ(e.find(1), nullptr);
    EXPECT_EQ(e.find("high"), nullptr);
    EXPECT_EQ(e.find(""), nullptr);
    EXPECT_FALSE(e.open);
    EXPECT_EQ(e.values[1].name, "ZERO");
}

TEST(SchemaLayout, OneofsRealAndSynthetic) {
    const Layout& three = *fuzz::rich().three;
    ASSERT_EQ(three.oneofs.size(), 2U);
    EXPECT_EQ(three.oneofs[0].name, "choice");
    EXPECT_EQ(three.oneofs[0].fields.size(), 2U);
    EXPECT_FALSE(three.oneofs[0].synthetic);
    EXPECT_TRUE(three.oneofs[1].synthetic);
    const auto maybe = static_cast<std::uint32_t>(three.find("maybe"));
    EXPECT_EQ(three.oneofs[1].fields, std::vector<std::uint32_t>{maybe});
    EXPECT_TRUE(three.fields[maybe].has_presence);
}

namespace {

using google::protobuf::DescriptorProto;
using google::protobuf::FieldDescriptorProto;

FieldDescriptorProto& add_field(DescriptorProto& message, FieldDescriptorProto::Type type) {
    FieldDescriptorProto& field = *message.add_field();
    field.set_number(message.field_size());
    field.set_name("f" + std::to_string(field.number()));
    field.set_label(FieldDescriptorProto::LABEL_OPTIONAL);
    field.set_type(type);
    return field;
}

/// A type with so many fields, each a type of 99 fields of its own: a schema of more than 1 MiB.
google::protobuf::FileDescriptorProto wide(int types) {
    google::protobuf::FileDescriptorProto file;
    file.set_name("wide.proto");
    file.add_message_type()->set_name("M");
    for (int t = 0; t < types; ++t) {
        const std::string name = "T" + std::to_string(t);
        DescriptorProto& type = *file.add_message_type();
        type.set_name(name);
        for (int f = 0; f < 99; ++f) add_field(type, FieldDescriptorProto::TYPE_BOOL);
        add_field(*file.mutable_message_type(0), FieldDescriptorProto::TYPE_MESSAGE)
            .set_type_name("." + name);
    }
    return file;
}

}  // namespace

TEST(SchemaLayout, FieldsInAllAreBounded) {
    for (const int types : {1000, 1001}) {
        google::protobuf::DescriptorPool pool;
        const auto* file = pool.BuildFile(wide(types));
        ASSERT_NE(file, nullptr);
        LayoutSet layouts;
        if (types == 1000)
            EXPECT_NO_THROW(layouts.of(*file->message_type(0)));
        else
            EXPECT_THROW(layouts.of(*file->message_type(0)), ConfigError);
    }
}

TEST(SchemaLayout, ValuesAndTextsOfARecordAreBounded) {
    Values values;
    values.reset(two());
    const auto used = static_cast<std::uint32_t>(two().fields.size());
    EXPECT_NO_THROW(values.add_elements(0, (1U << 18) - used));
    EXPECT_THROW(values.add_elements(1, 1), DataError);
    values.reset(two());
    EXPECT_NO_THROW(values.add_text(0, 1U << 24));
    EXPECT_THROW(values.add_text(1, 1), DataError);
}

TEST(SchemaLayout, LayoutsByHand) {
    LayoutSet set;
    Layout layout;
    layout.full_name = "by.Hand";
    for (const char* name : {"b", "a"}) {
        Field f;
        f.name = name;
        f.number = name[0];
        layout.fields.push_back(f);
    }
    const Layout& kept = set.add(std::move(layout));
    EXPECT_EQ(kept.find("a"), 1);
    EXPECT_EQ(kept.find_number('b'), 0);
    EXPECT_EQ(kept.by_number, (std::vector<std::uint32_t>{1, 0}));
    EXPECT_EQ(kept.descriptor, nullptr);
    Layout large;
    large.fields.resize(100'000);
    EXPECT_THROW(set.add(std::move(large)), ConfigError);
}

TEST(SchemaValues, BeginAbsent) {
    Values values;
    values.reset(two());
    for (std::uint32_t k = 0; k < two().fields.size(); ++k) {
        EXPECT_FALSE(values[k].present);
        EXPECT_EQ(values[k].u, 0U);
        EXPECT_EQ(values[k].aux, 0U);
    }
}

TEST(SchemaValues, SlotsAreBounded) {
    Values values;
    values.reset(two());
    const auto root = static_cast<std::uint32_t>(two().fields.size());
    EXPECT_EQ(values.add_slots(Values::max_slots - root), root);
    EXPECT_NO_THROW(values.add_slots(0));
    EXPECT_THROW(values.add_slots(1), DataError);
    values.reset(two());
    EXPECT_THROW(values.add_slots(0xffffffff), DataError);
    EXPECT_THROW(values.add_elements(index_of("list"), Values::max_slots), DataError);
    values.reset(two());
    std::uint32_t count = 0;
    try {
        for (;; ++count) values.append_element(index_of("list"));
    } catch (const DataError&) {
    }
    EXPECT_GE(count, Values::max_slots / 4);
    EXPECT_LT(count, Values::max_slots);
    values.reset(two());
    EXPECT_EQ(values.add_slots(1), root);  // as if nothing had been
}

TEST(SchemaValues, TextIsBounded) {
    Values values;
    values.reset(two());
    const std::string half(Values::max_text_bytes / 2, 'x');
    values.set_text(index_of("name"), half);
    values.set_text(index_of("raw"), half);
    EXPECT_EQ(values.text(values[index_of("raw")]), half);
    EXPECT_THROW(values.set_text(index_of("second"), "x"), DataError);
    EXPECT_THROW(values.add_text(index_of("second"), 0xffffffff), DataError);
    values.reset(two());
    EXPECT_THROW(values.set_text(0, std::string(Values::max_text_bytes + 1, 'x')), DataError);
}

/// Elements keep their values while the list grows, and other lists between them.
TEST(SchemaValues, ListsGrow) {
    EXPECT_TRUE(rc::check("append_element", [] {
        Values values;
        values.reset(two());
        const std::uint32_t lists[] = {index_of("list"), index_of("packed_list")};
        std::vector<std::int64_t> expected[2];
        for (const std::int64_t x : *rc::gen::arbitrary<std::vector<std::int64_t>>()) {
            const unsigned which = *rc::gen::inRange(0U, 2U);
            const std::uint32_t at = values.append_element(lists[which]);
            RC_ASSERT(!values[at].present);
            values[at].i = x;
            values[at].present = true;
            expected[which].push_back(x);
        }
        for (const unsigned which : {0U, 1U}) {
            const Slot& list = values[lists[which]];
            RC_ASSERT(list.present == !expected[which].empty());
            RC_ASSERT(list.aux == expected[which].size());
            for (std::uint32_t k = 0; k < list.aux; ++k)
                RC_ASSERT(values[static_cast<std::uint32_t>(list.u) + k].i == expected[which][k]);
        }
    }));
}

TEST(SchemaValues, EqualLooksAtWhatIsPresent) {
    Values a, b;
    a.reset(two());
    b.reset(two());
    EXPECT_TRUE(equal(a, b));
    a[index_of("i32")].i = 5;  // not present
    EXPECT_TRUE(equal(a, b));
    a[index_of("i32")].present = true;
    EXPECT_FALSE(equal(a, b));
    b[index_of("i32")] = a[index_of("i32")];
    EXPECT_TRUE(equal(a, b));
    // The same text at another place is the same.
    b.set_text(index_of("name"), "filler");
    b.set_text(index_of("name"), "x");
    a.set_text(index_of("name"), "x");
    EXPECT_TRUE(equal(a, b));
    a[index_of("twofold")].d = 0.0;
    b[index_of("twofold")].d = -0.0;
    a[index_of("twofold")].present = b[index_of("twofold")].present = true;
    EXPECT_FALSE(equal(a, b));
    a.add_block(index_of("sub_message"), two());
    b[index_of("twofold")].d = 0.0;
    EXPECT_FALSE(equal(a, b));
    b.add_block(index_of("sub_message"), two());
    EXPECT_TRUE(equal(a, b));
    Values other;
    other.reset(*fuzz::rich().three);
    EXPECT_FALSE(equal(a, other));
}

}  // namespace seautils::schema
