#ifndef SEAUTILS_DCCL_OPTIONS_HPP
#define SEAUTILS_DCCL_OPTIONS_HPP

#include <cstdint>
#include <optional>
#include <string>

namespace google::protobuf {
class Descriptor;
class FieldDescriptor;
}  // namespace google::protobuf

namespace seautils::dccl {

/// Lua expressions over the message; empty: none.
struct Conditions {
    std::string required_if, omit_if, only_if, min, max;
};

/// `(dccl.field)`: the options of a field, as schemas/dccl/option_extensions.proto documents them.
struct FieldOptions {
    std::optional<std::string> codec;
    bool omit = false;
    std::optional<bool> in_head;
    std::optional<std::int32_t> precision;
    std::optional<double> min, max, resolution;
    std::uint32_t num_days = 1;
    std::optional<std::string> static_value;
    std::optional<std::uint32_t> max_length, max_repeat;
    std::uint32_t min_repeat = 0;
    bool packed_enum = true;
    std::string description;
    std::string unit;  ///< of the `units` option, for people: "m", "m/s", "degree", or empty
    std::optional<Conditions> conditions;
    std::optional<std::string> arithmetic_model;                     ///< `[arithmetic] { model }`
    std::optional<std::uint32_t> ccl_thrust_mode_tag, ccl_bit_size;  ///< `[ccl]`
};

/// `(dccl.msg)`: the options of a message.
struct MessageOptions {
    bool any = false;  ///< whether the option is there at all
    std::optional<std::int32_t> id, codec_version;
    std::optional<std::uint32_t> max_bytes;
    std::optional<std::string> codec, codec_group;
    bool omit_id = false;
};

/// Read from the descriptor by extension number (1012), so that it does not matter which pool the
/// descriptor is of, nor whether the program holds generated code for the extensions.
FieldOptions field_options(const google::protobuf::FieldDescriptor& field);
MessageOptions message_options(const google::protobuf::Descriptor& message);

/// The serialized DCCLFieldOptions or DCCLMessageOptions, or nothing where the option is absent.
std::optional<std::string> raw_field_options(const google::protobuf::FieldDescriptor& field);
std::optional<std::string> raw_message_options(const google::protobuf::Descriptor& message);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_OPTIONS_HPP
