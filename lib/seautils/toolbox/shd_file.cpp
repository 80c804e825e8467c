#include "seautils/toolbox/shd_file.hpp"

#include "seautils/core/error.hpp"
#include "seautils/toolbox/little_endian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace seautils::toolbox {

namespace {

constexpr std::size_t title_bytes = 80, kind_bytes = 10, head_records = 10;
constexpr std::size_t most_bytes = std::size_t{1} << 31;

/// Records of so many bytes, one after another.
class Records {
public:
    explicit Records(std::size_t bytes) : bytes_(bytes) {}

    /// Fills up the record that was begun.
    void end() { out_.resize((out_.size() + bytes_ - 1) / bytes_ * bytes_, '\0'); }
    void text(std::string_view text, std::size_t bytes) {
        out_ += text.substr(0, bytes);
        out_.append(bytes - std::min(bytes, text.size()), ' ');
    }
    template <class T>
    void number(T x) {
        append_little_endian(out_, x);
    }
    template <class T>
    void one(T x) {
        number(x);
        end();
    }
    std::string take() { return std::move(out_); }

private:
    std::size_t bytes_;
    std::string out_;
};

/// What is in a file's bytes, none of which is trusted.
class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    ShdFile read() {
        if (bytes_.size() < 4) refuse("is cut at byte 0");
        const std::int64_t words = little_endian<std::int32_t>(bytes_, 0);
        if (words < 41 || words > (1 << 28))
            refuse(fmt::format("has records of {} words, which is outside 41 to 268435456", words));
        record_ = static_cast<std::size_t>(words) * 4;
        need(0, head_records * record_);
        ShdFile file;
        file.title = bytes_.substr(4, title_bytes);
        file.title.resize(file.title.find_last_not_of(std::string_view(" \0", 2)) + 1);
        const std::size_t counts = 2 * record_;
        for (std::size_t k = 0; k < 4; ++k)
            if (count(counts + 4 * k) != 1)
                refuse("holds more than one frequency, bearing or source position");
        const std::size_t sources = count(counts + 16), depths = count(counts + 20),
                          ranges = count(counts + 24);
        file.frequency_hz = little_endian<double>(bytes_, 3 * record_);
        file.source_depth_m = floats(7, sources);
        file.receiver_depth_m = floats(8, depths);
        file.irregular = bytes_.substr(record_, kind_bytes).starts_with("irregular");
        if (file.irregular && depths != ranges)
            refuse(fmt::format("is irregular, with {} depths and {} ranges", depths, ranges));
        file.range_m = file.irregular ? ranges_of_pairs(ranges) : ranges_of(ranges);
        pressure(file);
        return file;
    }

private:
    [[noreturn]] static void refuse(const std::string& what) { throw DataError("it " + what); }

    void need(std::size_t at, std::size_t bytes) const {
        if (at > bytes_.size() || bytes > bytes_.size() - at)
            refuse(fmt::format("is cut at byte {}", bytes_.size()));
    }

    std::size_t count(std::size_t at) const {
        const std::int32_t n = little_endian<std::int32_t>(bytes_, at);
        if (n < 1 || n > 100'000'000)
            refuse(
                fmt::format("has a count of {}, which is outside 1 to 100000000 (byte {})", n, at));
        return static_cast<std::size_t>(n);
    }

    std::vector<float> floats(std::size_t record, std::size_t n) const {
        if (4 * n > record_)
            refuse(fmt::format("has {} depths in a record of {} bytes", n, record_));
        std::vector<float> all(n);
        for (std::size_t k = 0; k < n; ++k)
            all[k] = little_endian<float>(bytes_, record * record_ + 4 * k);
        return all;
    }

    std::vector<double> ranges_of(std::size_t n) const {
        std::vector<double> all(n);
        if (8 * n > record_)
            refuse(fmt::format("has {} ranges in a record of {} bytes", n, record_));
        for (std::size_t k = 0; k < n; ++k)
            all[k] = little_endian<double>(bytes_, 9 * record_ + 8 * k);
        if (is_axis(all)) return all;
        for (std::size_t k = 0; k < n; ++k)
            all[k] = double{little_endian<float>(bytes_, 9 * record_ + 4 * k)};
        if (!is_axis(all)) refuse("has ranges in no order");
        return all;
    }

    /// In no order: binary64 where the second half of their bytes holds something.
    std::vector<double> ranges_of_pairs(std::size_t n) const {
        if (8 * n > record_)
            refuse(fmt::format("has {} ranges in a record of {} bytes", n, record_));
        const std::string_view half = bytes_.substr(9 * record_ + 4 * n, 4 * n);
        const bool is_wide = half.find_first_not_of('\0') != half.npos;
        std::vector<double> all(n);
        for (std::size_t k = 0; k < n; ++k)
            all[k] = is_wide ? little_endian<double>(bytes_, 9 * record_ + 8 * k)
                             : double{little_endian<float>(bytes_, 9 * record_ + 4 * k)};
        for (const double r : all)
            if (!(std::fabs(r) < 1e10)) refuse("has ranges that are none");
        return all;
    }

    /// Whether numbers are such as ranges (or phase speeds) are, and grow or fall.
    static bool is_axis(const std::vector<double>& x) {
        const bool falls = x.size() > 1 && x[1] < x[0];
        for (std::size_t k = 0; k < x.size(); ++k) {
            const bool is_sane = std::fabs(x[k]) < 1e10 && (x[k] == 0 || std::fabs(x[k]) > 1e-9);
            if (!is_sane) return false;
            if (k > 0 && (falls ? x[k] >= x[k - 1] : x[k] <= x[k - 1])) return false;
        }
        return true;
    }

    void pressure(ShdFile& file) const {
        const std::size_t rows =
            file.source_depth_m.size() * (file.irregular ? 1 : file.receiver_depth_m.size());
        const std::size_t n = file.range_m.size();
        need(head_records * record_, (rows - 1) * record_ + 8 * n);
        file.pressure.resize(rows * n);
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t at = (head_records + row) * record_;
            for (std::size_t k = 0; k < n; ++k)
                file.pressure[row * n + k] = {little_endian<float>(bytes_, at + 8 * k),
                                              little_endian<float>(bytes_, at + 8 * k + 4)};
        }
    }

    std::string_view bytes_;
    std::size_t record_ = 0;
};

}  // namespace

std::string write_shd(const ShdFile& f, ShdLayout layout) {
    const std::size_t sources = f.source_depth_m.size(), depths = f.receiver_depth_m.size(),
                      ranges = f.range_m.size();
    const std::size_t words = std::max({std::size_t{41}, sources, depths, 2 * ranges});
    if (words * 4 > most_bytes / (head_records + sources * (f.irregular ? 1 : depths)))
        throw DataError(
            fmt::format("a .shd file of {} sources, {} depths and {} ranges is too large", sources,
                        depths, ranges));
    const bool is_new = layout == ShdLayout::of_2023;
    Records out(words * 4);
    const auto axis = [&](double x) { is_new ? out.number(x) : out.number(static_cast<float>(x)); };
    const auto whole = [&](std::size_t n) { out.number(static_cast<std::int32_t>(n)); };
    whole(words);
    out.text(f.title, title_bytes);
    out.end();
    out.text(f.irregular ? "irregular" : "rectilin", kind_bytes);
    out.end();
    for (const std::size_t n :
         {std::size_t{1}, std::size_t{1}, std::size_t{1}, std::size_t{1}, sources, depths, ranges})
        whole(n);
    out.number(f.frequency_hz);
    out.one(0.0);  // attenuation that stabilises SCOOTER
    out.one(f.frequency_hz);
    for (int k = 0; k < 3; ++k) {  // bearing, and the source's place
        axis(0);
        out.end();
    }
    for (const float z : f.source_depth_m) out.number(z);
    out.end();
    for (const float z : f.receiver_depth_m) out.number(z);
    out.end();
    for (const double r : f.range_m) axis(r);
    out.end();
    for (std::size_t k = 0; k < f.pressure.size(); ++k) {
        out.number(f.pressure[k].real());
        out.number(f.pressure[k].imag());
        if ((k + 1) % ranges == 0) out.end();
    }
    return out.take();
}

ShdFile read_shd(std::string_view bytes) { return Reader(bytes).read(); }

}  // namespace seautils::toolbox
