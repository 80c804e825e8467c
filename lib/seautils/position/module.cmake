seautils_module(NAME position
  SOURCES codec.cpp
  DEPENDS core entropy LINK fmt::fmt)
