seautils_module(NAME modem
  SOURCES fields.cpp sentences.cpp statistics.cpp
  DEPENDS core stream record LINK fmt::fmt)
