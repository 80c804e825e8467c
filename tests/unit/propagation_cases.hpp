#ifndef SEAUTILS_TESTS_PROPAGATION_CASES_HPP
#define SEAUTILS_TESTS_PROPAGATION_CASES_HPP

// The reference cases of ../shared/cases, read apart from the library.
#include "seautils/propagation/environment.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace seautils::propagation {

using nlohmann::json;

inline std::filesystem::path cases() {
    const char* shared = std::getenv("SEAUTILS_SHARED");
    const std::filesystem::path folder =
        shared ? shared : std::string(SEAUTILS_SOURCE_DIR) + "/../shared";
    return folder / "cases";
}

inline std::string unpacked(const std::filesystem::path& file) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
        popen(("gzip -dc '" + file.string() + "'").c_str(), "r"), pclose);
    std::string text;
    char part[65536];
    for (std::size_t n; (n = std::fread(part, 1, sizeof part, pipe.get())) > 0;)
        text.append(part, n);
    return text;
}

inline std::vector<double> linspace(const json& range) {
    const double start = range["start"], stop = range["stop"];
    const int count = range["count"];
    std::vector<double> out;
    for (int k = 0; k < count; ++k) out.push_back(start + (stop - start) * k / (count - 1));
    return out;
}

inline void set_water(const json& from, WaterColumn& water) {
    SpeedMesh mesh;
    for (const auto& point : from["profile_z_c"]) {
        water.profile.push_back({point[0], point[1]});
        mesh.depth_m.push_back(point[0]);
    }
    const json& ranges = from["range_dependent"];
    if (!ranges.is_null()) {
        mesh.range_m = ranges["ranges_m"].get<std::vector<double>>();
        for (const auto& row : ranges["c_rows_by_depth"])
            mesh.sound_speed_mps.insert(mesh.sound_speed_mps.end(), row.begin(), row.end());
        water.mesh = mesh;
    }
    const json& absorption = from["absorption"];
    if (absorption["model"] == "thorp-jkps") water.absorption.model = AbsorptionModel::thorp;
    if (absorption["model"] == "francois-garrison")
        water.absorption = {AbsorptionModel::francois_garrison,
                            absorption["temperature_c"],
                            absorption["salinity_psu"],
                            absorption["ph"],
                            absorption["depth_m"],
                            0};
}

struct ReferenceCase {
    std::filesystem::path folder;
    json about;
    Environment sea;

    explicit ReferenceCase(const std::string& name) : folder(cases() / name) {
        about = json::parse(std::ifstream(folder / "case.json"));
        sea.frequency_hz = about["frequency_hz"];
        sea.source.depth_m = about["source"]["depth_m"];
        if (about["source"]["beam_pattern_deg_db"].is_array())
            for (const auto& point : about["source"]["beam_pattern_deg_db"])
                sea.source.pattern.push_back({point[0], point[1]});
        sea.receivers = {linspace(about["receivers"]["depth_m"]),
                         linspace(about["receivers"]["range_m"])};
        set_water(about["water"], sea.water);
        const json& bottom = about["bottom"];
        sea.bottom_depth_m = bottom["depth_m"];
        sea.bottom = {BoundaryKind::half_space,
                      bottom["sound_speed_m_s"],
                      0,
                      bottom["density_g_cm3"],
                      bottom["attenuation_db_per_wavelength"],
                      0,
                      0,
                      {}};
        if (bottom["bathymetry"].is_object()) {
            sea.bottom_line.emplace();
            for (const auto& point : bottom["bathymetry"]["points"]) {
                sea.bottom_line->range_m.push_back(point[0]);
                sea.bottom_line->depth_m.push_back(point[1]);
            }
        }
        sea.fan = {about["fan"]["min_deg"], about["fan"]["max_deg"], 0};
    }

    /// [depth][range], dB; empty cells are NaN.
    std::vector<double> grid(const std::string& key) const {
        std::istringstream lines(unpacked(folder / "csv" / (key + ".csv.gz")));
        std::vector<double> out;
        std::string line, cell;
        std::getline(lines, line);
        while (std::getline(lines, line)) {
            std::istringstream cells(line);
            std::getline(cells, cell, ',');
            while (std::getline(cells, cell, ','))
                out.push_back(cell.empty() ? std::numeric_limits<double>::quiet_NaN()
                                           : std::strtod(cell.c_str(), nullptr));
        }
        return out;
    }
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_TESTS_PROPAGATION_CASES_HPP
