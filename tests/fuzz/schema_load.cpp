// A hostile schema, and a frame that may be as hostile: loading, looking at, encoding and decoding
// end soon, in a value or in a refusal. Input: a .proto file, a zero byte, a frame.
#include "common.hpp"

#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/lint.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/pool.hpp"

using namespace seautils;

namespace {

void use(const std::shared_ptr<const dccl::Program>& program, std::string_view frame) {
    dccl::CodecOptions options;
    options.now_s = 1'700'000'000;
    options.lenient = frame.size() % 2 == 0;
    dccl::Codec codec(options);
    codec.load(program);
    schema::Values values;
    std::string bytes, json;
    dccl::lint(*program);
    fuzz::accepted([&] {
        dccl::typical_values(*program, options.now_s, values);
        codec.encode(*program, values, bytes);
        fuzz::require(bytes.size() <= program->largest_bytes(), "no frame is above the largest");
        codec.decode(bytes, values, program.get());
    });
    fuzz::accepted([&] {
        codec.decode(frame, values, program.get());
        schema::write_json(values, json);
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view input = fuzz::view(data, size);
    const std::size_t end = std::min(input.find('\0'), input.size());
    const std::string_view frame = end < size ? input.substr(end + 1) : std::string_view();
    schema::Pool pool;
    if (!fuzz::accepted(
            [&] { pool.load_text("input.proto", std::string(input.substr(0, end))); })) {
        return 0;
    }
    int left = 4;  // messages: more would be the same again
    for (const auto* descriptor : pool.messages()) {
        if (left-- == 0) break;
        fuzz::accepted([&] { use(dccl::Program::compile(pool.layout(*descriptor)), frame); });
    }
    return 0;
}
