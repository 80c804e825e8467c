#ifndef SEAUTILS_TESTS_PROPAGATION_GRIDS_HPP
#define SEAUTILS_TESTS_PROPAGATION_GRIDS_HPP

#include <algorithm>
#include <vector>

namespace seautils::propagation {

inline std::vector<double> evenly(double from, double to, int count) {
    std::vector<double> out;
    for (int k = 0; k < count; ++k) out.push_back(from + (to - from) * k / std::max(1, count - 1));
    return out;
}

}  // namespace seautils::propagation

#endif  // SEAUTILS_TESTS_PROPAGATION_GRIDS_HPP
