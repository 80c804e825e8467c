seautils_module(NAME plan
  SOURCES
    acomms_depth.cpp
  DEPENDS core LINK fmt::fmt)
