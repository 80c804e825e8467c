seautils_module(NAME schema
  SOURCES layout.cpp values.cpp pool.cpp json_reader.cpp json_writer.cpp message.cpp binary.cpp csv.cpp
  DEPENDS core LINK protobuf::libprotobuf fmt::fmt simdjson::simdjson)
target_sources(seautils_schema PRIVATE ${SEAUTILS_EMBEDDED_SOURCE})
add_dependencies(seautils_schema seautils_embedded)
