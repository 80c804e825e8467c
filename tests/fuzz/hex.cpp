// Any text as hexadecimal and as base64: what is read, written and read again is the same.
#include "common.hpp"

#include "seautils/stream/hex.hpp"

using namespace seautils;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::view(data, size);
    std::string bytes, written, again;
    if (fuzz::accepted([&] { stream::from_hex(text, bytes); })) {
        stream::append_hex(written, bytes);
        stream::from_hex(written, again);
        fuzz::require(bytes == again, "hexadecimal reads back the same");
    }
    if (fuzz::accepted([&] { bytes = from_base64(text); })) {
        written.clear();
        append_base64(written, bytes);
        fuzz::require(from_base64(written) == bytes, "base64 reads back the same");
    }
    written.clear();
    stream::append_hex(written, text);
    stream::from_hex(written, again);
    fuzz::require(again == text, "any bytes pass as hexadecimal");
    written.clear();
    append_base64(written, text);
    fuzz::require(from_base64(written) == text, "any bytes pass as base64");
    return 0;
}
