seautils_module(NAME propagation
  SOURCES
    absorption.cpp
    beam_sum.cpp
    engine.cpp
    environment.cpp
    modes.cpp
    ray_beam.cpp
    ray_layers.cpp
    ray_sea.cpp
    ray_tracer.cpp
    rays.cpp
    reflection.cpp
    wavenumber.cpp
  DEPENDS core LINK fmt::fmt)
