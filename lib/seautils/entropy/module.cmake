seautils_module(NAME entropy SOURCES arithmetic.cpp DEPENDS core)
