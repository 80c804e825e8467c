// Two message types with a field of every kind, for the readers and writers of `schema`.
#ifndef SEAUTILS_TESTS_FUZZ_RICH_HPP
#define SEAUTILS_TESTS_FUZZ_RICH_HPP

#include "seautils/schema/pool.hpp"
#include "seautils/schema/values.hpp"

namespace fuzz {

inline constexpr const char* rich2 = R"(
    syntax = "proto2"; package rich;
    enum State { IDLE = 0; RUN = 2; STOP = -1; }
    message Two {
      optional bool on = 1; optional int32 i32 = 2; optional int64 i64 = 3;
      optional uint32 u32 = 4; optional uint64 u64 = 5; optional sint32 s32 = 6;
      optional sint64 s64 = 7; optional fixed32 f32 = 8; optional fixed64 f64 = 9;
      optional sfixed32 sf32 = 10; optional sfixed64 sf64 = 11; optional float single = 12;
      optional double twofold = 13; optional string name = 14; optional bytes raw = 15;
      optional State state = 16; optional Two sub_message = 17;
      repeated int32 list = 18; repeated sint64 packed_list = 19 [packed = true];
      repeated string names = 20; repeated Two subs = 21; repeated State states = 22;
      repeated double doubles = 23 [packed = true]; optional group Grp = 24 { optional int32 g = 1; }
      oneof choice { int32 first = 25; bytes second = 26; Two third = 27; }
      optional int32 far_away = 100000;
    })";
inline constexpr const char* rich3 = R"(
    syntax = "proto3"; package rich;
    enum Mode { NONE = 0; SLOW = 1; FAST = 5; }
    message Three {
      bool on = 1; int32 i32 = 2; int64 i64 = 3; uint32 u32 = 4; uint64 u64 = 5; sint32 s32 = 6;
      float single = 7; double twofold = 8; string name = 9; bytes raw = 10; Mode mode = 11;
      Three sub_message = 12; repeated int32 list = 13; repeated string names = 14;
      repeated Mode modes = 15; repeated Three subs = 16; optional int32 maybe = 17;
      oneof choice { int32 first = 18; string second = 19; }
    })";

struct Rich {
    Rich() {
        pool.load_text("rich2.proto", rich2);
        pool.load_text("rich3.proto", rich3);
        two = &pool.layout(pool.message("rich.Two"));
        three = &pool.layout(pool.message("rich.Three"));
    }
    const seautils::schema::Layout& layout(unsigned choice) const {
        return choice % 2 == 0 ? *two : *three;
    }
    seautils::schema::Pool pool;
    const seautils::schema::Layout* two;
    const seautils::schema::Layout* three;
};

inline Rich& rich() {
    static Rich rich;
    return rich;
}

}  // namespace fuzz

#endif  // SEAUTILS_TESTS_FUZZ_RICH_HPP
