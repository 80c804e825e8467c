// What becomes of a cast's text, line by line, whatever it is.
#ifndef SEAUTILS_TESTS_FUZZ_CASTS_HPP
#define SEAUTILS_TESTS_FUZZ_CASTS_HPP

#include "common.hpp"

#include "seautils/acoustics/columns.hpp"
#include "seautils/acoustics/extend.hpp"
#include "seautils/acoustics/window.hpp"

#include <cmath>

namespace fuzz {

namespace ac = seautils::acoustics;

/// A profile can be used: its depths grow, and its numbers are numbers.
inline void check_profile(const ac::Profile& p) {
    double last_m = -1;
    for (const ac::Level& level : p.levels) {
        require(level.depth_m > last_m && level.depth_m <= 12100, "depths grow");
        require(level.sound_speed_mps > 1000 && level.sound_speed_mps < 2200, "a speed");
        require(level.standard_deviation_mps >= 0 && level.standard_deviation_mps < 500,
                "a deviation");
        last_m = level.depth_m;
    }
}

/// Reads the lines of a text, and makes profiles of what they hold, with settings told by a byte.
template <class Reader>
void read_cast(Reader reader, std::string_view text, unsigned settings) {
    ac::Binning binning;
    binning.bin_m = (settings & 1) != 0 ? 0.5 : 10;
    binning.cleaning.least_speed_mps = (settings & 2) != 0 ? 0.1 : 0;
    const ac::Reduction reduction{.measured = (settings & 4) != 0, .salinity = 35};
    ac::Windowing windowing;
    windowing.split = static_cast<ac::Split>(settings / 8 % 3);
    windowing.every_ns = (settings & 64) != 0 ? 600'000'000'000 : windowing.window_ns;
    std::uint64_t scans = 0, used = 0;
    ac::Profile before;
    ac::Windows windows(windowing, [&](std::span<const ac::Sample> samples, ac::Direction) {
        ac::Profile p = ac::bin_samples(samples, binning);
        require(p.dropped[ac::Drop::none] + p.dropped.dropped() == samples.size(),
                "all are counted");
        used += samples.size();
        check_profile(p);
        const ac::Profile measured = p;
        before.levels.empty() ? ac::extend_isothermal(p, {.to_m = 5000})
                              : ac::extend_by(p, before, {.to_m = 5000, .blend_m = 50});
        check_profile(p);
        before = measured;
    });
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        ac::Reading reading;
        bool is_scan = false;
        accepted([&] { is_scan = reader.read(text.substr(0, end), reading); });
        text.remove_prefix(std::min(end + 1, text.size()));
        ac::Sample sample;
        std::string why;
        if (!is_scan || ac::reduce(reading, reduction, sample, &why) != ac::Drop::none) continue;
        require(sample.depth_m >= 0 && std::isfinite(sample.sound_speed_mps), "a sample");
        windows.add(sample);
        ++scans;
    }
    windows.end();
    require(windowing.every_ns < windowing.window_ns ? used >= scans : used == scans,
            "none is lost");
}

}  // namespace fuzz

#endif  // SEAUTILS_TESTS_FUZZ_CASTS_HPP
