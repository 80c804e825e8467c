#include "seautils/propagation/beam_sum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

using std::numbers::pi;

constexpr double reach = 4;  // of a Gaussian beam, in widths

}  // namespace

Columns::Columns(const Receivers& receivers) {
    for (const double r : receivers.range_m)
        if (r > 0) range_m.push_back(r);
    depth_m.assign(receivers.depth_m.begin(), receivers.depth_m.end());
    stride = (depth_m.size() + 3) / 4 * 4;
    if (depth_m.empty()) return;
    top_m_ = depth_m.front();
    const float span_m = depth_m.back() - top_m_;
    const std::size_t bins = 2 * depth_m.size();
    per_bin_ = span_m > 0 ? static_cast<float>(bins) / span_m : 0;
    for (std::size_t k = 0, at = 0; k <= bins; ++k) {
        while (at < depth_m.size() && (depth_m[at] - top_m_) * per_bin_ < static_cast<float>(k))
            ++at;
        bin_.push_back(static_cast<std::uint32_t>(at));
    }
}

std::size_t Columns::first_below(float depth) const {
    const float bin = (depth - top_m_) * per_bin_;
    if (!(bin > 0)) return depth <= top_m_ ? 0 : depth_m.size();
    std::size_t at = bin_[std::min(static_cast<std::size_t>(std::min(bin, 1e9F)), bin_.size() - 1)];
    while (at < depth_m.size() && depth_m[at] < depth) ++at;
    return at;
}

/// Where a beam meets a column.
struct BeamSum::Spot {
    Advance at;
    double depth_m = 0, speed_mps = 0, range_m = 0, q = 0;
    double width_m = 0;    ///< between neighbours, across the ray
    double spread_m = 0;   ///< of the kernel, across the ray
    double amplitude = 0;  ///< of source, walls and water
};

BeamSum::BeamSum(const RaySea& sea, const Columns& columns, const BeamKind& kind)
    : sea_(sea), columns_(columns), kind_(kind), walk_(sea) {
    const std::size_t cells = columns.range_m.size() * columns.stride;
    if (kind.sum == Sum::coherent)
        pressure_.resize(cells);
    else
        intensity_.resize(cells);
}

void BeamSum::add(double launch_rad, double level) {
    if (columns_.range_m.empty() || level == 0) return;
    cosine_ = std::abs(std::cos(launch_rad));
    level_ = level;
    if (kind_.sum == Sum::semi_coherent)
        level_ *= std::numbers::sqrt2 *
                  std::abs(std::sin(2 * pi * sea_.frequency_hz * sea_.source_depth_m *
                                    std::sin(launch_rad) / sea_.source_speed_mps));
    const auto& ranges = columns_.range_m;
    std::size_t column = 0;
    walk_.run(launch_rad, ranges.back(), kind_.least_amplitude,
              [&](const Leg& leg, const BeamState& state) {
                  const double end_m = state.range_m + leg.whole.along_m;
                  while (column < ranges.size() && ranges[column] <= end_m)
                      deposit(leg, state, column++);
                  while (column > 0 && ranges[column - 1] > end_m) deposit(leg, state, --column);
                  return true;
              });
}

void BeamSum::deposit(const Leg& leg, const BeamState& state, std::size_t column) {
    Spot spot;
    spot.range_m = columns_.range_m[column];
    spot.at = leg.part(spot.range_m - state.range_m);
    const double elevation_deg = std::asin(spot.at.sine) * 180 / pi;
    if (kind_.baffle_from_deg < kind_.baffle_to_deg && elevation_deg >= kind_.baffle_from_deg &&
        elevation_deg <= kind_.baffle_to_deg)
        return;
    spot.depth_m = leg.depth_m + spot.at.down_m;
    spot.speed_mps =
        leg.speed_mps + leg.range_gradient * spot.at.along_m + leg.depth_gradient * spot.at.down_m;
    spot.q = state.q + state.p * spot.at.spread;
    spot.width_m = std::abs(spot.q) * kind_.spacing_rad / sea_.source_speed_mps;
    const double delay_s = state.delay_s + spot.at.delay_s;
    const double least_m =
        std::min(0.2 * sea_.frequency_hz * delay_s, pi * sea_.source_speed_mps / sea_.frequency_hz);
    spot.spread_m = kind_.beam == Beam::hat ? spot.width_m : std::max(spot.width_m, least_m);
    spot.amplitude = level_ * state.amplitude *
                     std::exp(-sea_.absorption_np_per_m * (state.length_m + spot.at.length_m));
    if (kind_.sum == Sum::coherent)
        add_pressure(spot, state, column);
    else
        add_intensity(spot, column);
}

void BeamSum::add_intensity(const Spot& spot, std::size_t column) {
    const double energy = cosine_ * kind_.spacing_rad * spot.speed_mps / sea_.source_speed_mps *
                          spot.amplitude * spot.amplitude / spot.range_m;
    const bool hat = kind_.beam == Beam::hat;
    const double height = energy / spot.spread_m / (hat ? 1 : std::sqrt(2 * pi));
    const double across = std::max(std::abs(spot.at.cosine), 1e-6);
    const double half_m = (hat ? 1 : reach) * spot.spread_m / across;
    const auto& z = columns_.depth_m;
    float* out = intensity_.data() + column * columns_.stride;
    for (std::size_t k = columns_.first_below(static_cast<float>(spot.depth_m - half_m));
         k < z.size() && z[k] <= spot.depth_m + half_m; ++k) {
        const double n = std::abs(z[k] - spot.depth_m) * across / spot.spread_m;
        out[k] += static_cast<float>(height * (hat ? std::max(0., 1 - n) : std::exp(-0.5 * n * n)));
    }
}

void BeamSum::add_pressure(const Spot& spot, const BeamState& state, std::size_t column) {
    const bool hat = kind_.beam == Beam::hat;
    const double across = std::max(std::abs(spot.at.cosine), 1e-6);
    const double half_m = (hat ? 1 : reach) * spot.spread_m / across;
    const bool caustic = (state.q > 0 && spot.q <= 0) || (state.q < 0 && spot.q >= 0);
    const double height = spot.amplitude *
                          std::sqrt(cosine_ / (hat ? 1 : 2 * pi) * spot.speed_mps /
                                    (std::abs(spot.q) * spot.range_m)) *
                          spot.width_m / spot.spread_m;
    const double omega = 2 * pi * sea_.frequency_hz;
    const double phase = state.phase_rad + 0.5 * pi * (state.caustics + (caustic ? 1 : 0)) -
                         omega * (state.delay_s + spot.at.delay_s);
    const double slope = -omega * spot.at.sine / spot.speed_mps;
    const auto& z = columns_.depth_m;
    auto* out = pressure_.data() + column * columns_.stride;
    for (std::size_t k = columns_.first_below(static_cast<float>(spot.depth_m - half_m));
         k < z.size() && z[k] <= spot.depth_m + half_m; ++k) {
        const double down_m = z[k] - spot.depth_m;
        const double n = std::abs(down_m) * across / spot.spread_m;
        const double size = height * (hat ? std::max(0., 1 - n) : std::exp(-0.5 * n * n));
        const double angle = phase + slope * down_m;
        out[k] += std::complex<float>(static_cast<float>(size * std::cos(angle)),
                                      static_cast<float>(size * std::sin(angle)));
    }
}

void BeamSum::add(const BeamSum& other) {
    for (std::size_t k = 0; k < intensity_.size(); ++k) intensity_[k] += other.intensity_[k];
    for (std::size_t k = 0; k < pressure_.size(); ++k) pressure_[k] += other.pressure_[k];
}

}  // namespace seautils::propagation
