#include "seautils/propagation/level_sea.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/absorption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace seautils::propagation {

namespace {

/// A check()ed sea that this engine can do.
const Environment& accepted(const Environment& e, const FieldOptions& o, const char* engine) {
    check(e);
    const auto refuse = [&](const char* what) {
        throw DataError(fmt::format("{}: {} (rays can)", engine, what));
    };
    if (!is_range_independent(e)) refuse("the sea depends on range");
    if (!e.source.pattern.empty()) refuse("source.pattern is not empty");
    if (e.source.line) refuse("source.line is true");
    if (o.sum == Sum::semi_coherent) refuse("no semi-coherent sum");
    if (o.baffle_from_deg != o.baffle_to_deg) refuse("receivers have a baffle");
    return e;
}

}  // namespace

LevelSea::LevelSea(const Environment& e, const FieldOptions& o, const char* engine)
    : column(accepted(e, o, engine)),
      surface(e.surface, "surface", e.frequency_hz, e.water.density_gcm3),
      bottom(e.bottom, "bottom", e.frequency_hz, e.water.density_gcm3),
      guide{column, surface, bottom, 2 * std::numbers::pi * e.frequency_hz,
            absorption_db_per_km(e.water.absorption, e.frequency_hz) / (1000 * db_per_neper)} {
    for (const double q : column.sampled(std::min<std::size_t>(4096, 64 + e.water.profile.size())))
        most_k2 = std::max(most_k2, q * guide.omega * guide.omega);
    const double top = column.surface_m(), below = top + column.height_m();
    for (std::size_t k = 0; k < e.receivers.depth_m.size(); ++k) {
        const double z = e.receivers.depth_m[k];
        if (z < top || z > below) continue;
        rows.push_back(k);
        depth_m.push_back(z);
    }
}

Field empty_field(const Environment& e, const FieldOptions& o, Engine engine) {
    Field field;
    field.depths = e.receivers.depth_m.size();
    field.ranges = e.receivers.range_m.size();
    const float none = std::numeric_limits<float>::quiet_NaN();
    field.loss_db.assign(field.depths * field.ranges, none);
    if (o.sum == Sum::coherent) field.pressure.assign(field.loss_db.size(), {none, none});
    field.basis.engine = engine;
    return field;
}

void put_intensity(Field& field, std::size_t cell, double intensity) {
    field.loss_db[cell] = intensity > 0 ? static_cast<float>(-10 * std::log10(intensity))
                                        : std::numeric_limits<float>::infinity();
}

void put_pressure(Field& field, std::size_t cell, const std::complex<double>& p) {
    put_intensity(field, cell, std::norm(p));
    field.pressure[cell] = {static_cast<float>(p.real()), static_cast<float>(-p.imag())};
}

}  // namespace seautils::propagation
