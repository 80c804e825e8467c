seautils_module(NAME schema
  SOURCES binary_reader.cpp binary_writer.cpp csv.cpp field_path.cpp json_reader.cpp json_writer.cpp layout.cpp
    layout_of_descriptor.cpp message.cpp number_text.cpp pool.cpp source_check.cpp source_tree.cpp text_writer.cpp values.cpp
  DEPENDS core LINK protobuf::libprotobuf fmt::fmt simdjson::simdjson)
target_sources(seautils_schema PRIVATE ${SEAUTILS_EMBEDDED_SOURCE})
add_dependencies(seautils_schema seautils_embedded)
