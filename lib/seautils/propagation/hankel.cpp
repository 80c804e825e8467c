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

Complex by_inverse_powers(const Complex& x) {
    const Complex inverse = -i / (8.0 * x);
    Complex term = 1, sum = 1;
    for (int k = 1; k < 9; ++k) {
        const double odd = 2 * k - 1;
        term *= inverse * (odd * odd) / static_cast<double>(k);
        sum += term;
    }
    return std::sqrt(2.0 / (pi * x)) * std::exp(-i * (pi / 4)) * sum;
}

}  // namespace

Complex hankel_over_exp(const Complex& x) {
    return std::abs(x) < 9 ? by_powers(x) : by_inverse_powers(x);
}

}  // namespace seautils::propagation
