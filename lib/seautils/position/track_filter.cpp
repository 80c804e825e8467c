#include "seautils/position/track_filter.hpp"

namespace seautils::position {

FilterGains::FilterGains(std::int32_t drift_q16, std::int32_t noise_q16, std::int32_t spread_q16) {
    const auto square_q24 = [](std::int64_t v_q16) { return v_q16 * v_q16 >> 8; };
    const std::int64_t drift = square_q24(drift_q16), noise = std::int64_t{noise_q16} << 8;
    std::int64_t pp = noise, pv = noise, vv = 2 * noise + square_q24(spread_q16);  // Q24
    for (std::size_t k = 0; k < steps; ++k) {
        pp += 2 * pv + vv + drift / 3;
        pv += vv + drift / 2;
        vv += drift;
        const std::int64_t s = pp + noise;
        const std::int64_t gain_p = (pp << 20) / s, gain_v = (pv << 20) / s;  // Q20
        position[k] = static_cast<std::int32_t>(gain_p >> 4);
        velocity[k] = static_cast<std::int32_t>(gain_v >> 4);
        innovation[k] = static_cast<std::int32_t>(clamp(s >> 8, 1, INT32_MAX));
        vv -= gain_v * pv >> 20;
        pv -= gain_p * pv >> 20;
        pp -= gain_p * pp >> 20;
    }
}

}  // namespace seautils::position
