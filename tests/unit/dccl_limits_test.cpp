// What is beyond the limits of seautils-formats(5) is refused by a schema's compiler, soon and in words
// that state the limit.
#include "seautils/core/error.hpp"
#include "seautils/dccl/program.hpp"
#include "seautils/schema/pool.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace seautils::dccl {
namespace {

/// What is said against message M of the schema; empty: nothing.
std::string refusal(const std::string& messages) {
    try {
        schema::Pool pool;
        pool.load_text(
            "hostile.proto",
            "syntax = \"proto2\"; import \"dccl/option_extensions.proto\";\n" + messages);
        Program::compile(pool.layout(pool.message("M")));
    } catch (const ConfigError& e) {
        const std::string what = e.what();
        EXPECT_LT(what.size(), 500U);
        EXPECT_EQ(what.find('\n'), std::string::npos);
        return what;
    }
    return "";
}

std::string message(const std::string& fields, unsigned max_bytes = 1U << 20) {
    return fmt::format(
        "message M {{ option (dccl.msg) = {{ id: 1 max_bytes: {} codec_version: 4 }};\n{} }}",
        max_bytes, fields);
}

/// Messages M, L1, L2, … each in the one before it, with a leaf in the last.
std::string chain(int levels) {
    std::string text = message("optional L1 down = 1;");
    for (int k = 1; k < levels; ++k)
        text += fmt::format("message L{} {{ optional L{} down = 1; }}\n", k, k + 1);
    return text + fmt::format("message L{} {{ optional bool leaf = 1; }}\n", levels);
}

/// M holds two A1, each of them two A2, …: 2^levels leaves from a few lines.
std::string tree(int levels) {
    std::string text = message("optional A1 a = 1; optional A1 b = 2;");
    for (int k = 1; k < levels; ++k) {
        text +=
            fmt::format("message A{0} {{ optional A{1} a = 1; optional A{1} b = 2; }}\n", k, k + 1);
    }
    return text + fmt::format("message A{} {{ optional bool leaf = 1; }}\n", levels);
}

}  // namespace

TEST(DcclLimits, Nesting) {
    EXPECT_EQ(refusal(chain(31)), "");
    EXPECT_NE(refusal(chain(32)).find("32"), std::string::npos) << refusal(chain(32));
    EXPECT_NE(refusal(chain(500)), "");
    EXPECT_NE(refusal(message("optional M down = 1;")).find("contains itself"), std::string::npos);
    EXPECT_NE(refusal(message("repeated N n = 1 [(dccl.field).max_repeat = 2];") +
                      "message N { optional M m = 1; }")
                  .find("contains itself"),
              std::string::npos);
}

TEST(DcclLimits, FieldsInAll) {
    EXPECT_EQ(refusal(tree(10)), "");
    const std::string what = refusal(tree(16));  // 131,070 sub-messages and leaves
    EXPECT_NE(what.find("20000"), std::string::npos) << what;
    EXPECT_NE(refusal(tree(30)), "") << "2^31 fields are not counted one by one";
}

TEST(DcclLimits, Repeats) {
    const auto list = [](long most) {
        return message(fmt::format("repeated bool b = 1 [(dccl.field).max_repeat = {}];", most));
    };
    EXPECT_EQ(refusal(list(65536)), "");
    EXPECT_NE(refusal(list(65537)).find("65536"), std::string::npos) << refusal(list(65537));
    EXPECT_NE(refusal(list(4294967295)), "");
}

TEST(DcclLimits, ValuesInAll) {
    const std::string bomb = message("repeated B b = 1 [(dccl.field).max_repeat = 60000];") +
                             "message B { repeated C c = 1 [(dccl.field).max_repeat = 60000]; }"
                             "message C { repeated bool d = 1 [(dccl.field).max_repeat = 60000]; }";
    EXPECT_NE(refusal(bomb), "");
}

TEST(DcclLimits, BytesOfAMessage) {
    const auto text = [](unsigned length, unsigned most) {
        return message(fmt::format("optional string s = 1 [(dccl.field).max_length = {}];", length),
                       most);
    };
    EXPECT_EQ(refusal(text(1000, 1010)), "");
    EXPECT_NE(refusal(text(1000, 1000)).find("1000"), std::string::npos)
        << "the schema's own limit";
    EXPECT_NE(refusal(text(1U << 20, 4294967295U)), "");
    EXPECT_NE(refusal(text(4294967295U, 4294967295U)), "");
}

TEST(DcclLimits, SizeOfASchema) {
    const std::string comment = "//" + std::string(1U << 20, 'x') + "\n";
    const std::string what = refusal(comment + message("optional bool b = 1;"));
    EXPECT_NE(what.find("1 MiB"), std::string::npos) << what;
    std::string fields;
    for (int k = 1; k <= 19000; ++k)
        fields += fmt::format("optional bool b{0} = {1};", k, k < 19000 ? k : 20001);
    EXPECT_EQ(refusal(message(fields)), "");
}

TEST(DcclLimits, ScriptsOfConditions) {
    const auto script = [](std::size_t bytes) {
        return message("optional bool b = 1 [(dccl.field) = { dynamic_conditions { omit_if: \"" +
                       std::string(bytes - 4, ' ') + "true\" } }];");
    };
    EXPECT_EQ(refusal(script(4096)), "");
    EXPECT_NE(refusal(script(4097)).find("4096"), std::string::npos) << refusal(script(4097));
}

}  // namespace seautils::dccl
