seautils_module(NAME cli SOURCES app.cpp io.cpp config_file.cpp
  DEPENDS core stream schema LINK CLI11::CLI11 Boost::program_options fmt::fmt)
