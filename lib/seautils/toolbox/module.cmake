seautils_module(NAME toolbox
  SOURCES
    attenuation.cpp
    companions.cpp
    env_file.cpp
    list_directed.cpp
  DEPENDS core propagation LINK fmt::fmt)
