// Encodes one message with the installed library and prints its bytes.
#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/program.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/pool.hpp"
#include "seautils/schema/values.hpp"

#include <cstdio>
#include <string>

using namespace seautils;

int main() {
    schema::Pool pool;
    pool.load_text("order.proto", R"(
        syntax = "proto2";
        import "dccl/option_extensions.proto";
        message Order {
          option (dccl.msg) = { id: 170 max_bytes: 8 codec_version: 4 };
          required uint32 z = 9 [(dccl.field) = { min: 0 max: 15 }];
          required uint32 a = 1 [(dccl.field) = { min: 0 max: 255 }];
          required bool m = 5;
        })");
    const schema::Layout& layout = pool.layout(pool.message("Order"));
    const auto program = dccl::Program::compile(layout, {});

    schema::Values values;
    schema::JsonReader().read(R"({"z":10,"a":200,"m":true})", layout, values);
    std::string bytes;
    dccl::Codec codec;
    codec.load(program);
    codec.encode(*program, values, bytes);

    for (const char c : bytes)
        std::printf("%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    std::printf("\n");
}
