seautils_module(NAME entropy SOURCES model.cpp arithmetic.cpp bits.cpp DEPENDS core LINK fmt::fmt)
