#include "seautils/toolbox/attenuation.hpp"

#include <numbers>

namespace seautils::toolbox {

double attenuation_db_per_wavelength(char unit, double x, double speed_mps, double frequency_hz) {
    constexpr double db_per_neper = 8.685889638065036;
    switch (unit) {
        case 'N':
            return x * db_per_neper * speed_mps / frequency_hz;
        case 'F':
            return x * speed_mps / 1000;
        case 'M':
            return x * speed_mps / frequency_hz;
        case 'Q':
            return x == 0 ? 0 : db_per_neper * std::numbers::pi / x;
        case 'L':
            return x * db_per_neper * 2 * std::numbers::pi;
        default:
            return x;
    }
}

}  // namespace seautils::toolbox
