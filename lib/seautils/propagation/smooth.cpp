#include "seautils/propagation/smooth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace seautils::propagation {

namespace {

struct Tally {
    double intensity = 0, cells = 0;
};

/// Sums over a window that slides along `n` cells, `step` apart.
void slide(std::vector<Tally>& cells, std::size_t first, std::size_t n, std::size_t step,
           std::size_t window, std::vector<Tally>& line) {
    const std::size_t half = window / 2;
    for (std::size_t k = 0; k < n; ++k) line[k] = cells[first + k * step];
    for (std::size_t k = 0; k < n; ++k) {
        Tally sum;  // anew each time: what is left over of a large one would drown small ones
        for (std::size_t i = k > half ? k - half : 0; i < std::min(n, k + half + 1); ++i) {
            sum.intensity += line[i].intensity;
            sum.cells += line[i].cells;
        }
        cells[first + k * step] = sum;
    }
}

}  // namespace

void smooth(Field& field, std::size_t depths, std::size_t ranges) {
    std::vector<Tally> cells(field.loss_db.size());
    for (std::size_t k = 0; k < cells.size(); ++k)
        if (!std::isnan(field.loss_db[k]))
            cells[k] = {std::pow(10, -0.1 * double{field.loss_db[k]}), 1};
    std::vector<Tally> line(std::max(field.depths, field.ranges));
    for (std::size_t k = 0; k < field.depths; ++k)
        slide(cells, k * field.ranges, field.ranges, 1, ranges, line);
    for (std::size_t k = 0; k < field.ranges; ++k)
        slide(cells, k, field.depths, field.ranges, depths, line);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (std::isnan(field.loss_db[k])) continue;
        const double mean = cells[k].intensity / cells[k].cells;
        field.loss_db[k] = mean > 0 ? static_cast<float>(-10 * std::log10(mean))
                                    : std::numeric_limits<float>::infinity();
    }
    field.pressure.clear();
}

}  // namespace seautils::propagation
