seautils_module(NAME stream SOURCES input.cpp output.cpp hex.cpp DEPENDS core)
