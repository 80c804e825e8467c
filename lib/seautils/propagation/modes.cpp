#include "seautils/propagation/modes.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/error_estimate.hpp"
#include "seautils/propagation/hankel.hpp"
#include "seautils/propagation/level_sea.hpp"
#include "seautils/propagation/mode_search.hpp"
#include "seautils/propagation/reflection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace seautils::propagation {

namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};
constexpr double pi = std::numbers::pi;
constexpr double forgotten_np = 16;  ///< a mode that has decayed by more adds nothing to a float
constexpr double left_out_np = 4.6;  ///< a steeper mode would leave less than 1 % of its amplitude
constexpr double radians_per_step = 0.7;
constexpr std::size_t few_modes = 200;

double first_range_m(const Environment& e) {
    for (const double r : e.receivers.range_m)
        if (r > 0) return r;
    return 1;
}

/// The least ξ of modes that still count at a range: by what the boundaries reflect, the steepest ray that leaves some,
/// or evanescent ones where nothing leaks.
double least_xi(const Environment& e, const LevelSea& sea, double range_m) {
    const double d = sea.column.height_m(), k = std::sqrt(sea.most_k2);
    const double c = sea.guide.omega / k;
    const auto log_reflection = [&](const Boundary& b, double grazing_rad) {
        const double r = std::abs(
            reflection_coefficient(b, e.frequency_hz, grazing_rad, c, e.water.density_gcm3));
        return -std::log(std::max(r, 1e-300));
    };
    double steepest_deg = 0;
    for (double deg = 0.25; deg < 90; deg += 0.25) {
        const double grazing = deg * pi / 180;
        const double cycles = range_m * std::tan(grazing) / (2 * d);
        const double lost = log_reflection(e.surface, grazing) + log_reflection(e.bottom, grazing);
        if (lost * cycles < left_out_np) steepest_deg = deg;
    }
    const double decay = left_out_np / range_m;
    if (steepest_deg > 89) return -decay * decay;
    const double kr = k * std::cos((steepest_deg + 0.25) * pi / 180);
    return kr * kr;
}

struct Plan {
    double xi;
    std::size_t steps, modes;
};

Plan plan(const LevelSea& sea, double xi) {
    const double across = std::sqrt(std::max(sea.most_k2 - xi, 0.0));
    const double d = sea.column.height_m();
    const double steps = std::max(24.0, std::ceil(across * d / radians_per_step));
    // Modes are about half a wave across apart: refuse before a mesh is laid.
    if (!(across * d / pi <= 2 * most_modes))
        throw DataError(fmt::format("modes: about {:.0f} are needed, more than {} (rays can)",
                                    across * d / pi, most_modes));
    const auto n = static_cast<std::size_t>(steps);
    const std::size_t modes = count_modes(Mesh(sea.guide, n), xi);
    if (modes > most_modes || modes * n > most_mode_nodes)
        throw DataError(fmt::format("modes: {} on {} nodes are more than {} on {} (rays can)",
                                    modes, n, most_modes, most_mode_nodes / most_modes));
    if (modes * sea.bottom.slices() > most_mode_slices)
        throw DataError(
            fmt::format("modes: {} through layers of {} slices are more than {} of them (rays can)",
                        modes, sea.bottom.slices(), most_mode_slices));
    return {xi, n, modes};
}

void check_work(const Environment& e, const LevelSea& sea, std::uint64_t modes) {
    const std::uint64_t depths = sea.depth_m.size() + 1;
    if (modes * depths > most_mode_values ||
        modes * depths * e.receivers.range_m.size() > most_mode_work)
        throw DataError(fmt::format(
            "modes: {} at {} depths and {} ranges are more than {} and {} (fewer receivers can)",
            modes, depths, e.receivers.range_m.size(), most_mode_values, most_mode_work));
}

/// As near to the source as it is cheap.
Plan plan(const Environment& e, const LevelSea& sea) {
    const double d = sea.column.height_m(), near = first_range_m(e);
    const Plan far = plan(sea, least_xi(e, sea, std::max(near, 3 * d)));
    if (far.modes > few_modes || near >= 3 * d) return far;
    const double wanted = least_xi(e, sea, std::max(near, d / 2));
    const double across = std::sqrt(std::max(sea.most_k2 - wanted, 0.0));
    return across * d / pi < 2 * few_modes ? plan(sea, wanted) : far;
}

/// Modes as floats, mode by mode: what each has at the receivers' depths, times what the source gives it.
struct Weights {
    std::vector<float> re, im;
    std::size_t depths = 0;

    Weights(const std::vector<Mode>& modes, std::size_t n) : depths(n) {
        for (const Mode& m : modes)
            for (std::size_t z = 0; z < n; ++z) {
                const Complex w = i * pi * m.values[z] * m.values[n];  // the last is the source
                re.push_back(static_cast<float>(w.real()));
                im.push_back(static_cast<float>(w.imag()));
            }
    }
};

/// exp(ikr) of all modes, range by range: turned on where ranges are evenly spaced.
class Turning {
public:
    explicit Turning(const std::vector<Complex>& xi) {
        for (const Complex& x : xi) {
            const Complex k = std::sqrt(x);
            k_.push_back(k.imag() < 0 ? -k : k);
        }
        turned_.resize(k_.size());
        turn_.resize(k_.size());
    }
    const Complex& k(std::size_t mode) const { return k_[mode]; }
    const Complex& turned(std::size_t mode) const { return turned_[mode]; }

    void to(double range_m) {
        const double step = range_m - range_m_;
        const bool even = std::abs(step - step_m_) <= 1e-12 * range_m;
        for (std::size_t m = 0; m < k_.size(); ++m) {
            if (even) {
                turned_[m] *= turn_[m];
                continue;
            }
            turned_[m] = std::exp(i * k_[m] * range_m);
            turn_[m] = std::exp(i * k_[m] * step);
        }
        step_m_ = step;
        range_m_ = range_m;
    }

private:
    std::vector<Complex> k_, turned_, turn_;
    double range_m_ = 0, step_m_ = -1;
};

struct Accumulator {
    std::vector<float> re, im;
    explicit Accumulator(std::size_t n) : re(n), im(n) {}

    void clear() {
        std::fill(re.begin(), re.end(), 0.0F);
        std::fill(im.begin(), im.end(), 0.0F);
    }
    void add(const float* wr, const float* wi, const Complex& factor) {
        const float cr = static_cast<float>(factor.real()), ci = static_cast<float>(factor.imag());
        for (std::size_t z = 0; z < re.size(); ++z) {
            re[z] += wr[z] * cr - wi[z] * ci;
            im[z] += wr[z] * ci + wi[z] * cr;
        }
    }
    void add_intensity(const float* wr, const float* wi, double factor) {
        const float f = static_cast<float>(factor);
        for (std::size_t z = 0; z < re.size(); ++z) re[z] += (wr[z] * wr[z] + wi[z] * wi[z]) * f;
    }
};

/// The sum of modes at all depths, at one range after another.
class ModeSum {
public:
    ModeSum(const Weights& weights, const std::vector<Complex>& xi, Sum sum)
        : weights_(weights), turning_(xi), modes_(xi.size()), sum_(sum), total_(weights.depths) {}

    void to(double range_m) {
        turning_.to(range_m);
        total_.clear();
        const std::size_t n = weights_.depths;
        for (std::size_t m = 0; m < modes_; ++m) {
            const Complex kr = turning_.k(m) * range_m;
            if (kr.imag() > forgotten_np) continue;
            const Complex factor = hankel_over_exp(kr) * turning_.turned(m);
            const float *wr = &weights_.re[m * n], *wi = &weights_.im[m * n];
            if (sum_ == Sum::coherent)
                total_.add(wr, wi, factor);
            else
                total_.add_intensity(wr, wi, std::norm(factor));
        }
    }
    /// A pressure, or an intensity.
    Complex at(std::size_t depth) const { return {total_.re[depth], total_.im[depth]}; }

private:
    const Weights& weights_;
    Turning turning_;
    std::size_t modes_;
    Sum sum_;
    Accumulator total_;
};

void fill(Field& field, const Environment& e, const LevelSea& sea, ModeSum total, Sum sum) {
    for (std::size_t r = 0; r < e.receivers.range_m.size(); ++r) {
        if (e.receivers.range_m[r] <= 0) continue;
        total.to(e.receivers.range_m[r]);
        for (std::size_t z = 0; z < sea.depth_m.size(); ++z) {
            const std::size_t cell = sea.rows[z] * field.ranges + r;
            if (sum == Sum::coherent)
                put_pressure(field, cell, total.at(z));
            else
                put_intensity(field, cell, total.at(z).real());
        }
    }
}

/// What the wavenumbers are amiss by: no more than the extrapolation over meshes has changed. It is
/// looked at at a few ranges.
double estimated_error_db(const std::vector<double>& range_m, std::size_t depths, ModeSum total,
                          ModeSum before, Sum sum) {
    constexpr std::size_t few = 6;
    const auto intensity = [sum](const Complex& x) {
        return sum == Sum::coherent ? std::norm(x) : x.real();
    };
    ErrorEstimate error;
    for (std::size_t k = 0; k < few; ++k) {
        const double r = range_m[(k + 1) * (range_m.size() - 1) / few];
        if (r <= 0) continue;
        total.to(r);
        before.to(r);
        for (std::size_t z = 0; z < depths; ++z)
            error.add(intensity(total.at(z)), intensity(before.at(z)));
    }
    return error.db();
}

/// Losses, and what they may be amiss by.
void sum_modes(Field& field, const Environment& e, const LevelSea& sea,
               const std::vector<Mode>& modes, Sum sum) {
    const Weights weights(modes, sea.depth_m.size());
    std::vector<Complex> xi, before;
    for (const Mode& mode : modes) {
        xi.push_back(mode.xi);
        before.push_back(mode.xi - mode.correction);
    }
    const ModeSum total(weights, xi, sum);
    fill(field, e, sea, total, sum);
    field.basis.estimated_error_db = estimated_error_db(e.receivers.range_m, sea.depth_m.size(),
                                                        total, ModeSum(weights, before, sum), sum);
}

}  // namespace

bool holds_modes(const Environment& e) {
    const Column column(e);
    const auto most_reflected = [&](const Boundary& b, double depth_m) {
        const double c = 1 / std::sqrt(column.squared_slowness(depth_m));
        double most = 0;
        for (double deg = 2; deg <= 45; deg += 1)
            most = std::max(most, std::abs(reflection_coefficient(b, e.frequency_hz, deg * pi / 180,
                                                                  c, e.water.density_gcm3)));
        return most;
    };
    constexpr double least = 0.03;
    const double top = column.surface_m();
    return most_reflected(e.surface, top) > least &&
           most_reflected(e.bottom, top + column.height_m()) > least;
}

Field mode_field(const Environment& environment, const FieldOptions& options) {
    const LevelSea sea(environment, options, "modes");
    if (!holds_modes(environment))
        throw DataError("modes: a boundary reflects nothing, so there are none (rays can)");
    const Plan what = plan(environment, sea);
    check_work(environment, sea, what.modes);
    std::vector<double> depths = sea.depth_m;
    depths.push_back(environment.source.depth_m);
    const ModeSet set = find_modes(sea.guide, what.xi, what.steps, depths);
    Field field = empty_field(environment, options, Engine::modes);
    if (!sea.depth_m.empty()) sum_modes(field, environment, sea, set.modes, options.sum);
    field.basis.modes = set.modes.size();
    if (what.xi > 0)
        field.basis.remarks.push_back(
            fmt::format("modes of a phase speed above {:.0f} m/s are left out",
                        sea.guide.omega / std::sqrt(what.xi)));
    if (set.lost > 0)
        field.basis.remarks.push_back(
            fmt::format("{} of {} modes were not found", set.lost, set.lost + set.modes.size()));
    return field;
}

}  // namespace seautils::propagation
