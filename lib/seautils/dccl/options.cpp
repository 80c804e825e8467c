#include "seautils/dccl/options.hpp"

#include "seautils/core/error.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/unknown_field_set.h>

#include <bit>

namespace seautils::dccl {

namespace {

using google::protobuf::UnknownField;
using google::protobuf::UnknownFieldSet;

constexpr int extension_number = 1012;

/// All occurrences of the extension, one behind the other: that is how protobuf merges messages.
std::optional<std::string> extension_bytes(const google::protobuf::Message& options) {
    UnknownFieldSet fields;
    if (!fields.ParseFromString(options.SerializeAsString())) return std::nullopt;
    std::optional<std::string> bytes;
    for (int k = 0; k < fields.field_count(); ++k) {
        const UnknownField& field = fields.field(k);
        if (field.number() != extension_number ||
            field.type() != UnknownField::TYPE_LENGTH_DELIMITED) {
            continue;
        }
        bytes = bytes.value_or("") + field.length_delimited();
    }
    return bytes;
}

/// Calls `each` for every field of a serialized message.
template <class Each>
void for_each_field(const std::string& bytes, Each each) {
    UnknownFieldSet fields;
    if (!fields.ParseFromString(bytes)) throw ConfigError("damaged dccl options");
    for (int k = 0; k < fields.field_count(); ++k) each(fields.field(k));
}

std::int64_t integer(const UnknownField& f) {
    return f.type() == UnknownField::TYPE_VARINT ? static_cast<std::int64_t>(f.varint()) : 0;
}
std::uint32_t natural(const UnknownField& f) { return static_cast<std::uint32_t>(integer(f)); }
double number(const UnknownField& f) {
    return f.type() == UnknownField::TYPE_FIXED64 ? std::bit_cast<double>(f.fixed64()) : 0;
}
std::string text(const UnknownField& f) {
    return f.type() == UnknownField::TYPE_LENGTH_DELIMITED ? f.length_delimited() : std::string();
}

Conditions conditions(const std::string& bytes, Conditions c) {
    for_each_field(bytes, [&](const UnknownField& f) {
        switch (f.number()) {
            case 1:
                c.required_if = text(f);
                break;
            case 2:
                c.omit_if = text(f);
                break;
            case 3:
                c.only_if = text(f);
                break;
            case 10:
                c.min = text(f);
                break;
            case 11:
                c.max = text(f);
                break;
            default:
                break;
        }
    });
    return c;
}

/// SI symbol of dimensions such as "LT^-1", as far as marine schemas use them.
std::string si_symbol(const std::string& dimensions) {
    static const std::pair<const char*, const char*> known[] = {
        {"L", "m"},     {"T", "s"}, {"LT^-1", "m/s"}, {"LT^-2", "m/s^2"}, {"M", "kg"},
        {"T^-1", "Hz"}, {"K", "K"}, {"Theta", "K"},   {"L^-1", "1/m"},
    };
    for (const auto& [dimension, symbol] : known) {
        if (dimensions == dimension) return symbol;
    }
    return {};
}

/// What the `units` option says to a person: the unit's own name, or the symbol of SI.
std::string unit_name(const std::string& bytes) {
    std::string base, derived, system, unit, prefix;
    for_each_field(bytes, [&](const UnknownField& f) {
        switch (f.number()) {
            case 1:
                base = text(f);
                break;
            case 2:
                derived = text(f);
                break;
            case 3:
                system = text(f);
                break;
            case 5:
                unit = text(f);
                break;
            case 6:
                prefix = text(f);
                break;
            default:
                break;
        }
    });
    if (!unit.empty()) return prefix + unit;
    if (const auto colon = system.rfind("::"); colon != std::string::npos) {
        return prefix + system.substr(colon + 2);
    }
    if (!system.empty() && system != "si") return {};
    if (derived == "plane_angle") return "radian";
    if (derived == "temperature" || derived == "pressure") {
        return derived == "pressure" ? prefix + "Pa" : "K";
    }
    const std::string symbol = si_symbol(base);
    return symbol.empty() ? symbol : prefix + symbol;
}

void read_arithmetic(const std::string& bytes, FieldOptions& o) {
    for_each_field(bytes, [&](const UnknownField& f) {
        if (f.number() == 1) o.arithmetic_model = text(f);
    });
}

void read_ccl(const std::string& bytes, FieldOptions& o) {
    for_each_field(bytes, [&](const UnknownField& f) {
        if (f.number() == 1) o.ccl_thrust_mode_tag = natural(f);
        if (f.number() == 2) o.ccl_bit_size = natural(f);
    });
}

/// One line for each option's number: long, but a table.
void read_field_option(const UnknownField& f, FieldOptions& o) {
    switch (f.number()) {
        case 1:
            o.codec = text(f);
            break;
        case 2:
            o.omit = integer(f) != 0;
            break;
        case 3:
            o.in_head = integer(f) != 0;
            break;
        case 4:
            o.precision = static_cast<std::int32_t>(integer(f));
            break;
        case 5:
            o.min = number(f);
            break;
        case 6:
            o.max = number(f);
            break;
        case 7:
            o.num_days = natural(f);
            break;
        case 8:
            o.static_value = text(f);
            break;
        case 9:
            o.max_length = natural(f);
            break;
        case 10:
            o.max_repeat = natural(f);
            break;
        case 11:
            o.packed_enum = integer(f) != 0;
            break;
        case 12:
            o.resolution = number(f);
            break;
        case 13:
            o.min_repeat = natural(f);
            break;
        case 20:
            o.description = text(f);
            break;
        case 30:
            o.unit = unit_name(text(f));
            break;
        case 40:
            o.conditions = conditions(text(f), o.conditions.value_or(Conditions{}));
            break;
        case 1000:
            read_ccl(text(f), o);
            break;
        case 1001:
            read_arithmetic(text(f), o);
            break;
        default:
            break;
    }
}

/// The unit that a field's name ends in (`depth_m`), where no option states one.
std::string unit_of_name(const std::string& name) {
    static const std::pair<const char*, const char*> endings[] = {
        {"_mps", "m/s"}, {"_deg", "degree"},   {"_dbar", "dbar"}, {"_db", "dB"}, {"_hz", "Hz"},
        {"_khz", "kHz"}, {"_ms", "ms"},        {"_us", "us"},     {"_s", "s"},   {"_m", "m"},
        {"_km", "km"},   {"_c", "degree C"},   {"_v", "V"},       {"_w", "W"},   {"_percent", "%"},
        {"_pct", "%"},   {"_dps", "degree/s"},
    };
    for (const auto& [ending, unit] : endings) {
        if (name.ends_with(ending)) return unit;
    }
    return {};
}

}  // namespace

std::optional<std::string> raw_field_options(const google::protobuf::FieldDescriptor& field) {
    return extension_bytes(field.options());
}

std::optional<std::string> raw_message_options(const google::protobuf::Descriptor& message) {
    return extension_bytes(message.options());
}

FieldOptions field_options(const google::protobuf::FieldDescriptor& field) {
    FieldOptions options;
    if (const auto bytes = raw_field_options(field)) {
        for_each_field(*bytes, [&](const UnknownField& f) { read_field_option(f, options); });
    }
    if (options.unit.empty()) options.unit = unit_of_name(field.name());
    return options;
}

MessageOptions message_options(const google::protobuf::Descriptor& message) {
    MessageOptions o;
    const auto bytes = raw_message_options(message);
    if (!bytes) return o;
    o.any = true;
    for_each_field(*bytes, [&](const UnknownField& f) {
        switch (f.number()) {
            case 1:
                o.id = static_cast<std::int32_t>(integer(f));
                break;
            case 2:
                o.max_bytes = natural(f);
                break;
            case 3:
                o.codec = text(f);
                break;
            case 4:
                o.codec_group = text(f);
                break;
            case 5:
                o.codec_version = static_cast<std::int32_t>(integer(f));
                break;
            case 10:
                o.omit_id = integer(f) != 0;
                break;
            default:
                break;
        }
    });
    return o;
}

}  // namespace seautils::dccl
