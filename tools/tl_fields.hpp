// Fields of the messages of schemas/seautils/acoustics.proto, by which tl-model finds them.
#ifndef SEAUTILS_TOOLS_TL_FIELDS_HPP
#define SEAUTILS_TOOLS_TL_FIELDS_HPP

#include <cstdint>

namespace seautils::tools {

/// Fields of the messages, in the order of their declaration; of a profile, those of SspSchema.
namespace field {

namespace mesh {
enum : std::uint32_t { range_m, depth_m, sound_speed_mps };
}
namespace absorption {
enum : std::uint32_t { model, temperature_c, salinity, ph, depth_m, db_per_km };
}
namespace boundary {
enum : std::uint32_t {
    kind,
    sound_speed_mps,
    shear_speed_mps,
    density_gcm3,
    attenuation,
    shear_attenuation,
    roughness_m,
    grain_phi,
    grazing_deg,
    magnitude,
    phase_deg,
    layer_thickness_m,
    layer_speed_mps,
    layer_bottom_speed_mps,
    layer_density_gcm3,
    layer_attenuation,
};
}
namespace line {
enum : std::uint32_t { curved, range_m, depth_m };
}
namespace source {
enum : std::uint32_t { depth_m, pattern_deg, pattern_db, line };
}
namespace span {
enum : std::uint32_t { start_m, stop_m, count };
}
namespace receivers {
enum : std::uint32_t { depth_m, range_m, depths, ranges, pairs };
}
namespace fan {
enum : std::uint32_t { min_deg, max_deg, beams };
}
namespace levels {
enum : std::uint32_t {
    source_level_db,
    bandwidth_hz,
    noise_db,
    wind_mps,
    beaufort,
    shipping,
    noise_fades,
    array_gain_db,
    threshold_db,
    noise_depth_m,
    noise_at_depth_db,
};
}
namespace request {
enum : std::uint32_t {
    id,
    reset,
    frequency_hz,
    source,
    receivers,
    profile,
    mesh,
    interpolation,
    water_density_gcm3,
    absorption,
    surface,
    altimetry,
    bottom,
    bottom_depth_m,
    bathymetry,
    fan,
    sum,
    beam,
    engine,
    min_amp,
    baffle_from_deg,
    baffle_to_deg,
    smooth,
    loss,
    arrivals,
    levels,
};
}
namespace basis {
enum : std::uint32_t {
    engine,
    why,
    sum,
    beam,
    absorption,
    absorption_db_per_km,
    beams,
    modes,
    estimated_error_db,
    remark,
};
}
namespace paths {
enum : std::uint32_t {
    depth_m,
    range_m,
    amplitude,
    phase_deg,
    delay_s,
    absorption_db,
    launch_deg,
    arrival_deg,
    surface_bounces,
    bottom_bounces,
    caustics,
    delay_spread_s,
    mean_delay_s,
    peak_to_mean_db,
    within_20db,
    span_10db_s,
    span_20db_s,
};
}
namespace answer {
enum : std::uint32_t {
    id,
    error,
    depth_m,
    range_m,
    tl_db,
    arrivals,
    basis,
    source_depth_m,
    snr_db,
    signal_excess_db,
    noise_in_band_db,
    critical_depth_m,
    pairs,
};
}

}  // namespace field

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_FIELDS_HPP
