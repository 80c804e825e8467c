#ifndef SEAUTILS_TOOLBOX_ARR_FILE_HPP
#define SEAUTILS_TOOLBOX_ARR_FILE_HPP

#include "seautils/propagation/field.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::toolbox {

/// Arrivals as the Acoustics Toolbox keeps them in a .arr file.
struct ArrFile {
    double frequency_hz = 0;
    std::vector<double> source_depth_m, receiver_depth_m, range_m;
    bool irregular = false;  ///< receivers are pairs of a depth and a range, as many of both
    /// [source][depth][range]; of pairs [source][range]
    std::vector<propagation::ReceiverArrivals> receivers;
};

enum class ArrForm : std::uint8_t {
    text,    ///< of run type A
    binary,  ///< of run type a: records of Fortran, of binary32 numbers
};

/// The file; absorption by the water is the imaginary part of each delay.
/// Layout: section 11 of the project's acoustics specification.
std::string write_arr(const ArrFile& file, ArrForm form);

/// Reads the text form, which does not say whether receivers are pairs. @throws DataError  says the line, and what is wrong there
ArrFile read_arr(std::string_view text, bool irregular = false);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_ARR_FILE_HPP
