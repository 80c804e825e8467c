#ifndef SEAUTILS_PROPAGATION_CASE_FILE_HPP
#define SEAUTILS_PROPAGATION_CASE_FILE_HPP

#include "seautils/propagation/environment.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::propagation {

/// An environment file, CASE.json (seautils-acoustics(5)).
struct Case {
    Environment environment;
    std::optional<Receivers> arrivals;  ///< where arrivals are wanted
    std::vector<std::string> remarks;   ///< fields that are not known, and were left alone
};

/// Reads an environment file: its form and the kinds of its values; check() says whether they mean something. A field
/// that is not known is a remark, but one that is nearly known is refused.
/// @throws DataError  names the field by its path, as water.profile_z_c[3][1], quotes its value, and says what is wrong;
///                    or the line and column where the text is no JSON, or the field that is given twice
Case read_case(std::string_view json);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_CASE_FILE_HPP
