seautils_module(NAME record SOURCES codec.cpp DEPENDS core stream schema)
