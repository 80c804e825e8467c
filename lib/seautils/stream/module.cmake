seautils_module(NAME stream SOURCES hex.cpp input.cpp nmea.cpp output.cpp DEPENDS core)
