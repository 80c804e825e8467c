#ifndef SEAUTILS_PLAN_LINK_CSV_HPP
#define SEAUTILS_PLAN_LINK_CSV_HPP

#include "seautils/plan/receipt.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace seautils::plan {

/// Reads a log of transmissions, line by line: a header that names its columns, then a row each, parted by commas.
/// Columns: `depth_m` and `received` (1, 0, true, false, yes, no), and where known `range_m`, `tl_db` or `loss_db`,
/// `rate`; others are passed over. Lines that begin with # are comments.
class LinkCsv {
public:
    /// Reads a line without its line end. @return nothing: it was no row
    /// @throws DataError  a header without a depth or a result; a cell that is neither empty nor what its column holds;
    ///                    a row with another number of cells than the header
    std::optional<LinkSample> read(std::string_view line);

private:
    void read_header();
    LinkSample read_row() const;
    std::string_view cell(std::optional<std::size_t> column) const;

    std::vector<std::string_view> cells_;
    std::size_t columns_ = 0;
    bool has_header_ = false;
    std::optional<std::size_t> depth_, received_, range_, loss_, rate_;
};

/// All values lie within bounds: depth 0 to 12000 m, range 0 to 1e7 m, loss -100 to 1000 dB, rate 0 to 1000.
/// @throws DataError  names the field, the value and the bound
void check(const LinkSample& sample);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_LINK_CSV_HPP
