#include "seautils/propagation/beam_columns.hpp"

#include <algorithm>

namespace seautils::propagation {
namespace {

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

Columns::Columns(const RaySea& sea, const Receivers& receivers, const FieldOptions& options,
                 const std::vector<double>& probe_m) {
    if (receivers.depth_m.empty()) return;
    depths_.emplace_back(receivers.depth_m);
    const bool coarse = options.beam == Beam::gaussian && options.sum != Sum::coherent;
    std::size_t probe = 0;
    for (const double r : receivers.range_m) {
        if (!(r > 0)) continue;
        for (; probe < probe_m.size() && probe_m[probe] < r; ++probe)
            add_probe(sea, probe_m[probe]);
        add_receivers(sea, r, coarse);
    }
    add_twins();
    for (View& view : views_) {
        view.depth_m = depths_[view.grid].data();
        view.finder = depths_[view.grid].finder();
    }
}

void Columns::add(const RaySea& sea, double range_m, std::size_t grid) {
    range_m_.push_back(range_m);
    views_.push_back({nullptr,
                      {},
                      static_cast<float>(sea.surface.depth_at(range_m)),
                      static_cast<float>(sea.bottom.depth_at(range_m)),
                      cells_,
                      grid,
                      range_m,
                      1 / range_m,
                      0});
    cells_ += depths_[grid].stride();
}

/// Steps of fewer depths hang on their number alone.
void Columns::add_receivers(const RaySea& sea, double range_m, bool coarse) {
    const Depths& own = depths_[0];
    const float top_m = own.top_m(), span_m = own.data()[own.count() - 1] - top_m;
    const auto wanted_m = static_cast<float>(least_width_m(sea, range_m) / steps_per_width);
    const auto steps = static_cast<std::size_t>(std::min(1e9F, span_m / wanted_m)) + 1;
    const std::size_t count = steps + 3;
    std::size_t grid = 0;
    if (coarse && 3 * count < 2 * own.count()) {
        if (coarse_ == 0 || depths_[coarse_].count() != count) {
            const float step_m = span_m / static_cast<float>(steps);
            depths_.emplace_back(top_m - step_m, step_m, count);
            coarse_ = depths_.size() - 1;
        }
        grid = coarse_;
    }
    receivers_.push_back(range_m_.size());
    add(sea, range_m, grid);
    cells_of_receivers_ += depths_[grid].stride();
}

void Columns::add_probe(const RaySea& sea, double range_m) {
    const auto top_m = static_cast<float>(sea.surface.depth_at(range_m));
    const auto height_m = static_cast<float>(sea.bottom.depth_at(range_m)) - top_m;
    if (!(height_m > 0)) return;
    const float step_m = height_m / static_cast<float>(depths_of_probe);
    depths_.emplace_back(top_m + step_m / 2, step_m, depths_of_probe);
    probes_.push_back(range_m_.size());
    add(sea, range_m, depths_.size() - 1);
}

void Columns::add_twins() {
    for (const std::size_t probe : probes_) {
        views_[probe].twin = views_.size();
        views_.push_back(views_[probe]);
        views_.back().offset = cells_;
        cells_ += depths(probe).stride();
    }
}

/// Cubic interpolation (Lagrange) between four depths.
void Columns::at_receivers(std::size_t column, const float* sums, float* out) const {
    const Depths& from = depths(column);
    const Depths& to = depths_[0];
    if (views_[column].grid == 0) {
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
