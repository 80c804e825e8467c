seautils_module(NAME core SOURCES time.cpp text.cpp LINK fmt::fmt)
