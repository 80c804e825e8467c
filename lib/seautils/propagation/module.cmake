seautils_module(NAME propagation
  SOURCES
    absorption.cpp
    column.cpp
    edge.cpp
    engine.cpp
    environment.cpp
    hankel.cpp
    level_sea.cpp
    mesh_rows.cpp
    mode_search.cpp
    modes.cpp
    rays.cpp
    reflection.cpp
    wavenumber.cpp
  DEPENDS core LINK fmt::fmt)
