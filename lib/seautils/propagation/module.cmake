seautils_module(NAME propagation
  SOURCES
    absorption.cpp
    beam_columns.cpp
    beam_intensity.cpp
    beam_pressure.cpp
    eigenrays.cpp
    engine.cpp
    environment.cpp
    modes.cpp
    ray_arrivals.cpp
    ray_beam.cpp
    ray_fan.cpp
    ray_layers.cpp
    ray_sea.cpp
    ray_tracer.cpp
    rays.cpp
    reflection.cpp
    wavenumber.cpp
  DEPENDS core LINK fmt::fmt)
