#ifndef SEAUTILS_DCCL_CCL_HPP
#define SEAUTILS_DCCL_CCL_HPP

#include <cstdint>
#include <optional>
#include <string_view>

namespace seautils::dccl {

/// The field codecs of the Compact Control Language, which came before DCCL. "Toward zero" is said
/// of the last step of encoding; a code that does not fit loses its upper bits, as the CCL's does.
///
/// | codec            | bits      | value to code, toward zero                  | code to value |
/// |------------------|-----------|---------------------------------------------|---------------|
/// | latloncompressed | 24 signed | degrees * 8388607 / 180, rounded            | degrees |
/// | fix_age          | 8         | s / 4                                       | multiple of 4 s |
/// | time_date        | 24        | by itself, below                            | |
/// | heading          | 8         | degrees * 255 / 360 + 0.5                   | degrees, to 360 |
/// | depth            | 13 and up | steps of 0.1 m to 100, 0.2 to 200,          | m |
/// |                  |           | 0.5 to 1000, 1 to 6000                      | |
/// | velocity         | 8 signed  | m/s * 25 + 0.5                              | m/s |
/// | speed            | 8 signed  | m/s * 30, or the number, rounded, +-127     | m/s, or 20 times the number |
/// | watts            | 8         | W / 4, 0 to 255                             | multiple of 4 W |
/// | hires_altitude   | 16        | m * 100 (in binary32), 0 to 65535           | m |
/// | salinity         | 8         | (S - 20) * 10, to 255; 0 below 20           | 0, or from 20.1 |
/// | temperature      | 8         | (C + 4) * 6.4 + 0.5, 0 to 255               | degrees Celsius |
/// | sound_speed      | 8         | (m/s - 1425) * 2                            | m/s |
/// | gfi_pitch_oil    | 16        | by itself, below                            | |
enum class CclCodec : std::uint8_t {
    latloncompressed,
    fix_age,
    time_date,
    heading,
    depth,
    velocity,
    speed,
    watts,
    hires_altitude,
    salinity,
    temperature,
    sound_speed,
    gfi_pitch_oil,
};

/// The codec of that name ("_ccl_depth"), or nothing.
std::optional<CclCodec> ccl_codec(std::string_view name);

/// Bits of its code. @param bit_size  the schema's; counts for depth only
unsigned ccl_bits(CclCodec codec, unsigned bit_size);

/// Values, ends included.
struct CclRange {
    double min, max;
};

/// The range that a value is outside of. Nothing if it comes back within a step of its code (a
/// velocity below 0: one and a half), or if it is a speed within ±127 in other units than metres
/// per second, which come back 20 times as large. Salinity 0 is never outside: it stands for none.
/// @param bits  as ccl_bits says
/// Not for time_date and gfi_pitch_oil, for which there is nothing.
std::optional<CclRange> ccl_out_of_range(CclCodec codec, double value, unsigned bits,
                                         bool metres_per_second);

/// @param value              of the codec's unit; a float field's value as a double
/// @param bits               as ccl_bits says
/// @param metres_per_second  speed: the thrust mode is 1
/// @return                   the code in its low bits, the others 0
/// @throws DataError         NaN or infinite
/// Not for time_date and gfi_pitch_oil, which give 0.
std::uint32_t ccl_encode(CclCodec codec, double value, unsigned bits, bool metres_per_second);

/// The inverse; of a float field it is exactly a binary32 number. Any code is decoded.
/// Not for time_date and gfi_pitch_oil, which give 0.
double ccl_decode(CclCodec codec, std::uint32_t code, bool metres_per_second);

/// Month, day, hour, minute and every fourth second of a time, UTC; the year is lost.
/// @param time_us    microseconds since 1970
/// @return           24 bits, from the lowest: second / 4 (4 bits), minute (6), hour (5), day (5),
///                   month (4)
/// @throws DataError after the year 9999
std::uint32_t ccl_encode_time_date(std::uint64_t time_us);

/// @param now_s  the receiver's clock, seconds since 1970, UTC: gives the year
/// @return       microseconds since 1970; hours above 23, minutes above 59 carry over
/// @throws DataError  a day that is not in the calendar of that year, or a year before 1970
std::uint64_t ccl_decode_time_date(std::uint32_t code, std::int64_t now_s);

struct GfiPitchOil {
    float gfi_percent, pitch_deg, oil_percent;
};

/// @return  16 bits, from the lowest: ground fault (5 bits, percent · 31 / 100 toward zero, cut to
///          0 to 100), oil (5, the same), pitch (6 signed, degrees · 63 / 180 rounded, cut to ±90;
///          +90 itself does not fit and comes back as −91.4)
/// @throws DataError  NaN or infinite
std::uint32_t ccl_encode_gfi_pitch_oil(const GfiPitchOil& value);
GfiPitchOil ccl_decode_gfi_pitch_oil(std::uint32_t code);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_CCL_HPP
