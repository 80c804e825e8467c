#include "seautils/propagation/hankel.hpp"

#include <cmath>
#include <numbers>

namespace seautils::propagation {

namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};
constexpr double pi = std::numbers::pi;

Complex by_powers(const Complex& x) {
    const Complex square = -x * x / 4.0;
    Complex term = 1, j = 1, y = 0;
    double harmonic = 0;
    for (int k = 1; k < 60; ++k) {
        term *= square / static_cast<double>(k * k);
        harmonic += 1.0 / k;
        j += term;
        y -= harmonic * term;
    }
    y = 2 / pi * ((std::log(x / 2.0) + std::numbers::egamma) * j + y);
    return (j + i * y) * std::exp(-i * x);
}

Complex times(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

Complex by_inverse_powers(const Complex& x) {
    const double size = x.real() * x.real() + x.imag() * x.imag();
    const Complex inverse = Complex(-x.imag(), -x.real()) / (8 * size);  // -i / 8x
    // The root in the right half plane; x is not far from the real axis, or well above it.
    const double length = std::sqrt(size), re = std::sqrt((length + x.real()) / 2);
    const Complex root = re > 0.1 ? Complex(re, x.imag() / (2 * re)) : std::sqrt(x);
    const double scale = std::sqrt(2 / pi) / length;
    Complex term = 1, sum = 1;
    const int terms = size > 1e4 ? 3 : 8;
    for (int k = 1; k <= terms; ++k) {
        const double odd = 2 * k - 1;
        term = times(term, inverse) * (odd * odd / k);
        sum += term;
    }
    // √(2/πx) exp(-iπ/4)
    const Complex quarter{std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2};
    return times(times(std::conj(root) * scale, quarter), sum);
}

}  // namespace

Complex hankel_over_exp(const Complex& x) {
    return std::abs(x) < 9 ? by_powers(x) : by_inverse_powers(x);
}

}  // namespace seautils::propagation
