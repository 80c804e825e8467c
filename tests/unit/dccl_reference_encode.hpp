// The reference model: values to bits.
#ifndef SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_ENCODE_HPP
#define SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_ENCODE_HPP

#include "dccl_reference_walk.hpp"

#include <bit>
#include <sstream>

namespace reference {

// Bits.

inline void put(Bits& bits, std::uint64_t x, std::uint64_t count) {
    for (std::uint64_t k = 0; k < count; ++k) {
        bits.push_back(k < 64 && ((x >> k) & 1) != 0);
    }
}

inline void put_bytes(Bits& bits, const std::string& bytes) {
    for (const char c : bytes) put(bits, static_cast<unsigned char>(c), 8);
}

inline std::string packed(const Bits& bits) {
    std::string bytes((bits.size() + 7) / 8, '\0');
    for (std::size_t k = 0; k < bits.size(); ++k) {
        if (bits[k]) bytes[k / 8] = static_cast<char>(bytes[k / 8] | 1 << k % 8);
    }
    return bytes;
}

inline void put_varint(Bits& bits, std::uint64_t x) {
    for (; x >= 128; x >>= 7) put(bits, x % 128 + 128, 8);
    put(bits, x, 8);
}

/// The static codec's value, as a C++ stream takes it out of the text.
inline void fixed(const Field& f, Value& v) {
    v.set = true;
    std::istringstream in(f.static_value);
    std::int64_t whole = 0;
    float single = 0;
    if (is_text(f.type)) {
        in >> v.text;
    } else if (f.type == Type::float32) {
        in >> single;
        v.real = static_cast<double>(single);
    } else if (f.type == Type::float64) {
        in >> v.real;
    } else {
        in >> whole;
        v.whole = whole;
    }
}

class Encoder : public Walk {
public:
    Encoder(const Message& message, Part part) : Walk{message, part} {}
    Bits bits;
    bool lossy = false;

    void message(const Message& m, const Value& v, Part enclosing, int version) {
        if (version == 4 && pass == Part::body) {
            for (const Oneof& o : m.oneofs) selector(o, v);
        }
        for (std::size_t k = 0; k < m.fields.size(); ++k) {
            const Field& f = m.fields[k];
            const auto part = enters(f, enclosing);
            if (!part) continue;
            const Value& value = v.items[k];
            if (f.oneof >= 0 && !value.set) continue;
            field(f, value, *part);
        }
    }

private:
    void selector(const Oneof& o, const Value& v) {
        std::size_t choice = 0;
        for (std::size_t i = 0; i < o.members.size(); ++i) {
            if (v.items[o.members[i]].set) choice = i + 1;
        }
        put(bits, choice, length_bits(static_cast<double>(o.members.size())));
    }

    void field(const Field& f, const Value& v, Part part) {
        const bool required = is_required(root, f);
        if (f.label != Label::repeated) return element(f, v.set ? &v : nullptr, required, part);
        const std::size_t given = v.items.size();
        lossy |= given < f.min_repeat || given > f.max_repeat;
        std::size_t count = f.max_repeat;
        if (root.version > 2) {
            count = std::clamp<std::size_t>(given, f.min_repeat, f.max_repeat);
            put(bits, count - f.min_repeat, count_bits(f));
        }
        for (std::size_t k = 0; k < count; ++k) {
            element(f, k < given ? &v.items[k] : nullptr, required, part);
        }
    }

    void element(const Field& f, const Value* v, bool required, Part part) {
        const Codec codec = *codec_of(root, f);
        if (f.sub) return sub_message(f, v, required, part, codec.version);
        if (codec.base == "dccl.static") {
            Value sent;
            fixed(f, sent);
            lossy |= v != nullptr &&
                     (v->text != sent.text || v->real != sent.real || v->whole != sent.whole);
            return;
        }
        if (codec.base != "dccl.presence" || required) return scalar(codec, f, v, required);
        put(bits, v != nullptr ? 1 : 0, 1);
        if (v != nullptr) scalar({"dccl.default", codec.version}, f, v, true);
    }

    void sub_message(const Field& f, const Value* v, bool required, Part part, int version) {
        const bool bit = has_presence_bit(f, required);
        if (bit) put(bits, v != nullptr ? 1 : 0, 1);
        if (v != nullptr) return message(*f.sub, *v, part, version);
        if (!bit) put(bits, 0, Walk::message(*f.sub, part, version).min);
    }

    void scalar(const Codec& codec, const Field& f, const Value* v, bool required) {
        if (codec.base == "dccl.native_protobuf") return native(f, v, required);
        if (is_text(f.type)) return text(codec, f, v, required);
        if (f.type == Type::boolean) {
            const unsigned shift = required ? 0 : 1;
            const std::uint64_t code = v == nullptr ? 0 : (v->whole != 0 ? 1U : 0U) + shift;
            return put(bits, code, 1 + shift);
        }
        const Number n = number_of(f, codec, required);
        const auto code = v == nullptr ? std::nullopt : value_code(codec, f, n, *v);
        if (!code) lossy |= v != nullptr;
        put(bits, code ? static_cast<std::uint64_t>(*code) + (required ? 0 : 1) : 0, n.bits());
    }

    static std::optional<Int> value_code(const Codec& codec, const Field& f, const Number& n,
                                         Value v) {
        if (f.type == Type::enumeration) {
            const auto position = position_of(f, v.whole);
            if (!position) return std::nullopt;
            if (codec.version == 2 || f.packed) v.whole = static_cast<Int>(*position);
        }
        if (codec.base == "dccl.time") {
            const double seconds =
                f.type == Type::float64 ? v.real : static_cast<double>(v.whole) / 1e6;
            v.real = std::fmod(seconds, n.max);
        }
        return code_of(n, v);
    }

    void text(const Codec& codec, const Field& f, const Value* v, bool required) {
        std::string s = v == nullptr ? std::string() : v->text;
        lossy |= s.size() > f.max_length;
        s.resize(std::min<std::size_t>(s.size(), f.max_length));
        if (!keeps_length(codec) && f.type == Type::string) {
            put(bits, s.size(), codec.version == 2 ? 8 : length_bits(f.max_length));
            return put_bytes(bits, s);
        }
        if (!required) put(bits, v != nullptr ? 1 : 0, 1);
        if (!required && v == nullptr) return;
        if (keeps_length(codec))
            put(bits, s.size(), length_bits(f.max_length));
        else
            s.resize(f.max_length);
        put_bytes(bits, s);
    }

    void native(const Field& f, const Value* v, bool required) {
        if (!required) put(bits, v != nullptr ? 1 : 0, 1);
        if (v == nullptr) return put(bits, 0, required ? native_size(f.type).min : 0);
        const auto x = static_cast<std::uint64_t>(v->whole);
        switch (f.type) {
            case Type::float64:
                return put(bits, std::bit_cast<std::uint64_t>(v->real), 64);
            case Type::float32:
                return put(bits, std::bit_cast<std::uint32_t>(static_cast<float>(v->real)), 32);
            case Type::fixed32:
            case Type::sfixed32:
            case Type::fixed64:
            case Type::sfixed64:
                return put(bits, x, native_size(f.type).max);
            case Type::sint32:
            case Type::sint64:
                return put_varint(bits, static_cast<std::uint64_t>(v->whole < 0 ? -2 * v->whole - 1
                                                                                : 2 * v->whole));
            case Type::enumeration:
                return put_varint(bits, *position_of(f, v->whole));
            default:
                return put_varint(bits, x);
        }
    }
};

inline bool drops(const Walk& head, const Walk& body, const Message& m, const Value& v,
                  Part enclosing, bool reached_by_head, bool reached_by_body) {
    for (std::size_t k = 0; k < m.fields.size(); ++k) {
        const Field& f = m.fields[k];
        if (f.omit || !v.items[k].set) continue;
        const auto in_head = reached_by_head ? head.enters(f, enclosing) : std::nullopt;
        const auto in_body = reached_by_body ? body.enters(f, enclosing) : std::nullopt;
        if (!in_head && !in_body) return true;
        if (!f.sub) continue;
        const Part part = in_head ? *in_head : *in_body;
        const auto inside = [&](const Value& item) {
            return drops(head, body, *f.sub, item, part, in_head.has_value(), in_body.has_value());
        };
        const auto& items = v.items[k].items;
        if (f.label == Label::repeated ? std::any_of(items.begin(), items.end(), inside)
                                       : inside(v.items[k])) {
            return true;
        }
    }
    return false;
}

inline Encoded encode(const Message& root, const Value& value, bool header_only = false) {
    Encoder head(root, Part::head), body(root, Part::body);
    if (!root.omit_id) {
        put(head.bits, static_cast<std::uint64_t>(root.id) * 2 + (root.id < 128 ? 0 : 1),
            id_bits(root));
    }
    head.message(root, value, Part::undetermined, root_version(root));
    body.message(root, value, Part::undetermined, root_version(root));
    const bool dropped = drops(head, body, root, value, Part::undetermined, true, true);
    if (header_only) return {packed(head.bits), head.lossy, dropped};
    return {packed(head.bits) + packed(body.bits), head.lossy || body.lossy, dropped};
}

}  // namespace reference

#endif  // SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_ENCODE_HPP
