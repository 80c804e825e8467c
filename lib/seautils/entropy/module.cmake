seautils_module(NAME entropy SOURCES model.cpp arithmetic.cpp DEPENDS core LINK fmt::fmt)
