seautils_module(NAME propagation
  SOURCES
    absorption.cpp
    array_gain.cpp
    beam_columns.cpp
    beam_intensity.cpp
    beam_pressure.cpp
    case_file.cpp
    column.cpp
    edge.cpp
    eigenrays.cpp
    engine.cpp
    environment.cpp
    hankel.cpp
    layer_stack.cpp
    level_sea.cpp
    mesh_rows.cpp
    mode_search.cpp
    modes.cpp
    noise.cpp
    pairs.cpp
    ray_arrivals.cpp
    ray_beam.cpp
    ray_energy.cpp
    ray_fan.cpp
    ray_layers.cpp
    ray_paths.cpp
    ray_sea.cpp
    ray_tracer.cpp
    rays.cpp
    reflection.cpp
    smooth.cpp
    spread.cpp
    wavenumber.cpp
  DEPENDS core LINK fmt::fmt $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)

# Square roots and comparisons become vectors only where nobody asks for errno or traps.
set_source_files_properties(seautils/propagation/beam_intensity.cpp
  seautils/propagation/ray_tracer.cpp
  PROPERTIES COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math")
