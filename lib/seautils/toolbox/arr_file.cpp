#include "seautils/toolbox/arr_file.hpp"

#include "seautils/core/error.hpp"
#include "seautils/toolbox/list_directed.hpp"
#include "seautils/toolbox/little_endian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numbers>

namespace seautils::toolbox {

namespace {

using propagation::Arrival;
using propagation::ReceiverArrivals;

/// Amplitude, phase, delay, its imaginary part, launch and arrival angle.
std::array<double, 6> numbers_of(const Arrival& a, double frequency_hz) {
    const double per_db_s = std::numbers::ln10 / 20 / (2 * std::numbers::pi * frequency_hz);
    return {a.amplitude,  a.phase_deg,  a.delay_s, -a.absorption_db * per_db_s + 0.0,
            a.launch_deg, a.arrival_deg};
}

class TextForm {
public:
    void tag() { out_ += "'2D'\n"; }
    void frequency(double x) { fmt::format_to(std::back_inserter(out_), "{}\n", x); }
    void axis(const std::vector<double>& x) {
        fmt::format_to(std::back_inserter(out_), "{}", x.size());
        for (const double value : x) fmt::format_to(std::back_inserter(out_), " {}", value);
        out_ += '\n';
    }
    void count(std::size_t n) { fmt::format_to(std::back_inserter(out_), "{}\n", n); }
    void arrival(const Arrival& a, double frequency_hz) {
        const auto x = numbers_of(a, frequency_hz);
        fmt::format_to(std::back_inserter(out_),
                       "{:.9g} {:.9g} {:.12g} {:.9g} {:.9g} {:.9g} {} {}\n", x[0], x[1], x[2], x[3],
                       x[4], x[5], a.surface_bounces, a.bottom_bounces);
    }
    std::string out_;
};

/// Each record has its length before and behind it.
class BinaryForm {
public:
    void tag() {
        record_ = "'2D'";
        end();
    }
    void frequency(double x) {
        real(x);
        end();
    }
    void axis(const std::vector<double>& x) {
        whole(x.size());
        for (const double value : x) real(value);
        end();
    }
    void count(std::size_t n) {
        whole(n);
        end();
    }
    void arrival(const Arrival& a, double frequency_hz) {
        for (const double x : numbers_of(a, frequency_hz)) real(x);
        real(a.surface_bounces);
        real(a.bottom_bounces);
        end();
    }
    std::string out_;

private:
    void real(double x) { append_little_endian(record_, static_cast<float>(x)); }
    void whole(std::size_t n) { append_little_endian(record_, static_cast<std::int32_t>(n)); }
    void end() {
        const auto bytes = static_cast<std::int32_t>(record_.size());
        append_little_endian(out_, bytes);
        out_ += record_;
        append_little_endian(out_, bytes);
        record_.clear();
    }
    std::string record_;
};

template <class Form>
std::string write(const ArrFile& file, Form form) {
    form.tag();
    form.frequency(file.frequency_hz);
    form.axis(file.source_depth_m);
    form.axis(file.receiver_depth_m);
    form.axis(file.range_m);
    const std::size_t n = (file.irregular ? 1 : file.receiver_depth_m.size()) * file.range_m.size();
    for (std::size_t first = 0; first < file.receivers.size(); first += n) {
        const auto block =
            std::span(file.receivers).subspan(first, std::min(n, file.receivers.size() - first));
        std::size_t most = 0;
        for (const ReceiverArrivals& r : block) most = std::max(most, r.arrivals.size());
        form.count(most);
        for (const ReceiverArrivals& r : block) {
            form.count(r.arrivals.size());
            for (const Arrival& a : r.arrivals) form.arrival(a, file.frequency_hz);
        }
    }
    return std::move(form.out_);
}

}  // namespace

namespace {

/// Reads values one by one, each of which must be there.
class ArrReader {
public:
    explicit ArrReader(std::string_view text) : file_(text) {}

    ArrFile read(bool irregular) {
        ArrFile f;
        std::string tag;
        file_.read([&](ListDirected::Read& r) { r.text(tag, "the tag"); });
        if (tag != "2D") throw DataError("line 1: the tag is not '2D'");
        file_.read([&](ListDirected::Read& r) { f.frequency_hz = real(r, "frequency"); });
        f.source_depth_m = axis("source depth");
        f.receiver_depth_m = axis("receiver depth");
        f.range_m = axis("range");
        f.irregular = irregular;
        if (irregular && f.receiver_depth_m.size() != f.range_m.size())
            throw DataError(fmt::format("{} receiver depths and {} ranges are no pairs",
                                        f.receiver_depth_m.size(), f.range_m.size()));
        for (std::size_t source = 0; source < f.source_depth_m.size(); ++source) {
            count("the largest number of arrivals");
            for (std::size_t k = 0; irregular && k < f.range_m.size(); ++k)
                f.receivers.push_back(
                    {f.receiver_depth_m[k], f.range_m[k], arrivals(f.frequency_hz)});
            for (std::size_t k = 0; !irregular && k < f.receiver_depth_m.size(); ++k)
                for (const double range_m : f.range_m)
                    f.receivers.push_back(
                        {f.receiver_depth_m[k], range_m, arrivals(f.frequency_hz)});
        }
        return f;
    }

private:
    double real(ListDirected::Read& r, std::string_view name) {
        double x = 0;
        if (!r.real(x, name)) file_.refuse(fmt::format("{} is not given", name));
        return x;
    }
    std::int64_t count(std::string_view name) {
        std::int64_t n = 0;
        file_.read([&](ListDirected::Read& r) { r.whole(n, name, 0, 1'000'000); });
        return n;
    }
    std::vector<double> axis(std::string_view name) {
        std::vector<double> all;
        file_.read([&](ListDirected::Read& r) {
            std::int64_t n = 0;
            r.whole(n, name, 1, 1'000'000);
            for (; n > 0; --n) all.push_back(real(r, name));
        });
        return all;
    }
    std::vector<Arrival> arrivals(double frequency_hz) {
        const double db_per_s = 2 * std::numbers::pi * frequency_hz * 20 / std::numbers::ln10;
        std::vector<Arrival> all;
        for (std::int64_t n = count("the number of arrivals"); n > 0; --n) {
            Arrival& a = all.emplace_back();
            file_.read([&](ListDirected::Read& r) {
                a.amplitude = real(r, "amplitude");
                a.phase_deg = real(r, "phase");
                a.delay_s = real(r, "delay");
                a.absorption_db = -real(r, "imaginary delay") * db_per_s + 0.0;
                a.launch_deg = real(r, "launch angle");
                a.arrival_deg = real(r, "arrival angle");
                a.surface_bounces = bounces(r);
                a.bottom_bounces = bounces(r);
            });
        }
        return all;
    }
    static std::uint32_t bounces(ListDirected::Read& r) {
        std::int64_t n = 0;
        r.whole(n, "bounces", 0, 1'000'000);
        return static_cast<std::uint32_t>(n);
    }

    ListDirected file_;
};

}  // namespace

ArrFile read_arr(std::string_view text, bool irregular) { return ArrReader(text).read(irregular); }

std::string write_arr(const ArrFile& file, ArrForm form) {
    return form == ArrForm::text ? write(file, TextForm()) : write(file, BinaryForm());
}

}  // namespace seautils::toolbox
