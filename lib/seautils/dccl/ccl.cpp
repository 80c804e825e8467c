#include "seautils/dccl/ccl.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace seautils::dccl {

namespace {

constexpr std::pair<std::string_view, CclCodec> names[] = {
    {"_ccl_latloncompressed", CclCodec::latloncompressed},
    {"_ccl_fix_age", CclCodec::fix_age},
    {"_ccl_time_date", CclCodec::time_date},
    {"_ccl_heading", CclCodec::heading},
    {"_ccl_depth", CclCodec::depth},
    {"_ccl_velocity", CclCodec::velocity},
    {"_ccl_speed", CclCodec::speed},
    {"_ccl_watts", CclCodec::watts},
    {"_ccl_hires_altitude", CclCodec::hires_altitude},
    {"_ccl_salinity", CclCodec::salinity},
    {"_ccl_temperature", CclCodec::temperature},
    {"_ccl_sound_speed", CclCodec::sound_speed},
    {"_ccl_gfi_pitch_oil", CclCodec::gfi_pitch_oil},
};

void require_finite(double value) {
    if (!std::isfinite(value)) throw DataError(fmt::format("'{}' is not a finite number", value));
}

/// The low bits of an integer, or of the number without its fraction; any finite one will do.
std::uint32_t low_bits(double number, unsigned bits) {
    const double rest = std::fmod(std::trunc(number), 4294967296.0);
    const auto code = static_cast<std::uint32_t>(static_cast<std::int64_t>(rest));
    return bits >= 32 ? code : code & ((1U << bits) - 1);
}

double sign_extended(std::uint32_t code, unsigned bits) {
    const std::int64_t span = std::int64_t{1} << bits;
    const std::int64_t n = code & (span - 1);
    return static_cast<double>(n < span / 2 ? n : n - span);
}

double depth_code(double depth_m) {
    if (depth_m < 0) return 0;
    if (depth_m < 100) return (depth_m + .05) / 0.1;
    if (depth_m < 200) return (depth_m - 100 + .1) / 0.2 + 1000;
    if (depth_m < 1000) return (depth_m - 200 + .25) / 0.5 + 1500;
    if (depth_m < 6000) return depth_m - 1000 + .5 + 3100;
    return 8100;
}

double depth_m(std::uint32_t code) {
    const double n = code & 0x1FFF;
    if (n < 1000) return n * 0.1;
    if (n < 1500) return (n - 1000) * 0.2 + 100;
    if (n < 3100) return (n - 1500) * 0.5 + 200;
    return n <= 8100 ? n - 3100 + 1000 : 6000;
}

double rounded(double x) { return x > 0 ? x + 0.5 : x - 0.5; }

double speed_code(double speed, bool metres_per_second) {
    return rounded(std::clamp(metres_per_second ? speed * 30 : speed, -127.0, 127.0));
}

double altitude_code(double altitude_m) {
    const float cm = static_cast<float>(altitude_m) * 100.0F;  // may be infinite: cut below
    return std::clamp(static_cast<double>(cm), 0.0, 65535.0);
}

double salinity_code(double salinity) {
    return salinity < 20 ? 0 : std::min((salinity - 20) * 10, 255.0);
}

double temperature_code(double temperature_c) {
    return std::min((std::max(temperature_c, -4.0) + 4) * 6.4 + 0.5, 255.0);
}

/// What is encoded, before its fraction goes.
double exact_code(CclCodec codec, double value, bool metres_per_second) {
    switch (codec) {
        case CclCodec::latloncompressed:
            return rounded(value * 8388607 / 180);
        case CclCodec::fix_age:
            return value / 4;
        case CclCodec::heading:
            return value * 255 / 360 + 0.5;
        case CclCodec::depth:
            return depth_code(value);
        case CclCodec::velocity:
            return value * 25 + 0.5;
        case CclCodec::speed:
            return speed_code(value, metres_per_second);
        case CclCodec::watts:
            return std::clamp(value / 4, 0.0, 255.0);
        case CclCodec::hires_altitude:
            return altitude_code(value);
        case CclCodec::salinity:
            return salinity_code(value);
        case CclCodec::temperature:
            return temperature_code(value);
        case CclCodec::sound_speed:
            return (value - 1425) * 2;
        case CclCodec::time_date:
        case CclCodec::gfi_pitch_oil:
            break;
    }
    return 0;
}

double exact_value(CclCodec codec, std::uint32_t code, bool metres_per_second) {
    const double n = code & 0xFF;
    const double n_signed = sign_extended(code, 8);
    switch (codec) {
        case CclCodec::latloncompressed:
            return sign_extended(code, 24) * 180 / 8388607;
        case CclCodec::fix_age:
            return n * 4;
        case CclCodec::heading:
            return n * 360 / 255;
        case CclCodec::depth:
            return depth_m(code);
        case CclCodec::velocity:
            return n_signed / 25;
        case CclCodec::speed:
            return metres_per_second ? n_signed / 30 : n_signed * 20;
        case CclCodec::watts:
            return n * 4;
        case CclCodec::hires_altitude:
            return (code & 0xFFFF) / 100.0;
        case CclCodec::salinity:
            return n == 0 ? 0 : n / 10 + 20;
        case CclCodec::temperature:
            return n * 40 / 256 - 4;
        case CclCodec::sound_speed:
            return n / 2 + 1425;
        case CclCodec::time_date:
        case CclCodec::gfi_pitch_oil:
            break;
    }
    return 0;
}

CclRange faithful_range(CclCodec codec, unsigned bits, bool metres_per_second) {
    switch (codec) {
        case CclCodec::latloncompressed:
            return CclRange{-180, 180};
        case CclCodec::fix_age:
            return CclRange{0, 1023};
        case CclCodec::heading:
            return CclRange{0, 360};
        case CclCodec::depth:
            return CclRange{0, bits < 13 ? depth_m((1U << bits) - 1) : 6000};
        case CclCodec::velocity:
            return CclRange{-5.12, 5.08};
        case CclCodec::speed: {
            const double max = metres_per_second ? 4.24 : 127;
            return CclRange{-max, max};
        }
        case CclCodec::watts:
            return CclRange{0, 1023};
        case CclCodec::hires_altitude:
            return CclRange{0, 655.35};
        case CclCodec::salinity:
            return CclRange{20.1, 45.5};
        case CclCodec::temperature:
            return CclRange{-4, 35.84375};
        case CclCodec::sound_speed:
            return CclRange{1425, 1552.5};
        case CclCodec::time_date:
        case CclCodec::gfi_pitch_oil:
            break;
    }
    constexpr double any = std::numeric_limits<double>::infinity();
    return {-any, any};
}

std::uint32_t percent_code(float percent) {
    return low_bits(std::clamp(static_cast<double>(percent), 0.0, 100.0) * 31 / 100, 5);
}

float percent_value(std::uint32_t code) {
    return static_cast<float>(static_cast<double>(code & 31) * 100 / 31);
}

}  // namespace

std::optional<CclCodec> ccl_codec(std::string_view name) {
    for (const auto& [known, codec] : names) {
        if (name == known) return codec;
    }
    return std::nullopt;
}

unsigned ccl_bits(CclCodec codec, unsigned bit_size) {
    switch (codec) {
        case CclCodec::latloncompressed:
        case CclCodec::time_date:
            return 24;
        case CclCodec::hires_altitude:
        case CclCodec::gfi_pitch_oil:
            return 16;
        case CclCodec::depth:
            return bit_size;
        default:
            return 8;
    }
}

std::optional<CclRange> ccl_out_of_range(CclCodec codec, double value, unsigned bits,
                                         bool metres_per_second) {
    const CclRange range = faithful_range(codec, bits, metres_per_second);
    if (value >= range.min && value <= range.max) return std::nullopt;
    if (codec == CclCodec::salinity && value == 0) return std::nullopt;
    return range;
}

std::uint32_t ccl_encode(CclCodec codec, double value, unsigned bits, bool metres_per_second) {
    require_finite(value);
    return low_bits(exact_code(codec, value, metres_per_second), bits);
}

double ccl_decode(CclCodec codec, std::uint32_t code, bool metres_per_second) {
    const double value = exact_value(codec, code, metres_per_second);
    if (codec == CclCodec::latloncompressed) return value;
    return static_cast<double>(static_cast<float>(value));
}

std::uint32_t ccl_encode_time_date(std::uint64_t time_us) {
    using namespace std::chrono;
    constexpr std::uint64_t end_s = 253402300800;  // 10000-01-01
    const std::uint64_t time_s = time_us / 1'000'000;
    if (time_s >= end_s) throw DataError(fmt::format("{} us is after the year 9999", time_us));
    const auto second = static_cast<std::uint32_t>(time_s % 86400);
    const year_month_day date(sys_days(days(static_cast<std::int64_t>(time_s / 86400))));
    return second % 60 >> 2 | second / 60 % 60 << 4 | second / 3600 << 10 |
           static_cast<unsigned>(date.day()) << 15 | static_cast<unsigned>(date.month()) << 20;
}

std::uint64_t ccl_decode_time_date(std::uint32_t code, std::int64_t now_s) {
    using namespace std::chrono;
    const year_month_day today(floor<days>(sys_seconds(seconds(now_s))));
    const year_month_day date(today.year(), month(code >> 20 & 15), day(code >> 15 & 31));
    if (!date.ok() || date.year() < year(1970)) {
        throw DataError(fmt::format("month {} has no day {} in the year {}", code >> 20 & 15,
                                    code >> 15 & 31, static_cast<int>(today.year())));
    }
    const std::int64_t day_s = std::int64_t{sys_days(date).time_since_epoch().count()} * 86400;
    const std::uint32_t second = (code & 15) * 4 + (code >> 4 & 63) * 60 + (code >> 10 & 31) * 3600;
    return (static_cast<std::uint64_t>(day_s) + second) * 1'000'000;
}

std::uint32_t ccl_encode_gfi_pitch_oil(const GfiPitchOil& value) {
    for (const float x : {value.gfi_percent, value.pitch_deg, value.oil_percent}) {
        require_finite(static_cast<double>(x));
    }
    const double pitch = std::clamp(static_cast<double>(value.pitch_deg), -90.0, 90.0);
    return percent_code(value.gfi_percent) | percent_code(value.oil_percent) << 5 |
           low_bits(std::round(pitch * 63 / 180), 6) << 10;
}

GfiPitchOil ccl_decode_gfi_pitch_oil(std::uint32_t code) {
    return {percent_value(code), static_cast<float>(sign_extended(code >> 10, 6) * 180 / 63),
            percent_value(code >> 5)};
}

}  // namespace seautils::dccl
