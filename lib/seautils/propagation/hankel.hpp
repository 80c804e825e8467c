#ifndef SEAUTILS_PROPAGATION_HANKEL_HPP
#define SEAUTILS_PROPAGATION_HANKEL_HPP

#include <complex>

namespace seautils::propagation {

/// Hankel function of the first kind and order 0 over exp(ix), for 0 <= Im x, 0 <= Re x, x not 0: to
/// 1e-6 of itself. M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, 9.1.12-13, 9.2.7.
/// Check value: H(1) = 0.765197687 + 0.088256964 i.
std::complex<double> hankel_over_exp(const std::complex<double>& x);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_HANKEL_HPP
