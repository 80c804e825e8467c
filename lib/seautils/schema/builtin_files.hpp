#ifndef SEAUTILS_SCHEMA_BUILTIN_FILES_HPP
#define SEAUTILS_SCHEMA_BUILTIN_FILES_HPP

#include <string_view>
#include <vector>

namespace seautils::schema {

/// A file that is part of the library: its import path and its text.
struct BuiltinFile {
    std::string_view path;
    std::string_view text;
};

/// The import files of DCCL schemas (`dccl/option_extensions.proto` and its neighbours).
const std::vector<BuiltinFile>& builtin_files();

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_BUILTIN_FILES_HPP
