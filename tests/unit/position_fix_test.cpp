// Fixes in CSV and NDJSON.
#include "seautils/core/error.hpp"
#include "seautils/position/fix_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <fmt/format.h>

#include <string>
#include <vector>

namespace seautils::position {
namespace {

/// Each line's fix, or what is wrong with it; headers give nothing.
std::vector<std::string> read(const std::vector<std::string>& lines,
                              FixReader::Options options = {}) {
    FixReader reader(std::move(options));
    std::vector<std::string> all;
    for (const std::string& line : lines) {
        try {
            const auto fix = reader.read(line);
            if (fix)
                all.push_back(fmt::format("{} {:.6g} {:.6g} {:.6g}", fix->time_us,
                                          fix->place.x_m + 0.0, fix->place.y_m + 0.0,
                                          fix->place.z_m + 0.0));
        } catch (const DataError& e) {
            all.push_back(e.what());
        }
    }
    return all;
}

std::string one(const std::string& line) { return read({line}).front(); }

using Lines = std::vector<std::string>;

TEST(FixReader, a_table_has_its_columns_in_any_order) {
    EXPECT_EQ(read({"t,x,y,z", "1622104190.0,-122.652,83.716,0.036", "7,1,+2,-3e0"}),
              (Lines{"1622104190000000 -122.652 83.716 0.036", "7000000 1 2 -3"}));
    EXPECT_EQ(read({"\xEF\xBB\xBF"
                    "depth_m , \"y_m\",temperature_c,x_m,time",
                    "5,2,,1,2024-05-01T12:00:25.25Z"}),
              (Lines{"1714564825250000 1 2 -5"}));
    EXPECT_EQ(read({"\"note\",t,x,y,z", "\"a, \"\"b\"\"\",1,2,3,4"}), Lines{"1000000 2 3 4"});
}

TEST(FixReader, a_header_counts_from_where_it_stands) {
    EXPECT_EQ(read({"t,x,y,z", "1,2,3,4", "z,y,x,t", "4,3,2,1"}),
              (Lines{"1000000 2 3 4", "1000000 2 3 4"}));
}

TEST(FixReader, an_object_has_its_keys_in_any_order) {
    EXPECT_EQ(one(R"({"t":1.5,"x":2,"y":3,"z":-4})"), "1500000 2 3 -4");
    EXPECT_EQ(
        one(R"( {"depth_m":4,"note":{"t":[1]},"y_m":3,"x_m":2,"time":"1970-01-01T00:00:01.5Z"})"),
        "1500000 2 3 -4");
    EXPECT_EQ(one(R"({"time":"@12.5","x":"2","y":3,"z":null,"depth":1})"), "12500000 2 3 -1");
}

TEST(FixReader, latitude_and_longitude_are_metres_from_the_datum) {
    FixReader::Options options;
    options.frame.emplace(Frame::Kind::local, Geographic{60, 5});
    // A minute of latitude at 60 degrees is 1856.9 m on WGS84 (111412.24 m a degree).
    EXPECT_EQ(read({"time_s,lat_deg,lon_deg,depth_m,speed_mps", "1,60.01,5,7,1"}, options),
              Lines{"1000000 0 1114.12 -7"});
    EXPECT_EQ(read({R"({"t":1,"latitude_deg":60.01,"longitude_deg":5,"depth_m":7})"}, options),
              Lines{"1000000 0 1114.12 -7"});
    options.frame.reset();
    options.first_is_datum = true;
    EXPECT_EQ(read({"t,lat,lon,depth", "1,60,5,0", "2,60.01,5,0"}, options),
              (Lines{"1000000 0 0 0", "2000000 0 1114.12 0"}));
}

TEST(FixReader, x_and_z_count_more_than_latitude_and_depth) {
    EXPECT_EQ(read({"t,x,y,z,latitude_deg,longitude_deg,depth_m", "1,2,3,4,99,999,9"}),
              Lines{"1000000 2 3 4"});
}

TEST(FixReader, what_says_too_little_or_too_much_is_refused) {
    EXPECT_EQ(
        read({"t,x,y,z", "1,2,3", "1,2,3,4,5", "1,,3,4", "1,2,3,", ",2,3,4", "1,2,3,4x",
              "nan,2,3,4", "1,inf,3,4", "1e99,1,1,1", "2024-05-01T12:00:25,1,1,1", "\"1,2,3,4"}),
        (Lines{"3 cells where there are 4 columns", "5 cells where there are 4 columns",
               "the fix has no x", "the fix has no z or depth_m (on the surface: --surface)",
               "the fix has no time (t, time or time_s)", "z '4x' is no number",
               "time 'nan' is no number", "x 'inf' is no number",
               "time 1e+99 s is outside the years 1970 to 2200",
               "time '2024-05-01T12:00:25' is not of the form 2024-05-01T12:00:25Z",
               "a quote in the row does not end"}));
    EXPECT_EQ(one("1,2,3,4"), "no line with the names of the columns (t,x,y,z) stands before it");
    EXPECT_EQ(read({"t,x,y,z,time_s", "1,2,3,4,5"}).front(), "columns t and time_s say the same");
    EXPECT_EQ(read({"t,lat,lon,depth", "1,60,5,0"}),
              Lines{"latitude and longitude need a datum (--datum)"});
    EXPECT_EQ(one(R"({"t":1,"x":2,"z":3})"), "the fix has no y");
    EXPECT_EQ(one(R"({"t":1,"z":3})"),
              "the fix has neither x and y nor latitude_deg and longitude_deg");
    EXPECT_EQ(one(R"({"t":1,"time":2,"x":2,"y":1,"z":3})"),
              "'time' comes after the same by another name");
    EXPECT_EQ(one(R"({"t":true,"x":2,"y":1,"z":3})"), "time is no number");
    EXPECT_EQ(one(R"({"t":1,"x":[2],"y":1,"z":3})"), "x is no number");
    EXPECT_EQ(one(R"({"t":1} 7)"), "not valid JSON: '{\"t\":1} 7'");
    EXPECT_EQ(one(R"({"t":1)"), "not valid JSON: '{\"t\":1'");
    EXPECT_EQ(one(R"({"t" 1})"), "not valid JSON: '{\"t\" 1}'");
}

TEST(FixReader, a_form_that_was_chosen_is_kept_to) {
    FixReader::Options options;
    options.form = FixReader::Form::ndjson;
    EXPECT_EQ(read({"[1]"}, options), Lines{"the record is not a JSON object"});
    options.form = FixReader::Form::csv;
    EXPECT_EQ(read({"{}"}, options),
              Lines{"no line with the names of the columns (t,x,y,z) stands before it"});
}

TEST(FixReader, on_the_surface_there_is_no_depth) {
    FixReader::Options options;
    options.on_surface = true;
    EXPECT_EQ(read({"t,x,y", "1,2,3"}, options), Lines{"1000000 2 3 0"});
}

TEST(FixReader, any_number_reads_back_from_either_form) {
    EXPECT_TRUE(rc::check("CSV and JSON agree, to the last bit", [] {
        const double t =
            static_cast<double>(*rc::gen::inRange<std::int64_t>(0, 4'000'000'000'000)) / 1e3;
        const double x = *rc::gen::inRange(-2'000'000'000, 2'000'000'000) / 1e4;
        const double z = *rc::gen::inRange(-2'000'000'000, 2'000'000'000) / 1e7;
        FixReader reader({});
        RC_ASSERT(!reader.read("t,x,y,z"));
        const auto row = reader.read(fmt::format("{},{},{},{}", t, x, -x, z));
        const auto object =
            reader.read(fmt::format(R"({{"t":{},"x":{},"y":{},"z":{}}})", t, x, -x, z));
        RC_ASSERT(row && object);
        RC_ASSERT(row->time_us == std::llround(t * 1e3) * 1000);
        RC_ASSERT(row->time_us == object->time_us);
        RC_ASSERT(row->place.x_m == x && row->place.y_m == -x && row->place.z_m == z);
        RC_ASSERT(object->place.x_m == x && object->place.y_m == -x && object->place.z_m == z);
    }));
}

}  // namespace
}  // namespace seautils::position
