// Any text as protobuf's text format: what is written reads back the same.
// Input: a byte that chooses the type, then the record.
#include "common.hpp"
#include "rich.hpp"

#include "seautils/schema/message.hpp"

using namespace seautils;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    fuzz::Rich& rich = fuzz::rich();
    const schema::Layout& layout = rich.layout(data[0]);
    static schema::Values values, again;
    const std::string_view text = fuzz::view(data + 1, size - 1);
    if (!fuzz::accepted([&] { schema::read_text(text, rich.pool, layout, values); })) return 0;
    std::string written;
    schema::write_text(values, written);
    fuzz::require(written.find('\n') == written.npos, "a record is one line");
    schema::read_text(written, rich.pool, layout, again);
    fuzz::require(schema::equal(values, again), "what is written reads back the same");
    return 0;
}
