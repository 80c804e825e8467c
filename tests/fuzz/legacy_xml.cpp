// A hostile XML of DCCL 1, and a frame: loading and decoding end soon; what is decoded and encoded
// decodes to the same. Input: the XML, a zero byte, a frame.
#include "common.hpp"

#include "seautils/dccl/legacy_codec.hpp"
#include "seautils/schema/json.hpp"

using namespace seautils;

namespace {

void use(const dccl::LegacyMessage& message, std::string_view frame) {
    dccl::LegacyOptions options;
    options.now_s = 1'300'000'000;
    schema::Values values, again;
    if (!fuzz::accepted([&] { dccl::decode(message, frame, options, values); })) return;
    std::string json, bytes;
    schema::write_json(values, json);
    if (!fuzz::accepted([&] { dccl::encode(message, values, options, bytes); })) return;
    fuzz::require(bytes.size() <= message.largest_bytes(), "no frame is above the largest");
    dccl::decode(message, bytes, options, again);
    fuzz::require(schema::equal(values, again), "decode(encode(decode(b))) is decode(b)");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view input = fuzz::view(data, size);
    const std::size_t end = std::min(input.find('\0'), input.size());
    const std::string_view frame = end < size ? input.substr(end + 1) : std::string_view();
    schema::LayoutSet layouts;
    fuzz::accepted([&] {
        const dccl::LegacySchema schema =
            dccl::parse_legacy("input.xml", input.substr(0, end), layouts);
        int left = 4;
        for (const dccl::LegacyMessage& message : schema.messages) {
            if (left-- == 0) break;
            use(message, frame);
        }
    });
    return 0;
}
