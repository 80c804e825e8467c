// Levels of source and noise, as requests say them.
#ifndef SEAUTILS_TOOLS_TL_LEVELS_HPP
#define SEAUTILS_TOOLS_TL_LEVELS_HPP

#include "tl_fields.hpp"
#include "tl_part.hpp"

#include "seautils/propagation/environment.hpp"
#include "seautils/propagation/noise.hpp"

#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

namespace pg = propagation;

class TlLevels {
public:
    /// @throws DataError  names the field
    void merge(const TlPart& p) {
        namespace f = field::levels;
        p.bounded(f::source_level_db, "source_level_db", -200, 400, source_level_db_);
        p.bounded(f::bandwidth_hz, "bandwidth_hz", 0.001, 1e7, bandwidth_hz_);
        if (p.has(f::noise_db)) {
            noise_db_ = 0;
            p.bounded(f::noise_db, "noise_db", -200, 400, *noise_db_);
        }
        p.bounded(f::wind_mps, "wind_mps", 0, 100, wind_mps_);
        if (p.has(f::beaufort)) {
            double beaufort = 0;
            p.bounded(f::beaufort, "beaufort", 0, 12, beaufort);
            wind_mps_ = pg::wind_of_beaufort_mps(beaufort);
        }
        p.bounded(f::shipping, "shipping", 0, 1, shipping_);
        fades_ = p.flag(f::noise_fades).value_or(fades_);
        p.bounded(f::array_gain_db, "array_gain_db", -200, 200, array_gain_db_);
        if (p.has(f::threshold_db)) {
            threshold_db = 0;
            p.bounded(f::threshold_db, "threshold_db", -200, 400, *threshold_db);
        }
        if (p.has(f::noise_depth_m) || p.has(f::noise_at_depth_db)) merge_table(p);
    }

    /// What they come to in a sea.
    pg::SonarLevels in(const pg::Environment& e) const {
        pg::SonarLevels levels;
        levels.source_level_db = source_level_db_;
        levels.bandwidth_hz = bandwidth_hz_;
        levels.noise_db =
            noise_db_ ? *noise_db_ : pg::ambient_noise_db(e.frequency_hz, shipping_, wind_mps_);
        levels.array_gain_db = array_gain_db_;
        if (fades_) levels.fades_below_m = critical_depth_of(e);
        levels.noise_depth_m = noise_depth_m_;
        levels.noise_at_depth_db = noise_at_depth_db_;
        return levels;
    }

    static std::optional<double> critical_depth_of(const pg::Environment& e) {
        return e.water.profile.empty() ? std::nullopt : pg::critical_depth_m(e.water.profile);
    }

    std::optional<double> threshold_db;

private:
    void merge_table(const TlPart& p) {
        namespace f = field::levels;
        noise_depth_m_ = p.list(f::noise_depth_m);
        noise_at_depth_db_ = p.list(f::noise_at_depth_db);
        p.same(noise_depth_m_.size(), "noise_depth_m", noise_at_depth_db_.size(),
               "noise_at_depth_db");
        for (std::size_t k = 0; k < noise_depth_m_.size(); ++k) {
            if (!(noise_at_depth_db_[k] >= -200 && noise_at_depth_db_[k] <= 400))
                throw DataError(fmt::format("{}noise_at_depth_db[{}] {} is outside -200 to 400",
                                            p.path, k, noise_at_depth_db_[k]));
            if (k > 0 && !(noise_depth_m_[k] > noise_depth_m_[k - 1]))
                throw DataError(
                    fmt::format("{}noise_depth_m[{}] {} is not more than the {} before "
                                "it",
                                p.path, k, noise_depth_m_[k], noise_depth_m_[k - 1]));
        }
    }

    double source_level_db_ = 0, bandwidth_hz_ = 1, wind_mps_ = 0, shipping_ = 0.5,
           array_gain_db_ = 0;
    std::optional<double> noise_db_;
    bool fades_ = false;
    std::vector<double> noise_depth_m_, noise_at_depth_db_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_LEVELS_HPP
