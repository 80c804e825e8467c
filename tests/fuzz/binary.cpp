// Any bytes as protobuf's binary form: what is written reads back the same; where protobuf's parser
// takes them too, both see the same message. Input: a byte that chooses the type, then the record.
#include "common.hpp"
#include "rich.hpp"

#include "seautils/schema/message.hpp"

using namespace seautils;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    fuzz::Rich& rich = fuzz::rich();
    const schema::Layout& layout = rich.layout(data[0]);
    static schema::Values values, again;
    const std::string_view bytes = fuzz::view(data + 1, size - 1);
    if (!fuzz::accepted([&] { schema::read_binary(bytes, layout, values); })) return 0;
    std::string written;
    schema::write_binary(values, written);
    schema::read_binary(written, layout, again);
    fuzz::require(schema::equal(values, again), "what is written reads back the same");
    const auto message = rich.pool.new_message(*layout.descriptor);
    if (!message->ParsePartialFromString(std::string(bytes))) return 0;
    fuzz::accepted([&] {
        schema::from_message(*message, layout, again);
        fuzz::require(schema::equal(values, again), "protobuf's parser sees the same message");
    });
    return 0;
}
