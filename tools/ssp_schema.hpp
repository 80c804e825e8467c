// The messages of schemas/seautils/acoustics.proto, as ssp has them in memory.
#ifndef SEAUTILS_TOOLS_SSP_SCHEMA_HPP
#define SEAUTILS_TOOLS_SSP_SCHEMA_HPP

#include "message_table.hpp"

#include "seautils/schema/layout.hpp"

#include <cstdint>

namespace seautils::tools {

/// The messages of acoustics.proto, with the numbers that it declares, so that no file has to be read.
class SspSchema : MessageTable {
public:
    /// Fields of SoundSpeedProfile, in the order of their declaration.
    enum Field : std::uint32_t {
        time,
        start,
        latitude_deg,
        longitude_deg,
        source,
        direction,
        depth_m,
        sound_speed_mps,
        standard_deviation_mps,
        count,
        extrapolated,
        temperature_c,
        salinity,
        formula,
        samples,
        dropped,
        measured_from_m,
        measured_to_m,
        extension,
        remark,
    };

    // Long, as it is a table: the file that it repeats is its contract, and a test compares them.
    SspSchema() {
        using enum schema::Kind;
        const schema::Layout* stamp =
            &add_message("google.protobuf.Timestamp", {{"seconds", int64}, {"nanos", int32}});
        const schema::EnumLayout* directions = &add_enumeration(
            "seautils.SoundSpeedProfile.Direction", {"UNSPECIFIED", "DIVE", "CLIMB"});
        const schema::EnumLayout* extensions = &add_enumeration(
            "seautils.SoundSpeedProfile.Extension", {"NONE", "ISOTHERMAL", "CLIMATOLOGY"});
        const schema::Layout* drops =
            &add_message("seautils.SoundSpeedProfile.Dropped", {{"flagged", uint32},
                                                                {"incomplete", uint32},
                                                                {"out_of_bounds", uint32},
                                                                {"above_surface", uint32},
                                                                {"spike", uint32},
                                                                {"loop", uint32},
                                                                {"slow", uint32}});
        sample_ = &add_message("seautils.CtdSample",
                               {{.name = "time", .kind = schema::Kind::message, .message = stamp},
                                {"pressure_dbar", float64},
                                {"depth_m", float64},
                                {"temperature_c", float64},
                                {"salinity", float64},
                                {"conductivity_spm", float64},
                                {"sound_speed_mps", float64},
                                {"latitude_deg", float64},
                                {"longitude_deg", float64}});
        profile_ = &add_message(
            "seautils.SoundSpeedProfile",
            {{.name = "time", .kind = schema::Kind::message, .message = stamp},
             {.name = "start", .kind = schema::Kind::message, .message = stamp},
             {"latitude_deg", float64},
             {"longitude_deg", float64},
             {"source", string},
             {.name = "direction", .kind = schema::Kind::enumeration, .enumeration = directions},
             {"depth_m", float64, true},
             {"sound_speed_mps", float64, true},
             {"standard_deviation_mps", float64, true},
             {"count", uint32, true},
             {"extrapolated", boolean, true},
             {"temperature_c", float64, true},
             {"salinity", float64, true},
             {"formula", string},
             {"samples", uint32},
             {.name = "dropped", .kind = schema::Kind::message, .message = drops},
             {"measured_from_m", float64},
             {"measured_to_m", float64},
             {.name = "extension", .kind = schema::Kind::enumeration, .enumeration = extensions},
             {"remark", string, true}});
    }

    const schema::Layout& sample() const { return *sample_; }
    const schema::Layout& profile() const { return *profile_; }

private:
    const schema::Layout *sample_ = nullptr, *profile_ = nullptr;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_SSP_SCHEMA_HPP
