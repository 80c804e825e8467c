#ifndef SEAUTILS_TOOLBOX_OAST_FILE_HPP
#define SEAUTILS_TOOLBOX_OAST_FILE_HPP

#include "seautils/propagation/field.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::toolbox {

/// Depths from a first to a last one, equally spaced.
struct EvenDepths {
    double first_m = 0, last_m = 0;
    std::size_t count = 1;
};

/// What OAST of OASES is to be fed (User Guide 3.1, chapter on OAST: blocks I to VII, and the axes of
/// option T): transmission loss over range at each depth, on a complex contour with automatic samples.
/// Water is cut into layers of linear 1/c², each of which changes by no more than 5 m/s.
/// @throws DataError  the sea depends on range, or has what cannot be said there; what is it
std::string write_oast(const propagation::Environment& environment, const EvenDepths& depths);

/// A curve of a plot: y at first + k·step of x.
struct PlotCurve {
    double first = 0, step = 0;
    std::vector<double> y;
};

/// The first curves of the plots over range that OAST leaves, in their order: .plp says what they are, .plt has the
/// values, curve by curve, in Fortran's numbers (1.5E+01, 1.5D1, 0.45-001). Ranges are kilometres.
/// @throws DataError  a line of the first, or a value of the second, that is not as it should be; values that lack, or
///                    are left over
std::vector<PlotCurve> read_plots(std::string_view plp, std::string_view plt);

/// y between two values, at x; NaN below the first.
/// @throws DataError  x lies beyond the last
double value_at(const PlotCurve& curve, double x);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_OAST_FILE_HPP
