#ifndef SEAUTILS_SCHEMA_JSON_HPP
#define SEAUTILS_SCHEMA_JSON_HPP

#include "seautils/schema/values.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace seautils::schema {

/// What to do with fields and enumerators that the layout does not declare.
enum class Unknown : std::uint8_t { refuse, skip };

/// Reads protobuf's JSON mapping into Values, without a protobuf message in between.
///
/// Accepts what protobuf's parser accepts: either spelling of a field name, 64-bit integers as
/// strings or numbers, integers written 1.0 or 1e3 or "1", enumerators by name or number, bytes in
/// either base64 alphabet with or without padding, "NaN" "Infinity" "-Infinity", null for unset.
/// Refuses, each with the field's path and the value quoted: an unknown field (proposes the nearest
/// name), a duplicate field, two members of a oneof, a fraction or out-of-type number for an
/// integer, an undeclared enumerator, a null element (unless Field::nullable_elements), invalid
/// UTF-8, more than 32 levels, anything after the object. google.protobuf.Timestamp is a time,
/// `"2024-05-01T12:00:25.5Z"`, from 1970 on. Not covered: map fields, and the special forms of
/// google.protobuf's other well-known types, which are read and written as plain messages.
///
/// Stricter than protobuf's parser, which guesses: JSON is that of RFC 8259 (no bare key, no single
/// quotes, no last comma, no `5.`); a repeated field is an array; in quotes stands no "+1", no
/// "0x10", no "1" for true; a number too small for a double is no integer; int64 does not clip.
/// Laxer: a base64 text may mix both alphabets, and an open enumeration's number be in quotes.
class JsonReader {
public:
    JsonReader();
    ~JsonReader();
    JsonReader(JsonReader&&) noexcept;
    JsonReader& operator=(JsonReader&&) noexcept;

    /// Value of the top-level key "@type" of the object in `json`, its last part after a '/', or
    /// empty. Looks at no more than the keys. @throws DataError  not an object
    std::string type_of(std::string_view json);

    /// @param json  one object; keys that begin with '@' ("@type") are skipped at the top level
    /// @return whether all was known
    /// @throws DataError  as above; `values` is then unspecified
    bool read(std::string_view json, const Layout& layout, Values& values,
              Unknown unknown = Unknown::refuse);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Appends the object on one line: fields in declaration order with their names as declared, unset
/// ones left out, 64-bit integers as strings, bytes in base64, enumerators by name (an undeclared
/// number as a number), doubles and floats as the shortest decimal that reads back the same.
/// Parsed, it equals what protobuf's printer writes (preserve_proto_field_names).
/// @param type  if not empty, `"@type":"TYPE"` comes first
void write_json(const Values& values, std::string& out, std::string_view type = {});

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_JSON_HPP
