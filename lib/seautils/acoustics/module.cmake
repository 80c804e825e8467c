seautils_module(NAME acoustics
  SOURCES clean.cpp cnv.cpp columns.cpp ctd_csv.cpp extend.cpp legs.cpp profile.cpp sample.cpp seawater.cpp
    sound_speed.cpp window.cpp
  DEPENDS core LINK fmt::fmt)
