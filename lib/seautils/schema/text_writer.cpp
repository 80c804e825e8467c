#include "seautils/schema/message.hpp"
#include "seautils/schema/number_text.hpp"

#include <google/protobuf/descriptor.h>

#include <cmath>

namespace seautils::schema {

namespace {

void append_quoted(std::string& out, std::string_view text) {
    out += '"';
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        switch (c) {
            case '"':
                out += "\\\"";
                continue;
            case '\'':
                out += "\\'";
                continue;
            case '\\':
                out += "\\\\";
                continue;
            case '\n':
                out += "\\n";
                continue;
            case '\r':
                out += "\\r";
                continue;
            case '\t':
                out += "\\t";
                continue;
            default:
                break;
        }
        if (byte >= 0x20 && byte < 0x7f) {
            out += c;
            continue;
        }
        out += '\\';
        for (const int shift : {6, 3, 0}) out += static_cast<char>('0' + (byte >> shift & 7));
    }
    out += '"';
}

class Writer {
public:
    Writer(const Values& values, std::string& out) : values_(values), out_(out) {}

    void message(const Layout& layout, std::uint32_t block) {
        bool first = true;
        for (const std::uint32_t k : layout.by_number) {
            const Field& f = layout.fields[k];
            const Slot& slot = values_[block + k];
            if (!slot.present) continue;
            const std::uint32_t count = f.repeated ? slot.aux : 1;
            for (std::uint32_t e = 0; e < count; ++e) {
                if (!first) out_ += ' ';
                first = false;
                field(f, f.repeated ? values_[static_cast<std::uint32_t>(slot.u) + e] : slot);
            }
        }
    }

private:
    void field(const Field& f, const Slot& s) {
        out_ += f.wire_form == WireForm::group ? f.message->descriptor->name() : f.name;
        if (f.kind == Kind::message) {
            out_ += " { ";
            const std::size_t before = out_.size();
            message(*f.message, static_cast<std::uint32_t>(s.u));
            out_ += out_.size() == before ? "}" : " }";
            return;
        }
        out_ += ": ";
        value(f, s);
    }

    void value(const Field& f, const Slot& s) {
        switch (f.kind) {
            case Kind::boolean:
                out_ += s.i != 0 ? "true" : "false";
                return;
            case Kind::uint32:
            case Kind::uint64:
                return append_integer(out_, s.u);
            case Kind::float32:
                return append_float(out_, static_cast<float>(s.d));
            case Kind::float64:
                return append_double(out_, s.d);
            case Kind::string:
            case Kind::bytes:
                return append_quoted(out_, values_.text(s));
            case Kind::enumeration:
                if (const EnumLayout::Value* v =
                        f.enumeration->find(static_cast<std::int32_t>(s.i))) {
                    out_ += v->name;
                    return;
                }
                return append_integer(out_, s.i);
            default:
                return append_integer(out_, s.i);
        }
    }

    const Values& values_;
    std::string& out_;
};

}  // namespace

void write_text(const Values& values, std::string& out) {
    Writer(values, out).message(values.layout(), 0);
}

}  // namespace seautils::schema
