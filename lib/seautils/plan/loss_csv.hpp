#ifndef SEAUTILS_PLAN_LOSS_CSV_HPP
#define SEAUTILS_PLAN_LOSS_CSV_HPP

#include "seautils/plan/loss_field.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace seautils::plan {

/// A field from a table: the first row has ranges behind its first cell, each further row a depth and a loss for each range.
/// An empty cell and `nan` are no value, `inf` is no energy. Lines that begin with # are comments.
/// @throws DataError  `LINE: what`, also as check() does
LossField read_loss_csv(std::string_view text);

/// Values over depth from a table of two columns, with or without a header: `depth_m,noise_db`.
struct DepthTable {
    std::vector<double> depth_m, values;
};
/// @throws DataError  `LINE: what`: a cell is no number, or depth does not grow; no row
DepthTable read_depth_table(std::string_view text);

/// A whole text as a finite number or ±inf, blanks around it left out; nothing: it is none. Also `nan`.
std::optional<double> read_number(std::string_view text);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_LOSS_CSV_HPP
