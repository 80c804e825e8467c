#include "seautils/acoustics/profile.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace seautils::acoustics {

namespace {

/// A mean that forgets what is not available.
class Mean {
public:
    void add(double x) {
        if (std::isnan(x)) return;
        ++count_;
        mean_ += (x - mean_) / static_cast<double>(count_);
    }
    double value() const { return count_ > 0 ? mean_ : not_available; }

private:
    std::uint64_t count_ = 0;
    double mean_ = 0;
};

/// The samples of one bin. Source of the deviation: B. P. Welford, Technometrics 4, 419-420 (1962).
class Bin {
public:
    void add(const Sample& s) {
        ++count_;
        depth_.add(s.depth_m);
        temperature_.add(s.temperature_c);
        salinity_.add(s.salinity);
        const double off = s.sound_speed_mps - mean_;
        mean_ += off / static_cast<double>(count_);
        squares_ += off * (s.sound_speed_mps - mean_);
        extrapolated_ = extrapolated_ || s.extrapolated;
    }
    Level level() const {
        Level level;
        level.depth_m = depth_.value();
        level.sound_speed_mps = mean_;
        if (count_ > 1)
            level.standard_deviation_mps = std::sqrt(squares_ / static_cast<double>(count_ - 1));
        level.temperature_c = temperature_.value();
        level.salinity = salinity_.value();
        level.count = count_;
        level.extrapolated = extrapolated_;
        return level;
    }

private:
    std::uint64_t count_ = 0;
    Mean depth_, temperature_, salinity_;
    double mean_ = 0, squares_ = 0;
    bool extrapolated_ = false;
};

/// Bins in the order of their depth. Neighbours in time mostly are so in depth: the last one used is
/// looked at first.
class Bins {
public:
    explicit Bins(double bin_m) : bin_m_(bin_m) {}

    void add(const Sample& s) {
        const auto index = static_cast<std::int64_t>(std::floor(s.depth_m / bin_m_ + 0.5));
        if (last_ == nullptr || index != index_) {
            last_ = &bins_[index];
            index_ = index;
            if (bins_.size() > Binning::most_levels)
                throw DataError(fmt::format("more than {} bins of {} m hold something (--bin)",
                                            Binning::most_levels, bin_m_));
        }
        last_->add(s);
    }
    std::vector<Level> levels() const {
        std::vector<Level> all;
        for (const auto& entry : bins_) all.push_back(entry.second.level());
        return all;
    }

private:
    double bin_m_;
    std::map<std::int64_t, Bin> bins_;
    Bin* last_ = nullptr;
    std::int64_t index_ = 0;
};

/// What one sample says of the profile as a whole.
void note(const Sample& s, Profile& profile, std::uint64_t& measured) {
    if (s.time_ns != no_time) {
        if (profile.start_ns == no_time || s.time_ns < profile.start_ns)
            profile.start_ns = s.time_ns;
        profile.end_ns = std::max(profile.end_ns, s.time_ns);
    }
    measured += s.measured;
    profile.latitude_assumed = profile.latitude_assumed || s.latitude_assumed;
    profile.salinity_assumed = profile.salinity_assumed || s.salinity_assumed;
}

}  // namespace

Profile bin_samples(std::span<const Sample> samples, const Binning& how, std::vector<Drop>* why) {
    const std::vector<Drop> drop = clean(samples, how.cleaning);
    Profile profile;
    Bins bins(how.bin_m);
    std::uint64_t measured = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        ++profile.dropped[drop[k]];
        if (drop[k] != Drop::none) continue;
        bins.add(samples[k]);
        note(samples[k], profile, measured);
    }
    const std::uint64_t used = profile.dropped[Drop::none];
    profile.mixed = measured > 0 && measured < used;
    if (measured < used) profile.formula = how.formula;
    profile.levels = bins.levels();
    if (!profile.levels.empty()) {
        profile.measured_from_m = profile.levels.front().depth_m;
        profile.measured_to_m = profile.levels.back().depth_m;
    }
    if (why != nullptr) *why = drop;
    return profile;
}

double speed_at_mps(const Profile& profile, double depth_m) {
    const auto& levels = profile.levels;
    const auto below =
        std::lower_bound(levels.begin(), levels.end(), depth_m,
                         [](const Level& level, double depth) { return level.depth_m < depth; });
    if (below == levels.begin()) return below->sound_speed_mps;
    if (below == levels.end()) return levels.back().sound_speed_mps;
    const Level &a = *(below - 1), &b = *below;
    const double part = (depth_m - a.depth_m) / (b.depth_m - a.depth_m);
    return a.sound_speed_mps + part * (b.sound_speed_mps - a.sound_speed_mps);
}

}  // namespace seautils::acoustics
