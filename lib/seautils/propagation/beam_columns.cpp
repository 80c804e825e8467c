#include "seautils/propagation/beam_columns.hpp"

#include <algorithm>

namespace seautils::propagation {
namespace {

/// So many depths, and what stands in memory beyond them.
std::size_t padded(std::size_t depths) {
    return (depths + Depths::grain - 1) / Depths::grain * Depths::grain + Depths::run_past;
}

/// What is added at a third of the width of the narrowest beam is interpolated by cubics to 0.04
/// dB, three widths off a beam's axis, and better near it.
constexpr double steps_per_width = 3;

/// Even to a hundred thousandth of the step.
double even_step_m(const std::vector<double>& depth_m) {
    if (depth_m.size() < 2) return 0;
    const double step_m =
        (depth_m.back() - depth_m.front()) / static_cast<double>(depth_m.size() - 1);
    for (std::size_t k = 0; k < depth_m.size(); ++k)
        if (std::abs(depth_m[k] - depth_m.front() - step_m * static_cast<double>(k)) >
            1e-5 * step_m)
            return 0;
    return step_m;
}

}  // namespace

Depths::Depths(const std::vector<double>& depth_m) : count_(depth_m.size()) {
    depth_m_.assign(depth_m.begin(), depth_m.end());
    depth_m_.resize(padded(count_), depth_m_.back());
    step_m_ = even_step_m(depth_m);
    make_bins();
}

Depths::Depths(float top_m, float step_m, std::size_t count) : count_(count) {
    depth_m_.resize(padded(count));
    for (std::size_t k = 0; k < depth_m_.size(); ++k)
        depth_m_[k] = top_m + step_m * static_cast<float>(k);
    make_bins();
}

/// A bin begins with the number of depths above it: first one for all that lies above the top, then
/// as many as there are depths, and one for all that lies below.
void Depths::make_bins() {
    const float span_m = depth_m_[count_ - 1] - depth_m_[0];
    const std::size_t bins = count_;
    per_bin_ = span_m > 0 ? static_cast<float>(bins) / span_m : 1;
    bin_.push_back(0);
    for (std::size_t k = 0, at = 0; k <= bins; ++k) {
        while (at < count_ &&
               (depth_m_[at] - depth_m_[0]) * per_bin_ < static_cast<float>(k) - 0.01F)
            ++at;
        bin_.push_back(static_cast<std::uint32_t>(at));
    }
    last_bin_ = static_cast<float>(bin_.size() - 1);
    bin_.push_back(static_cast<std::uint32_t>(count_));
    bin_.push_back(static_cast<std::uint32_t>(count_));
}

Columns::Columns(const RaySea& sea, const Receivers& receivers, const FieldOptions& options) {
    if (receivers.depth_m.empty()) return;
    depths_.emplace_back(receivers.depth_m);
    const float top_m = depths_[0].top_m();
    const float span_m = static_cast<float>(receivers.depth_m.back()) - top_m;
    const bool coarse = options.beam == Beam::gaussian && options.sum != Sum::coherent;
    for (const double r : receivers.range_m) {
        if (!(r > 0)) continue;
        range_m_.push_back(r);
        surface_m_.push_back(static_cast<float>(sea.surface.depth_at(r)));
        bottom_m_.push_back(static_cast<float>(sea.bottom.depth_at(r)));
        const auto step_m = static_cast<float>(least_width_m(sea, r) / steps_per_width);
        const auto count = static_cast<std::size_t>(std::min(1e9F, span_m / step_m)) + 4;
        if (coarse && 3 * count < 2 * depths_[0].count()) {
            const bool again = depths_.size() > 1 && depths_.back().count() == count;
            if (!again) depths_.emplace_back(top_m - step_m, step_m, count);
            grid_.push_back(static_cast<std::uint32_t>(depths_.size() - 1));
        } else {
            grid_.push_back(0);
        }
        offset_.push_back(cells_);
        cells_ += depths(range_m_.size() - 1).stride();
    }
    for (std::size_t k = 0; k < range_m_.size(); ++k)
        views_.push_back({depths(k).data(), depths(k).finder(), surface_m_[k], bottom_m_[k],
                          offset_[k], range_m_[k], 1 / range_m_[k]});
}

/// Cubic interpolation (Lagrange) between four depths.
void Columns::at_receivers(std::size_t column, const float* sums, float* out) const {
    const Depths& from = depths(column);
    const Depths& to = depths_[0];
    if (grid_[column] == 0) {
        std::copy_n(sums, to.count(), out);
        return;
    }
    const float step_m = from.data()[1] - from.data()[0];
    for (std::size_t k = 0; k < to.count(); ++k) {
        const float place = (to.data()[k] - from.top_m()) / step_m;
        const std::size_t at =
            std::clamp<std::size_t>(static_cast<std::size_t>(place), 1, from.count() - 3);
        const float t = place - static_cast<float>(at);
        const float* s = sums + at;
        const float value = -t * (t - 1) * (t - 2) / 6 * s[-1] +
                            (t + 1) * (t - 1) * (t - 2) / 2 * s[0] -
                            (t + 1) * t * (t - 2) / 2 * s[1] + (t + 1) * t * (t - 1) / 6 * s[2];
        out[k] = std::max(value, 0.F);
    }
}

}  // namespace seautils::propagation
