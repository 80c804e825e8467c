// Any text as JSON: what is read and written reads back the same; where protobuf's parser takes it
// too, both see the same message. Input: a byte that chooses the type, then the record.
#include "common.hpp"
#include "rich.hpp"

#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"

#include <google/protobuf/util/json_util.h>

using namespace seautils;

namespace {

/// JsonReader may look 64 bytes beyond the record, as a stream's records allow.
std::string padded(std::string_view text) { return std::string(text) + std::string(64, '\0'); }

void check_against_protobuf(std::string_view json, const schema::Layout& layout,
                            const schema::Values& values) {
    const auto message = fuzz::rich().pool.new_message(*layout.descriptor);
    google::protobuf::util::JsonParseOptions options;
    const std::string text(json);
    if (!google::protobuf::util::JsonStringToMessage(text, message.get(), options).ok()) return;
    schema::Values other;
    schema::from_message(*message, layout, other);
    fuzz::require(schema::equal(values, other), "protobuf's parser sees the same message");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const schema::Layout& layout = fuzz::rich().layout(data[0]);
    static schema::JsonReader reader;
    static schema::Values values, again;
    const std::string record = padded(fuzz::view(data + 1, size - 1));
    const std::string_view json(record.data(), size - 1);
    fuzz::accepted([&] { reader.type_of(json); });
    if (!fuzz::accepted([&] { reader.read(json, layout, values); })) return 0;
    std::string written;
    schema::write_json(values, written);
    fuzz::require(is_valid_utf8(written), "JSON is UTF-8");
    const std::string second = padded(written);
    reader.read(std::string_view(second).substr(0, written.size()), layout, again);
    fuzz::require(schema::equal(values, again), "what is written reads back the same");
    // Its parser drops the sign of -0, and does not know "@type" here.
    const bool comparable = json.find("@type") == json.npos && json.find("-0") == json.npos;
    if (comparable) check_against_protobuf(json, layout, values);
    return 0;
}
