#ifndef SEAUTILS_TOOLBOX_SHD_FILE_HPP
#define SEAUTILS_TOOLBOX_SHD_FILE_HPP

#include <complex>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::toolbox {

/// A field as the Acoustics Toolbox keeps it in a .shd file; one frequency, one bearing.
struct ShdFile {
    std::string title;
    double frequency_hz = 0;
    std::vector<float> source_depth_m, receiver_depth_m;
    std::vector<double> range_m;  ///< of a .grn file: phase speeds in m/s
    /// Receivers are pairs: receiver_depth_m[k] at range_m[k], as many of both, in any order; and one value for each. The
    /// plot type is `irregular` then, and each source has one record (Nrcvrs_per_range is 1 in read_shd_bin.m).
    bool irregular = false;
    /// [source][depth][range], of pairs [source][range], re 1 at 1 m, in the Toolbox's time convention; 0: no energy, or no value. Of an incoherent
    /// sum its magnitude alone means something.
    std::vector<std::complex<float>> pressure;
};

/// Since 2023 ranges (and what is 1 here) are binary64, before that they were binary32.
enum class ShdLayout : std::uint8_t { of_2022, of_2023 };

/// The file: little endian, records of equal length; the title is cut after 80 bytes.
/// Layout: section 11 of the project's acoustics specification; read_shd_bin.m of the Toolbox reads it.
/// @throws DataError  it would be larger than 2^31 bytes
std::string write_shd(const ShdFile& file, ShdLayout layout);

/// Reads either layout: whichever gives ranges in an order.
/// @throws DataError  it is cut, or holds what ShdFile cannot: says what, and the offset
ShdFile read_shd(std::string_view bytes);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_SHD_FILE_HPP
