// Any bytes as a record, in either form: what is taken comes back the same, and nothing of it is lost
// on the way through the other form. Input: a byte that chooses the form, then the record.
#include "common.hpp"

#include "seautils/record/codec.hpp"

using namespace seautils;
using record::Form;

namespace {

std::string_view unframed(std::string_view bytes, Form form) {
    if (form == Form::ndjson) return bytes.substr(0, bytes.size() - 1);
    return bytes.substr((static_cast<unsigned char>(bytes[0]) & 0x80) != 0 ? 2 : 1);
}

Form other(Form form) { return form == Form::ndjson ? Form::delimited : Form::ndjson; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const Form form = (data[0] & 1) != 0 ? Form::delimited : Form::ndjson;
    const std::string_view bytes = fuzz::view(data + 1, size - 1);
    if (form == Form::ndjson && bytes.find('\n') != bytes.npos) return 0;  // two lines
    fuzz::context.assign(bytes);
    record::Codec codec;
    record::Record first, second;
    if (!fuzz::accepted([&] { codec.read(bytes, form, first); })) return 0;
    std::string written, again, converted, back;
    const bool known = first.kind.index() != 0;
    if (known && fuzz::accepted([&] { codec.write(first, form, written); })) {
        fuzz::require(written.size() <= record::max_bytes,
                      "a record is not longer than a pipe takes");
        codec.read(unframed(written, form), form, second);
        codec.write(second, form, again);
        fuzz::require(again == written, "what is written is read again");
    }
    if (!fuzz::accepted([&] { codec.convert(bytes, form, other(form), converted); })) return 0;
    codec.read(unframed(converted, other(form)), other(form), second);
    fuzz::require(second.kind.index() == first.kind.index(), "the other form holds the same kind");
    if (!known) return 0;
    std::string a, b;
    const bool fits = fuzz::accepted([&] { codec.write(first, Form::delimited, a); });
    if (fits) codec.write(second, Form::delimited, b);
    fuzz::require(a == b, "the other form holds the same record");
    return 0;
}
