// The binary form of fixes is what protobuf reads by the schema; the texts say the same.
#include "seautils/position/fix_writer.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/pool.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

namespace seautils::position {
namespace {

TEST(FixWriter, the_binary_form_is_that_of_the_schema) {
    schema::Pool pool;
    pool.load(SEAUTILS_SOURCE_DIR "/schemas/seautils/position.proto");
    const schema::Layout& layout = pool.layout(pool.message("seautils.Fix"));
    EXPECT_TRUE(rc::check("delimited, read by the schema, is the NDJSON", [&] {
        Grid grid = make_grid(*rc::gen::inRange(1, 9) * 250, *rc::gen::inRange(1, 9) * 250);
        const Cell cell{*rc::gen::inRange(-9'000, 9'000), *rc::gen::inRange(-9'000, 9'000),
                        *rc::gen::inRange(-900, 9)};
        const auto time_ms = *rc::gen::inRange<std::int64_t>(0, 7'258'118'400'000);
        std::string binary, text;
        FixWriter(FixWriter::Form::delimited, grid, {}).write(time_ms, cell, binary);
        FixWriter(FixWriter::Form::ndjson, grid, {}).write(time_ms, cell, text);
        schema::Values from_binary, from_text;
        RC_ASSERT(binary.size() - 1 == static_cast<std::size_t>(binary[0]));
        RC_ASSERT(schema::read_binary(std::string_view(binary).substr(1), layout, from_binary));
        RC_ASSERT(schema::JsonReader().read(text, layout, from_text));
        RC_ASSERT(schema::equal(from_binary, from_text));
    }));
}

TEST(FixWriter, decimals_are_those_of_the_resolution) {
    std::string out;
    const FixWriter writer(FixWriter::Form::csv, make_grid(250, 100), {});
    writer.header(out);
    writer.write(1'500, {-1, 4, -3}, out);
    EXPECT_EQ(out, "t,x,y,z\n1.5,-0.25,1,-0.3\n");
}

}  // namespace
}  // namespace seautils::position
