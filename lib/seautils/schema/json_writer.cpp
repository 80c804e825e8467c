#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/number_text.hpp"

#include <cmath>

namespace seautils::schema {

namespace {

constexpr std::int64_t last_second = 253'402'300'799;  ///< of the year 9999

constexpr char hex_digits[] = "0123456789abcdef";

void append_escape(std::string& out, unsigned char c) {
    switch (c) {
        case '"':
            out += "\\\"";
            return;
        case '\\':
            out += "\\\\";
            return;
        case '\n':
            out += "\\n";
            return;
        case '\r':
            out += "\\r";
            return;
        case '\t':
            out += "\\t";
            return;
        default:
            break;
    }
    out += "\\u00";
    out += hex_digits[c >> 4];
    out += hex_digits[c & 15];
}

bool is_plain(unsigned char c) { return c >= 0x20 && c < 0x7f && c != '"' && c != '\\'; }

void append_string(std::string& out, std::string_view text) {
    out += '"';
    std::size_t at = 0;
    while (at < text.size()) {
        std::size_t end = at;
        while (end < text.size() && is_plain(static_cast<unsigned char>(text[end]))) ++end;
        out.append(text.substr(at, end - at));
        if (end == text.size()) break;
        const auto c = static_cast<unsigned char>(text[end]);
        at = end + 1;
        if (c < 0x80) {
            append_escape(out, c);
            continue;
        }
        // A text that was cut within a character is still to be valid JSON.
        const std::size_t length = utf8_length(text.substr(end));
        if (length == 0) {
            out += "\xEF\xBF\xBD";
        } else {
            out.append(text.substr(end, length));
            at = end + length;
        }
    }
    out += '"';
}

void append_floating(std::string& out, const Field& f, double x) {
    if (std::isnan(x))
        out += "\"NaN\"";
    else if (std::isinf(x))
        out += x > 0 ? "\"Infinity\"" : "\"-Infinity\"";
    else if (f.kind == Kind::float32)
        append_float(out, static_cast<float>(x));
    else
        append_double(out, x);
}

class Writer {
public:
    Writer(const Values& values, std::string& out) : values_(values), out_(out) {}

    /// @param first  whether nothing stands before the first field
    void fields(const Layout& layout, std::uint32_t block, bool first) {
        for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
            const Slot& slot = values_[block + k];
            if (!slot.present) continue;
            const Field& f = layout.fields[k];
            if (!first) out_ += ',';
            first = false;
            out_ += f.json_key;
            f.repeated ? list(f, slot) : value(f, slot);
        }
        out_ += '}';
    }

private:
    void list(const Field& f, const Slot& slot) {
        out_ += '[';
        for (std::uint32_t k = 0; k < slot.aux; ++k) {
            if (k > 0) out_ += ',';
            const Slot& one = values_[static_cast<std::uint32_t>(slot.u) + k];
            one.present ? value(f, one) : void(out_ += "null");
        }
        out_ += ']';
    }

    void value(const Field& f, const Slot& s) {
        switch (f.kind) {
            case Kind::boolean:
                out_ += s.i != 0 ? "true" : "false";
                return;
            case Kind::int32:
                return append_integer(out_, s.i);
            case Kind::uint32:
                return append_integer(out_, s.u);
            case Kind::int64:
                out_ += '"';
                append_integer(out_, s.i);
                out_ += '"';
                return;
            case Kind::uint64:
                out_ += '"';
                append_integer(out_, s.u);
                out_ += '"';
                return;
            case Kind::float32:
            case Kind::float64:
                return append_floating(out_, f, s.d);
            case Kind::string:
                return append_string(out_, values_.text(s));
            case Kind::bytes:
                out_ += '"';
                append_base64(out_, values_.text(s));
                out_ += '"';
                return;
            case Kind::enumeration:
                return enumerator(f, s);
            case Kind::message:
                if (f.message->timestamp && timestamp(static_cast<std::uint32_t>(s.u))) return;
                out_ += '{';
                return fields(*f.message, static_cast<std::uint32_t>(s.u), true);
        }
    }

    /// False: no time that JSON can write; it is written as a plain message then.
    bool timestamp(std::uint32_t block) {
        const Slot& seconds = values_[block];
        const Slot& nanos = values_[block + 1];
        const UtcInstant instant{seconds.present ? seconds.i : 0,
                                 nanos.present ? static_cast<std::int32_t>(nanos.i) : 0};
        if (instant.seconds < 0 || instant.seconds > last_second || instant.nanoseconds < 0 ||
            instant.nanoseconds > 999'999'999)
            return false;
        out_ += '"';
        append_instant(out_, instant);
        out_ += '"';
        return true;
    }

    void enumerator(const Field& f, const Slot& s) {
        const EnumLayout::Value* v = f.enumeration->find(static_cast<std::int32_t>(s.i));
        if (v == nullptr) return append_integer(out_, s.i);
        out_ += '"';
        out_ += v->name;
        out_ += '"';
    }

    const Values& values_;
    std::string& out_;
};

}  // namespace

void write_json(const Values& values, std::string& out, std::string_view type) {
    out += '{';
    if (!type.empty()) {
        out += "\"@type\":";
        append_string(out, type);
    }
    Writer(values, out).fields(values.layout(), 0, type.empty());
}

}  // namespace seautils::schema
