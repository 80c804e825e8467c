seautils_module(NAME propagation
  SOURCES
    absorption.cpp
    engine.cpp
    environment.cpp
    modes.cpp
    rays.cpp
    reflection.cpp
    wavenumber.cpp
  DEPENDS core LINK fmt::fmt)
