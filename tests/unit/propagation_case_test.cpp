// Environment files: what they say, and what is refused with which words.
#include "seautils/core/error.hpp"
#include "seautils/propagation/case_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace seautils::propagation {

namespace {

const std::string shelf = R"({
 "name": "shelf", "title": "A shelf", "frequency_hz": 1000,
 "source": {"depth_m": 30, "type": "point", "beam_pattern_deg_db": [[-90, -30], [0, 0.5]]},
 "receivers": {"depth_m": {"start": 1, "stop": 4, "count": 3}, "range_m": [10, 20], "layout": "rectilinear"},
 "water": {"ssp_interpolation": "bilinear-quad", "profile_z_c": [[0, 1500], [100, 1510]], "density_g_cm3": 1.02,
  "range_dependent": {"ranges_m": [-10, 0, 50], "c_rows_by_depth": [[1500, 1501, 1502], [1510, 1511, 1512]]},
  "absorption": {"model": "francois-garrison", "temperature_c": 4, "salinity_psu": 34, "ph": 7.9, "depth_m": 60}},
 "surface": {"type": "reflection-table", "table_deg_mag_phasedeg": [[0, 1, 180], [90, 0.5, 170]],
  "altimetry": {"interp": "C", "points": [[0, 0], [50, 1]]}},
 "bottom": {"type": "elastic-halfspace", "depth_m": 100, "sound_speed_m_s": 1700, "shear_speed_m_s": 400,
  "density_g_cm3": 1.9, "attenuation_db_per_wavelength": 0.8, "shear_attenuation_db_per_wavelength": 1.5,
  "bathymetry": {"interp": "L", "points": [[0, 100], [60, 90]]}},
 "fan": {"min_deg": -70, "max_deg": 60, "positive": "down"},
 "reference_run": {"beams": 20001, "step_m": 2.0}, "box": null,
 "arrivals": {"depth_m": [5, 6], "range_m": [15], "beams": 20001, "engine": "any"}
})";

/// The text with its first `from` in other words.
std::string changed(const std::string& from, const std::string& to) {
    std::string text = shelf;
    return text.replace(text.find(from), from.size(), to);
}

std::string refusal(const std::string& text) {
    try {
        read_case(text);
    } catch (const DataError& e) {
        return e.what();
    }
    return "accepted";
}

}  // namespace

TEST(Case, SourceReceiversAndWater) {
    const Environment e = read_case(shelf).environment;
    EXPECT_EQ(e.title, "A shelf");
    EXPECT_EQ(e.frequency_hz, 1000);
    EXPECT_EQ(e.source.depth_m, 30);
    EXPECT_EQ(e.source.pattern.size(), 2U);
    EXPECT_EQ(e.source.pattern[1].level_db, 0.5);
    EXPECT_EQ(e.receivers.depth_m, (std::vector<double>{1, 2.5, 4}));
    EXPECT_EQ(e.receivers.range_m, (std::vector<double>{10, 20}));
    EXPECT_EQ(e.water.profile.size(), 2U);
    EXPECT_EQ(e.water.mesh->sound_speed_mps,
              (std::vector<double>{1500, 1501, 1502, 1510, 1511, 1512}));
    EXPECT_EQ(e.water.mesh->depth_m, (std::vector<double>{0, 100}));
    EXPECT_EQ(e.water.density_gcm3, 1.02);
    EXPECT_EQ(e.water.absorption.model, AbsorptionModel::francois_garrison);
    EXPECT_EQ(e.water.absorption.depth_m, 60);
}

TEST(Case, BoundariesFanAndArrivals) {
    const Case c = read_case(shelf);
    const Environment& e = c.environment;
    EXPECT_EQ(e.surface.kind, BoundaryKind::table);
    EXPECT_EQ(e.surface.table[1].phase_deg, 170);
    EXPECT_TRUE(e.surface_line->curved);
    EXPECT_FALSE(e.bottom_line->curved);
    EXPECT_EQ(e.bottom_line->depth_m, (std::vector<double>{100, 90}));
    EXPECT_EQ(e.bottom.shear_speed_mps, 400);
    EXPECT_EQ(e.bottom.shear_attenuation_db_per_wavelength, 1.5);
    EXPECT_EQ(e.fan.least_deg, -70);
    EXPECT_EQ(e.fan.beams, 0U);
    EXPECT_EQ(c.arrivals->depth_m.size(), 2U);
    EXPECT_TRUE(c.remarks.empty());
    EXPECT_EQ(read_case(changed("\"down\"", "\"up\"")).environment.fan.least_deg, -60);
}

TEST(Case, SedimentByItsGrain) {
    const std::string bottom =
        shelf.substr(shelf.find("\"type\": \"elastic"),
                     shelf.find("\"bathymetry\"") - shelf.find("\"type\": \"elastic"));
    const Boundary b =
        read_case(changed(bottom, R"("type": "grain-size", "depth_m": 100, "grain_size_phi": 4, )"))
            .environment.bottom;
    // -0.0014881 · 64 + 0.0213937 · 16 - 0.1382798 · 4 + 1.3425 = 1.0364416 times the 1510 m/s above it
    EXPECT_NEAR(b.sound_speed_mps, 1510 * 1.0364416, 1e-3);
    EXPECT_EQ(refusal(changed(bottom, R"("type": "rigid", "depth_m": 100, "grain_size_phi": 4, )")),
              "bottom.grain_size_phi is for a bottom of type 'grain-size', below a profile");
}

TEST(Case, LayersOfABottom) {
    const auto with = [](const std::string& layers) {
        return changed("\"bathymetry\"", "\"layers\": " + layers + ", \"bathymetry\"");
    };
    const std::vector<SedimentLayer> layers =
        read_case(with(R"([{"thickness_m": 4, "sound_speed_m_s": 1550, "density_g_cm3": 1.4},
                           {"thickness_m": 10, "sound_speed_top_m_s": 1600,
                            "sound_speed_bottom_m_s": 1650, "shear_speed_m_s": 0,
                            "attenuation_db_per_wavelength": 0.3}])"))
            .environment.bottom.layers;
    EXPECT_EQ(layers,
              (std::vector<SedimentLayer>{{4, 1550, 1550, 1.4, 0}, {10, 1600, 1650, 1.8, 0.3}}));
    const std::vector<std::pair<std::string, std::string>> all = {
        {"4", "bottom.layers '4' is not a list"},
        {"[4]", "bottom.layers[0] is not an object"},
        {"[{}]", "bottom.layers[0].thickness_m is not given"},
        {R"([{"thickness_m": "x"}])", "bottom.layers[0].thickness_m '\"x\"' is not a number"},
        {R"([{"thickness_m": 1}])", "bottom.layers[0].sound_speed_top_m_s is not given"},
        {R"([{"thickness_m": 1, "sound_speed_m_s": 1500, "sound_speed_top_m_s": 1500}])",
         "bottom.layers[0].sound_speed_top_m_s is given beside sound_speed_m_s"},
        {R"([{"thickness_m": 1, "sound_speed_m_s": 1500, "shear_speed_m_s": 90}])",
         "bottom.layers[0].shear_speed_m_s 90 is not 0 m/s: layers are fluid"},
        {R"([{"thickness_m": 1, "sound_speed_m_s": 1500, "densty_g_cm3": 1}])",
         "field 'bottom.layers[0].densty_g_cm3' is not known (did you mean 'density_g_cm3'?)"},
    };
    for (const auto& [text, what] : all) EXPECT_EQ(refusal(with(text)), what);
}

TEST(Case, WhatIsNotKnownIsRemarked) {
    const Case c = read_case(changed("\"box\"", "\"ice_cover\""));
    EXPECT_TRUE(c.remarks.empty());  // null says nothing
    EXPECT_EQ(read_case(changed("\"box\": null", "\"ice_cover\": 1")).remarks,
              (std::vector<std::string>{"field 'ice_cover' is not known: left alone"}));
}

TEST(Case, RefusalsAreLocated) {
    const std::vector<std::pair<std::string, std::string>> all = {
        {changed("[100, 1510]", "[100, \"fast\"]"),
         "water.profile_z_c[1][1] '\"fast\"' is not a number"},
        {changed("[100, 1510]", "[100]"), "water.profile_z_c[1] has 1 elements in place of 2"},
        {changed("\"depth_m\": 30", "\"depth\": 30"), "source.depth_m is not given"},
        {changed("\"surface\"", "\"surfaces\""),
         "field 'surfaces' is not known (did you mean 'surface'?)"},
        {changed("\"C\"", "\"D\""), "surface.altimetry.interp 'D' is none of L, C, linear, curved"},
        {changed("\"count\": 3", "\"count\": 0"),
         "receivers.depth_m.count '0' is not a whole number of 1 to 2000000"},
        {changed("[1510, 1511, 1512]", "[1510, 1511]"),
         "water.range_dependent.c_rows_by_depth[1] has 2 elements where ranges_m has 3"},
        {changed("\"frequency_hz\": 1000", "\"frequency_hz\": {}"),
         "frequency_hz an object is not a number"},
        {changed("\"depth_m\": 30", "\"depth_m\": 30, \"depth_m\": 31"),
         "field 'depth_m' is given twice"},
        {changed("1000,", "1000,,"), "line 2 column 60: this is no JSON (',')"},
        {changed("1000", "1e999"), "a number is beyond the range of its type"},
        {"[]", "the file is not an object"},
    };
    for (const auto& [text, what] : all) EXPECT_EQ(refusal(text), what);
}

TEST(Case, BoundedHoweverDeep) {
    EXPECT_NE(refusal(std::string(1'000'000, '[')), "accepted");
    std::string deep(shelf);
    deep.insert(1, "\"x\":" + std::string(100'000, '[') + std::string(100'000, ']') + ",");
    EXPECT_EQ(refusal(deep), "accepted");
}

}  // namespace seautils::propagation
