#include "seautils/propagation/mode_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seautils::propagation {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

/// Roots of the lossless problem between two values of ξ, and how many lie above each.
struct Bracket {
    double low, high;
    std::size_t above_low, above_high;
    std::size_t roots() const { return above_low - above_high; }
    double middle() const { return (low + high) / 2; }
    double width() const { return high - low; }
};

std::vector<std::size_t> count(const Mesh& mesh, const std::vector<double>& xi) {
    std::vector<std::size_t> counts(xi.size());
    for (std::size_t k = 0; k < xi.size(); k += count_lanes) {
        std::array<double, count_lanes> x;
        for (std::size_t l = 0; l < count_lanes; ++l) x[l] = xi[std::min(k + l, xi.size() - 1)];
        const auto n = roots_above(mesh, x);
        for (std::size_t l = 0; l < count_lanes && k + l < xi.size(); ++l) counts[k + l] = n[l];
    }
    return counts;
}

/// Brackets evenly spaced in the vertical wavenumber, as modes nearly are.
std::vector<Bracket> first_brackets(const Mesh& mesh, double low) {
    const double most =
        std::max(*std::max_element(mesh.k2.begin(), mesh.k2.end()), mesh.guide.bottom.most_k2());
    const double high = most + 1e-9 * std::abs(most);
    const std::size_t total = count_modes(mesh, low), n = std::max<std::size_t>(8, total * 3 / 2);
    std::vector<double> xi;
    for (std::size_t k = 0; k <= n; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(n);
        xi.push_back(high - (high - low) * part * part);
    }
    const std::vector<std::size_t> above = count(mesh, xi);
    std::vector<Bracket> brackets;
    for (std::size_t k = 1; k <= n; ++k)
        if (above[k] > above[k - 1]) brackets.push_back({xi[k], xi[k - 1], above[k], above[k - 1]});
    return brackets;
}

/// Halves the brackets that are marked; empty halves are dropped.
std::vector<Bracket> halved(const Mesh& mesh, const std::vector<Bracket>& brackets,
                            const std::vector<bool>& marked) {
    std::vector<double> xi;
    for (std::size_t k = 0; k < brackets.size(); ++k)
        if (marked[k]) xi.push_back(brackets[k].middle());
    const std::vector<std::size_t> above = count(mesh, xi);
    std::vector<Bracket> result;
    std::size_t next = 0;
    for (std::size_t k = 0; k < brackets.size(); ++k) {
        const Bracket& b = brackets[k];
        if (!marked[k]) {
            result.push_back(b);
            continue;
        }
        // Rounding may make a count run backwards: keep it between those of the ends.
        const std::size_t n = std::clamp(above[next++], b.above_high, b.above_low);
        if (n > b.above_high) result.push_back({b.middle(), b.high, n, b.above_high});
        if (b.above_low > n) result.push_back({b.low, b.middle(), b.above_low, n});
    }
    return result;
}

/// Several roots in one bracket, or one that is wide against what lies between it and its neighbours.
std::vector<bool> unresolved(const std::vector<Bracket>& brackets) {
    std::vector<bool> marked(brackets.size());
    for (std::size_t k = 0; k < brackets.size(); ++k) {
        double between = brackets[k].roots() > 1 ? 0 : 1e300;
        if (k > 0) between = std::min(between, brackets[k - 1].middle() - brackets[k].middle());
        if (k + 1 < brackets.size())
            between = std::min(between, brackets[k].middle() - brackets[k + 1].middle());
        marked[k] = brackets[k].width() > between / 8;
    }
    return marked;
}

std::vector<Bracket> isolated(const Mesh& mesh, double low) {
    std::vector<Bracket> brackets = first_brackets(mesh, low);
    for (int k = 0; k < 40; ++k) {
        const std::vector<bool> marked = unresolved(brackets);
        if (std::find(marked.begin(), marked.end(), true) == marked.end()) break;
        brackets = halved(mesh, brackets, marked);
    }
    return brackets;
}

/// Where to look for each mode in the complex plane.
std::vector<Complex> starts(const Mesh& mesh, const std::vector<Bracket>& brackets) {
    std::vector<Complex> xi;
    const std::size_t n = brackets.size();
    const Waveguide& guide = mesh.guide;
    for (std::size_t k = 0; k < n; ++k) {
        const double at = brackets[k].middle();
        const std::size_t before = k > 0 ? k - 1 : k, after = k + 1 < n ? k + 1 : k;
        double spacing = -brackets[k].width();
        if (after > before)
            spacing = (brackets[after].middle() - brackets[before].middle()) /
                      static_cast<double>(after - before);
        const Complex excess = guide.surface.excess_phase(at, mesh.k2.front()) +
                               guide.bottom.excess_phase(at, mesh.k2.back());
        const double loss = mesh.k2_loss[mesh.k2.size() / 2];
        const Complex shift = excess / (2 * pi) * spacing;
        for (std::size_t r = 0; r < brackets[k].roots(); ++r)
            xi.push_back(at - shift + Complex(0, loss));
    }
    return xi;
}

/// Inverse iteration of a few modes at once, until each moves by less than a part of itself.
class Polisher {
public:
    Polisher(const Waveguide& guide, std::size_t steps) : mesh_(guide, steps), rows_(mesh_) {}
    const Mesh& mesh() const noexcept { return mesh_; }

    /// @param moved  less than this, relative to `scale`, counts as found
    void polish(TwistedRows::Xis& xi, double scale, double moved, int most) {
        for (int k = 0; k < most; ++k) {
            rows_.factor(xi);
            double largest = 0;
            for (std::size_t l = 0; l < xi.size(); ++l) {
                const TwistedRows::Shape s = rows_.shape(l, nullptr);
                const Complex step = s.residual / s.slope;
                if (!std::isfinite(std::abs(step))) continue;
                xi[l] -= step;
                largest = std::max(largest, std::abs(step));
            }
            if (largest < moved * scale) return;
        }
    }
    /// Shapes at the last values, and one more step of them.
    void shapes(TwistedRows::Xis& xi, std::array<std::vector<Complex>, polish_lanes>& u) {
        rows_.factor(xi);
        for (std::size_t l = 0; l < xi.size(); ++l) {
            const TwistedRows::Shape s = rows_.shape(l, &u[l]);
            const Complex norm = std::sqrt(-s.slope / mesh_.step_m);
            for (Complex& value : u[l]) value /= norm;
            xi[l] -= s.residual / s.slope;
        }
    }

private:
    Mesh mesh_;
    TwistedRows rows_;
};

TwistedRows::Xis lanes_of(const std::vector<Complex>& xi, std::size_t from) {
    TwistedRows::Xis lanes;
    for (std::size_t l = 0; l < polish_lanes; ++l) lanes[l] = xi[std::min(from + l, xi.size() - 1)];
    return lanes;
}

/// Drops what is none (grows with range, not finite) and what was found before.
void drop_doubtful(std::vector<Complex>& xi, double scale) {
    const auto is_none = [&](const Complex& x) {
        return !std::isfinite(std::abs(x)) || x.imag() < -1e-9 * scale;
    };
    xi.erase(std::remove_if(xi.begin(), xi.end(), is_none), xi.end());
    std::sort(xi.begin(), xi.end(),
              [](const Complex& a, const Complex& b) { return a.real() > b.real(); });
    const auto same = [&](const Complex& a, const Complex& b) {
        return std::abs(a - b) < 1e-10 * scale;
    };
    xi.erase(std::unique(xi.begin(), xi.end(), same), xi.end());
}

/// Six nodes about a depth, and what each counts there.
struct Interpolation {
    std::size_t first;
    std::array<double, 6> weights;
};

Interpolation interpolation(const Mesh& mesh, double depth_m) {
    const std::size_t n = mesh.k2.size();
    const double x = (depth_m - mesh.guide.column.surface_m()) / mesh.step_m;
    const double start = std::clamp(std::floor(x) - 2, 0.0, static_cast<double>(n - 6));
    Interpolation i{static_cast<std::size_t>(start), {}};
    for (int a = 0; a < 6; ++a) {
        double weight = 1;
        for (int b = 0; b < 6; ++b)
            if (a != b) weight *= (x - start - b) / (a - b);
        i.weights[static_cast<std::size_t>(a)] = weight;
    }
    return i;
}

}  // namespace

namespace {

/// Modes of layers by themselves lie as close as they like to others, and no estimate tells them apart: losses grow from
/// nothing in steps, and each mode is followed.
std::vector<Complex> followed(const Waveguide& guide, double least_xi, std::size_t steps) {
    constexpr int stages = 12;
    std::vector<Complex> xi, before;
    for (int stage = 0; stage < stages; ++stage) {
        const Edge bottom = guide.bottom.losing(static_cast<double>(stage) / stages);
        const Waveguide now{guide.column, guide.surface, bottom, guide.omega,
                            guide.absorption_np_per_m};
        Polisher polisher(now, steps);
        const Mesh& mesh = polisher.mesh();
        if (stage == 0) before = xi = starts(mesh, isolated(mesh, least_xi));
        const double scale = *std::max_element(mesh.k2.begin(), mesh.k2.end());
        for (std::size_t k = 0; k < xi.size(); k += polish_lanes) {
            TwistedRows::Xis lanes = lanes_of(xi, k), ahead = lanes, last = lanes_of(before, k);
            for (std::size_t l = 0; stage > 1 && l < polish_lanes; ++l)
                ahead[l] += lanes[l] - last[l];
            polisher.polish(ahead, scale, 1e-9, 12);
            for (std::size_t l = 0; l < polish_lanes && k + l < xi.size(); ++l) {
                before[k + l] = lanes[l];
                xi[k + l] = ahead[l];
            }
        }
    }
    for (std::size_t k = 0; k < xi.size(); ++k) xi[k] += xi[k] - before[k];
    return xi;
}

}  // namespace

std::size_t count_modes(const Mesh& mesh, double least_xi) { return count(mesh, {least_xi})[0]; }

ModeSet find_modes(const Waveguide& guide, double least_xi, std::size_t steps,
                   const std::vector<double>& depth_m) {
    const bool layered = guide.bottom.slices() > 0;
    // Modes of layers do not move between meshes as their neighbours do: no mode may move far.
    if (layered) steps *= 2;
    Polisher coarse(guide, steps), fine(guide, steps * 3 / 2);
    const double scale = *std::max_element(coarse.mesh().k2.begin(), coarse.mesh().k2.end());
    const double ratio = static_cast<double>(steps * 3 / 2) / static_cast<double>(steps);
    const double extrapolated = 1 / (ratio * ratio * ratio * ratio - 1);
    std::vector<Complex> xi = layered ? followed(guide, least_xi, steps)
                                      : starts(coarse.mesh(), isolated(coarse.mesh(), least_xi));
    const std::size_t sought = xi.size();
    for (std::size_t k = 0; k < xi.size(); k += polish_lanes) {
        TwistedRows::Xis lanes = lanes_of(xi, k);
        coarse.polish(lanes, scale, 1e-6, 12);
        std::copy_n(lanes.begin(), std::min(polish_lanes, xi.size() - k),
                    xi.begin() + static_cast<std::ptrdiff_t>(k));
    }
    drop_doubtful(xi, scale);
    ModeSet set;
    set.lost = sought - xi.size();
    std::vector<Interpolation> at;
    for (const double z : depth_m) at.push_back(interpolation(fine.mesh(), z));
    std::array<std::vector<Complex>, polish_lanes> u;
    // Between the meshes steep modes move by more than lies between them, and all in the same way.
    Complex shift = 0;
    for (std::size_t k = 0; k < xi.size(); k += polish_lanes) {
        TwistedRows::Xis lanes = lanes_of(xi, k);
        for (Complex& lane : lanes) lane += shift;
        fine.polish(lanes, scale, 1e-6, 3);
        fine.shapes(lanes, u);
        for (std::size_t l = 0; l < polish_lanes && k + l < xi.size(); ++l) {
            Mode mode;
            mode.correction = (lanes[l] - xi[k + l]) * extrapolated;
            mode.xi = lanes[l] + mode.correction;
            if (!std::isfinite(std::abs(mode.xi))) continue;
            if (!layered) shift = lanes[l] - xi[k + l];
            for (const Interpolation& i : at) {
                Complex sum = 0;
                for (std::size_t a = 0; a < 6; ++a) sum += i.weights[a] * u[l][i.first + a];
                mode.values.push_back(sum);
            }
            set.modes.push_back(std::move(mode));
        }
    }
    return set;
}

}  // namespace seautils::propagation
