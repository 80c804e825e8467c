// Our own messages: they fit the sizes published for their purposes, and what a mission says with them
// comes back as it was said.
#include "seautils/core/error.hpp"
#include "seautils/core/time.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/options.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/pool.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace seautils {
namespace {

/// Bytes of the messages of the GLINT and CCL sea trials; of the two of a track: what it says here.
const std::map<std::string, std::uint64_t> published{
    {"DeployCommand", 31}, {"ProsecuteCommand", 31}, {"Status", 27},
    {"StatusFillIn", 29},  {"Contact", 29},          {"Track", 29},
    {"Ctd", 256},          {"BeamTimeRecord", 64},   {"DebugPoke", 32},
    {"SurfaceDeploy", 13}, {"SourceActivation", 5},  {"WinchControl", 3},
    {"TrackPacket", 257},  {"TrackAck", 257}};

struct Own {
    Own() {
        pool.load(SEAUTILS_SOURCE_DIR "/schemas/seautils");
        dccl::CodecOptions options;
        options.now_s = parse_utc("2024-05-01T12:30:00Z") / 1'000'000;
        codec = dccl::Codec(options);
        for (const auto* descriptor : pool.messages()) {
            const schema::Layout& layout = pool.layout(*descriptor);
            // Records (record.proto) are not for the link: they carry no options.
            if (!dccl::raw_message_options(*descriptor)) continue;
            programs[descriptor->name()] = dccl::Program::compile(layout);
            codec.load(programs[descriptor->name()]);
        }
    }
    std::string encode(const std::string& name, const std::string& json) {
        schema::Values values;
        schema::JsonReader().read(json, programs.at(name)->layout(), values);
        std::string bytes;
        codec.encode(*programs.at(name), values, bytes);
        return bytes;
    }
    std::string decode(const std::string& bytes) {
        schema::Values values;
        const auto decoded = codec.decode(bytes, values);
        EXPECT_EQ(decoded.bytes, bytes.size());
        std::string json;
        schema::write_json(values, json);
        return json;
    }
    schema::Pool pool;
    std::map<std::string, std::shared_ptr<const dccl::Program>> programs;
    dccl::Codec codec;
};

/// Each field on its grid, all of them set where a oneof does not forbid it.
const std::map<std::string, std::string> said{
    {"DeployCommand",
     R"({"time_s":1714564825.3,"src":1,"dest":30,"command_id":62,"x_m":-104800,"y_m":104800,"depth_m":6550,)"
     R"("deep_m":0,"altitude_m":204,"speed_mps":10.2,"axis_deg":359.6,"length_m":16382,"width_m":0,)"
     R"("spacing_m":1022,"laps":30,"start_time_s":1714568400,"duration_s":163820,"report_interval_s":2540})"},
    {"ProsecuteCommand",
     R"({"time_s":1714564825.3,"src":1,"dest":7,"command_id":0,"track_id":1022,"track_time_s":1714564800,)"
     R"("target_x_m":-12.3,"target_y_m":45.6,"target_depth_m":120.5,"target_course_deg":359.8,)"
     R"("target_speed_mps":20.4,"target_error_m":2044,"standoff_m":500,"aspect_deg":90,"depth_m":60.1,)"
     R"("speed_mps":1.53,"duration_s":3600,"priority":6})"},
    {"Status",
     R"({"time_s":1714564825.3,"src":7,"dest":0,"x_m":1234.5,"y_m":-678.9,"depth_m":-3,"altitude_m":0.1,)"
     R"("speed_mps":1.53,"heading_deg":359.8,"course_deg":0,"pitch_deg":-89.6,"roll_deg":180,)"
     R"("position_error_m":1020,"fix_age_s":40940,"state":"DOCKED","fault":"OPERATOR","battery_percent":100,)"
     R"("command_id":62,"leg":62})"},
    {"StatusFillIn",
     R"({"time_s":1714564825.3,"src":7,"dest":0,"x_m":0,"y_m":-0.1,"depth_m":6550,"interval_s":512,)"
     R"("step":[{"dx_m":-255.5,"dy_m":255.5,"ddepth_m":63.5},{"dx_m":0,"dy_m":0.5,"ddepth_m":-63.5}]})"},
    {"Contact",
     R"({"time_s":1714564825.3,"src":7,"dest":0,"contact_id":1023,"sensor_x_m":1.1,"sensor_y_m":2.2,)"
     R"("sensor_depth_m":50,"sensor_heading_deg":12.4,"bearing_deg":123.4,"ambiguous":true,)"
     R"("bearing_error_deg":25.4,"bearing_rate_deg_per_s":-5.1,"elevation_deg":90,"range_m":32764,)"
     R"("snr_db":-39.5,"frequency_hz":65534,"bandwidth_hz":16380,"confidence_percent":99})"},
    {"Track",
     R"({"time_s":1714564825.3,"src":7,"dest":0,"track_id":1,"x_m":100,"y_m":200,"depth_m":50,)"
     R"("course_deg":45.2,"speed_mps":7.72,"error_major_m":4092,"error_minor_m":2,"error_axis_deg":180,)"
     R"("speed_error_mps":0.15,"course_error_deg":126,"contact_count":62,"age_s":20460,"confidence_percent":1})"},
    {"Ctd",
     R"({"time_s":1714564825.3,"src":7,"dest":0,"x_m":1,"y_m":2,"sample":[{"offset_s":0,"depth_m":0.5,)"
     R"("temperature_c":21.344,"salinity":38.016},{"offset_s":4095,"depth_m":512.3,"salinity":65}]})"},
    {"DebugPoke", R"({"time_s":1714564825.3,"src":1,"dest":7,"variable":"GAIN","number":-0.125})"},
    {"SurfaceDeploy",
     R"({"time_s":1714564825.3,"src":1,"dest":7,"command_id":5,"x_m":-0.5,"y_m":99999.9,"speed_mps":12.4,)"
     R"("radius_m":1260})"},
    {"SourceActivation",
     R"({"dest":7,"sequence":7,"active":false,"waveform":14,"source_level_db":202,"delay_s":62,)"
     R"("duration_s":1260})"},
    {"TrackPacket", R"({"packet":"AQIDBA=="})"},
    {"TrackAck", R"({"ack":"/w=="})"}};

}  // namespace

TEST(SchemaOwn, EveryMessageFitsThePublishedSize) {
    const Own own;
    ASSERT_EQ(own.programs.size(), published.size());
    std::set<std::int32_t> ids;
    for (const auto& [name, program] : own.programs) {
        SCOPED_TRACE(name);
        ASSERT_TRUE(published.contains(name));
        EXPECT_EQ(program->max_bytes(), published.at(name));
        EXPECT_LE(program->largest_bytes(), published.at(name));
        EXPECT_EQ(program->codec_version(), 4);
        EXPECT_GE(program->id(), 96);
        EXPECT_LE(program->id(), 111);
        EXPECT_EQ(program->id_bits(), 8U);
        EXPECT_TRUE(ids.insert(program->id()).second);
    }
}

TEST(SchemaOwn, WhatIsSaidComesBack) {
    Own own;
    for (const auto& [name, json] : said) {
        SCOPED_TRACE(name);
        const std::string bytes = own.encode(name, json);
        EXPECT_LE(bytes.size(), published.at(name));
        EXPECT_EQ(own.decode(bytes), json);
    }
}

/// The most that a vehicle may have to say of what it measured.
TEST(SchemaOwn, FullListsFit) {
    Own own;
    std::string samples, steps;
    for (int k = 0; k < 35; ++k)
        samples += std::string(k > 0 ? "," : "") + R"({"offset_s":)" + std::to_string(10 * k) +
                   R"(,"depth_m":)" + std::to_string(k) + R"(,"temperature_c":12.5,"salinity":35})";
    const std::string ctd =
        R"({"time_s":1714564825,"src":7,"dest":0,"x_m":1,"y_m":2,"sample":[)" + samples + "]}";
    const std::string bytes = own.encode("Ctd", ctd);
    EXPECT_LE(bytes.size(), 256U);
    EXPECT_EQ(own.decode(bytes), ctd);
    EXPECT_THROW(own.encode("Ctd", R"({"time_s":1714564825,"src":7,"dest":0,"sample":[)" + samples +
                                       "," + samples + "]}"),
                 DataError);
}

/// A wrong depth is worse than none.
TEST(SchemaOwn, WhatIsOutOfBoundsIsRefused) {
    Own own;
    for (const char* bad : {R"("depth_m":6550.1)", R"("depth_m":-3.1)", R"("heading_deg":360.2)",
                            R"("battery_percent":101)", R"("x_m":1e9)", R"("altitude_m":-0.1)"}) {
        EXPECT_THROW(own.encode("Status", R"({"time_s":1714564825,"src":7,"dest":0,)" +
                                              std::string(bad) + "}"),
                     DataError)
            << bad;
    }
    EXPECT_THROW(own.encode("Status", R"({"time_s":1714564825,"src":7})"), DataError);  // dest
    const std::string bare = R"({"time_s":1714564825,"src":7,"dest":0})";
    EXPECT_EQ(own.decode(own.encode("Status", bare)), bare);  // unknown stays unknown
}

}  // namespace seautils
