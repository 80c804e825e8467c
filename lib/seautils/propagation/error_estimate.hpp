#ifndef SEAUTILS_PROPAGATION_ERROR_ESTIMATE_HPP
#define SEAUTILS_PROPAGATION_ERROR_ESTIMATE_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace seautils::propagation {

/// What a field is amiss by, from some of its cells, each computed in two ways.
class ErrorEstimate {
public:
    static constexpr double most_db = 20;

    /// Two intensities that should be one. Nothing is learnt from a cell without energy.
    void add(double intensity, double other) {
        if (!(intensity > 0)) return;
        const double apart_db = other > 0 ? 10 * std::log10(other / intensity) : most_db;
        if (!std::isnan(apart_db)) error_db_.push_back(std::min(std::abs(apart_db), most_db));
    }
    /// 95 % of the cells are no farther apart; 0 where there are none.
    double db() {
        if (error_db_.empty()) return 0;
        const auto at = error_db_.begin() + static_cast<std::ptrdiff_t>(error_db_.size() * 19 / 20);
        std::nth_element(error_db_.begin(), at, error_db_.end());
        return *at;
    }

private:
    std::vector<double> error_db_;
};

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_ERROR_ESTIMATE_HPP
