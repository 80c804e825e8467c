// Fields for the tests of plan: made by hand, and of the shared cases.
#ifndef SEAUTILS_TESTS_UNIT_PLAN_GRIDS_HPP
#define SEAUTILS_TESTS_UNIT_PLAN_GRIDS_HPP

#include "seautils/plan/loss_csv.hpp"
#include "seautils/plan/loss_field.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seautils::plan {

inline constexpr float no_value = std::numeric_limits<float>::quiet_NaN();
inline constexpr float no_energy = std::numeric_limits<float>::infinity();

/// A field whose rows are depths.
inline LossField field_of(std::vector<double> depth_m, std::vector<double> range_m,
                          std::vector<float> loss_db) {
    return {std::move(depth_m), std::move(range_m), std::move(loss_db)};
}

/// A grid of the shared cases; nothing: it is not there. Cells below the seabed have no value.
inline std::optional<LossField> case_grid(const std::string& name, const std::string& grid) {
    const char* shared = std::getenv("SEAUTILS_SHARED");
    const std::string root =
        shared != nullptr ? shared : std::string(SEAUTILS_SOURCE_DIR) + "/../shared";
    const std::string file = root + "/cases/" + name + "/csv/" + grid + ".csv.gz";
    if (!std::filesystem::exists(file)) return std::nullopt;
    std::FILE* const pipe = ::popen(("gzip -dc '" + file + "'").c_str(), "r");
    std::string text;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    ::pclose(pipe);
    return read_loss_csv(text);
}

}  // namespace seautils::plan

#endif  // SEAUTILS_TESTS_UNIT_PLAN_GRIDS_HPP
