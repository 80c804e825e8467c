seautils_module(NAME toolbox
  SOURCES
    arr_file.cpp
    attenuation.cpp
    companions.cpp
    env_file.cpp
    list_directed.cpp
    shd_file.cpp
  DEPENDS core propagation LINK fmt::fmt)
