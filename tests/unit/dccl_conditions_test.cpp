#include "seautils/dccl/conditions.hpp"

#include "seautils/core/error.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/schema/pool.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace seautils::dccl {
namespace {

constexpr const char* nav_proto = R"(
    syntax = "proto2";
    package t;
    enum State { IDLE = 1; RUN = 2; FAULT = 5; }
    message Leg { optional uint32 seq = 1; optional string name = 2; }
    message Nav {
      optional State state = 1;
      optional int32 base = 2;
      optional int32 with_default = 3 [default = 42];
      optional State state_default = 4 [default = FAULT];
      optional string text_default = 5 [default = "hi"];
      optional uint64 big = 6;
      optional int64 small = 7;
      optional double depth = 8;
      optional float speed = 9;
      optional bool on = 10;
      optional string name = 11;
      optional bytes raw = 12;
      optional Leg leg = 13;
      repeated int32 list = 14;
      repeated Leg legs = 15;
      oneof choice { int32 first = 16; string second = 17; }
      optional double double_default = 18 [default = 2.5];
      optional bool bool_default = 19 [default = true];
      optional uint32 camel_case = 20;
      repeated int32 empty = 21;
    })";

constexpr const char* new_proto = R"(
    syntax = "proto3";
    package n;
    enum State { UNKNOWN = 0; RUN = 1; }
    message Leg { uint32 seq = 1; }
    message Nav {
      State state = 1;
      int32 base = 2;
      string name = 3;
      bool on = 4;
      double depth = 5;
      optional int32 maybe = 6;
      Leg leg = 7;
      repeated int32 list = 8;
      oneof choice { int32 first = 9; }
    })";

class Conditions : public testing::Test {
protected:
    void use(const char* text, const std::string& type) {
        pool_.load_text(type + ".proto", text);
        layout_ = &pool_.layout(pool_.message(type));
        values_.reset(*layout_);
        self_ = {layout_, 0};
    }
    void SetUp() override { use(nav_proto, "t.Nav"); }

    std::uint32_t slot(const std::string& name, BlockRef in) const {
        return in.block + static_cast<std::uint32_t>(in.layout->find(name));
    }
    std::uint32_t slot(const std::string& name) const { return slot(name, {layout_, 0}); }
    void set(std::uint32_t at, std::int64_t i) {
        values_[at].i = i;
        values_[at].present = true;
    }
    void set(std::uint32_t at, std::uint64_t u) {
        values_[at].u = u;
        values_[at].present = true;
    }
    void set(std::uint32_t at, double d) {
        values_[at].d = d;
        values_[at].present = true;
    }
    void set(const std::string& name, auto value) { set(slot(name), value); }
    void set_list(const std::string& name, std::initializer_list<std::int64_t> numbers) {
        std::uint32_t at =
            values_.add_elements(slot(name), static_cast<std::uint32_t>(numbers.size()));
        for (const std::int64_t n : numbers) set(at++, n);
    }
    BlockRef add_leg(std::uint32_t at, std::uint64_t seq) {
        const schema::Layout& leg = *layout_->fields[slot("leg")].message;
        const BlockRef ref{&leg, values_.add_block(at, leg)};
        set(slot("seq", ref), seq);
        return ref;
    }

    bool test(const std::string& script) {
        return engine_.test(script, values_, {layout_, 0}, self_, index_);
    }
    std::optional<double> number(const std::string& script) {
        return engine_.number(script, values_, {layout_, 0}, self_, index_);
    }
    /// The error, without `condition '…': `.
    std::string reason(const std::string& script) {
        try {
            test(script);
        } catch (const DataError& e) {
            const std::string what = e.what();
            EXPECT_TRUE(what.starts_with("condition '")) << what;
            const std::size_t end = what.find("': ");
            EXPECT_NE(end, std::string::npos) << what;
            return what.substr(end + 3);
        }
        return "no error";
    }

    schema::Pool pool_;
    const schema::Layout* layout_ = nullptr;
    schema::Values values_;
    BlockRef self_{};
    std::uint32_t index_ = 1;
    ConditionEngine engine_;
};

TEST_F(Conditions, ReturnIsPutInFrontUnlessTheTextIsThere) {
    EXPECT_TRUE(test("1 == 1"));
    EXPECT_TRUE(test("return 1 == 1"));
    EXPECT_TRUE(test("local a = 1; return a == 1"));
    EXPECT_EQ(reason("this.returned"), "syntax error near <eof>");
}

TEST_F(Conditions, LuaTruth) {
    EXPECT_FALSE(test("nil"));
    EXPECT_FALSE(test("false"));
    EXPECT_FALSE(test("return"));
    EXPECT_TRUE(test("0"));
    EXPECT_TRUE(test("''"));
    EXPECT_TRUE(test("this"));
}

TEST_F(Conditions, Numbers) {
    EXPECT_EQ(number("3"), 3.0);
    EXPECT_EQ(number("2.5"), 2.5);
    EXPECT_EQ(number("nil"), std::nullopt);
    EXPECT_EQ(number("this.base"), std::nullopt);
    EXPECT_EQ(number("1/0"), HUGE_VAL);
    EXPECT_THROW(number("'3'"), DataError);
    EXPECT_THROW(number("true"), DataError);
    EXPECT_THROW(number("this"), DataError);
    EXPECT_THROW(number("0/0"), DataError);
}

TEST_F(Conditions, FieldsThatAreSet) {
    set("state", std::int64_t{2});
    set("base", std::int64_t{-7});
    set("depth", 10.5);
    set("speed", 0.5);
    set("on", std::int64_t{1});
    set("small", std::numeric_limits<std::int64_t>::min());
    values_.set_text(slot("name"), "auv");
    values_.set_text(slot("raw"), std::string_view("a\0b", 3));
    EXPECT_TRUE(test("this.state == 'RUN'"));
    EXPECT_TRUE(test("this.base == -7 and math.type(this.base) == 'integer'"));
    EXPECT_TRUE(test("this.depth == 10.5 and this.speed == 0.5"));
    EXPECT_TRUE(test("this.on == true"));
    EXPECT_TRUE(test("this.small == math.mininteger"));
    EXPECT_TRUE(test("this.name == 'auv' and this.name:upper() == 'AUV'"));
    EXPECT_TRUE(test("#this.raw == 3 and this.raw == 'a\\0b'"));
}

TEST_F(Conditions, UnsignedNumbersAboveTheSignedOnesAreFloats) {
    set("big", std::uint64_t{1} << 62);
    EXPECT_TRUE(test("this.big == 1 << 62 and math.type(this.big) == 'integer'"));
    set("big", std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(number("this.big"), 18446744073709551616.0);
    EXPECT_TRUE(test("math.type(this.big) == 'float'"));
}

TEST_F(Conditions, UnsetFieldsAreTheirExplicitDefaultOrNil) {
    for (const char* name : {"state", "base", "big", "depth", "speed", "on", "name", "raw", "leg",
                             "list", "legs", "first", "second", "empty"}) {
        EXPECT_TRUE(test(std::string("this.") + name + " == nil")) << name;
    }
    EXPECT_TRUE(test("this.with_default == 42"));
    EXPECT_TRUE(test("this.state_default == 'FAULT'"));
    EXPECT_TRUE(test("this.text_default == 'hi'"));
    EXPECT_TRUE(test("this.double_default == 2.5"));
    EXPECT_TRUE(test("this.bool_default == true"));
    set("with_default", std::int64_t{0});
    EXPECT_TRUE(test("this.with_default == 0"));
}

TEST_F(Conditions, NamesAreThoseOfTheSchema) {
    set("camel_case", std::uint64_t{3});
    EXPECT_TRUE(test("this.camel_case == 3"));
    EXPECT_TRUE(test("this.camelCase == nil"));
    EXPECT_TRUE(test("this.nothing == nil and this[1] == nil and this[true] == nil"));
}

TEST_F(Conditions, UndeclaredEnumeratorIsANumber) {
    set("state", std::int64_t{9});
    EXPECT_TRUE(test("this.state == 9"));
}

TEST_F(Conditions, AnOneofNamesItsMember) {
    EXPECT_TRUE(test("this.choice == nil"));
    values_.set_text(slot("second"), "x");
    EXPECT_TRUE(test("this.choice == 'second' and this.second == 'x' and this.first == nil"));
}

TEST_F(Conditions, SubMessagesThisAndRoot) {
    const BlockRef leg = add_leg(slot("leg"), 9);
    EXPECT_TRUE(test("this.leg.seq == 9 and this.leg.name == nil"));
    EXPECT_TRUE(test("this == root and this.leg == root.leg and this ~= this.leg"));
    self_ = leg;
    set("base", std::int64_t{4});
    EXPECT_TRUE(test("this.seq == 9 and root.base == 4 and this == root.leg and this ~= root"));
}

TEST_F(Conditions, RepeatedFields) {
    set_list("list", {5, 6, 7});
    EXPECT_TRUE(test("#this.list == 3 and this.list[1] == 5 and this.list[3] == 7"));
    EXPECT_TRUE(test("this.list[0] == nil and this.list[4] == nil and this.list[-1] == nil"));
    EXPECT_TRUE(test("this.list[1.0] == 5 and this.list[1.5] == nil and this.list.x == nil"));
    for (const char* each : {"ipairs", "pairs"}) {
        EXPECT_EQ(number(std::string("local s = 0 for i, v in ") + each +
                         "(this.list) do s = s + i * v end return s"),
                  5 + 12 + 21);
    }
    const std::uint32_t first = values_.add_elements(slot("legs"), 2);
    add_leg(first, 1);
    add_leg(first + 1, 2);
    EXPECT_TRUE(test("#this.legs == 2 and this.legs[2].seq == 2"));
    EXPECT_EQ(reason("pairs({})"), "pairs takes a repeated field only");
    EXPECT_EQ(reason("pairs(this)"), "pairs takes a repeated field only");
    EXPECT_TRUE(test("this.legs[1] == this.legs[1] and this.legs[1] ~= this.legs[2]"));
}

TEST_F(Conditions, NullElementsOfLegacyArraysAreNil) {
    set_list("list", {5, 6});
    values_[values_[slot("list")].aux + static_cast<std::uint32_t>(values_[slot("list")].u) - 1]
        .present = false;
    EXPECT_TRUE(test("#this.list == 2 and this.list[1] == 5 and this.list[2] == nil"));
}

TEST_F(Conditions, ThisIndexIsTheOneGiven) {
    index_ = 3;
    EXPECT_EQ(number("this_index"), 3.0);
    index_ = 4;
    EXPECT_EQ(number("this_index"), 4.0);
}

TEST_F(Conditions, Proto3FieldsHaveTheirTypesDefault) {
    use(new_proto, "n.Nav");
    EXPECT_TRUE(test("this.state == 'UNKNOWN' and this.base == 0 and this.name == ''"));
    EXPECT_TRUE(test("this.on == false and this.depth == 0"));
    EXPECT_TRUE(test("this.maybe == nil and this.leg == nil and this.first == nil"));
    EXPECT_TRUE(test("#this.list == 0 and this.list[1] == nil"));
    set("maybe", std::int64_t{0});
    EXPECT_TRUE(test("this.maybe == 0"));
}

TEST_F(Conditions, WhatTheValuesAreIsAskedAnew) {
    EXPECT_EQ(number("this.base"), std::nullopt);
    set("base", std::int64_t{1});
    EXPECT_EQ(number("this.base"), 1.0);
    schema::Values other;
    other.reset(*layout_);
    EXPECT_EQ(engine_.number("this.base", other, {layout_, 0}, {layout_, 0}, 1), std::nullopt);
}

TEST_F(Conditions, MovesWithItsScripts) {
    EXPECT_TRUE(test("this.base == nil"));
    ConditionEngine other = std::move(engine_);
    EXPECT_TRUE(other.test("this.base == nil", values_, {layout_, 0}, {layout_, 0}, 1));
    engine_ = std::move(other);
    EXPECT_TRUE(test("this.base == nil"));
}

TEST_F(Conditions, TypesAreThoseOfTables) {
    add_leg(slot("leg"), 1);
    EXPECT_TRUE(test("type(this) == 'table' and type(this.leg) == 'table'"));
    EXPECT_TRUE(test("type(this.base) == 'nil' and type(1) == 'number' and type('') == 'string'"));
}

TEST_F(Conditions, LibrariesThatAreLeft) {
    EXPECT_TRUE(test("tonumber('12') == 12 and tonumber('ff', 16) == 255"));
    EXPECT_TRUE(test("tostring(1) == '1' and tostring(nil) == 'nil' and tostring('x') == 'x'"));
    EXPECT_TRUE(test("select('#', 1, 2) == 2 and select(2, 'a', 'b') == 'b'"));
    EXPECT_TRUE(test("string.format('%d-%s-%.1f', 3, 'x', 0.5) == '3-x-0.5'"));
    EXPECT_TRUE(test("string.byte('A') == 65 and string.char(65) == 'A'"));
    EXPECT_TRUE(test("('abc'):sub(2, 2) == 'b' and ('abc'):reverse() == 'cba'"));
    EXPECT_TRUE(test("('aB'):lower() == 'ab' and ('abc'):len() == 3"));
    EXPECT_TRUE(test("math.floor(2.5) == 2 and math.abs(-1) == 1 and math.max(1, 2) == 2"));
}

TEST_F(Conditions, ReasonsAreOneLineWithoutAPlace) {
    try {
        test("this.base + 4");
        FAIL();
    } catch (const DataError& e) {
        EXPECT_STREQ(e.what(),
                     "condition 'this.base + 4': attempt to perform arithmetic on a nil value "
                     "(field 'base')");
    }
    EXPECT_EQ(reason("this.leg.seq"), "attempt to index a nil value (field 'leg')");
    EXPECT_EQ(reason("this.x()"), "attempt to call a nil value (field 'x')");
    EXPECT_EQ(reason("#this"), "attempt to get length of a message");
    EXPECT_EQ(reason("'a\nb' "), "unfinished string near ''a'");
}

TEST_F(Conditions, UnprintableScriptsAreQuotedOnOneLine) {
    const auto refusal = [this](const std::string& script) -> std::string {
        try {
            engine_.check(script);
        } catch (const ConfigError& e) {
            return e.what();
        }
        return "no error";
    };
    EXPECT_EQ(refusal("\x01 x"), "condition '\\x01 x': unexpected symbol near '<\\1>'");
    EXPECT_EQ(refusal("x =\n'\xff\t"), "condition 'x =\\x0a'\\xff\\x09': <eof> expected near '='");
    EXPECT_LT(refusal(std::string(4000, 'x') + " =").size(), 300U);
}

TEST_F(Conditions, CheckLooksAtTheSyntax) {
    engine_.check("this.a.b.c + 4");
    engine_.check("return this.a");
    EXPECT_THROW(engine_.check("this.a ="), ConfigError);
    EXPECT_THROW(engine_.check("(("), ConfigError);
    const std::string most = "1" + std::string(ConditionEngine::max_script_bytes - 1, ' ');
    engine_.check(most);
    EXPECT_THROW(engine_.check(most + " "), ConfigError);
    EXPECT_THROW(test(most + " "), DataError);
}

// Hostile scripts: each must be stopped, and the engine must work afterwards.

class HostileConditions : public Conditions {
protected:
    void TearDown() override {
        set("base", std::int64_t{1});
        EXPECT_TRUE(test("this.base == 1 and math.floor(1.5) == 1 and ('x'):upper() == 'X'"));
    }
};

constexpr const char* too_long = "runs for more than 100000 instructions";
constexpr const char* too_big = "takes too much memory";

TEST_F(HostileConditions, InfiniteLoops) {
    EXPECT_EQ(reason("while true do end return 1"), too_long);
    EXPECT_EQ(reason("repeat until false return 1"), too_long);
    EXPECT_EQ(reason("::a:: goto a return 1"), too_long);
    EXPECT_EQ(reason("for i = 1, math.huge do end return 1"), too_long);
    EXPECT_EQ(reason("local function f() return f() end return f()"), too_long);
    EXPECT_EQ(reason("for i = 1, 1e9 do local x = i .. '' end return 1"), too_long);
}

TEST_F(HostileConditions, AFewThousandInstructionsAreFine) {
    EXPECT_EQ(number("local s = 0 for i = 1, 10000 do s = s + i end return s"), 50005000.0);
}

TEST_F(HostileConditions, Memory) {
    EXPECT_EQ(reason("local s = 'x' while true do s = s .. s end return 1"), too_big);
    EXPECT_EQ(reason("local t = {} while true do t = {t, t, t, t, t, t, t, t} end return 1"),
              too_big);
    EXPECT_EQ(reason("local t = {} for i = 1, 1e9 do t[i] = i end return 1"), too_big);
    EXPECT_EQ(reason("local s = 'x' for i = 1, 40 do s = ('%s%s'):format(s, s) end return s"),
              too_big);
    values_.set_text(slot("name"), std::string(5000, 'x'));
    EXPECT_EQ(reason("this.name"), too_big);
    EXPECT_EQ(reason("('x'):rep(1e9)"), "attempt to call a nil value (method 'rep')");
}

TEST_F(HostileConditions, WhatOneRunLeavesBehindIsNotTheNextOnes) {
    // A list of a hundred and fifty thousand bytes, which lies in the stack's unused places afterwards.
    const std::string list = "local t = {} for i = 1, 1500 do t = {t, t, t} end return 1";
    const std::string endless = "local t = {} while true do t = {t, t, t} end return 1";
    for (int k = 0; k < 50; ++k) {
        EXPECT_EQ(number(list), 1.0);
        EXPECT_EQ(reason(endless), too_big);
        EXPECT_TRUE(test("('x'):upper() .. 1 == 'X1'"));
    }
}

TEST_F(HostileConditions, GarbageIsNotHeldAgainstThem) {
    set_list("list", {1, 2});
    EXPECT_EQ(number("local n = 0 for i = 1, 15000 do n = n + #this.list end return n"), 30000.0);
    for (int k = 0; k < 200; ++k) {
        EXPECT_EQ(number("local n = 0 for i = 1, 500 do n = n + #(i .. 'xxxxxxxx') end return n"),
                  500 * 8 + 9 + 90 * 2 + 401 * 3);
    }
}

TEST_F(HostileConditions, Recursion) {
    EXPECT_EQ(reason("local function f() return 1 + f() end return f()"), too_big);
    EXPECT_EQ(reason("local function f(...) return f(1, ...) end return f()"), too_big);
    EXPECT_EQ(reason("string.byte(('x'):rep(1))"), "attempt to call a nil value (method 'rep')");
}

TEST_F(HostileConditions, Nesting) {
    const std::string open(1500, '(');
    const std::string close(1500, ')');
    EXPECT_EQ(reason(open + "1" + close),
              "too many C levels (limit is 200) in main function near '('");
    EXPECT_THROW(engine_.check(std::string(4000, '{')), ConfigError);
    for (const char* each : {"- ", "not ", "1^", "''..", "function() return "}) {
        std::string script;
        while (script.size() < 4000) script += each;
        EXPECT_THROW(engine_.check(script + "1"), ConfigError) << each;
    }
}

TEST_F(HostileConditions, NothingOfTheSystemIsThere) {
    for (const char* name :
         {"os",           "io",           "debug",     "package",        "load",     "loadstring",
          "loadfile",     "dofile",       "require",   "collectgarbage", "pcall",    "xpcall",
          "error",        "assert",       "coroutine", "table",          "utf8",     "bit32",
          "print",        "next",         "rawget",    "rawset",         "rawequal", "rawlen",
          "getmetatable", "setmetatable", "_G",        "_VERSION",       "module",   "unpack",
          "setfenv",      "getfenv"}) {
        EXPECT_TRUE(test(std::string(name) + " == nil")) << name;
    }
    for (const char* name : {"string.rep", "string.find", "string.match", "string.gmatch",
                             "string.gsub", "string.dump", "string.pack", "string.unpack",
                             "string.packsize", "math.random", "math.randomseed"}) {
        EXPECT_TRUE(test(std::string(name) + " == nil")) << name;
    }
    EXPECT_EQ(reason("os.execute('true')"), "attempt to index a nil value (global 'os')");
    EXPECT_EQ(reason("('').dump(function() end)"), "attempt to call a nil value (field 'dump')");
    EXPECT_EQ(reason("return ('').find('aaaa', '.-b')"),
              "attempt to call a nil value (field 'find')");
}

TEST_F(HostileConditions, NothingCanBeChanged) {
    const char* const fixed = "globals and libraries cannot be changed";
    EXPECT_EQ(reason("x = 1 return x"), fixed);
    EXPECT_EQ(reason("this = 1 return 1"), fixed);
    EXPECT_EQ(reason("_ENV.tostring = 1 return 1"), fixed);
    EXPECT_EQ(reason("math.floor = nil return 1"), fixed);
    EXPECT_EQ(reason("string.upper = nil return 1"), fixed);
    EXPECT_EQ(reason("function f() end return 1"), fixed);
    EXPECT_EQ(reason("this.base = 1 return 1"), "messages cannot be changed");
    EXPECT_NE(reason("('x').upper = 1 return 1"), "no error");
    EXPECT_TRUE(test("local _ENV = {a = 1} a = 2 return a == 2"));
    EXPECT_TRUE(test("local math = 1 local this = 2 return this == 2"));
}

TEST_F(HostileConditions, ByteCodeIsRefused) {
    // The head of a file of Lua 5.3 byte code, "return" in its name so that nothing is put in
    // front.
    const std::string code("\x1bLua\x53\x00\x19\x93\r\n\x1a\nreturn", 18);
    EXPECT_EQ(reason(code), "attempt to load a binary chunk (mode is 't')");
    EXPECT_THROW(engine_.check(code), ConfigError);
    EXPECT_THROW(engine_.check(std::string("\x1bLua")), ConfigError);
}

TEST_F(HostileConditions, NoAddressesAreTold) {
    EXPECT_TRUE(test("tostring(this) == 'table' and tostring(math.floor) == 'function'"));
    EXPECT_TRUE(test("tostring({}) == 'table'"));
    EXPECT_EQ(reason("('%s'):format({})"), "bad argument #1 to 'format' (no plain value)");
    EXPECT_EQ(reason("string.format('%s', this)"), "bad argument #2 to 'format' (no plain value)");
}

TEST_F(HostileConditions, FinalizersAndMetatablesCannotBeMade) {
    EXPECT_EQ(reason("setmetatable({}, {__gc = function() while true do end end}) return 1"),
              "attempt to call a nil value (global 'setmetatable')");
    EXPECT_EQ(reason("error({}) return 1"), "attempt to call a nil value (global 'error')");
    EXPECT_TRUE(test("local t = {__gc = 1, __index = 2, __metatable = 3} return t.x == nil"));
    EXPECT_TRUE(test("this.__index == nil and this.__gc == nil and ('').__index == nil"));
}

TEST_F(HostileConditions, FormatsAreBounded) {
    EXPECT_NE(reason("('%99999d'):format(1)"), "no error");
    EXPECT_NE(reason("('%999.999f'):format(1)"), "no error");
    EXPECT_EQ(number("#('%99.99f'):format(-1e308)"), 410.0);  // 309 digits, sign, point, 99
}

TEST_F(HostileConditions, ManyArguments) {
    values_.set_text(slot("name"), std::string(4096, 'x'));
    EXPECT_EQ(number("select('#', this.name:byte(1, -1))"), 4096.0);
    EXPECT_EQ(reason("local function f(...) return f(1, ...) end return f(this.name:byte(1, -1))"),
              too_big);
}

TEST_F(HostileConditions, LongComparisonsTakeBoundedTime) {
    values_.set_text(slot("name"), std::string(4000, '7'));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(reason("local a, b = this.name .. 'a', this.name .. 'b' "
                     "while true do local x = a < b end return 1"),
              too_long);
    EXPECT_EQ(reason("local a = ' ' .. this.name while true do local x = a + 0 end return 1"),
              too_long);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_LT(took.count(), 10);  // seconds; with slow instrumentation
}

TEST_F(HostileConditions, AMessageHasABudgetOfItsOwn) {
    const std::string script = "for i = 1, 20000 do end return true";
    for (int k = 0; k < 2000; ++k) EXPECT_TRUE(test(script));
    engine_.start_message();
    int runs = 0;
    EXPECT_THROW(for (; runs < 2000; ++runs) test(script), DataError);
    EXPECT_GT(runs, 100);
    engine_.start_message();
    EXPECT_TRUE(test(script));
}

TEST_F(HostileConditions, ManyScriptsAreForgottenInTime) {
    for (int k = 0; k < 3000; ++k) {
        const std::string n = std::to_string(k);
        EXPECT_EQ(number("local t = {'" + n + "', 'a" + n + "', 'b" + n + "'} return #t + " + n),
                  3.0 + k);
    }
}

/// The codec gives each message its budget: a hostile schema costs bounded time for each.
TEST(ConditionsInCodec, AMessageHasABudgetOfItsOwn) {
    schema::Pool pool;
    pool.load_text("hostile.proto", R"(
        syntax = "proto2"; import "dccl/option_extensions.proto";
        message M { option (dccl.msg) = { id: 1 max_bytes: 8192 codec_version: 4 };
          repeated uint32 n = 1 [(dccl.field) = { min: 0 max: 255 max_repeat: 3000
            dynamic_conditions { omit_if: "for i = 1, 20000 do end return false" } }]; })");
    const schema::Layout& layout = pool.layout(pool.message("M"));
    const auto program = Program::compile(layout);
    Codec codec;
    codec.load(program);
    const auto message = [&](std::uint32_t count) {
        schema::Values values;
        values.reset(layout);
        const std::uint32_t first = values.add_elements(0, count);
        for (std::uint32_t k = 0; k < count; ++k) values[first + k].present = true;
        return values;
    };
    std::string bytes;
    EXPECT_THROW(codec.encode(*program, message(3000), bytes), DataError);
    for (int k = 0; k < 50; ++k) EXPECT_NO_THROW(codec.encode(*program, message(20), bytes));
    bytes.clear();
    codec.encode(*program, message(20), bytes);
    schema::Values back;
    for (int k = 0; k < 50; ++k) EXPECT_NO_THROW(codec.decode(bytes, back));
    // 2 + 12 bits of identifier and count, then 3000 elements: the decoder asks as often.
    EXPECT_THROW(codec.decode(std::string("\x02\xb8\x0b", 3) + std::string(3000, '\0'), back),
                 DataError);
}

}  // namespace
}  // namespace seautils::dccl
