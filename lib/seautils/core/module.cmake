seautils_module(NAME core SOURCES rate_table.cpp text.cpp time.cpp warp.cpp LINK fmt::fmt)
