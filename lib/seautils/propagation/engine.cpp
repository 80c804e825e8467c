#include "seautils/propagation/engine.hpp"

#include "seautils/propagation/column.hpp"
#include "seautils/propagation/modes.hpp"
#include "seautils/propagation/pairs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace seautils::propagation {

namespace {

/// Why modes cannot be had; nothing where they can.
const char* against_modes(const Environment& e, const FieldOptions& o) {
    if (o.sum != Sum::coherent) return "intensities are summed";
    if (e.fan.beams != 0) return "a number of beams is given";
    if (!is_range_independent(e)) return "the sea depends on range";
    if (!e.source.pattern.empty()) return "the source has a pattern";
    if (e.source.line) return "the source is a line";
    if (o.baffle_from_deg != o.baffle_to_deg) return "receivers have a baffle";
    if (e.surface.kind == BoundaryKind::table || e.bottom.kind == BoundaryKind::table)
        return "a boundary is a table";
    if (!holds_modes(e)) return "the boundaries hold no modes";
    return nullptr;
}

double depth_in_wavelengths(const Environment& e) {
    const Column column(e);
    const double middle = column.surface_m() + column.height_m() / 2;
    double travel_s = column.height_m() * std::sqrt(column.squared_slowness(middle));
    for (const SedimentLayer& l : e.bottom.layers)
        travel_s += 2 * l.thickness_m / (l.sound_speed_top_mps + l.sound_speed_bottom_mps);
    return e.frequency_hz * travel_s;
}

/// Of pairs: modes are searched for anew in each block, and wavenumbers take seconds.
PairCost pair_cost(Engine engine) {
    if (engine == Engine::modes) return {250'000, 250};
    if (engine == Engine::wavenumber) return {40'000, 50};
    return {};
}

}  // namespace

std::string_view name(Engine engine) {
    static constexpr std::string_view names[]{"auto", "rays", "modes", "wavenumber"};
    return names[static_cast<std::size_t>(engine)];
}

Choice choose_engine(const Environment& e, const FieldOptions& o) {
    if (const char* why = against_modes(e, o)) return {Engine::rays, why};
    const double wavelengths = depth_in_wavelengths(e);
    const bool few = wavelengths <= most_wavelengths_of_modes;
    return {few ? Engine::modes : Engine::rays,
            fmt::format("the water {} {:.3g} wavelengths deep, {} than {}",
                        e.bottom.layers.empty() ? "is" : "and the layers below are", wavelengths,
                        few ? "not more" : "more", most_wavelengths_of_modes)};
}

Field compute_field(const Environment& environment, Engine engine, const FieldOptions& options) {
    return FieldComputer(0).compute(environment, engine, options);
}

Field FieldComputer::on_grid(const Environment& environment, Engine engine,
                             const FieldOptions& options) {
    if (engine == Engine::modes) return mode_field(environment, options);
    if (engine == Engine::wavenumber) return wavenumber_field(environment, options);
    return rays_.field(environment, options);
}

Field FieldComputer::compute(const Environment& environment, Engine engine,
                             const FieldOptions& options) {
    check(environment);
    Choice choice{engine, ""};
    if (engine == Engine::automatic) choice = choose_engine(environment, options);
    Field field = environment.receivers.pairs
                      ? field_at_pairs(environment, pair_cost(choice.engine),
                                       [&](const Environment& grid) {
                                           return on_grid(grid, choice.engine, options);
                                       })
                      : on_grid(environment, choice.engine, options);
    field.basis.engine = choice.engine;
    field.basis.why = choice.why;
    return field;
}

}  // namespace seautils::propagation
