#include "seautils/sim/water.hpp"

#include <algorithm>
#include <cmath>

namespace seautils::sim {

namespace {

/// What a chance is asked about; the numbers are part of what a seed means.
enum Question : std::uint64_t { lost_anywhere = 1, lost_by_range = 2, frame_spoilt = 3 };

/// SplitMix64's finalizer: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

}  // namespace

std::uint64_t Chance::bits(std::initializer_list<std::uint64_t> words) const {
    std::uint64_t state = mixed(seed_);
    for (const std::uint64_t word : words) state = mixed(state ^ word);
    return state;
}

bool Chance::happens(double p, std::initializer_list<std::uint64_t> words) const {
    return static_cast<double>(bits(words) >> 11) * 0x1p-53 < p;
}

double Water::threshold_db(unsigned rate) const {
    return spec_.threshold_db.at(std::min<std::size_t>(rate, spec_.threshold_db.size() - 1));
}

Path Water::path(const Track& from, const Track& to, Time sent, unsigned rate) const {
    const Position source = from.at(sent);
    Path path{.arrives = sent};
    for (int k = 0; k < 6; ++k) {
        path.range_m = distance_m(source, to.at(path.arrives));
        path.arrives = sent + nanoseconds(path.range_m / spec_.sound_speed_mps);
    }
    const double later_m = distance_m(from.at(sent + second_ns), to.at(path.arrives + second_ns));
    path.closing_mps = path.range_m - later_m;
    path.tl_db = spec_.tl_db.empty() ? 20 * std::log10(std::max(path.range_m, 1.0))
                                     : spec_.tl_db.at(path.range_m);
    path.snr_db = spec_.source_level_db - path.tl_db - spec_.noise_db;
    path.audible = path.range_m <= spec_.max_range_m &&
                   (spec_.tl_db.empty() || path.snr_db >= threshold_db(rate));
    return path;
}

bool Water::is_lost(double range_m, std::uint64_t source, std::uint64_t packet,
                    std::uint64_t receiver) const {
    const double by_range = spec_.loss_by_range.empty() ? 0 : spec_.loss_by_range.at(range_m);
    return chance_.happens(spec_.loss, {lost_anywhere, source, packet, receiver}) ||
           chance_.happens(by_range, {lost_by_range, source, packet, receiver});
}

bool Water::is_spoilt(std::uint64_t source, std::uint64_t packet, std::uint64_t receiver,
                      std::uint64_t frame) const {
    return chance_.happens(spec_.bad_crc, {frame_spoilt, source, packet, receiver, frame});
}

}  // namespace seautils::sim
