// What our JSON reader takes, refuses and understands, held against protobuf's parser: token by token,
// and over documents that are put together, and broken, at random.
#include "fuzz/rich.hpp"

#include "seautils/core/error.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

namespace seautils::schema {
namespace {

using Strings = std::vector<std::string>;

/// What a reader makes of a text: values, or why not.
struct Outcome {
    std::optional<Values> values;
    std::string refusal;
};

Outcome ours(const std::string& text, const Layout& layout) {
    static JsonReader reader;
    Outcome outcome;
    Values values;
    try {
        reader.read(text, layout, values);
        outcome.values = std::move(values);
    } catch (const DataError& e) {
        outcome.refusal = e.what();
    }
    return outcome;
}

Outcome theirs(const std::string& text, const Layout& layout) {
    const auto message = fuzz::rich().pool.new_message(*layout.descriptor);
    const auto status = google::protobuf::util::JsonStringToMessage(text, message.get());
    if (!status.ok()) return {{}, std::string(status.message())};
    Values values;
    from_message(*message, layout, values);
    return {std::move(values), {}};
}

std::string written(const Values& values) {
    std::string text;
    write_json(values, text);
    return text;
}

const Layout& two() { return *fuzz::rich().two; }
const Layout& three() { return *fuzz::rich().three; }

std::string refusal(const std::string& text, const Layout& layout = two()) {
    const Outcome outcome = ours(text, layout);
    return outcome.values ? "taken: " + written(*outcome.values) : outcome.refusal;
}

bool is_in(const std::string& text, const Strings& list) {
    return std::find(list.begin(), list.end(), text) != list.end();
}

const Strings numbers{"0",
                      "-0",
                      "1",
                      "-1",
                      "2",
                      "7",
                      "1.0",
                      "2.0",
                      "1e0",
                      "1e2",
                      "1E2",
                      "1e+2",
                      "100e-2",
                      "1.50e1",
                      "15e-1",
                      "0.1",
                      "2.5",
                      "0.0",
                      "-0.0",
                      "-0e5",
                      "1e10",
                      "2147483647",
                      "2147483648",
                      "-2147483648",
                      "-2147483649",
                      "2147483647.0",
                      "2147483648.0",
                      "4294967295",
                      "4294967296",
                      "4294967295.0",
                      "9007199254740991",
                      "9007199254740992",
                      "9007199254740993",
                      "-9007199254740993",
                      "9223372036854775807",
                      "9223372036854775808",
                      "-9223372036854775808",
                      "-9223372036854775809",
                      "9223372036854775807.0",
                      "9.223372036854775e18",
                      "0.0000200000000000001600000003240321081",
                      "0.12345678901234567890123",
                      "0.000000000000000000000000000001",
                      "12345678901234567890.123456",
                      "100000000000000000000000000",
                      "0.30000000000000000000000000000000000001e3",
                      "1.00000000000000000000000000000000001",
                      "18446744073709551615",
                      "18446744073709551616",
                      "1.8446744073709552e19",
                      "1e-400",
                      "4.9e-325",
                      "5e-324",
                      "2.2250738585072014e-308",
                      "1.1754943508222875e-38",
                      "1e-46",
                      "3.4028234663852886e38",
                      "3.4028235e38",
                      "3.40282356e38",
                      "3.40282357e38",
                      "-3.40282357e38",
                      "1e39",
                      "1.7976931348623157e308",
                      "1e309",
                      "-1e400"};
const Strings no_json{"01",          "+1",          ".5",        "5.",       "1.e2",
                      "--1",         "0x10",        "NaN",       "Infinity", "nan",
                      "-Infinity",   "True",        "tru",       "'x'",      "",
                      "1 2",         "-",           "1e",        "\"\xff\"", "\"\xed\xa0\x80\"",
                      "\"\\ud83d\"", "\"\\ude00\"", "\"\\u12\"", "\"\\a\"",  "\"\t\"",
                      "\"\n\"",      "\"a"};
const Strings quoted{"\"\"",
                     "\"0\"",
                     "\"1\"",
                     "\"-1\"",
                     "\"2\"",
                     "\"7\"",
                     "\"1.0\"",
                     "\"1e2\"",
                     "\" 1\"",
                     "\"1 \"",
                     "\"+1\"",
                     "\"01\"",
                     "\"-0\"",
                     "\"0x10\"",
                     "\"NaN\"",
                     "\"nan\"",
                     "\"Infinity\"",
                     "\"-Infinity\"",
                     "\"inf\"",
                     "\"+Infinity\"",
                     "\"true\"",
                     "\"false\"",
                     "\"TRUE\"",
                     "\"9007199254740993\"",
                     "\"9223372036854775807\"",
                     "\"-9223372036854775808\"",
                     "\"9223372036854775808\"",
                     "\"18446744073709551615\"",
                     "\"2147483648\"",
                     "\"1.5\"",
                     "\".5\"",
                     "\"5.\"",
                     "\"1e400\"",
                     "\"1e-400\"",
                     "\"3.4028235e38\"",
                     "\"1e39\"",
                     "\"IDLE\"",
                     "\"RUN\"",
                     "\"STOP\"",
                     "\"idle\"",
                     "\"FAST\"",
                     "\"QUJD\"",
                     "\"QUI\"",
                     "\"QUI=\"",
                     "\"QUJ=\"",
                     "\"QQ\"",
                     "\"QR==\"",
                     "\"Q\"",
                     "\"QUJDQQ\"",
                     "\"QUJD \"",
                     "\"_-_-\"",
                     "\"+/+/\"",
                     "\"+/_-\"",
                     "\"a\\u00e9\"",
                     "\"\\ud83d\\ude00\"",
                     "\"\\u0000\"",
                     "\"\\/\\b\\f\\n\\r\\t\\\\\\\"\"",
                     "\"\xe2\x80\xa8\"",
                     "\"\x7f\"",
                     "\"😀é\""};
const Strings other{"null",   "true",         "false",       "[]",           "[null]",
                    "[[]]",   "{}",           "[{}]",        "[1]",          "[\"1\",2]",
                    "[true]", "[\"a\",\"\"]", "[2,\"RUN\"]", "[1.5,\"NaN\"]"};

Strings all_tokens() {
    Strings all = numbers;
    for (const Strings* more : {&no_json, &quoted, &other})
        all.insert(all.end(), more->begin(), more->end());
    return all;
}

bool is_integer(Kind kind) {
    return kind == Kind::int32 || kind == Kind::int64 || kind == Kind::uint32 ||
           kind == Kind::uint64 || kind == Kind::enumeration;
}

bool is_floating(Kind kind) { return kind == Kind::float32 || kind == Kind::float64; }

/// Tokens that protobuf's parser takes for this field and we do not: the header lists the reasons.
bool is_stricter(const Field& f, const std::string& token) {
    const bool number_kind = is_integer(f.kind) || is_floating(f.kind);
    if (f.repeated) return token != "null" && token.front() != '[';
    if (is_in(token, {"5.", "1.e2"})) return number_kind;
    if (token == "\"+1\"")
        return number_kind && (f.kind != Kind::enumeration || f.enumeration->open);
    if (token == "\"0x10\"" || token == "\"1e-400\"") return is_floating(f.kind);
    if (is_in(token, {"1e-400", "4.9e-325"})) return is_integer(f.kind);
    if (is_in(token, {"\"0\"", "\"1\"", "\"TRUE\""})) return f.kind == Kind::boolean;
    if (is_in(token, {"'x'", "\"\\a\"", "\"\t\"", "\"\n\""})) return f.kind == Kind::string;
    if (token == "-9223372036854775809") return f.kind == Kind::int64;
    return false;
}

/// Undeclared numbers of a closed enumeration are dropped there without a word.
bool is_dropped_enumerator(const Field& f, const Outcome& them) {
    return f.kind == Kind::enumeration && !f.enumeration->open && !f.repeated && them.values &&
           written(*them.values) == "{}";
}

/// Tokens that we take and protobuf's parser does not.
bool is_laxer(const Field& f, const std::string& token) {
    if (f.kind == Kind::bytes) return token == "\"+/_-\"";
    if (f.kind == Kind::float32) return token == "\"3.4028235e38\"";  // without quotes it is taken
    const bool open = f.kind == Kind::enumeration && f.enumeration->open;
    return open && is_in(token, {"\"-1\"", "\"2\"", "\"7\"", "\"2147483648\""});
}

/// Its parser drops the sign of the integer -0.
bool is_minus_zero(const std::string& token) { return token == "-0"; }

void compare(const Layout& layout, const Field& f, const std::string& token) {
    const std::string text = "{\"" + f.name + "\":" + token + "}";
    const Outcome us = ours(text, layout);
    const Outcome them = theirs(text, layout);
    SCOPED_TRACE(layout.full_name + " " + text + "\nours: " + us.refusal +
                 "\ntheirs: " + them.refusal);
    if (us.values && them.values) {
        const bool same = equal(*us.values, *them.values);
        EXPECT_TRUE(same || is_minus_zero(token))
            << written(*us.values) << " where it is " << written(*them.values);
    } else if (us.values) {
        EXPECT_TRUE(is_laxer(f, token)) << "taken by us alone";
    } else if (them.values) {
        EXPECT_TRUE(is_stricter(f, token) || is_dropped_enumerator(f, them) || f.repeated)
            << "refused by us alone";
    }
}

}  // namespace

TEST(SchemaJson, EveryTokenForEveryFieldIsAsProtobufHasIt) {
    for (const Layout* layout : {&two(), &three()}) {
        for (const Field& f : layout->fields) {
            if (f.wire_form == WireForm::group) continue;  // protobuf's JSON has none
            for (const std::string& token : all_tokens()) compare(*layout, f, token);
        }
    }
}

TEST(SchemaJson, TheListsOfDifferencesAreTrue) {
    for (const char* name :
         {"on", "i32", "i64", "u32", "u64", "single", "twofold", "name", "list"}) {
        const Field& f = two().fields[static_cast<std::size_t>(two().find(name))];
        for (const std::string& token : all_tokens()) {
            if (!is_stricter(f, token)) continue;
            const std::string text = "{\"" + f.name + "\":" + token + "}";
            EXPECT_FALSE(ours(text, two()).values) << text;
            if (!f.repeated) {
                EXPECT_TRUE(theirs(text, two()).values) << text;
            }
        }
    }
    EXPECT_TRUE(ours(R"({"raw":"+/_-"})", two()).values);
    EXPECT_FALSE(theirs(R"({"raw":"+/_-"})", two()).values);
    EXPECT_TRUE(ours(R"({"mode":"7"})", three()).values);
    EXPECT_FALSE(theirs(R"({"mode":"7"})", three()).values);
}

TEST(SchemaJson, ExtremesPassBothReaders) {
    using D = std::numeric_limits<double>;
    using F = std::numeric_limits<float>;
    const auto check = [](const char* field, auto set) {
        const Layout& layout = two();
        Values values;
        values.reset(layout);
        Slot& slot = values[static_cast<std::uint32_t>(layout.find(field))];
        set(slot);
        slot.present = true;
        const std::string text = written(values);
        for (const Outcome& outcome : {ours(text, layout), theirs(text, layout)}) {
            ASSERT_TRUE(outcome.values) << text << outcome.refusal;
            EXPECT_TRUE(equal(values, *outcome.values)) << text;
        }
    };
    for (const double x : {D::max(),
                           D::lowest(),
                           D::min(),
                           D::denorm_min(),
                           -D::denorm_min(),
                           D::epsilon(),
                           0.1,
                           1e21,
                           1e22,
                           1e23,
                           123456789012345678.0,
                           9007199254740991.0,
                           9007199254740992.0,
                           9007199254740994.0,
                           0.3,
                           1e-5,
                           1e-7,
                           5e-5,
                           D::infinity(),
                           -D::infinity(),
                           D::quiet_NaN()}) {
        check("twofold", [x](Slot& s) { s.d = x; });
    }
    for (const float x :
         {F::max(), F::lowest(), F::min(), F::denorm_min(), F::epsilon(), 0.1F, 16777216.0F,
          16777215.0F, 1e10F, 3.3e-7F, F::infinity(), F::quiet_NaN()}) {
        check("single", [x](Slot& s) { s.d = static_cast<double>(x); });
    }
    using I = std::numeric_limits<std::int64_t>;
    for (const std::int64_t x :
         {I::min(), I::max(), std::int64_t{1} << 53, (std::int64_t{1} << 53) + 1})
        check("i64", [x](Slot& s) { s.i = x; });
    check("u64", [](Slot& s) { s.u = std::numeric_limits<std::uint64_t>::max(); });
    check("i32", [](Slot& s) { s.i = std::numeric_limits<std::int32_t>::min(); });
    check("u32", [](Slot& s) { s.u = std::numeric_limits<std::uint32_t>::max(); });
}

namespace {

/// An element of a list, whose first elements shrink to the simplest.
std::string one_of(const Strings& list) { return *rc::gen::elementOf(list); }

std::string blank() { return one_of({"", "", "", " ", "\t", "\n", "\r\n "}); }

/// A name as it may be written: declared, in camel case, with an escape.
std::string any_key(const Field& f) {
    switch (*rc::gen::inRange(0, 5)) {
        case 0:
            return "\"" + f.json_name + "\"";
        case 1: {
            char escaped[8];
            std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(f.name[0]));
            return "\"" + std::string(escaped) + f.name.substr(1) + "\"";
        }
        default:
            return "\"" + f.name + "\"";
    }
}

/// Protobuf's parser takes lists in lists, and nothing behind the last comma.
bool is_loose_element(const std::string& token) { return token.empty() || token.front() == '['; }

/// The tokens that protobuf's parser takes for a field, or for an element of it.
const Strings& fitting(const Field& f) {
    static std::map<const void*, Strings> known;
    Strings& list = known[f.descriptor];
    if (!list.empty()) return list;
    Field one = f;
    one.repeated = false;
    const Layout& layout = f.descriptor->containing_type()->name() == "Two" ? two() : three();
    for (const std::string& token : all_tokens()) {
        const std::string value = f.repeated ? "[" + token + "]" : token;
        if (f.repeated && is_loose_element(token)) continue;
        if (is_stricter(one, token) || is_laxer(one, token)) continue;
        if (theirs("{\"" + f.name + "\":" + value + "}", layout).values) list.push_back(token);
    }
    return list;
}

/// A token that nearly always fits the field, and that both readers take or refuse.
std::string any_token(const Field& f) {
    if (*rc::gen::inRange(0, 50) != 0) return one_of(fitting(f));
    const std::string token = one_of(all_tokens());
    Field one = f;
    one.repeated = false;
    const bool loose = f.repeated && is_loose_element(token);
    return loose || is_stricter(one, token) || is_laxer(one, token) ? "null" : token;
}

std::string any_object(const Layout& layout, int depth);

std::string any_value(const Field& f, int depth) {
    return f.kind == Kind::message ? any_object(*f.message, depth - 1) : any_token(f);
}

std::string any_member(const Field& f, int depth) {
    if (!f.repeated) return any_value(f, depth);
    std::string text = "[";
    for (int n = *rc::gen::inRange(0, 4); n > 0; --n)
        text += blank() + any_value(f, depth) + blank() + (n > 1 ? "," : "");
    return text + "]";
}

/// Groups have no JSON in protobuf; of a oneof not too many members are named.
bool is_named(const Layout& layout, const Field& f, int depth) {
    if (f.wire_form == WireForm::group || (f.kind == Kind::message && depth <= 0)) return false;
    const bool choice = f.oneof >= 0 && !layout.oneofs[static_cast<std::size_t>(f.oneof)].synthetic;
    return *rc::gen::inRange(0, choice ? 15 : 5) == 0;
}

std::string any_object(const Layout& layout, int depth) {
    std::string text = "{";
    bool first = true;
    for (const Field& f : layout.fields) {
        if (!is_named(layout, f, depth)) continue;
        for (int times = *rc::gen::inRange(0, 100) == 0 ? 2 : 1; times > 0; --times, first = false)
            text += (first ? "" : ",") + blank() + any_key(f) + blank() + ":" + blank() +
                    any_member(f, depth) + blank();
    }
    return text + "}";
}

/// What protobuf's parser does not mind; token by token the tests above look.
bool may_refuse_alone(const std::string& why) {
    for (const char* reason : {"is given twice", "is null", "is not in enum"}) {
        if (why.find(reason) != why.npos) return true;
    }
    return false;
}

/// Both refuse the text, or see the same in it; returns whether they take it.
bool agree(const std::string& text, const Layout& layout) {
    const Outcome us = ours(text, layout);
    const Outcome them = theirs(text, layout);
    RC_LOG() << text << "\nours: " << us.refusal << "\ntheirs: " << them.refusal << "\n";
    if (us.values && them.values) {
        const bool signless = text.find("-0") != text.npos;  // its parser drops the sign
        RC_ASSERT(signless || equal(*us.values, *them.values));
        return true;
    }
    RC_ASSERT(!us.values);
    RC_ASSERT(!them.values || may_refuse_alone(us.refusal));
    return false;
}

}  // namespace

TEST(SchemaJson, RandomDocumentsMeanTheSameToBoth) {
    int taken = 0;
    EXPECT_TRUE(rc::check("documents", [&] {
        const Layout& layout = *rc::gen::arbitrary<bool>() ? two() : three();
        taken += agree(any_object(layout, 2), layout) ? 1 : 0;
    }));
    EXPECT_GT(taken, 20);
}

/// A document with a few characters changed: what is no JSON by RFC 8259 is refused, and what
/// protobuf's parser refuses too.
TEST(SchemaJson, BrokenDocumentsAreRefused) {
    int refused = 0;
    EXPECT_TRUE(rc::check("documents with faults", [&] {
        std::string text =
            R"({"on":true,"i32":-12,"i64":"340","single":1.5e2,"name":"a\u00e9 b",)"
            R"("sub_message":{"u32":7,"list":[1,20,3]},"names":["x","y"],"subs":[{}]})";
        for (int n = *rc::gen::inRange(1, 4); n > 0; --n) {
            const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
            const std::string with =
                one_of({"",     "{",    "}", "[",  "]", ",", ":",    "\"", "0",
                        "-",    ".",    "e", "\\", " ", "n", "true", "{}", std::string(1, '\0'),
                        "\xc3", "/**/", "#"});
            text.replace(at, *rc::gen::inRange<std::size_t>(0, 2), with);
        }
        RC_LOG() << text;
        const Outcome us = ours(text, two());
        if (!us.values) {
            ++refused;
            RC_ASSERT(us.refusal.size() < 300 && us.refusal.find('\n') == us.refusal.npos);
            return;
        }
        const bool is_json = nlohmann::json::accept(text);
        RC_ASSERT(is_json);
        const Outcome them = theirs(text, two());
        RC_LOG() << them.refusal;
        RC_ASSERT(them.values.has_value());
    }));
    EXPECT_GT(refused, 50);
}

TEST(SchemaJson, ARefusalNamesTheFieldTheValueAndTheBound) {
    EXPECT_EQ(refusal(R"({"i32":2147483648})"),
              "i32 '2147483648' is outside -2147483648 to 2147483647");
    EXPECT_EQ(refusal(R"({"u32":-1})"), "u32 '-1' is outside 0 to 4294967295");
    EXPECT_EQ(refusal(R"({"i32":1.5})"), "i32 '1.5' is not a whole number");
    EXPECT_EQ(refusal(R"({"subs":[{},{"sub_message":{"list":[1,"x"]}}]})"),
              "subs[1].sub_message.list[1] 'x' is not a whole number");
    EXPECT_EQ(refusal(R"({"nam":1})"),
              "field 'nam' is not in message rich.Two (did you mean 'name'?)");
    EXPECT_EQ(refusal(R"({"subs":[{"zzz":1}]})"),
              "field 'zzz' is not in message rich.Two (at subs[0])");
    EXPECT_EQ(refusal(R"({"state":"RUNN"})"),
              "state 'RUNN' is not in enum rich.State (did you mean 'RUN'?)");
    EXPECT_EQ(refusal(R"({"state":7})"), "state 7 is not in enum rich.State");
    EXPECT_EQ(refusal(R"({"first":1,"second":"QQ"})"),
              "second and 'first' exclude each other (oneof)");
    EXPECT_EQ(refusal(R"({"name":"a","name":"b"})"), "name is given twice");
    EXPECT_EQ(refusal(R"({"sub_message":3})"), "sub_message is not an object");
    EXPECT_EQ(refusal(R"({"twofold":1e999})"), "twofold '1e999' is beyond the range of its type");
    EXPECT_EQ(refusal(R"({"twofold":"1e999"})"), "twofold '1e999' is beyond the range of its type");
    EXPECT_EQ(refusal(R"({"raw":"?"})"), "raw '?' is not base64");
    EXPECT_EQ(refusal("[]"), "the record is not a JSON object");
    EXPECT_EQ(refusal("{} {}"), "something follows the JSON object");
    EXPECT_EQ(refusal("\xEF\xBB\xBF{}"), "the record begins with a byte order mark");
    EXPECT_EQ(refusal(std::string("{}\0", 3)), "a NUL byte is not JSON");
    EXPECT_EQ(refusal("{\"name\":\"\xff\"}"), "not valid JSON: it is not UTF-8");
}

TEST(SchemaJson, TheTypeThatARecordNames) {
    JsonReader reader;
    EXPECT_EQ(reader.type_of(R"({"on":true})"), "");
    EXPECT_EQ(reader.type_of(R"({"@type":"rich.Two"})"), "rich.Two");
    EXPECT_EQ(reader.type_of(R"({"on":true,"@type":"type.googleapis.com/rich.Two"})"), "rich.Two");
    EXPECT_EQ(reader.type_of(R"({"sub_message":{"@type":"inner"},"@type":"outer"})"), "outer");
    EXPECT_EQ(reader.type_of(R"({"sub_message":{"@type":"inner"}})"), "");
    for (const char* bad : {R"({"@type":1})", "[]", "", "x", R"({"@type":)", R"({"@type"})"})
        EXPECT_THROW(reader.type_of(bad), DataError) << bad;
    // It is no field, and only stands at the top.
    EXPECT_EQ(refusal(R"({"@type":"rich.Two","on":true})"), R"(taken: {"on":true})");
    EXPECT_EQ(refusal(R"({"sub_message":{"@type":"rich.Two"}})"),
              "field '@type' is not in message rich.Two (at sub_message)");
}

TEST(SchemaJson, ATextThatIsNoUtf8IsWrittenAsJsonAllTheSame) {
    Values values;
    values.reset(two());
    values.set_text(static_cast<std::uint32_t>(two().find("name")), "a\xff\xe2\x82z\x80");
    EXPECT_EQ(written(values), "{\"name\":\"a\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDz\xEF\xBF\xBD\"}");
    std::string typed;
    write_json(values, typed, "rich.Two");
    EXPECT_TRUE(typed.starts_with("{\"@type\":\"rich.Two\",\"name\":"));
    values.reset(two());
    typed.clear();
    write_json(values, typed, "rich.Two");
    EXPECT_EQ(typed, "{\"@type\":\"rich.Two\"}");
}

}  // namespace seautils::schema
