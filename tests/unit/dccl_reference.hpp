// DCCL versions 2, 3 and 4 written down once more, bit by bit and value by value, with nothing in
// common with the library: what the library is held against.
#ifndef SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_HPP
#define SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_HPP

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reference {

__extension__ typedef __int128 Int;

enum class Type {
    float64,
    float32,
    int32,
    int64,
    uint32,
    uint64,
    sint32,
    sint64,
    fixed32,
    fixed64,
    sfixed32,
    sfixed64,
    boolean,
    string,
    bytes,
    enumeration,
    message,
};
enum class Label { optional, required, repeated };
enum class Part { undetermined, head, body };

struct Message;

struct Field {
    std::string name;
    int number = 0;
    Type type = Type::int32;
    Label label = Label::optional;
    int oneof = -1;         ///< index in the message's oneofs
    bool implicit = false;  ///< proto3: zero is the same as unset
    std::string type_name;  ///< of enumerations
    std::vector<std::pair<std::string, std::int32_t>> enumerators;
    std::shared_ptr<Message> sub;
    // (dccl.field)
    std::string codec;
    bool omit = false;
    std::optional<bool> in_head;
    std::optional<int> precision;
    std::optional<double> min, max, resolution;
    unsigned num_days = 1;
    std::string static_value;
    unsigned max_length = 0;
    unsigned min_repeat = 0, max_repeat = 1;
    bool packed = true;
};

struct Oneof {
    std::string name;
    bool synthetic = false;
    std::vector<std::size_t> members;
};

struct Message {
    std::string name;
    std::vector<Field> fields;
    std::vector<Oneof> oneofs;  ///< synthetic ones last
    // (dccl.msg)
    int version = 4, id = 0;
    bool omit_id = false;
    std::string codec, codec_group;
};

/// A message's fields, a repeated field's elements, or a scalar.
struct Value {
    bool set = false;
    double real = 0;
    Int whole = 0;  ///< integers, bool, an enumerator's number
    std::string text;
    std::vector<Value> items;
};

/// What the format does not define, because the reference's types overflow: nothing to compare.
struct Undefined {};
/// The bits cannot be decoded.
struct Refused {};

struct Size {
    std::uint64_t min = 0, max = 0;
};

using Bits = std::vector<bool>;

struct Encoded {
    std::string bytes;
    bool lossy = false;    ///< something was out of range, cut or padded
    bool dropped = false;  ///< something is set that no part takes
};

}  // namespace reference

#endif  // SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_HPP
