#ifndef SEAUTILS_PLAN_LOSS_FIELD_HPP
#define SEAUTILS_PLAN_LOSS_FIELD_HPP

#include <cstddef>
#include <limits>
#include <vector>

namespace seautils::plan {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Transmission loss between a source and a grid of depths and ranges.
struct LossField {
    std::vector<double> depth_m;  ///< grows, positive down
    std::vector<double> range_m;  ///< grows, 0 or more
    /// [depth][range], dB re 1 m. NaN: no value (below the seabed, range 0); infinite: no energy.
    std::vector<float> loss_db;

    float at(std::size_t depth, std::size_t range) const {
        return loss_db[depth * range_m.size() + range];
    }
};

/// Both axes have 1 to 100000 finite values that grow, from 0 on; there is a loss for each pair of them, -100 to 1000 dB,
/// NaN or +infinite.
/// @throws DataError  names what is wrong, the value and the bound
void check(const LossField& field);

/// Ranges from the source, both ends included.
struct RangeWindow {
    double from_m = 0, to_m = 0;
};

/// How a window lies in a field.
enum class Cover { full, part, none };

/// A window that ends nearer than the field begins is covered by the field's first range; beyond its last range (by more
/// than half a step) there is nothing.
Cover cover(const LossField& field, RangeWindow window);

/// Loss of the mean intensity at one depth over a window: -10 lg(mean of 10^(-H/10)), of the ranges in it that have a
/// value; where no range of the field lies in it, of the one nearest to its middle (eq 4.2 of the thesis, with
/// the mean in place of a sum that supposes a sample each metre).
/// Check value: losses of 90, 92, 88 and 100 dB give 90.81465 dB.
/// @return  dB; NaN: no value; infinite: no energy
double mean_loss_db(const LossField& field, std::size_t depth, RangeWindow window);

/// Loss at one depth and any range: intensity is linear between ranges of the field. NaN outside them, and where neither
/// neighbour has a value.
double loss_at_db(const LossField& field, std::size_t depth, double range_m);
/// The same at any depth between those of the field.
double loss_at_db(const LossField& field, double depth_m, double range_m);

}  // namespace seautils::plan

#endif  // SEAUTILS_PLAN_LOSS_FIELD_HPP
