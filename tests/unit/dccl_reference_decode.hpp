// The reference model: bits to values.
#ifndef SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_DECODE_HPP
#define SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_DECODE_HPP

#include "dccl_reference_encode.hpp"

namespace reference {

struct Reader {
    const std::string& bytes;
    std::size_t at = 0;  ///< bits

    std::uint64_t get(std::uint64_t count) {
        if (count > bytes.size() * 8 - at) throw Refused{};
        std::uint64_t x = 0;
        for (std::uint64_t k = 0; k < count; ++k, ++at) {
            const auto bit = static_cast<unsigned char>(bytes[at / 8]) >> at % 8 & 1;
            if (k < 64) x |= static_cast<std::uint64_t>(bit) << k;
        }
        return x;
    }
    std::string text(std::uint64_t count) {
        if (count * 8 > bytes.size() * 8 - at) throw Refused{};
        std::string out;
        for (std::uint64_t k = 0; k < count; ++k) out += static_cast<char>(get(8));
        return out;
    }
};

inline std::uint64_t get_varint(Reader& reader) {
    std::uint64_t x = 0;
    for (unsigned k = 0; k < 10; ++k) {
        const std::uint64_t byte = reader.get(8);
        if (k < 9 || byte < 2) x |= (byte % 128) << (7 * k);
        if (byte < 128) return x;
    }
    throw Refused{};
}

class Decoder : public Walk {
public:
    Decoder(const Message& message, Part part, const std::string& bytes, std::int64_t now_s)
        : Walk{message, part}, reader{bytes}, now_s_(now_s) {}
    Reader reader;

    void message(const Message& m, Value& v, Part enclosing, int version) {
        v.set = true;
        v.items.resize(m.fields.size());
        std::vector<std::uint64_t> choices(m.oneofs.size());
        if (version == 4 && pass == Part::body) {
            for (std::size_t k = 0; k < m.oneofs.size(); ++k) {
                choices[k] =
                    reader.get(length_bits(static_cast<double>(m.oneofs[k].members.size())));
            }
        }
        for (std::size_t k = 0; k < m.fields.size(); ++k) {
            const Field& f = m.fields[k];
            const auto part = enters(f, enclosing);
            if (!part) continue;
            if (f.oneof >= 0) {
                const auto o = static_cast<std::size_t>(f.oneof);
                const auto& members = m.oneofs[o].members;
                if (choices[o] == 0 || choices[o] > members.size()) continue;
                if (members[choices[o] - 1] != k) continue;
            }
            field(f, v.items[k], *part);
        }
    }

private:
    void field(const Field& f, Value& v, Part part) {
        const bool required = is_required(root, f);
        if (f.label != Label::repeated) return element(f, v, required, part);
        std::uint64_t count = f.max_repeat;
        if (root.version > 2) count = f.min_repeat + reader.get(count_bits(f));
        if (f.sub && count > f.max_repeat) throw Refused{};
        if (!v.items.empty() && v.items.size() != count)
            throw Refused{};  // the header said another
        v.items.resize(count);
        for (Value& item : v.items) element(f, item, required, part);
    }

    void element(const Field& f, Value& v, bool required, Part part) {
        const Codec codec = *codec_of(root, f);
        if (f.sub) {
            if (has_presence_bit(f, required) && reader.get(1) == 0) return;
            return message(*f.sub, v, part, codec.version);
        }
        if (codec.base == "dccl.static") return fixed(f, v);
        if (codec.base != "dccl.presence" || required) return scalar(codec, f, v, required);
        if (reader.get(1) == 1) scalar({"dccl.default", codec.version}, f, v, true);
    }

    void scalar(const Codec& codec, const Field& f, Value& v, bool required) {
        if (codec.base == "dccl.native_protobuf") return native(f, v, required);
        if (is_text(f.type)) return text(codec, f, v, required);
        if (f.type == Type::boolean) {
            const std::uint64_t code = reader.get(required ? 1 : 2);
            v.set = required || code != 0;
            v.whole = required ? code : code > 1;
            return;
        }
        const Number n = number_of(f, codec, required);
        std::uint64_t code = reader.get(n.bits());
        if (!required && code == 0) return;
        code -= required ? 0 : 1;
        set_from_code(n, code, v);
        if (codec.base == "dccl.time") time(f, v);
        if (f.type == Type::enumeration) enumerator(f, codec.version == 2 || f.packed, v);
    }

    static void enumerator(const Field& f, bool by_position, Value& v) {
        if (by_position) {
            v.set = v.whole >= 0 && v.whole < static_cast<Int>(f.enumerators.size());
            if (v.set) v.whole = f.enumerators[static_cast<std::size_t>(v.whole)].second;
        } else {
            v.set = position_of(f, v.whole).has_value();
        }
    }

    void time(const Field& f, Value& v) const {
        const std::int64_t period = std::int64_t{86400} * f.num_days;
        const std::int64_t today = now_s_ % period;
        std::int64_t start = now_s_ - today;
        const double half = static_cast<double>(period / 2);
        if (v.real - static_cast<double>(today) > half)
            start -= period;
        else if (static_cast<double>(today) - v.real > half)
            start += period;
        const double sum = static_cast<double>(start) + v.real;
        if (f.type == Type::float64) {
            v.real = quantized_real(sum, std::pow(10.0, -f.precision.value_or(0)));
        } else {
            v.whole = quantized<std::int64_t>(static_cast<Int>(1e6 * sum),
                                              std::pow(10.0, -f.precision.value_or(-6)));
        }
    }

    void text(const Codec& codec, const Field& f, Value& v, bool required) {
        if (!keeps_length(codec) && f.type == Type::string) {
            v.text = reader.text(reader.get(codec.version == 2 ? 8 : length_bits(f.max_length)));
            v.set = !v.text.empty();
            return;
        }
        if (!required && reader.get(1) == 0) return;
        v.set = true;
        v.text =
            reader.text(keeps_length(codec) ? reader.get(length_bits(f.max_length)) : f.max_length);
    }

    void native(const Field& f, Value& v, bool required) {
        if (!required && reader.get(1) == 0) return;
        v.set = true;
        switch (f.type) {
            case Type::float64:
                v.real = not_nan(std::bit_cast<double>(reader.get(64)));
                return;
            case Type::float32:
                v.real = not_nan(static_cast<double>(
                    std::bit_cast<float>(static_cast<std::uint32_t>(reader.get(32)))));
                return;
            case Type::fixed32:
                v.whole = static_cast<std::uint32_t>(reader.get(32));
                return;
            case Type::sfixed32:
                v.whole = static_cast<std::int32_t>(reader.get(32));
                return;
            case Type::fixed64:
                v.whole = reader.get(64);
                return;
            case Type::sfixed64:
                v.whole = static_cast<std::int64_t>(reader.get(64));
                return;
            case Type::boolean:
                v.whole = reader.get(8) != 0;
                return;
            default:
                break;
        }
        const std::uint64_t x = get_varint(reader);
        const auto signed_half = static_cast<Int>(x / 2);
        switch (f.type) {
            case Type::sint64:
            case Type::sint32:
                v.whole = x % 2 == 0 ? signed_half : -signed_half - 1;
                if (f.type == Type::sint32 && x > 0xffffffff) throw Undefined{};
                return;
            case Type::uint32:
                if (x > 0xffffffff) throw Undefined{};
                v.whole = x;
                return;
            case Type::uint64:
                v.whole = x;
                return;
            case Type::enumeration:
                if (x > 0x7fffffff) throw Undefined{};
                v.whole = static_cast<Int>(x);
                return enumerator(f, true, v);
            default:
                v.whole = checked_native(f.type, static_cast<std::int64_t>(x));
                return;
        }
    }

    /// The text of a NaN does not say which.
    static double not_nan(double x) {
        if (std::isnan(x)) throw Undefined{};
        return x;
    }

    static Int checked_native(Type type, std::int64_t x) {
        return type == Type::int32 ? checked<std::int32_t>(x) : Int{x};
    }

    std::int64_t now_s_;
};

/// Version 2's messages in which nothing is set are absent; elements that are not set close up. A
/// protobuf message does not say of a zero of proto3 without presence that it is set.
inline void prune(const Walk& walk, const Message& m, Value& v) {
    for (std::size_t k = 0; k < m.fields.size(); ++k) {
        const Field& f = m.fields[k];
        Value& value = v.items[k];
        const auto one = [&](Value& item) {
            if (!f.sub || !item.set) return;
            item.items.resize(f.sub->fields.size());
            prune(walk, *f.sub, item);
            const Codec codec = *codec_of(walk.root, f);
            if (codec.base != "dccl.default" || codec.version != 2) return;
            item.set = std::any_of(item.items.begin(), item.items.end(),
                                   [](const Value& inner) { return inner.set; });
        };
        if (f.omit) continue;
        const bool is_zero = value.real == 0 && value.whole == 0 && value.text.empty();
        if (f.implicit && is_zero) value.set = false;
        if (f.label != Label::repeated) {
            one(value);
            continue;
        }
        for (Value& item : value.items) one(item);
        std::erase_if(value.items, [](const Value& item) { return !item.set; });
        value.set = !value.items.empty();
    }
}

inline Value decode(const Message& root, const std::string& bytes, std::int64_t now_s,
                    std::size_t& used) {
    Value value;
    Decoder head(root, Part::head, bytes, now_s);
    head.reader.get(id_bits(root));
    head.message(root, value, Part::undetermined, root_version(root));
    const std::size_t head_bytes = (head.reader.at + 7) / 8;
    const std::string rest = bytes.substr(head_bytes);
    Decoder body(root, Part::body, rest, now_s);
    body.message(root, value, Part::undetermined, root_version(root));
    used = head_bytes + (body.reader.at + 7) / 8;
    prune(head, root, value);
    return value;
}

}  // namespace reference

#endif  // SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_DECODE_HPP
