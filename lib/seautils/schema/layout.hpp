#ifndef SEAUTILS_SCHEMA_LAYOUT_HPP
#define SEAUTILS_SCHEMA_LAYOUT_HPP

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace google::protobuf {
class Descriptor;
class EnumDescriptor;
class FieldDescriptor;
}  // namespace google::protobuf

namespace seautils::schema {

/// What a field holds, and with it which member of a Slot is meaningful (values.hpp).
enum class Kind : std::uint8_t {
    boolean,
    int32,
    int64,
    uint32,
    uint64,
    float32,
    float64,
    string,
    bytes,
    enumeration,
    message,
};

/// How protobuf's binary form writes a value; only the wire reader and writer care.
enum class WireForm : std::uint8_t { varint, zigzag, fixed32, fixed64, length, group };

/// An enumeration: its values in declaration order, aliases included.
struct EnumLayout {
    struct Value {
        std::string name;
        std::int32_t number;
    };
    std::string full_name;
    std::vector<Value> values;
    bool open = false;  ///< proto3: numbers that are not declared are kept
    const google::protobuf::EnumDescriptor* descriptor = nullptr;

    /// First value with that name or number, or nullptr. Binary search, no allocation.
    const Value* find(std::string_view name) const;
    const Value* find(std::int32_t number) const;

    /// Indices into `values`: sorted by name, and by number with the first declared first.
    std::vector<std::uint32_t> by_name, by_number;
};

struct Layout;

/// A field of a message, at its place in the declaration.
struct Field {
    std::string name;       ///< as declared
    std::string json_name;  ///< lowerCamelCase, also accepted by the JSON reader
    std::string json_key;   ///< `"name":`, for the JSON writer; made by LayoutSet
    std::int32_t number = 0;
    Kind kind = Kind::int32;
    WireForm wire_form = WireForm::varint;
    bool required = false;  ///< proto2 `required`
    bool repeated = false;
    bool packed = false;             ///< binary form writes one length-prefixed run
    bool has_presence = true;        ///< false: proto3 scalar, where the default value means unset
    bool nullable_elements = false;  ///< elements of the repeated field may be null (legacy arrays)
    std::int32_t oneof = -1;         ///< index into Layout::oneofs (real and synthetic), or -1
    const Layout* message = nullptr;                                ///< kind message
    const EnumLayout* enumeration = nullptr;                        ///< kind enumeration
    const google::protobuf::FieldDescriptor* descriptor = nullptr;  ///< null in a legacy layout
};

struct Oneof {
    std::string name;
    std::vector<std::uint32_t> fields;  ///< indices into Layout::fields, in order
    bool synthetic = false;             ///< made by proto3 `optional`
};

/// A message type, flattened for work at speed: fields in declaration order, no extensions.
struct Layout {
    std::string full_name;
    std::vector<Field> fields;
    std::vector<Oneof> oneofs;  ///< real ones in order, then synthetic ones
    /// google.protobuf.Timestamp (seconds, nanos), which JSON writes as a time.
    bool timestamp = false;
    const google::protobuf::Descriptor* descriptor = nullptr;  ///< null in a legacy layout

    /// Index of the field with that name or json_name, or -1. `hint` is tried first: a reader
    /// that passes the index after the last hit pays one comparison a field for ordered input.
    std::int32_t find(std::string_view name, std::uint32_t hint = 0) const;
    /// Index of the field with that number, or -1; `hint` as above.
    std::int32_t find_number(std::int32_t number, std::uint32_t hint = 0) const {
        const bool hit = hint < fields.size() && fields[hint].number == number;
        return hit ? static_cast<std::int32_t>(hint) : search_number(number);
    }

    std::unordered_map<std::string_view, std::uint32_t> by_name;  ///< names and json_names
    std::vector<std::uint32_t> by_number;                         ///< indices, sorted by number
    std::vector<std::uint32_t> to_check;  ///< indices of what is required, and of messages

private:
    std::int32_t search_number(std::int32_t number) const;
};

/// Owns layouts, makes each message type's only once, and keeps their addresses.
/// The descriptors must outlive it. Not thread-safe while it grows.
class LayoutSet {
public:
    LayoutSet();
    ~LayoutSet();
    LayoutSet(LayoutSet&&) noexcept;
    LayoutSet& operator=(LayoutSet&&) noexcept;

    /// The layout of a protobuf message type; of the types below it too (cycles are allowed).
    /// @throws ConfigError  more than 100,000 fields in all
    const Layout& of(const google::protobuf::Descriptor& descriptor);

    /// Takes over a layout made by hand (the legacy XML, records): fills its indices.
    const Layout& add(Layout layout);
    const EnumLayout& add(EnumLayout enumeration);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_LAYOUT_HPP
