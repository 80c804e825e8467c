#ifndef SEAUTILS_TOOLBOX_GREEN_HPP
#define SEAUTILS_TOOLBOX_GREEN_HPP

#include "seautils/toolbox/shd_file.hpp"

#include <complex>
#include <vector>

namespace seautils::toolbox {

/// The pressure that a Green's function over horizontal wavenumber (SCOOTER's .grn) means at ranges: the asymptotic Hankel
/// transform p(r) = -Σ G(k) √(k + iδ) e^{-i((k + iδ) r - π/4)} Δk / √(2πr), with δ = Δk, off which SCOOTER integrates.
/// @param green  of one source; its range_m are phase speeds
/// @return  [depth][range]; 0 at range 0
/// @throws DataError  fewer than two wavenumbers
std::vector<std::complex<float>> transform_green(const ShdFile& green,
                                                 const std::vector<double>& range_m);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_GREEN_HPP
