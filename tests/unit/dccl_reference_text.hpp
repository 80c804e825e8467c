// The reference model's schemas as .proto files, and its messages as protobuf's text.
#ifndef SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_TEXT_HPP
#define SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_TEXT_HPP

#include "dccl_reference_number.hpp"

#include <fmt/format.h>

#include <set>

namespace reference {

inline const char* const type_names[] = {"double",   "float",    "int32",  "int64",   "uint32",
                                         "uint64",   "sint32",   "sint64", "fixed32", "fixed64",
                                         "sfixed32", "sfixed64", "bool",   "string",  "bytes"};

inline std::string escaped(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    return out + '"';
}

inline std::string options_text(const Field& f) {
    std::string o;
    const auto add = [&](const char* name, const auto& value) {
        o += fmt::format(" {}: {}", name, value);
    };
    if (!f.codec.empty()) o += " codec: \"" + f.codec + "\"";
    if (f.omit) o += " omit: true";
    if (f.in_head) add("in_head", *f.in_head ? "true" : "false");
    if (f.precision) add("precision", *f.precision);
    if (f.min) o += fmt::format(" min: {:.17g}", *f.min);
    if (f.max) o += fmt::format(" max: {:.17g}", *f.max);
    if (f.resolution) o += fmt::format(" resolution: {:.17g}", *f.resolution);
    if (f.num_days != 1) add("num_days", f.num_days);
    if (!f.static_value.empty()) o += " static_value: " + escaped(f.static_value);
    if (is_text(f.type)) add("max_length", f.max_length);
    if (f.label == Label::repeated) add("max_repeat", f.max_repeat);
    if (f.min_repeat != 0) add("min_repeat", f.min_repeat);
    if (!f.packed) o += " packed_enum: false";
    return o.empty() ? o : " [(dccl.field) = {" + o + " }]";
}

inline std::string field_text(const Field& f, bool proto3, bool synthetic) {
    std::string line = "  ";
    if (f.label == Label::repeated)
        line += "repeated ";
    else if (f.label == Label::required)
        line += "required ";
    else if (synthetic || (!proto3 && f.oneof < 0))
        line += "optional ";
    line += f.sub                         ? f.sub->name
            : f.type == Type::enumeration ? f.type_name
                                          : type_names[static_cast<int>(f.type)];
    return line + fmt::format(" {} = {}{};\n", f.name, f.number, options_text(f));
}

inline void define(const Message& m, bool proto3, bool is_root, std::set<std::string>& known,
                   std::string& out) {
    if (!known.insert(m.name).second) return;
    std::string text = "message " + m.name + " {\n";
    if (is_root || !m.codec.empty()) {
        text += "  option (dccl.msg) = {";
        if (is_root) text += fmt::format(" max_bytes: 1000000 codec_version: {}", m.version);
        if (is_root && !m.omit_id) text += fmt::format(" id: {}", m.id);
        if (m.omit_id) text += " omit_id: true";
        if (!m.codec.empty()) text += " codec: \"" + m.codec + "\"";
        if (!m.codec_group.empty()) text += " codec_group: \"" + m.codec_group + "\"";
        text += " };\n";
    }
    int open = -1;
    for (const Field& f : m.fields) {
        const bool synthetic =
            f.oneof >= 0 && m.oneofs[static_cast<std::size_t>(f.oneof)].synthetic;
        const int group = synthetic ? -1 : f.oneof;
        if (group != open && open >= 0) text += "  }\n";
        if (group != open && group >= 0)
            text += "  oneof " + m.oneofs[static_cast<std::size_t>(group)].name + " {\n";
        open = group;
        text += field_text(f, proto3, synthetic);
        if (f.sub) define(*f.sub, proto3, false, known, out);
        if (f.type != Type::enumeration || !known.insert(f.type_name).second) continue;
        out += "enum " + f.type_name + " {\n";
        std::set<std::int32_t> numbers;
        for (const auto& e : f.enumerators) numbers.insert(e.second);
        if (numbers.size() < f.enumerators.size()) out += "  option allow_alias = true;\n";
        for (const auto& e : f.enumerators) out += fmt::format("  {} = {};\n", e.first, e.second);
        out += "}\n";
    }
    out += text + (open >= 0 ? "  }\n}\n" : "}\n");
}

inline std::string whole_text(Int x) {
    return x < 0 ? fmt::format("{}", static_cast<std::int64_t>(x))
                 : fmt::format("{}", static_cast<std::uint64_t>(x));
}

inline std::string scalar_text(const Field& f, const Value& v) {
    if (f.type == Type::float64) return fmt::format("{:.17g}", v.real);
    if (f.type == Type::float32) return fmt::format("{:.9g}", v.real);
    if (is_text(f.type)) return escaped(v.text);
    return whole_text(v.whole);
}

inline std::string proto_text(const Message& root, bool proto3) {
    std::string out = proto3 ? "syntax = \"proto3\";\n" : "syntax = \"proto2\";\n";
    out += "import \"dccl/option_extensions.proto\";\npackage r;\n";
    std::set<std::string> known;
    define(root, proto3, true, known, out);
    return out;
}

inline std::string text_of(const Message& message, const Value& value) {
    std::string out;
    for (std::size_t k = 0; k < message.fields.size(); ++k) {
        const Field& f = message.fields[k];
        const Value& v = value.items[k];
        if (!v.set) continue;
        const auto one = [&](const Value& item) {
            out += f.name;
            out += f.sub ? " { " + text_of(*f.sub, item) + "} " : ": " + scalar_text(f, item) + " ";
        };
        if (f.label != Label::repeated) {
            one(v);
            continue;
        }
        for (const Value& item : v.items) one(item);
    }
    return out;
}

}  // namespace reference

#endif  // SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_TEXT_HPP
