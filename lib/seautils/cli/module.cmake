seautils_module(NAME cli
  SOURCES app.cpp clock.cpp commands.cpp config_file.cpp help.cpp io.cpp loop.cpp messages.cpp progress.cpp
    source.cpp
  DEPENDS core stream schema LINK CLI11::CLI11 Boost::program_options fmt::fmt)
target_compile_definitions(seautils_cli PRIVATE SEAUTILS_VERSION="${PROJECT_VERSION}")
