seautils_module(NAME toolbox
  SOURCES
    arr_file.cpp
    attenuation.cpp
    companions.cpp
    env_file.cpp
    env_writer.cpp
    external.cpp
    green.cpp
    list_directed.cpp
    oast_file.cpp
    program.cpp
    shd_file.cpp
  DEPENDS core propagation LINK fmt::fmt)
