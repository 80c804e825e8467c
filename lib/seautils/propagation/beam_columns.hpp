#ifndef SEAUTILS_PROPAGATION_BEAM_COLUMNS_HPP
#define SEAUTILS_PROPAGATION_BEAM_COLUMNS_HPP

#include "seautils/propagation/field.hpp"
#include "seautils/propagation/ray_sea.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace seautils::propagation {

/// Depths at which beams are added. Beyond `count` they only fill: vectors begin at each `grain`
/// and may run past the last by `run_past`.
class Depths {
public:
    static constexpr std::size_t grain = 4, run_past = 4;
    /// What so many depths take.
    static std::size_t padded(std::size_t count) {
        return (count + grain - 1) / grain * grain + run_past;
    }

    /// @param depth_m  grows; 1 at least
    explicit Depths(const std::vector<double>& depth_m);
    /// `count` of them, evenly from `top_m`, at least 2.
    Depths(float top_m, float step_m, std::size_t count);

    std::size_t count() const { return count_; }
    std::size_t stride() const { return depth_m_.size(); }
    const float* data() const { return depth_m_.data(); }
    float top_m() const { return depth_m_.front(); }
    /// Between neighbours; 0 where they are not even.
    double step_m() const { return step_m_; }
    /// From `from` up to but not `to`: all depths within [least_m, most_m], and few others.
    struct Run {
        std::size_t from, to;
    };
    Run run(float least_m, float most_m) const { return finder().run(least_m, most_m); }

    /// What finds a depth, close together.
    struct Finder {
        const std::uint32_t* bins;
        float top_m, per_bin, last;

        std::size_t bin(float depth_m) const {
            const float place = (depth_m - top_m) * per_bin + 1.F;
            return static_cast<std::uint32_t>(
                static_cast<std::int32_t>(std::max(0.F, std::min(place, last))));
        }
        Run run(float least_m, float most_m) const {
            return {bins[bin(least_m)], bins[bin(most_m) + 1]};
        }
    };
    Finder finder() const { return {bin_.data(), top_m(), per_bin_, last_bin_}; }

private:
    void make_bins();

    std::vector<float> depth_m_;
    std::size_t count_ = 0;
    double step_m_ = 0;
    float per_bin_ = 0, last_bin_ = 0;
    std::vector<std::uint32_t> bin_;
};

/// Where beams are met: columns, each with the depths at which beams are added there. Those of
/// receivers have fewer than these where no beam is narrow; the loss in between is interpolated.
/// Probes are columns besides, from surface to bottom, each with a twin for a fan half as dense.
class Columns {
public:
    static constexpr std::size_t depths_of_probe = 48;

    /// @param receivers  ranges and depths grow
    /// @param options    where beams are Gaussian, they are no narrower than least_width_m() tells
    /// @param probe_m    ranges, which grow; what lies beyond the receivers is left out
    Columns(const RaySea& sea, const Receivers& receivers, const FieldOptions& options,
            const std::vector<double>& probe_m);
    Columns(const Columns&) = delete;  // views point into it
    Columns& operator=(const Columns&) = delete;

    /// Of all columns; those above 0.
    const std::vector<double>& range_m() const { return range_m_; }
    /// Columns of receivers at ranges above 0, in their order; of probes.
    const std::vector<std::size_t>& receivers() const { return receivers_; }
    const std::vector<std::size_t>& probes() const { return probes_; }

    const Depths& depths(std::size_t column) const { return depths_[views_[column].grid]; }
    /// All of a column that a beam asks for.
    struct View {
        const float* depth_m;
        Depths::Finder finder;
        float surface_m, bottom_m;
        std::size_t offset, grid;
        double range_m, per_range;  ///< and 1 over it
        std::size_t twin;           ///< a column at the same range; 0: none
    };
    const View& view(std::size_t column) const { return views_[column]; }
    std::size_t offset(std::size_t column) const { return views_[column].offset; }
    /// Of all columns and twins; of receivers.
    std::size_t cells() const { return cells_; }
    std::size_t cells_of_receivers() const { return cells_of_receivers_; }

    /// The sums of a receivers' column at their depths.
    void at_receivers(std::size_t column, const float* sums, float* out) const;

private:
    void add(const RaySea& sea, double range_m, std::size_t grid);
    void add_receivers(const RaySea& sea, double range_m, bool coarse);
    void add_probe(const RaySea& sea, double range_m);
    void add_twins();

    std::vector<double> range_m_;
    std::vector<Depths> depths_;  ///< first the receivers' own
    std::vector<View> views_;     ///< of columns, then of twins
    std::vector<std::size_t> receivers_, probes_;
    std::size_t coarse_ = 0;  ///< the last grid of fewer depths
    std::size_t cells_ = 0, cells_of_receivers_ = 0;
};

/// A Gaussian beam is no narrower than this, spec §7: min(0.2 f τ, πλ).
inline double least_width_m(const RaySea& sea, double path_m) {
    return std::min(0.2 * sea.frequency_hz * path_m / sea.source_speed_mps,
                    3.14159265358979 * sea.source_speed_mps / sea.frequency_hz);
}

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_BEAM_COLUMNS_HPP
