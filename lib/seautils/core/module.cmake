seautils_module(NAME core SOURCES text.cpp time.cpp warp.cpp LINK fmt::fmt)
