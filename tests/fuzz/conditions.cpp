// Any script: it ends soon, in a value or in an error of one line, twice the same, and leaves the
// engine as it was. Input: a byte of switches, then the script.
#include "seautils/dccl/conditions.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/schema/pool.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>

using namespace seautils;

namespace {

constexpr const char* proto = R"(
    syntax = "proto2";
    enum State { IDLE = 1; RUN = 2; }
    message M {
      optional State state = 1;
      optional int32 base = 2 [default = 7];
      optional uint64 big = 3;
      optional double depth = 4;
      optional bool on = 5;
      optional string name = 6;
      optional M sub = 7;
      repeated int32 list = 8;
      repeated M subs = 9;
      oneof choice { int32 first = 10; bytes second = 11; }
    })";

/// A message with something in every field, two levels deep.
class Sample {
public:
    Sample() {
        pool_.load_text("m.proto", proto);
        layout = &pool_.layout(pool_.message("M"));
        values.reset(*layout);
        fill(0);
        sub = values.add_block(6, *layout);
        fill(sub);
    }

    const schema::Layout* layout = nullptr;
    schema::Values values;
    std::uint32_t sub = 0;

private:
    void fill(std::uint32_t block) {
        for (const std::uint32_t field : {0U, 2U, 3U, 4U}) {
            values[block + field].present = true;
            if (field == 3)
                values[block + field].d = 2.5;
            else
                values[block + field].i = field == 2 ? -1 : 1;
        }
        values.set_text(block + 5, "auv");
        values.set_text(block + 10, std::string("\0\xff", 2));
        const std::uint32_t list = values.add_elements(block + 7, 3);
        for (std::uint32_t k = 0; k < 3; ++k) {
            values[list + k].i = k;
            values[list + k].present = true;
        }
        values.add_block(values.add_elements(block + 8, 1), *layout);
    }

    schema::Pool pool_;
};

std::string outcome(dccl::ConditionEngine& engine, const std::string& script, const Sample& sample,
                    std::uint8_t switches) {
    const dccl::BlockRef root{sample.layout, 0};
    const dccl::BlockRef self{sample.layout, (switches & 1) != 0 ? sample.sub : 0};
    const std::uint32_t index = switches >> 2;
    try {
        if ((switches & 2) != 0) {
            return engine.test(script, sample.values, root, self, index) ? "true" : "false";
        }
        const auto number = engine.number(script, sample.values, root, self, index);
        return number ? std::to_string(*number) : "nothing";
    } catch (const DataError& e) {
        const std::string what = e.what();
        if (what.size() > 500) std::abort();
        if (!is_valid_utf8(what) || what.find('\n') != std::string::npos) std::abort();
        return what;
    }
}

void check(dccl::ConditionEngine& engine, const std::string& script) {
    try {
        engine.check(script);
    } catch (const ConfigError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Sample sample;
    static dccl::ConditionEngine kept;
    if (size == 0) return 0;
    const std::string script(reinterpret_cast<const char*>(data) + 1, size - 1);
    check(kept, script);
    kept.start_message();
    const std::string first = outcome(kept, script, sample, data[0]);
    dccl::ConditionEngine fresh;
    if (outcome(fresh, script, sample, data[0]) != first) std::abort();
    if (outcome(fresh, script, sample, data[0]) != first) std::abort();
    const std::string probe = "this.base == 7 and math.floor(1.5) == 1 and ('x'):upper() == 'X'";
    if (outcome(kept, probe, sample, 2) != "true") std::abort();
    return 0;
}
