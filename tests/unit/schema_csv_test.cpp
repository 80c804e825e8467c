// Values as rows of a table.
#include "fuzz/rich.hpp"

#include "seautils/core/error.hpp"
#include "seautils/schema/csv.hpp"
#include "seautils/schema/json.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace seautils::schema {
namespace {

struct Table {
    explicit Table(const std::string& messages) {
        pool.load_text("table.proto", "syntax = \"proto2\"; " + messages);
        layout = &pool.layout(pool.message("M"));
    }
    std::string header(const std::map<std::string, std::uint32_t>& counts = {}) const {
        std::string out;
        CsvWriter(*layout, counts).header(out);
        return out;
    }
    std::string row(const std::string& json,
                    const std::map<std::string, std::uint32_t>& counts = {}) const {
        Values values;
        JsonReader().read(json, *layout, values);
        std::string out;
        CsvWriter(*layout, counts).row(values, out);
        return out;
    }
    Pool pool;
    const Layout* layout = nullptr;
};

/// Reads a row by the grammar of RFC 4180, section 2.
std::vector<std::string> cells(std::string_view row) {
    std::vector<std::string> all(1);
    bool inside = false;
    for (std::size_t k = 0; k < row.size(); ++k) {
        const char c = row[k];
        if (inside && c == '"' && k + 1 < row.size() && row[k + 1] == '"') {
            all.back() += row[++k];
        } else if (c == '"') {
            inside = !inside;
        } else if (!inside && c == ',') {
            all.emplace_back();
        } else if (!inside && c == '\n') {
            EXPECT_EQ(k + 1, row.size());
        } else {
            all.back() += c;
        }
    }
    EXPECT_FALSE(inside);
    return all;
}

}  // namespace

TEST(SchemaCsv, ColumnsInTheOrderOfTheSchema) {
    const Table table(R"(message S { optional double depth_m = 1; repeated int32 n = 2; }
        message M { optional int32 b = 5; optional S leg = 2; repeated S sample = 1;
                    oneof o { int32 x = 7; string y = 8; } })");
    EXPECT_EQ(table.header(), "b,leg.depth_m,leg.n[0],sample[0].depth_m,sample[0].n[0],x,y\n");
    EXPECT_EQ(table.header({{"sample", 2}, {"leg.n", 3}, {"sample.n", 0}}),
              "b,leg.depth_m,leg.n[0],leg.n[1],leg.n[2],sample[0].depth_m,sample[1].depth_m,x,y\n");
}

TEST(SchemaCsv, CellsOfEveryKind) {
    const Table table(R"(enum E { RED = 1; }
        message M { optional bool a = 1; optional int32 b = 2; optional int64 c = 3;
                    optional uint64 d = 4; optional float e = 5; optional double f = 6;
                    optional string g = 7; optional bytes h = 8; optional E i = 9; })");
    EXPECT_EQ(table.row(R"({"a":true,"b":-1,"c":"-9223372036854775808","d":"18446744073709551615",)"
                        R"("e":0.1,"f":1e-7,"g":"x","h":"AP8=","i":"RED"})"),
              "true,-1,-9223372036854775808,18446744073709551615,0.1,1e-07,x,AP8=,RED\n");
    EXPECT_EQ(table.row("{}"), ",,,,,,,,\n");
    EXPECT_EQ(table.row(R"({"a":false,"b":0,"g":""})"), "false,0,,,,,,,\n");
}

TEST(SchemaCsv, MissingElementsAreEmptyCells) {
    const Table table(R"(message S { optional int32 n = 1; optional S below = 2; }
        message T { optional int32 n = 1; optional bool on = 2; }
        message M { repeated int32 list = 1; repeated T subs = 2; optional T one = 3; })");
    const std::map<std::string, std::uint32_t> counts{{"list", 3}, {"subs", 2}};
    EXPECT_EQ(table.row(R"({"list":[1,2]})", counts), "1,2,,,,,,,\n");
    EXPECT_EQ(table.row(R"({"subs":[{},{"on":true}],"one":{"n":5}})", counts), ",,,,,,true,5,\n");
    EXPECT_EQ(table.row(R"({"list":[1,2,3,4]})", counts), "1,2,3,,,,,,\n");  // as the header says
}

TEST(SchemaCsv, TextsAreQuotedWhereTheyMustBe) {
    const Table table("message M { optional string s = 1; optional int32 n = 2; }");
    EXPECT_EQ(table.row(R"({"s":"plain text","n":1})"), "plain text,1\n");
    EXPECT_EQ(table.row(R"({"s":"a,b"})"), "\"a,b\",\n");
    EXPECT_EQ(table.row(R"({"s":"say \"hi\""})"), "\"say \"\"hi\"\"\",\n");
    EXPECT_EQ(table.row(R"({"s":"two\nlines\r"})"), "\"two\nlines\r\",\n");
    EXPECT_TRUE(rc::check("any text reads back", [&] {
        const auto text =
            *rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab,\"\r\n; '\t")));
        Values values;
        values.reset(*table.layout);
        values.set_text(0, text);
        std::string out;
        CsvWriter(*table.layout, {}).row(values, out);
        const auto read = cells(out);
        RC_ASSERT(read.size() == 2U);
        RC_ASSERT(read[0] == text);
    }));
}

TEST(SchemaCsv, ColumnsAreBounded) {
    const Table table("message S { repeated int32 n = 1; } message M { repeated S s = 1; }");
    EXPECT_EQ(CsvWriter(*table.layout, {{"s", 100}, {"s.n", 100}}).columns().size(), 10'000U);
    EXPECT_THROW(CsvWriter(*table.layout, {{"s", 100}, {"s.n", 101}}), ConfigError);
    EXPECT_THROW(CsvWriter(*table.layout, {{"s", 4'000'000'000U}, {"s.n", 4'000'000'000U}}),
                 ConfigError);
    // Type that holds itself: as deep as records may be.
    EXPECT_THROW(CsvWriter(*fuzz::rich().two, {}), ConfigError);
}

}  // namespace seautils::schema
