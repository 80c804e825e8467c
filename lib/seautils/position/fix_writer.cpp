#include "seautils/position/fix_writer.hpp"

#include "seautils/core/time.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <iterator>

namespace seautils::position {

namespace {

constexpr double metres_of_degree = 111'320;

int decimals_for(double resolution_m) {
    int decimals = 0;
    for (double step_m = metres_of_degree; step_m > resolution_m / 20; step_m /= 10) ++decimals;
    return decimals;
}

/// Thousandths as a decimal without needless zeros.
std::string thousandths(std::int64_t n) {
    std::string text = fmt::format("{}{}", n < 0 ? "-" : "", std::abs(n) / 1000);
    const auto part = std::abs(n) % 1000;
    if (part == 0) return text;
    text += fmt::format(".{:03}", part);
    while (text.back() == '0') text.pop_back();
    return text;
}

void put_varint(std::string& out, std::uint64_t n) {
    for (; n >= 128; n >>= 7) out += static_cast<char>(n | 128);
    out += static_cast<char>(n);
}

void put_number(std::string& out, unsigned field, std::uint64_t n) {
    if (n == 0) return;  // as protobuf writes what has no presence
    put_varint(out, field << 3);
    put_varint(out, n);
}

void put_double(std::string& out, unsigned field, double x) {
    put_varint(out, field << 3 | 1);
    const auto bits = std::bit_cast<std::uint64_t>(x);
    for (unsigned k = 0; k < 64; k += 8) out += static_cast<char>(bits >> k & 255);
}

void put_bytes(std::string& out, unsigned field, const std::string& bytes) {
    put_varint(out, field << 3 | 2);
    put_varint(out, bytes.size());
    out += bytes;
}

}  // namespace

FixWriter::FixWriter(Form form, const Grid& grid, std::optional<Frame> frame)
    : form_(form),
      grid_(grid),
      frame_(std::move(frame)),
      decimals_(decimals_for(static_cast<double>(grid.resolution_mm) / 1000)) {}

void FixWriter::header(std::string& out) const {
    if (form_ != Form::csv) return;
    out += frame_ ? "t,x,y,z,latitude_deg,longitude_deg\n" : "t,x,y,z\n";
}

void FixWriter::write(std::int64_t time_ms, const Cell& cell, std::string& out) const {
    form_ == Form::delimited ? binary(time_ms, cell, out) : text(time_ms, cell, out);
}

std::string FixWriter::decimal(std::int32_t cell, std::int64_t resolution_mm) const {
    return thousandths(cell * resolution_mm);
}

Geographic FixWriter::geographic(const Cell& cell) const {
    const Place place = place_of(grid_, cell);
    return frame_->reverse({place.x_m, place.y_m});
}

void FixWriter::text(std::int64_t time_ms, const Cell& cell, std::string& out) const {
    const std::string x = decimal(cell.x, grid_.resolution_mm);
    const std::string y = decimal(cell.y, grid_.resolution_mm);
    const std::string z = decimal(cell.z, grid_.resolution_z_mm);
    const bool csv = form_ == Form::csv;
    const auto to = std::back_inserter(out);
    if (csv)
        fmt::format_to(to, "{},{},{},{}", thousandths(time_ms), x, y, z);
    else
        fmt::format_to(to, R"({{"time":"{}","x_m":{},"y_m":{},"z_m":{})",
                       format_utc(time_ms * 1000), x, y, z);
    if (frame_) {
        const Geographic at = geographic(cell);
        fmt::format_to(to,
                       fmt::runtime(csv ? ",{:.{}f},{:.{}f}"
                                        : R"(,"latitude_deg":{:.{}f},"longitude_deg":{:.{}f})"),
                       at.latitude_deg, decimals_, at.longitude_deg, decimals_);
    }
    out += csv ? "\n" : "}\n";
}

void FixWriter::binary(std::int64_t time_ms, const Cell& cell, std::string& out) const {
    std::string time, fix;
    put_number(time, 1, static_cast<std::uint64_t>(time_ms / 1000));
    put_number(time, 2, static_cast<std::uint64_t>(time_ms % 1000) * 1'000'000);
    put_bytes(fix, 1, time);
    const Place place = place_of(grid_, cell);
    put_double(fix, 2, place.x_m);
    put_double(fix, 3, place.y_m);
    put_double(fix, 4, place.z_m);
    if (frame_) {
        const Geographic at = geographic(cell);
        put_double(fix, 5, at.latitude_deg);
        put_double(fix, 6, at.longitude_deg);
    }
    put_varint(out, fix.size());
    out += fix;
}

}  // namespace seautils::position
