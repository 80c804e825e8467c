#ifndef SEAUTILS_SCHEMA_SOURCE_CHECK_HPP
#define SEAUTILS_SCHEMA_SOURCE_CHECK_HPP

#include <string>
#include <string_view>

namespace seautils::schema {

/// What protobuf's compiler must not be given: it recurses with the nesting, and takes time and room
/// by the square of some numbers, all without limit.
///
/// Limits of one file: 64 brackets of a kind inside of each other; 512 bytes in a name and 100 parts;
/// in one block 1000 options, reserved numbers and extension ranges; 1000 elements in one pair of
/// square brackets; 128 MiB for all full names, as if each were the longest. No NUL byte.
///
/// @param text  of a .proto file, whatever it holds
/// @return      what is against it, as in "FILE: nested deeper than 64 brackets"; empty: nothing
std::string source_fault(std::string_view text);

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_SOURCE_CHECK_HPP
