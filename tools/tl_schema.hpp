// The requests and answers of schemas/seautils/acoustics.proto, as tl-model has them in memory.
#ifndef SEAUTILS_TOOLS_TL_SCHEMA_HPP
#define SEAUTILS_TOOLS_TL_SCHEMA_HPP

#include "message_table.hpp"
#include "ssp_schema.hpp"
#include "tl_fields.hpp"

#include "seautils/schema/layout.hpp"

namespace seautils::tools {

/// The messages, so that no file has to be read; a test compares them with the file.
class TlSchema : MessageTable {
public:
    TlSchema() {
        add_request();
        add_answer();
    }

    const schema::Layout& request() const { return *request_; }
    const schema::Layout& answer() const { return *answer_; }

private:
    using Kind = schema::Kind;
    static Declared real(const char* name) { return {name, Kind::float64}; }
    static Declared reals(const char* name) { return {name, Kind::float64, true}; }
    static Declared whole(const char* name) { return {name, Kind::uint32}; }
    static Declared wholes(const char* name) { return {name, Kind::uint32, true}; }
    static Declared flag(const char* name) { return {name, Kind::boolean}; }
    static Declared text(const char* name) { return {name, Kind::string}; }

    const schema::Layout& add_absorption() {
        const auto& model =
            add_enumeration("seautils.Absorption.Model",
                            {"NONE", "THORP", "FRANCOIS_GARRISON", "AINSLIE_MCCOLM", "FIXED"});
        return add_message("seautils.Absorption",
                           {choice("model", model), real("temperature_c"), real("salinity"),
                            real("ph"), real("depth_m"), real("db_per_km")});
    }

    const schema::Layout& add_boundary() {
        const auto& kind =
            add_enumeration("seautils.Boundary.Kind", {"VACUUM", "RIGID", "HALF_SPACE", "TABLE"});
        return add_message(
            "seautils.Boundary",
            {choice("kind", kind), real("sound_speed_mps"), real("shear_speed_mps"),
             real("density_gcm3"), real("attenuation_db_per_wavelength"),
             real("shear_attenuation_db_per_wavelength"), real("roughness_m"), real("grain_phi"),
             reals("grazing_deg"), reals("magnitude"), reals("phase_deg"),
             reals("layer_thickness_m"), reals("layer_speed_mps"), reals("layer_bottom_speed_mps"),
             reals("layer_density_gcm3"), reals("layer_attenuation_db_per_wavelength")});
    }

    const schema::Layout& add_receivers() {
        const auto& span =
            add_message("seautils.Span", {real("start_m"), real("stop_m"), whole("count")});
        return add_message("seautils.TlReceivers",
                           {reals("depth_m"), reals("range_m"), part("depths", span),
                            part("ranges", span), flag("pairs")});
    }

    void add_request() {
        const auto& mesh = add_message(
            "seautils.SpeedMesh", {reals("range_m"), reals("depth_m"), reals("sound_speed_mps")});
        const auto& absorption = add_absorption();
        const auto& boundary = add_boundary();
        const auto& line = add_message("seautils.BoundaryLine",
                                       {flag("curved"), reals("range_m"), reals("depth_m")});
        const auto& source =
            add_message("seautils.TlSource",
                        {real("depth_m"), reals("pattern_deg"), reals("pattern_db"), flag("line")});
        const auto& receivers = add_receivers();
        const auto& fan =
            add_message("seautils.Fan", {real("min_deg"), real("max_deg"), whole("beams")});
        const auto& interpolation = add_enumeration("seautils.TlRequest.Interpolation",
                                                    {"C_LINEAR", "N2_LINEAR", "PCHIP", "SPLINE"});
        const auto& sum =
            add_enumeration("seautils.TlRequest.Sum", {"INCOHERENT", "SEMICOHERENT", "COHERENT"});
        const auto& beam = add_enumeration("seautils.TlRequest.Beam", {"GAUSSIAN", "HAT"});
        const auto& levels = add_message(
            "seautils.TlLevels",
            {real("source_level_db"), real("bandwidth_hz"), real("noise_db"), real("wind_mps"),
             real("beaufort"), real("shipping"), flag("noise_fades"), real("array_gain_db"),
             real("threshold_db"), reals("noise_depth_m"), reals("noise_at_depth_db")});
        request_ = &add_message("seautils.TlRequest", {whole("id"),
                                                       flag("reset"),
                                                       real("frequency_hz"),
                                                       part("source", source),
                                                       part("receivers", receivers),
                                                       part("profile", profile_.profile()),
                                                       part("mesh", mesh),
                                                       choice("interpolation", interpolation),
                                                       real("water_density_gcm3"),
                                                       part("absorption", absorption),
                                                       part("surface", boundary),
                                                       part("altimetry", line),
                                                       part("bottom", boundary),
                                                       real("bottom_depth_m"),
                                                       part("bathymetry", line),
                                                       part("fan", fan),
                                                       choice("sum", sum),
                                                       choice("beam", beam),
                                                       text("engine"),
                                                       real("min_amp"),
                                                       real("baffle_from_deg"),
                                                       real("baffle_to_deg"),
                                                       flag("smooth"),
                                                       flag("loss"),
                                                       flag("arrivals"),
                                                       part("levels", levels)});
    }

    void add_answer() {
        const auto& basis = add_message("seautils.TlBasis", {text("engine"),
                                                             text("why"),
                                                             text("sum"),
                                                             text("beam"),
                                                             text("absorption"),
                                                             real("absorption_db_per_km"),
                                                             whole("beams"),
                                                             whole("modes"),
                                                             real("estimated_error_db"),
                                                             {"remark", Kind::string, true}});
        const auto& paths = add_message(
            "seautils.TlArrivals",
            {real("depth_m"), real("range_m"), reals("amplitude"), reals("phase_deg"),
             reals("delay_s"), reals("absorption_db"), reals("launch_deg"), reals("arrival_deg"),
             wholes("surface_bounces"), wholes("bottom_bounces"), wholes("caustics"),
             real("delay_spread_s"), real("mean_delay_s"), real("peak_to_mean_db"),
             whole("within_20db"), real("span_10db_s"), real("span_20db_s")});
        answer_ = &add_message("seautils.TlAnswer", {whole("id"),
                                                     text("error"),
                                                     reals("depth_m"),
                                                     reals("range_m"),
                                                     {"tl_db", Kind::float32, true},
                                                     part("arrivals", paths, true),
                                                     part("basis", basis),
                                                     real("source_depth_m"),
                                                     {"snr_db", Kind::float32, true},
                                                     {"signal_excess_db", Kind::float32, true},
                                                     real("noise_in_band_db"),
                                                     real("critical_depth_m"),
                                                     flag("pairs")});
    }

    SspSchema profile_;
    const schema::Layout *request_ = nullptr, *answer_ = nullptr;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_SCHEMA_HPP
