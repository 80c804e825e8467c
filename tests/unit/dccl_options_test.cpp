// The options of fields and messages as schemas write them.
#include "seautils/dccl/options.hpp"

#include "dccl_bench.hpp"

namespace seautils::dccl {
namespace {

/// Options of the field x of message M.
FieldOptions of_field(const std::string& field, const std::string& before = "") {
    Bench bench(before + " message M { " + field + " }");
    return field_options(*bench.pool().message("M").field(0));
}

MessageOptions of_message(const std::string& option) {
    Bench bench("message M { " + option + " }");
    return message_options(bench.pool().message("M"));
}

TEST(DcclOptions, WhatIsNotSaidIsTheDefault) {
    for (const char* field :
         {"optional int32 x = 1;", "optional int32 x = 1 [(dccl.field) = {}];"}) {
        const FieldOptions o = of_field(field);
        EXPECT_FALSE(o.codec || o.in_head || o.precision || o.min || o.max || o.resolution ||
                     o.static_value || o.max_length || o.max_repeat || o.conditions ||
                     o.arithmetic_model || o.ccl_bit_size || o.ccl_thrust_mode_tag);
        EXPECT_FALSE(o.omit);
        EXPECT_TRUE(o.packed_enum);
        EXPECT_EQ(o.num_days, 1U);
        EXPECT_EQ(o.min_repeat, 0U);
        EXPECT_EQ(o.unit, "");
    }
    EXPECT_FALSE(of_message("").any);
    EXPECT_TRUE(of_message("option (dccl.msg) = {};").any);
}

TEST(DcclOptions, AllOfAField) {
    const FieldOptions o = of_field(R"(repeated int32 x = 1 [(dccl.field) = {
        codec: "a.b" omit: true in_head: false precision: -2 min: -1.5 max: 1e300 num_days: 7
        static_value: "s" max_length: 4000000000 max_repeat: 5 packed_enum: false resolution: 0.25
        min_repeat: 3 description: "what"
        dynamic_conditions { required_if: "r" omit_if: "o" only_if: "y" min: "1" max: "2" }
        [arithmetic] { model: "m" } [ccl] { thrust_mode_tag: 9 bit_size: 13 } }];)");
    EXPECT_EQ(o.codec, "a.b");
    EXPECT_TRUE(o.omit);
    EXPECT_EQ(o.in_head, false);
    EXPECT_EQ(o.precision, -2);
    EXPECT_EQ(o.min, -1.5);
    EXPECT_EQ(o.max, 1e300);
    EXPECT_EQ(o.num_days, 7U);
    EXPECT_EQ(o.static_value, "s");
    EXPECT_EQ(o.max_length, 4'000'000'000U);
    EXPECT_EQ(o.max_repeat, 5U);
    EXPECT_FALSE(o.packed_enum);
    EXPECT_EQ(o.resolution, 0.25);
    EXPECT_EQ(o.min_repeat, 3U);
    EXPECT_EQ(o.description, "what");
    ASSERT_TRUE(o.conditions);
    EXPECT_EQ(o.conditions->required_if, "r");
    EXPECT_EQ(o.conditions->omit_if, "o");
    EXPECT_EQ(o.conditions->only_if, "y");
    EXPECT_EQ(o.conditions->min, "1");
    EXPECT_EQ(o.conditions->max, "2");
    EXPECT_EQ(o.arithmetic_model, "m");
    EXPECT_EQ(o.ccl_thrust_mode_tag, 9U);
    EXPECT_EQ(o.ccl_bit_size, 13U);
}

TEST(DcclOptions, OneByOneIsTheSame) {
    const FieldOptions o = of_field(
        "optional int32 x = 1 [(dccl.field).min = 1, (dccl.field).max = 2,"
        " (dccl.field).(arithmetic).model = \"m\", (dccl.field).dynamic_conditions.min = \"3\","
        " (dccl.field).dynamic_conditions.max = \"4\"];");
    EXPECT_EQ(o.min, 1);
    EXPECT_EQ(o.max, 2);
    EXPECT_EQ(o.arithmetic_model, "m");
    EXPECT_EQ(o.conditions->min, "3");
    EXPECT_EQ(o.conditions->max, "4");
}

TEST(DcclOptions, OtherOptionsBesideThem) {
    const FieldOptions o = of_field(
        "repeated int32 x = 1 [packed = true, (dccl.field) = { min: 1 max: 2 }, deprecated = true,"
        " (other) = 5];",
        "import \"google/protobuf/descriptor.proto\"; "
        "extend google.protobuf.FieldOptions { optional int32 other = 50001; }");
    EXPECT_EQ(o.min, 1);
    EXPECT_EQ(o.max, 2);
}

TEST(DcclOptions, AllOfAMessage) {
    const MessageOptions o = of_message(
        "option (dccl.msg) = { id: -5 max_bytes: 4000000000 codec: \"c\" codec_group: \"g\""
        " codec_version: 3 omit_id: true unit_system: \"cgs\" };");
    EXPECT_EQ(o.id, -5);
    EXPECT_EQ(o.max_bytes, 4'000'000'000U);
    EXPECT_EQ(o.codec, "c");
    EXPECT_EQ(o.codec_group, "g");
    EXPECT_EQ(o.codec_version, 3);
    EXPECT_TRUE(o.omit_id);
}

TEST(DcclOptions, TheOldImportPath) {
    schema::Pool pool;
    pool.load_text(
        "t.proto",
        "syntax = \"proto2\"; import \"dccl/protobuf/option_extensions.proto\";"
        "message M { option (dccl.msg).id = 7; optional int32 x = 1 [(dccl.field).max = 2]; }");
    EXPECT_EQ(message_options(pool.message("M")).id, 7);
    EXPECT_EQ(field_options(*pool.message("M").field(0)).max, 2);
}

TEST(DcclOptions, UnitsAreForPeople) {
    const auto unit = [](const std::string& name, const std::string& units) {
        return of_field("optional double " + name + " = 1 [(dccl.field) = { " + units + " }];")
            .unit;
    };
    EXPECT_EQ(unit("x", "units { base_dimensions: \"L\" }"), "m");
    EXPECT_EQ(unit("x", "units { base_dimensions: \"LT^-1\" }"), "m/s");
    EXPECT_EQ(unit("x", "units { derived_dimensions: \"plane_angle\" system: \"angle::degree\" }"),
              "degree");
    EXPECT_EQ(unit("depth_m", ""), "m") << "else by the name's ending";
    EXPECT_EQ(unit("speed_mps", ""), "m/s");
    EXPECT_EQ(unit("altitude", ""), "");
}

}  // namespace
}  // namespace seautils::dccl
