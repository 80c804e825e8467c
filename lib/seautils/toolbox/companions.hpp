#ifndef SEAUTILS_TOOLBOX_COMPANIONS_HPP
#define SEAUTILS_TOOLBOX_COMPANIONS_HPP

#include "seautils/propagation/environment.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace seautils::toolbox {

/// The files beside an environment file. All refusals say the line.

/// .bty and .ati: the depth of a boundary; km in the file. @param remarks  says what was left alone
propagation::Line read_boundary_file(std::string_view text, std::vector<std::string>& remarks);

/// .ssp: speeds at ranges (km in the file), depth by depth.
propagation::SpeedMesh read_ssp_file(std::string_view text, const std::vector<double>& depth_m);

/// .sbp: a source's beam pattern.
std::vector<propagation::PatternPoint> read_sbp_file(std::string_view text);

/// .brc and .trc: reflection coefficients.
std::vector<propagation::ReflectionRow> read_reflection_file(std::string_view text);

/// What FIELD is asked for.
struct FieldFile {
    bool coherent = true, line_source = false;
    std::vector<double> range_m, source_depth_m, receiver_depth_m;
};

/// .flp. @throws DataError  adiabatic or coupled modes over more than one profile
FieldFile read_flp_file(std::string_view text);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_COMPANIONS_HPP
