#include "seautils/propagation/beam_intensity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

// Loops over eight floats at a time are for the compiler to make vectors of: no calls, no branches
// in them. They stand twice, for processors with vectors of eight and for all others; the sums are
// the same, bit for bit, as nothing is fused.
#define SEAUTILS_INLINED [[gnu::always_inline]] inline

namespace seautils::propagation {
namespace {

using std::numbers::pi;

constexpr std::size_t lanes = Depths::run_past + Depths::grain;
constexpr float gaussian_reach = 4;  // in widths
/// A narrow beam is a hat as wide as its neighbour is far, from this many least widths on: there a
/// hat is as wide, rms, as a Gaussian of the least width.
constexpr float hat_from = 2.2F;
constexpr float hat_rms = 0.45F;

/// 2^x for x in -126 to 0, to 1e-5.
SEAUTILS_INLINED float power_of_two(float x) {
    const auto whole = static_cast<std::int32_t>(x);
    const float part = x - static_cast<float>(whole);  // -1 to 0
    const float mantissa =
        1.F + part * (0.69314718F +
                      part * (0.24022651F +
                              part * (0.05550411F + part * (0.00961813F + part * 0.00133336F))));
    return mantissa * std::bit_cast<float>((whole + 127) << 23);
}

SEAUTILS_INLINED float gaussian(float x) { return power_of_two(std::max(-x * x, -126.F)); }
SEAUTILS_INLINED float hat(float x) { return std::max(1.F - std::abs(x), 0.F); }

template <float (*kernel)(float)>
SEAUTILS_INLINED void add_kernel(const float* __restrict depth_m, float* __restrict out,
                                 std::size_t from, std::size_t to, float middle_m, float steepness,
                                 float height) {
    for (std::size_t k = from & ~(Depths::grain - 1); k < to; k += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            out[k + lane] += height * kernel((depth_m[k + lane] - middle_m) * steepness);
}

}  // namespace

IntensitySum::IntensitySum(const RaySea& sea, const Columns& columns, const BeamKind& kind)
    : sea_(sea),
      columns_(columns),
      kind_(kind),
      walk_(sea, kind.legs, kind.least_amplitude, kind.mark_every_m),
      sum_(columns.cells()) {
    if (kind.beam == Beam::hat) return;
    least_at_most_m_ = static_cast<float>(least_width_m(sea, far_m));
    least_per_m_ = static_cast<float>(least_width_m(sea, 1e-9) * 1e9);
}

/// @param share  of the fan that the beam stands for, in beams
SEAUTILS_INLINED void IntensitySum::put(const EnergyArc& arc, const EnergyState& state,
                                        std::size_t column, double share) {
    const Columns::View& view = columns_.view(column);
    const double along_m = view.range_m - state.range_m;
    const double q = std::abs(state.q + state.p * double{arc.spread_per_m} * along_m);
    if (!(q < 1e15)) return;
    const std::size_t k = spots_.count++;
    const auto along = static_cast<float>(along_m);
    spots_.column[k] = static_cast<std::uint32_t>(column);
    spots_.cosine[k] = std::abs(arc.cosine);
    spots_.sine[k] = arc.sine;
    spots_.turn[k] = arc.curvature * along;
    spots_.along_m[k] = std::abs(along);
    spots_.depth_m[k] = arc.depth_m;
    spots_.speed_mps[k] = arc.speed_mps + arc.range_gradient * along;
    spots_.gradient[k] = arc.depth_gradient;
    spots_.width_m[k] = static_cast<float>(share * width_per_q_ * q);
    spots_.path_m[k] = static_cast<float>(state.length_m + double{arc.length_per_m} * along_m);
    spots_.energy[k] =
        static_cast<float>(share * energy_ * state.amplitude * state.amplitude * view.per_range);
    if (spots_.count == Spots::most) flush();
}

void IntensitySum::put_twin(const EnergyArc& arc, const EnergyState& state, std::size_t column) {
    put(arc, state, column, 2);
}

SEAUTILS_INLINED void IntensitySum::meet(const EnergyArc& arc, const EnergyState& state,
                                         std::size_t column) {
    put(arc, state, column, 1);
    const std::size_t twin = columns_.view(column).twin;
    if (twin != 0 && even_) put_twin(arc, state, twin);
}

void IntensitySum::add(const Launch& launch, bool even) {
    forgotten_.forget();
    add(launch, even, forgotten_);
}

void IntensitySum::add(const Launch& launch, bool even, KeptRay& ray) {
    even_ = even;
    if (columns_.range_m().empty() || launch.level == 0) return;
    double level = launch.level;
    if (kind_.sum == Sum::semi_coherent)
        level *= std::numbers::sqrt2 * std::sin(2 * pi * sea_.frequency_hz * sea_.source_depth_m *
                                                std::sin(launch.angle_rad) / sea_.source_speed_mps);
    energy_ = level * level * launch.cosine * launch.spacing_rad / sea_.source_speed_mps;
    width_per_q_ = launch.spacing_rad / sea_.source_speed_mps;
    walk_.run(ray, launch.angle_rad, columns_.range_m(),
              [&](const EnergyArc& arc, const EnergyState& state, std::size_t column) {
                  meet(arc, state, column);
              });
}

/// From arcs to kernels.
SEAUTILS_INLINED void IntensitySum::shape() {
    Spots& s = spots_;
    const float hat_over = kind_.beam == Beam::hat ? 0.F : kind_.mirrored ? hat_from : 1e9F;
    const float narrow = 0.84932180F;  // √(log2(e)/2): exp(-n²/2) as a power of two
    const float area = 0.39894228F;    // 1/√(2π)
    const float factor = static_cast<float>(kind_.width_factor);
    const float fading =
        static_cast<float>(2 * std::numbers::log2e * sea_.absorption_np_per_m);  // in powers of two
    for (std::size_t k = 0; k < s.count; ++k) {
        const float sine = s.sine[k] + s.turn[k];
        const float cosine = std::sqrt(std::max(1.F - sine * sine, 1e-10F));
        const float down_m = s.along_m[k] * (s.sine[k] + sine) / (s.cosine[k] + cosine);
        const float least_m = std::min(least_per_m_ * s.path_m[k], least_at_most_m_);
        const bool hat = s.width_m[k] > hat_over * least_m;
        const float gaussian_m = std::max(factor * s.width_m[k], least_m);
        const float width_m = std::max(hat ? s.width_m[k] : gaussian_m, 1e-6F);
        s.depth_m[k] += down_m;
        s.sine[k] = sine;
        const float faded = power_of_two(std::max(-fading * s.path_m[k], -126.F));
        s.height[k] = s.energy[k] * faded * (s.speed_mps[k] + s.gradient[k] * down_m) / width_m *
                      (hat ? 1.F : area);
        s.steepness[k] = (hat ? 1.F : narrow) * cosine / width_m;
        s.half_m[k] = (hat ? 1.F : gaussian_reach) * width_m / cosine;
        s.mirrored[k] = hat ? 1.F - least_m / (hat_rms * width_m) : 0.F;
        s.hat[k] = hat;
    }
}

SEAUTILS_INLINED void IntensitySum::spread(std::size_t k, const Columns::View& column,
                                           float depth_m, float height) {
    const Spots& s = spots_;
    const auto [from, to] = column.finder.run(depth_m - s.half_m[k], depth_m + s.half_m[k]);
    float* out = sum_.data() + column.offset;
    if (s.hat[k])
        add_kernel<hat>(column.depth_m, out, from, to, depth_m, s.steepness[k], height);
    else
        add_kernel<gaussian>(column.depth_m, out, from, to, depth_m, s.steepness[k], height);
}

SEAUTILS_INLINED void IntensitySum::spread(std::size_t k) {
    const Spots& s = spots_;
    const auto& column = columns_.view(s.column[k]);
    spread(k, column, s.depth_m[k], s.height[k]);
    if (!kind_.mirrored || s.mirrored[k] <= 0) return;
    if (s.depth_m[k] - s.half_m[k] < column.surface_m)
        spread(k, column, 2 * column.surface_m - s.depth_m[k], s.mirrored[k] * s.height[k]);
    if (s.depth_m[k] + s.half_m[k] > column.bottom_m)
        spread(k, column, 2 * column.bottom_m - s.depth_m[k], s.mirrored[k] * s.height[k]);
}

SEAUTILS_INLINED void IntensitySum::spread_all() {
    shape();
    const bool baffled = kind_.baffle_from_sine < kind_.baffle_to_sine;
    for (std::size_t k = 0; k < spots_.count; ++k) {
        if (baffled && spots_.sine[k] >= kind_.baffle_from_sine &&
            spots_.sine[k] <= kind_.baffle_to_sine)
            continue;
        spread(k);
    }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void IntensitySum::spread_all_wide() { spread_all(); }
#endif

void IntensitySum::flush() {
#if defined(__x86_64__)
    static const bool is_wide = __builtin_cpu_supports("avx2");
    kind_.wide&& is_wide ? spread_all_wide() : spread_all();
#else
    spread_all();
#endif
    spots_.count = 0;
}

void IntensitySum::add(const IntensitySum& other) {
    cut_ += other.cut();
    for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += other.sum_[k];
}

}  // namespace seautils::propagation
