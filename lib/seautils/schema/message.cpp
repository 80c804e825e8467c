#include "seautils/schema/message.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

namespace seautils::schema {

namespace {

using google::protobuf::Message;
using google::protobuf::Reflection;

constexpr int max_depth = 32;
/// Of what protobuf says, which may quote a whole record.
constexpr std::size_t longest_fault = 300;

/// A message's fields into slots.
class Reader {
public:
    explicit Reader(Values& values) : values_(values) {}

    void block(const Message& message, const Layout& layout, std::uint32_t at, int depth) {
        if (depth > max_depth) throw DataError("nested deeper than 32 messages");
        const Reflection& r = *message.GetReflection();
        for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
            const Field& f = layout.fields[k];
            if (f.repeated)
                list(message, r, f, at + k, depth);
            else if (r.HasField(message, f.descriptor))
                single(message, r, f, at + k, depth);
        }
    }

private:
    void single(const Message& m, const Reflection& r, const Field& f, std::uint32_t at,
                int depth) {
        Slot& s = values_[at];
        const auto* d = f.descriptor;
        s.present = true;
        switch (f.kind) {
            case Kind::boolean:
                s.i = r.GetBool(m, d) ? 1 : 0;
                return;
            case Kind::int32:
                s.i = r.GetInt32(m, d);
                return;
            case Kind::int64:
                s.i = r.GetInt64(m, d);
                return;
            case Kind::uint32:
                s.u = r.GetUInt32(m, d);
                return;
            case Kind::uint64:
                s.u = r.GetUInt64(m, d);
                return;
            case Kind::float32:
                s.d = static_cast<double>(r.GetFloat(m, d));
                return;
            case Kind::float64:
                s.d = r.GetDouble(m, d);
                return;
            case Kind::enumeration:
                s.i = r.GetEnumValue(m, d);
                return;
            case Kind::string:
            case Kind::bytes:
                values_.set_text(at, r.GetStringReference(m, d, &scratch_));
                return;
            case Kind::message:
                block(r.GetMessage(m, d), *f.message, values_.add_block(at, *f.message), depth + 1);
                return;
        }
    }

    void list(const Message& m, const Reflection& r, const Field& f, std::uint32_t at, int depth) {
        const int count = r.FieldSize(m, f.descriptor);
        if (count == 0) return;
        const std::uint32_t first = values_.add_elements(at, static_cast<std::uint32_t>(count));
        for (int k = 0; k < count; ++k)
            element(m, r, f, k, first + static_cast<std::uint32_t>(k), depth);
    }

    void element(const Message& m, const Reflection& r, const Field& f, int k, std::uint32_t at,
                 int depth) {
        Slot& s = values_[at];
        const auto* d = f.descriptor;
        s.present = true;
        switch (f.kind) {
            case Kind::boolean:
                s.i = r.GetRepeatedBool(m, d, k) ? 1 : 0;
                return;
            case Kind::int32:
                s.i = r.GetRepeatedInt32(m, d, k);
                return;
            case Kind::int64:
                s.i = r.GetRepeatedInt64(m, d, k);
                return;
            case Kind::uint32:
                s.u = r.GetRepeatedUInt32(m, d, k);
                return;
            case Kind::uint64:
                s.u = r.GetRepeatedUInt64(m, d, k);
                return;
            case Kind::float32:
                s.d = static_cast<double>(r.GetRepeatedFloat(m, d, k));
                return;
            case Kind::float64:
                s.d = r.GetRepeatedDouble(m, d, k);
                return;
            case Kind::enumeration:
                s.i = r.GetRepeatedEnumValue(m, d, k);
                return;
            case Kind::string:
            case Kind::bytes:
                values_.set_text(at, r.GetRepeatedStringReference(m, d, k, &scratch_));
                return;
            case Kind::message:
                block(r.GetRepeatedMessage(m, d, k), *f.message, values_.add_block(at, *f.message),
                      depth + 1);
                return;
        }
    }

    Values& values_;
    std::string scratch_;
};

/// Slots into a message's fields.
class Writer {
public:
    explicit Writer(const Values& values) : values_(values) {}

    void block(std::uint32_t at, const Layout& layout, Message& message) {
        const Reflection& r = *message.GetReflection();
        for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
            const Slot& s = values_[at + k];
            if (!s.present) continue;
            const Field& f = layout.fields[k];
            if (!f.repeated) {
                single(message, r, f, s);
                continue;
            }
            for (std::uint32_t e = 0; e < s.aux; ++e)
                add(message, r, f, values_[static_cast<std::uint32_t>(s.u) + e]);
        }
    }

private:
    void single(Message& m, const Reflection& r, const Field& f, const Slot& s) {
        const auto* d = f.descriptor;
        switch (f.kind) {
            case Kind::boolean:
                r.SetBool(&m, d, s.i != 0);
                return;
            case Kind::int32:
                r.SetInt32(&m, d, static_cast<std::int32_t>(s.i));
                return;
            case Kind::int64:
                r.SetInt64(&m, d, s.i);
                return;
            case Kind::uint32:
                r.SetUInt32(&m, d, static_cast<std::uint32_t>(s.u));
                return;
            case Kind::uint64:
                r.SetUInt64(&m, d, s.u);
                return;
            case Kind::float32:
                r.SetFloat(&m, d, static_cast<float>(s.d));
                return;
            case Kind::float64:
                r.SetDouble(&m, d, s.d);
                return;
            case Kind::enumeration:
                r.SetEnumValue(&m, d, static_cast<int>(s.i));
                return;
            case Kind::string:
            case Kind::bytes:
                r.SetString(&m, d, std::string(values_.text(s)));
                return;
            case Kind::message:
                block(static_cast<std::uint32_t>(s.u), *f.message, *r.MutableMessage(&m, d));
                return;
        }
    }

    void add(Message& m, const Reflection& r, const Field& f, const Slot& s) {
        const auto* d = f.descriptor;
        switch (f.kind) {
            case Kind::boolean:
                r.AddBool(&m, d, s.i != 0);
                return;
            case Kind::int32:
                r.AddInt32(&m, d, static_cast<std::int32_t>(s.i));
                return;
            case Kind::int64:
                r.AddInt64(&m, d, s.i);
                return;
            case Kind::uint32:
                r.AddUInt32(&m, d, static_cast<std::uint32_t>(s.u));
                return;
            case Kind::uint64:
                r.AddUInt64(&m, d, s.u);
                return;
            case Kind::float32:
                r.AddFloat(&m, d, static_cast<float>(s.d));
                return;
            case Kind::float64:
                r.AddDouble(&m, d, s.d);
                return;
            case Kind::enumeration:
                r.AddEnumValue(&m, d, static_cast<int>(s.i));
                return;
            case Kind::string:
            case Kind::bytes:
                r.AddString(&m, d, std::string(values_.text(s)));
                return;
            case Kind::message:
                block(static_cast<std::uint32_t>(s.u), *f.message, *r.AddMessage(&m, d));
                return;
        }
    }

    const Values& values_;
};

/// Keeps the first fault of a text as one line.
class FirstFault : public google::protobuf::io::ErrorCollector {
public:
    void AddError(int line, int column, const std::string& message) override {
        if (!what.empty()) return;
        std::string text = message;
        if (!text.empty() && text.back() == '.') text.pop_back();
        if (line >= 0) {
            what = line > 0 ? "line " + std::to_string(line + 1) + " " : "";
            what += "column " + std::to_string(column + 1) + ": ";
        }
        what += printable(lower_first(std::move(text)), longest_fault);
    }
    std::string what;
};

}  // namespace

void from_message(const Message& message, const Layout& layout, Values& values) {
    values.reset(layout);
    Reader(values).block(message, layout, 0, 1);
}

void to_message(const Values& values, Message& message) {
    message.Clear();
    Writer(values).block(0, values.layout(), message);
}

namespace {

bool is_compiled(const Message& message) {
    return message.GetReflection()->GetMessageFactory() ==
           google::protobuf::MessageFactory::generated_factory();
}

}  // namespace

void MessageBridge::read(const Message& message, const Layout& layout, Values& values) {
    if (!is_compiled(message)) return from_message(message, layout, values);
    if (!message.SerializePartialToString(&wire_)) throw DataError("the message is over 2 GB");
    read_binary(wire_, layout, values);
}

void MessageBridge::write(const Values& values, Message& message) {
    if (!is_compiled(message)) return to_message(values, message);
    wire_.clear();
    write_binary(values, wire_);
    message.ParsePartialFromString(wire_);
}

void read_text(std::string_view text, Pool& pool, const Layout& layout, Values& values) {
    const auto message = pool.new_message(*layout.descriptor);
    FirstFault fault;
    google::protobuf::TextFormat::Parser parser;
    parser.RecordErrorsTo(&fault);
    parser.AllowPartialMessage(true);
    parser.SetRecursionLimit(max_depth);
    if (!parser.ParseFromString(std::string(text), message.get())) {
        throw DataError(fault.what.empty() ? "not a message in text format" : fault.what);
    }
    from_message(*message, layout, values);
}

}  // namespace seautils::schema
