#ifndef SEAUTILS_PROPAGATION_COLUMN_STORE_HPP
#define SEAUTILS_PROPAGATION_COLUMN_STORE_HPP

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace seautils::propagation {

/// Columns of one sea and fan that were computed before, by their range: a window of receivers that moves
/// along asks for most of them again. The oldest make room.
class ColumnStore {
public:
    /// Numbers that are kept: 256 KiB.
    static constexpr std::size_t most_cells = 65'536;

    /// Forgets all columns of other depths.
    void open(const std::vector<double>& depth_m) {
        if (depth_m == depth_m_) return;
        *this = {};
        depth_m_ = depth_m;
        columns_ = std::max<std::size_t>(most_cells / std::max<std::size_t>(depths(), 1), 1);
    }
    /// At all depths; nothing where it is not known.
    const float* find(double range_m) const {
        const auto found = place_.find(range_m);
        return found == place_.end() ? nullptr : &cells_[found->second * depths()];
    }
    /// @param column  a value for each depth; find() does not know it
    void put(double range_m, const float* column) {
        if (range_m_.size() < columns_) {
            next_ = range_m_.size();
            range_m_.push_back(range_m);
            cells_.resize(cells_.size() + depths());
        } else {
            next_ = (next_ + 1) % columns_;
            place_.erase(range_m_[next_]);
            range_m_[next_] = range_m;
        }
        place_[range_m] = next_;
        std::copy_n(column, depths(), &cells_[next_ * depths()]);
    }

private:
    std::size_t depths() const { return depth_m_.size(); }

    std::vector<double> depth_m_;
    std::size_t columns_ = 1, next_ = 0;
    std::vector<double> range_m_;  ///< by place
    std::vector<float> cells_;
    std::map<double, std::size_t> place_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_COLUMN_STORE_HPP
