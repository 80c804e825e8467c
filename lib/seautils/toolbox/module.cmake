seautils_module(NAME toolbox
  SOURCES
    env_file.cpp
  DEPENDS core propagation LINK fmt::fmt)
