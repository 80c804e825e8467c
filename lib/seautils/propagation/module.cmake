seautils_module(NAME propagation
  SOURCES
    engine.cpp
    environment.cpp
    modes.cpp
    rays.cpp
    reflection.cpp
    wavenumber.cpp
  DEPENDS core LINK fmt::fmt)
