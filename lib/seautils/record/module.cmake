seautils_module(NAME record SOURCES codec.cpp duplicates.cpp DEPENDS core stream schema)
