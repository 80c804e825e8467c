seautils_module(NAME dccl
  SOURCES codec.cpp
  DEPENDS core schema entropy LINK PkgConfig::CRYPTOPP PkgConfig::LUA pugixml::pugixml fmt::fmt)
