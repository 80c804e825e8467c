seautils_module(NAME dccl
  SOURCES ccl.cpp codec.cpp compile_field.cpp compiler.cpp conditions.cpp crypto.cpp decode.cpp
    decode_addons.cpp dynamic.cpp encode.cpp encode_addons.cpp hash.cpp legacy_decode.cpp
    legacy_encode.cpp legacy_schema.cpp lint.cpp lua_proxy.cpp lua_sandbox.cpp models.cpp
    murmur.cpp native.cpp number.cpp options.cpp program.cpp raw_stream.cpp survey.cpp
    survey_text.cpp type_set.cpp
  DEPENDS core schema entropy LINK PkgConfig::CRYPTOPP PkgConfig::LUA pugixml::pugixml fmt::fmt
    $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
