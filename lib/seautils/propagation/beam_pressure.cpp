#include "seautils/propagation/beam_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

using std::numbers::pi;

constexpr double gaussian_reach = 4;  // in widths

struct Turning {
    double re, im;
    void operator*=(const Turning& by) {
        const double real = re * by.re - im * by.im;
        im = re * by.im + im * by.re;
        re = real;
    }
};

Turning turning(double size, double phase_rad) {
    return {size * std::cos(phase_rad), size * std::sin(phase_rad)};
}

}  // namespace

/// Where a beam meets a column: its kernel over depth.
struct PressureSum::Spot {
    double depth_m = 0, half_m = 0;
    double steepness = 0, height = 0;
    double phase_rad = 0, phase_per_m = 0;
};

/// At even depths from the first, n widths off the ray: the exponent of a Gaussian beam is
/// quadratic in depth, so that each value follows from the last by two products.
void PressureSum::add_evenly(const Spot& spot, bool hat, double n, double depth_m, double step_m,
                             std::complex<float>* out, const std::complex<float>* end) {
    const double step = step_m * spot.steepness;
    const double square = hat ? 0 : 1;
    auto value = turning(spot.height * std::exp(-0.5 * square * n * n),
                         spot.phase_rad + spot.phase_per_m * (depth_m - spot.depth_m));
    auto ratio = turning(std::exp(-square * step * (n + 0.5 * step)), spot.phase_per_m * step_m);
    const double bend = std::exp(-square * step * step);
    for (; out != end; ++out, n += step) {
        const double weight = hat ? std::max(0., 1 - std::abs(n)) : 1;
        *out += std::complex<float>(static_cast<float>(weight * value.re),
                                    static_cast<float>(weight * value.im));
        value *= ratio;
        ratio.re *= bend;
        ratio.im *= bend;
    }
}

PressureSum::PressureSum(const RaySea& sea, const Columns& columns, const BeamKind& kind)
    : sea_(sea), columns_(columns), kind_(kind), walk_(sea, kind.legs), sum_(columns.cells()) {}

void PressureSum::add(const Launch& launch, bool even) {
    const auto& ranges = columns_.range_m();
    if (ranges.empty() || launch.level == 0) return;
    launch_ = launch;
    even_ = even;
    std::size_t column = 0;
    walk_.run<BeamState>(launch.angle_rad, ranges.back(), kind_.least_amplitude,
                         [&](const Leg& leg, const BeamState& state) {
                             const double end_m = state.range_m + leg.whole.along_m;
                             while (column < ranges.size() && ranges[column] <= end_m)
                                 meet(leg, state, column++);
                             while (column > 0 && ranges[column - 1] > end_m)
                                 meet(leg, state, --column);
                             return true;
                         });
}

void PressureSum::meet(const Leg& leg, const BeamState& state, std::size_t column) {
    put(leg, state, column, 1);
    const std::size_t twin = columns_.view(column).twin;
    if (twin != 0 && even_) put(leg, state, twin, 2);
}

/// @param share  of the fan that the beam stands for, in beams
void PressureSum::put(const Leg& leg, const BeamState& state, std::size_t column, double share) {
    const double range_m = columns_.view(column).range_m;
    const Advance at = leg.part(range_m - state.range_m);
    if (kind_.baffle_from_sine < kind_.baffle_to_sine && at.sine >= kind_.baffle_from_sine &&
        at.sine <= kind_.baffle_to_sine)
        return;
    const double q = state.q + state.p * at.spread;
    const double speed_mps =
        leg.speed_mps + leg.range_gradient * at.along_m + leg.depth_gradient * at.down_m;
    if (!(std::abs(q) < 1e15) || q == 0) return;
    const bool hat = kind_.beam == Beam::hat;
    const double length_m = state.length_m + at.length_m;
    const double between_m = share * std::abs(q) * launch_.spacing_rad / sea_.source_speed_mps;
    const double width_m =
        hat ? between_m : std::max(kind_.width_factor * between_m, least_width_m(sea_, length_m));
    const double across = std::max(std::abs(at.cosine), 1e-5);
    const bool caustic = (state.q > 0 && q < 0) || (state.q < 0 && q > 0);
    const double omega = 2 * pi * sea_.frequency_hz;
    Spot spot;
    spot.depth_m = leg.depth_m + at.down_m;
    spot.half_m = (hat ? 1 : gaussian_reach) * width_m / across;
    spot.steepness = across / width_m;
    spot.height =
        launch_.level * state.amplitude * std::exp(-sea_.absorption_np_per_m * length_m) *
        std::sqrt(launch_.cosine / (hat ? 1 : 2 * pi) * speed_mps / (std::abs(q) * range_m)) *
        between_m / width_m;
    spot.phase_rad = state.phase_rad + 0.5 * pi * (state.caustics + (caustic ? 1 : 0)) -
                     omega * (state.delay_s + at.delay_s);
    spot.phase_per_m = -omega * at.sine / speed_mps;
    spread(spot, column);
}

void PressureSum::spread(const Spot& spot, std::size_t column) {
    const Depths& depths = columns_.depths(column);
    const bool hat = kind_.beam == Beam::hat;
    const double reach = hat ? 1 : gaussian_reach;
    auto [from, to] = depths.run(static_cast<float>(spot.depth_m - spot.half_m),
                                 static_cast<float>(spot.depth_m + spot.half_m));
    const auto n = [&](std::size_t k) {
        return (depths.data()[k] - spot.depth_m) * spot.steepness;
    };
    while (from < to && n(from) < -reach) ++from;
    while (from < to && n(to - 1) > reach) --to;
    if (from == to) return;
    auto* out = sum_.data() + columns_.offset(column);
    if (depths.step_m() > 0)
        add_evenly(spot, hat, n(from), depths.data()[from], depths.step_m(), out + from, out + to);
    else
        for (std::size_t k = from; k < to; ++k)
            add_evenly(spot, hat, n(k), depths.data()[k], 0, out + k, out + k + 1);
}

void PressureSum::add(const PressureSum& other) {
    cut_ += other.cut();
    for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += other.sum_[k];
}

}  // namespace seautils::propagation
