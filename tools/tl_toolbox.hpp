// Results of tl-model in the files of the Acoustics Toolbox.
#ifndef SEAUTILS_TOOLS_TL_TOOLBOX_HPP
#define SEAUTILS_TOOLS_TL_TOOLBOX_HPP

#include "tl_answer.hpp"

#include "seautils/toolbox/arr_file.hpp"
#include "seautils/toolbox/shd_file.hpp"

#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace seautils::tools {

/// The losses of several sources, and nothing else different. @param results  one at least
inline toolbox::ShdFile shd_of(const std::vector<TlResult>& results) {
    const pg::Environment& e = results.front().task->environment;
    toolbox::ShdFile file;
    file.title = e.title;
    file.frequency_hz = e.frequency_hz;
    file.receiver_depth_m.assign(e.receivers.depth_m.begin(), e.receivers.depth_m.end());
    file.range_m = e.receivers.range_m;
    file.irregular = e.receivers.pairs;
    for (const TlResult& result : results) {
        file.source_depth_m.push_back(static_cast<float>(result.task->environment.source.depth_m));
        const bool has_phase = !result.field.pressure.empty();
        for (std::size_t k = 0; k < result.field.loss_db.size(); ++k) {
            const float loss_db = result.field.loss_db[k];
            if (!std::isfinite(loss_db))
                file.pressure.emplace_back(0.0F);
            else
                file.pressure.push_back(has_phase ? result.field.pressure[k]
                                                  : std::complex<float>(static_cast<float>(
                                                        std::pow(10, double{loss_db} / -20))));
        }
    }
    return file;
}

/// The arrivals of several sources. @param results  one at least
inline toolbox::ArrFile arr_of(const std::vector<TlResult>& results) {
    const TlTask& task = *results.front().task;
    const pg::Receivers& at = task.arrivals_at ? *task.arrivals_at : task.environment.receivers;
    toolbox::ArrFile file;
    file.frequency_hz = task.environment.frequency_hz;
    file.receiver_depth_m = at.depth_m;
    file.range_m = at.range_m;
    file.irregular = at.pairs;
    for (const TlResult& result : results) {
        file.source_depth_m.push_back(result.task->environment.source.depth_m);
        file.receivers.insert(file.receivers.end(), result.arrivals.begin(), result.arrivals.end());
    }
    return file;
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_TOOLBOX_HPP
