// A codec that the program brings along: found by its name, asked for whole fields, and nothing of the
// other fields changes.
#include "seautils/core/error.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/survey.hpp"
#include "seautils/dccl/type_set.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/pool.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <memory>
#include <string>

namespace seautils::dccl {
namespace {

/// A message with one number n from 1: as many ones, and a zero. Not set is a zero. More than 9 ones
/// leave it unset.
class Unary : public FieldCodec {
public:
    Bounds bounds(const schema::Field& field, const FieldOptions& options) override {
        if (field.kind != schema::Kind::message) throw ConfigError("is for messages");
        return {1, options.max_length.value_or(9) + 1};
    }
    void encode(const schema::Field&, const schema::Values& values, const schema::Slot& slot,
                BitWriter& out) override {
        const schema::Slot& n = values[static_cast<std::uint32_t>(slot.u)];
        if (n.i > 20) throw DataError("is too much");
        for (std::int64_t k = 0; k < n.i; ++k) out.put(1, 1);
        out.put(0, 1);
    }
    void decode(const schema::Field& field, BitReader& in, schema::Values& values,
                std::uint32_t slot) override {
        std::int64_t n = 0;
        while (in.get(1) != 0) ++n;
        if (n == 0 || n > 9) return;
        const std::uint32_t block = values.add_block(slot, *field.message);
        values[block].i = n;
        values[block].present = true;
    }
};

std::string schema_with(const std::string& field) {
    return R"(syntax = "proto2"; import "dccl/option_extensions.proto";
        message Count { optional int32 n = 1; }
        message M {
          option (dccl.msg) = { id: 1 max_bytes: 32 codec_version: 4 };
          optional int32 before = 1 [(dccl.field) = { min: 0 max: 100 }];
          )" +
           field + R"(
          optional int32 after = 3 [(dccl.field) = { min: 0 max: 1000 }];
        })";
}

struct Link {
    explicit Link(const std::string& field, bool is_registered = true) {
        pool.load_text("m.proto", schema_with(field));
        ProgramOptions options;
        if (is_registered) options.field_codecs["test.unary"] = std::make_shared<Unary>();
        program = Program::compile(pool.layout(pool.message("M")), options);
        codec.load(program);
    }
    std::string encode(const std::string& json) {
        schema::Values values;
        std::string bytes;
        schema::JsonReader().read(json + std::string(64, ' '), program->layout(), values);
        codec.encode(*program, values, bytes);
        return bytes;
    }
    std::string decode(const std::string& bytes) {
        schema::Values values;
        std::string json;
        codec.decode(bytes, values);
        schema::write_json(values, json);
        return json;
    }
    schema::Pool pool;
    std::shared_ptr<const Program> program;
    Codec codec;
};

const std::string unary = R"(optional Count count = 2 [(dccl.field).codec = "test.unary"];)";

std::string refusal(const std::string& field, bool is_registered = true) {
    try {
        Link link(field, is_registered);
    } catch (const ConfigError& e) {
        return e.what();
    }
    return "";
}

}  // namespace

TEST(DcclFieldCodec, ANameThatNobodyBringsIsRefused) {
    EXPECT_EQ(refusal(unary, false),
              "message M: field count: no codec 'test.unary' for its type (codec_version 4)");
    EXPECT_EQ(refusal(R"(optional int32 count = 2 [(dccl.field).codec = "test.unary"];)"),
              "message M: field count: codec test.unary: is for messages");
}

TEST(DcclFieldCodec, ItsBoundsCountAsThoseOfOthers) {
    const Link link(unary);
    EXPECT_EQ(link.program->body_min_bits(), 7U + 1 + 10);
    EXPECT_EQ(link.program->body_max_bits(), 7U + 10 + 10);
    const FieldReport row = link.program->report().at(1);
    EXPECT_EQ(row.path, "count");
    EXPECT_EQ(row.codec, "test.unary");
    EXPECT_EQ(row.min_bits, 1U);
    EXPECT_EQ(row.max_bits, 10U);
    EXPECT_EQ(link.program->report().size(), 3U);  // what is inside has no rows of its own
    EXPECT_NE(refusal(R"(optional Count count = 2
        [(dccl.field) = { codec: "test.unary" max_length: 400 }];)"),
              "");  // beyond max_bytes
    EXPECT_NE(refusal(R"(optional Count count = 2
        [(dccl.field) = { codec: "test.unary" in_head: true }];)"),
              "");  // varies
}

TEST(DcclFieldCodec, OtherFieldsKeepTheirBits) {
    Link with(unary), without("");
    EXPECT_TRUE(rc::check([&] {
        const int n = *rc::gen::inRange(0, 15);
        const std::string before = std::to_string(*rc::gen::inRange(0, 101));
        const std::string after = std::to_string(*rc::gen::inRange(0, 1001));
        const std::string count =
            n > 0 ? R"("count":{"n":)" + std::to_string(n) + "}," : std::string();
        const std::string head = R"({"before":)" + before + ",";
        const std::string tail = R"("after":)" + after + "}";
        const std::string frame = with.encode(head + count + tail);
        RC_ASSERT(with.decode(frame) == head + (n > 9 ? "" : count) + tail);
        // Cut out, what is left is the frame of the message without the field.
        const std::string plain = without.encode(head + tail);
        BitReader in(frame), other(plain);
        RC_ASSERT(in.get(15) == other.get(15));
        in.skip(static_cast<std::size_t>(n) + 1);
        RC_ASSERT(in.get(10) == other.get(10));
    }));
}

TEST(DcclFieldCodec, ElementsAndMembersOfAOneof) {
    Link list(R"(repeated Count count = 2
        [(dccl.field) = { codec: "test.unary" min_repeat: 0 max_repeat: 3 }];)");
    const std::string three = R"({"count":[{"n":1},{"n":9},{"n":3}],"after":5})";
    EXPECT_EQ(list.decode(list.encode(three)), three);
    EXPECT_EQ(list.program->body_max_bits(), 7U + 2 + 3 * 10 + 10);
    Link choice(R"(oneof what { Count count = 2 [(dccl.field).codec = "test.unary"];
        int32 other = 4 [(dccl.field) = { min: 0 max: 7 }]; })");
    for (const std::string said : {R"({"count":{"n":4},"after":5})", R"({"other":2,"after":5})"})
        EXPECT_EQ(choice.decode(choice.encode(said)), said);
}

TEST(DcclFieldCodec, ItsErrorsNameTheField) {
    Link link(unary);
    try {
        link.encode(R"({"count":{"n":21}})");
        FAIL();
    } catch (const DataError& e) {
        EXPECT_STREQ(e.what(), "count is too much (message M)");
    }
    try {
        link.decode("\x02\xff\xff");
        FAIL();
    } catch (const DataError& e) {
        EXPECT_EQ(std::string(e.what()).find("count takes 1 bit"), 0U) << e.what();
    }
}

}  // namespace seautils::dccl
