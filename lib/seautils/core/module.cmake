seautils_module(NAME core SOURCES rate_table.cpp text.cpp time.cpp LINK fmt::fmt)
