// The reference model: which codec, which part, how many bits, and what is refused.
#ifndef SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_WALK_HPP
#define SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_WALK_HPP

#include "dccl_reference_number.hpp"

#include <algorithm>
#include <set>

namespace reference {

inline constexpr std::uint64_t endless = std::uint64_t{1} << 50;

struct Codec {
    std::string base;  ///< "dccl.default", "dccl.time", …
    int version = 0;
};

inline bool exists(const std::string& name) {
    static const std::set<std::string> names = {
        "dccl.default2",  "dccl.default3",   "dccl.default4",   "dccl.time2",
        "dccl.time3",     "dccl.time4",      "_time",           "dccl.static2",
        "dccl.static3",   "dccl.static4",    "_static",         "dccl.presence3",
        "dccl.presence4", "dccl.var_bytes3", "dccl.var_bytes4", "dccl.native_protobuf"};
    return names.contains(name);
}

inline std::optional<Codec> codec_named(std::string name, int version) {
    const auto ends_in_digit = [&] { return name.back() >= '0' && name.back() <= '9'; };
    if (!ends_in_digit() && exists(name + std::to_string(version))) name += std::to_string(version);
    if (!exists(name)) return std::nullopt;
    if (name == "dccl.native_protobuf") return Codec{name, 4};
    if (!ends_in_digit()) return Codec{"dccl." + name.substr(1), version};
    return Codec{name.substr(0, name.size() - 1), name.back() - '0'};
}

inline std::optional<Codec> codec_of(const Message& root, const Field& f) {
    std::string name = f.codec;
    if (name.empty() && f.sub) name = f.sub->codec;
    if (name.empty()) name = root.codec_group;
    if (name.empty()) name = "dccl.default";
    const auto codec = codec_named(name, root.version);
    if (!codec) return codec;
    const bool text = is_text(f.type);
    if (codec->base == "dccl.var_bytes" && !text) return std::nullopt;
    if (codec->base == "dccl.native_protobuf" && text) return std::nullopt;
    return codec;
}

inline bool is_required(const Message& root, const Field& f) {
    if (root.version == 2) return f.label == Label::required;
    if (f.label != Label::optional) return true;
    return root.version == 4 && f.oneof >= 0;
}

inline double step_of(const Field& f) {
    if (f.precision) return std::pow(10.0, -*f.precision);
    return f.resolution.value_or(1);
}

inline Number number_of(const Field& f, const Codec& codec, bool required) {
    Number n{f.type, f.min.value_or(0), f.max.value_or(0), step_of(f), required};
    if (f.type == Type::enumeration) {
        n.min = 0;
        n.max = static_cast<double>(f.enumerators.size() - 1);
        if (codec.version != 2 && !f.packed) {
            const auto [low, high] = std::minmax_element(
                f.enumerators.begin(), f.enumerators.end(),
                [](const auto& a, const auto& b) { return a.second < b.second; });
            n.min = low->second;
            n.max = high->second;
        }
    }
    if (codec.base == "dccl.time") {
        const double digits = f.type == Type::float64 ? 0 : 6;
        n.type = Type::float64;
        n.min = 0;
        n.max = f.num_days * 86400.0;
        if (f.precision) n.res = std::pow(10.0, -(*f.precision + digits));
    }
    return n;
}

inline unsigned length_bits(double longest) {
    return static_cast<unsigned>(std::ceil(std::log2(longest + 1)));
}

inline bool keeps_length(const Codec& codec) {
    return codec.base == "dccl.var_bytes" || codec.version == 4;
}

inline Size text_size(const Field& f, const Codec& codec, bool required) {
    const std::uint64_t all = f.max_length * 8ULL;
    const std::uint64_t bit = required ? 0 : 1;
    if (keeps_length(codec)) {
        const std::uint64_t p = length_bits(f.max_length);
        return {required ? p : 1, bit + p + all};
    }
    if (f.type == Type::bytes) return {required ? all : 1, bit + all};
    const std::uint64_t p = codec.version == 2 ? 8 : length_bits(f.max_length);
    return {p, p + all};
}

inline Size native_size(Type type) {
    switch (type) {
        case Type::boolean:
            return {8, 8};
        case Type::float32:
        case Type::fixed32:
        case Type::sfixed32:
            return {32, 32};
        case Type::float64:
        case Type::fixed64:
        case Type::sfixed64:
            return {64, 64};
        case Type::uint32:
        case Type::sint32:
            return {8, 40};
        default:
            return {8, 80};
    }
}

/// Who sits where: the same for sizes, encoding and decoding.
struct Walk {
    const Message& root;
    Part pass;

    /// Whether the field takes part in this pass; the part that it settles for what is inside.
    std::optional<Part> enters(const Field& f, Part enclosing) const {
        if (f.omit) return std::nullopt;
        const Part pushed = f.sub && f.in_head ? own_part(f) : enclosing;
        Part part = enclosing;
        if (part == Part::undetermined && (!f.sub || f.in_head)) part = own_part(f);
        if (part != Part::undetermined)
            return part == pass ? std::optional<Part>(pushed) : std::nullopt;
        const auto codec = codec_of(root, f);
        const bool split = codec && codec->base == "dccl.default" && codec->version == 2;
        if (split || pass == Part::body) return Part::undetermined;
        return std::nullopt;
    }

    static Part own_part(const Field& f) {
        return f.in_head.value_or(false) ? Part::head : Part::body;
    }

    int message_version(const Field& f) const { return codec_of(root, f)->version; }

    bool has_presence_bit(const Field& f, bool required) const {
        if (f.label != Label::optional) return false;
        const int version = message_version(f);
        return version == 3 || (version == 4 && !required);
    }

    Size element(const Field& f, bool required, Part part) const {
        const Codec codec = *codec_of(root, f);
        if (f.sub) {
            Size size = message(*f.sub, part, codec.version);
            if (has_presence_bit(f, required)) size = {1, size.max + 1};
            return size;
        }
        if (codec.base == "dccl.static") return {};
        if (codec.base == "dccl.presence" && !required) {
            return {1, element_with({"dccl.default", codec.version}, f, true).max + 1};
        }
        return element_with(codec, f, required);
    }

    static Size element_with(const Codec& codec, const Field& f, bool required) {
        if (codec.base == "dccl.native_protobuf") {
            const Size size = native_size(f.type);
            return required ? size : Size{1, size.max + 1};
        }
        if (is_text(f.type)) return text_size(f, codec, required);
        if (f.type == Type::boolean) return required ? Size{1, 1} : Size{2, 2};
        const unsigned bits = number_of(f, codec, required).bits();
        return {bits, bits};
    }

    unsigned count_bits(const Field& f) const {
        if (root.version == 2) return 0;
        return length_bits(static_cast<double>(f.max_repeat) - f.min_repeat);
    }

    Size field(const Field& f, Part part) const {
        const Size one = element(f, is_required(root, f), part);
        if (f.label != Label::repeated) return one;
        const std::uint64_t fewest = root.version == 2 ? f.max_repeat : f.min_repeat;
        return {count_bits(f) + one.min * fewest, count_bits(f) + one.max * f.max_repeat};
    }

    Size message(const Message& m, Part enclosing, int version) const {
        Size sum;
        if (version == 4 && pass == Part::body) {
            for (const Oneof& o : m.oneofs) {
                sum.min += length_bits(static_cast<double>(o.members.size()));
            }
            sum.max = sum.min;
        }
        std::vector<std::uint64_t> largest(m.oneofs.size());
        for (const Field& f : m.fields) {
            const auto part = enters(f, enclosing);
            if (!part) continue;
            const Size size = field(f, *part);
            if (f.oneof >= 0) {
                auto& l = largest[static_cast<std::size_t>(f.oneof)];
                l = std::max(l, size.max);
            } else {
                sum.min += size.min;
                sum.max = std::min(sum.max + size.max, endless);
            }
        }
        for (const std::uint64_t l : largest) sum.max += l;
        return sum;
    }
};

inline int root_version(const Message& root) {
    std::string name = root.codec.empty() ? root.codec_group : root.codec;
    if (name.empty()) name = "dccl.default";
    const auto codec = codec_named(name, root.version);
    return codec ? codec->version : 0;
}

inline std::uint64_t id_bits(const Message& root) {
    if (root.omit_id) return 0;
    return root.id < 128 ? 8 : 16;
}

// What may not be loaded.

inline std::optional<std::string> number_refusal(const Field& f, const Number& n) {
    if (f.precision && f.resolution) return "precision and resolution";
    if (!(n.res > 0)) return "resolution";
    if (!(std::log2(n.max - n.min) - std::log2(n.res) <= 53)) return "more than 53 bits";
    if (!f.resolution) return std::nullopt;
    for (const double bound : {n.min, n.max}) {
        if (!(std::fabs(quantized_real(bound, n.res) - bound) < 1e-10)) return "off the grid";
    }
    return std::nullopt;
}

inline std::optional<std::string> field_refusal(const Message& root, const Field& f) {
    const auto codec = codec_of(root, f);
    if (!codec) return "no such codec";
    if (f.label == Label::repeated && (f.max_repeat < 1 || f.max_repeat < f.min_repeat)) {
        return "max_repeat";
    }
    if (codec->base == "dccl.static" || codec->base == "dccl.native_protobuf") return std::nullopt;
    if (f.type == Type::string && codec->base != "dccl.var_bytes" && codec->version == 2 &&
        f.max_length > 255) {
        return "max_length above 255";
    }
    if (is_text(f.type) || f.type == Type::boolean || f.sub) return std::nullopt;
    return number_refusal(f, number_of(f, *codec, is_required(root, f)));
}

inline std::optional<std::string> message_refusal(const Message& root, const Message& m,
                                                  Part enclosing, int version, bool reached_by_head,
                                                  bool reached_by_body) {
    if (!m.oneofs.empty() && version < 4) return "oneof";
    const Walk head{root, Part::head}, body{root, Part::body};
    for (const Field& f : m.fields) {
        if (f.omit) continue;
        const auto in_head = reached_by_head ? head.enters(f, enclosing) : std::nullopt;
        const auto in_body = reached_by_body ? body.enters(f, enclosing) : std::nullopt;
        if (!in_head && !in_body && !f.sub) continue;
        if (const auto why = field_refusal(root, f)) return f.name + ": " + *why;
        if (!in_head && !in_body) continue;
        const Part part = in_head ? *in_head : *in_body;
        if (f.sub) {
            const auto why = message_refusal(root, *f.sub, part, head.message_version(f),
                                             in_head.has_value(), in_body.has_value());
            if (why) return f.name + "." + *why;
        }
        if (!in_head) continue;
        if (f.oneof >= 0) return f.name + ": oneof in the header";
        const Size size = head.field(f, part);
        if (size.min != size.max) return f.name + ": varies in the header";
    }
    return std::nullopt;
}

/// The declaration's position of a number (of the first name, where several have it).
inline std::optional<std::size_t> position_of(const Field& f, Int number) {
    for (std::size_t k = 0; k < f.enumerators.size(); ++k) {
        if (f.enumerators[k].second == number) return k;
    }
    return std::nullopt;
}

inline std::optional<std::string> refusal(const Message& root) {
    const int version = root_version(root);
    if (version == 0) return "no codec for the message";
    return message_refusal(root, root, Part::undetermined, version, true, true);
}

inline std::pair<Size, Size> sizes(const Message& root) {
    Size head = Walk{root, Part::head}.message(root, Part::undetermined, root_version(root));
    head.min += id_bits(root);
    head.max += id_bits(root);
    return {head, Walk{root, Part::body}.message(root, Part::undetermined, root_version(root))};
}

}  // namespace reference

#endif  // SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_WALK_HPP
