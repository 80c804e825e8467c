#include "seautils/propagation/spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seautils::propagation {

namespace {

double intensity(const Arrival& a) {
    return a.amplitude * a.amplitude * std::pow(10, -0.1 * a.absorption_db);
}

double span_s(std::span<const Arrival> arrivals, double least) {
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (const Arrival& a : arrivals) {
        if (intensity(a) < least) continue;
        first = std::min(first, a.delay_s);
        last = std::max(last, a.delay_s);
    }
    return last - first;
}

}  // namespace

Spread spread_of(std::span<const Arrival> arrivals) {
    double sum = 0, moment = 0, peak = 0, first = std::numeric_limits<double>::infinity();
    for (const Arrival& a : arrivals) first = std::min(first, a.delay_s);
    for (const Arrival& a : arrivals) {
        const double i = intensity(a);
        sum += i;
        moment += i * (a.delay_s - first);
        peak = std::max(peak, i);
    }
    Spread s;
    s.mean_delay_s = moment / sum;
    double squares = 0;
    for (const Arrival& a : arrivals) {
        const double off = a.delay_s - first - s.mean_delay_s;
        squares += intensity(a) * off * off;
        s.within_20db += intensity(a) >= 0.01 * peak;
    }
    s.rms_delay_s = std::sqrt(squares / sum);
    s.peak_to_mean_db = 10 * std::log10(peak * static_cast<double>(arrivals.size()) / sum);
    s.span_10db_s = span_s(arrivals, 0.1 * peak);
    s.span_20db_s = span_s(arrivals, 0.01 * peak);
    return s;
}

}  // namespace seautils::propagation
