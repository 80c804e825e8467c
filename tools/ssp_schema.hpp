// The messages of schemas/seautils/acoustics.proto, as ssp has them in memory.
#ifndef SEAUTILS_TOOLS_SSP_SCHEMA_HPP
#define SEAUTILS_TOOLS_SSP_SCHEMA_HPP

#include "seautils/schema/layout.hpp"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

namespace seautils::tools {

/// The messages of acoustics.proto, with the numbers that it declares, so that no file has to be read.
class SspSchema {
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
        const schema::EnumLayout* directions =
            &add_enumeration("Direction", {"UNSPECIFIED", "DIVE", "CLIMB"});
        const schema::EnumLayout* extensions =
            &add_enumeration("Extension", {"NONE", "ISOTHERMAL", "CLIMATOLOGY"});
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
    struct Declared {
        const char* name;
        schema::Kind kind;
        bool repeated = false;
        const schema::Layout* message = nullptr;
        const schema::EnumLayout* enumeration = nullptr;
    };

    const schema::Layout& add_message(const char* full_name,
                                      std::initializer_list<Declared> fields) {
        schema::Layout layout;
        layout.full_name = full_name;
        for (const Declared& d : fields) {
            schema::Field f;
            f.name = d.name;
            f.number = static_cast<std::int32_t>(layout.fields.size()) + 1;
            f.kind = d.kind;
            f.repeated = d.repeated;
            f.message = d.message;
            f.enumeration = d.enumeration;
            const bool text = d.kind == schema::Kind::string || d.kind == schema::Kind::message;
            f.packed = d.repeated && !text;
            if (text) f.wire_form = schema::WireForm::length;
            if (d.kind == schema::Kind::float64) f.wire_form = schema::WireForm::fixed64;
            f.has_presence = layout.full_name != "google.protobuf.Timestamp";  // that is proto3
            layout.fields.push_back(std::move(f));
        }
        return set_.add(std::move(layout));
    }

    const schema::EnumLayout& add_enumeration(const std::string& name,
                                              std::initializer_list<const char*> names) {
        schema::EnumLayout e;
        e.full_name = "seautils.SoundSpeedProfile." + name;
        for (const char* value : names)
            e.values.push_back({value, static_cast<std::int32_t>(e.values.size())});
        return set_.add(std::move(e));
    }

    schema::LayoutSet set_;
    const schema::Layout *sample_ = nullptr, *profile_ = nullptr;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_SSP_SCHEMA_HPP
