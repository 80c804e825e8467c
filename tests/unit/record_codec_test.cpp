// Records: the structs against record.proto, both forms against protobuf's own, and what this
// version does not know.
#include "seautils/record/codec.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/time.hpp"
#include "seautils/record/fields.hpp"
#include "seautils/schema/pool.hpp"

#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <random>

namespace seautils::record {
namespace {

using google::protobuf::util::MessageDifferencer;

schema::Pool& pool() {
    static schema::Pool pool = [] {
        schema::Pool made;
        made.load(SEAUTILS_SOURCE_DIR "/schemas/seautils/record.proto");
        return made;
    }();
    return pool;
}

std::unique_ptr<google::protobuf::Message> new_record() {
    return pool().new_message(pool().message("seautils.Record"));
}

void expect_same(const schema::Layout& ours, const schema::Layout& theirs) {
    SCOPED_TRACE(ours.full_name);
    EXPECT_EQ(ours.full_name, theirs.full_name);
    EXPECT_EQ(ours.timestamp, theirs.timestamp);
    ASSERT_EQ(ours.fields.size(), theirs.fields.size());
    for (std::size_t k = 0; k < ours.fields.size(); ++k) {
        const schema::Field& a = ours.fields[k];
        const schema::Field& b = theirs.fields[k];
        SCOPED_TRACE(b.name);
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.number, b.number);
        EXPECT_EQ(a.kind, b.kind);
        EXPECT_EQ(a.wire_form, b.wire_form);
        EXPECT_EQ(a.repeated, b.repeated);
        EXPECT_EQ(a.packed, b.packed);
        EXPECT_EQ(a.required, b.required);
        EXPECT_EQ(a.has_presence, b.has_presence || b.repeated);
        EXPECT_EQ(a.oneof, b.oneof);
        ASSERT_EQ(a.message != nullptr, b.message != nullptr);
        if (a.message != nullptr) expect_same(*a.message, *b.message);
        ASSERT_EQ(a.enumeration != nullptr, b.enumeration != nullptr);
        if (a.enumeration == nullptr) continue;
        EXPECT_EQ(a.enumeration->full_name, b.enumeration->full_name);
        ASSERT_EQ(a.enumeration->values.size(), b.enumeration->values.size());
        for (std::size_t v = 0; v < a.enumeration->values.size(); ++v) {
            EXPECT_EQ(a.enumeration->values[v].name, b.enumeration->values[v].name);
            EXPECT_EQ(a.enumeration->values[v].number, b.enumeration->values[v].number);
        }
    }
}

TEST(RecordCodec, TheStructsAreThoseOfTheSchema) {
    expect_same(layout(), pool().layout(pool().message("seautils.Record")));
}

/// Random records of any kind, of every field.
class Filler {
public:
    explicit Filler(std::uint64_t seed) : random_(seed) {}

    Record record() {
        Record r;
        fill(r.time);
        const std::size_t wanted = random_() % (std::variant_size_v<decltype(r.kind)> - 1) + 1;
        std::size_t k = 0;
        kinds([&]<class Struct>(std::int32_t, const char*, Of<Struct>) {
            if (++k == wanted) fill(r.kind.emplace<Struct>());
        });
        return r;
    }

private:
    template <class T>
    void fill(T& to) {
        if constexpr (std::is_same_v<T, UtcTime>)
            to.ns = static_cast<std::int64_t>(random_() >> 1) / (random_() % 2 == 0 ? 1 : 1000) /
                    1000 * (random_() % 2 == 0 ? 1000 : 1);
        else if constexpr (std::is_same_v<T, bool>)
            to = random_() % 2 == 0;
        else if constexpr (std::is_same_v<T, double>)
            to = static_cast<double>(static_cast<std::int64_t>(random_())) / 4096 / 4096;
        else if constexpr (std::is_arithmetic_v<T>)
            to = static_cast<T>(random_() >> (random_() % 60));
        else if constexpr (std::is_enum_v<T>)
            to = static_cast<T>(random_() % Names<T>::values.size());
        else
            fields(Of<T>(), [&](std::int32_t, const char* name, auto member, auto... tag) {
                one(to.*member, sizeof...(tag) > 0, name);
            });
    }
    template <class T>
    void one(T& to, bool, const char*) {
        fill(to);
    }
    void one(std::string& to, bool bytes, const char*) { to = text(bytes); }
    template <class T>
    void one(std::optional<T>& to, bool, const char*) {
        if (random_() % 2 == 0) fill(to.emplace());
    }
    template <class T>
    void one(std::vector<T>& to, bool bytes, const char* name) {
        to.resize(random_() % 4);
        for (T& x : to) {
            if constexpr (std::is_same_v<T, std::string>)
                one(x, bytes, name);
            else
                fill(x);
        }
    }
    std::string text(bool bytes) {
        std::string s;
        for (std::size_t n = random_() % 12; n > 0; --n)
            s += bytes ? std::string(1, static_cast<char>(random_()))
                       : std::string(std::array{"a", "\"", "\\", "\n", "µ", "\x01"}[random_() % 6]);
        return s;
    }

    std::mt19937_64 random_;
};

std::string written(Codec& codec, const Record& r, Form form) {
    std::string out;
    codec.write(r, form, out);
    return out;
}

std::string unframed(std::string_view framed, Form form) {
    if (form == Form::ndjson) return std::string(framed.substr(0, framed.size() - 1));
    return std::string(framed.substr((framed[0] & 0x80) != 0 ? 2 : 1));
}

TEST(RecordCodec, BothFormsAreProtobufs) {
    Codec codec;
    Filler filler(1);
    for (int k = 0; k < 3000; ++k) {
        const Record r = filler.record();
        const std::string json = written(codec, r, Form::ndjson);
        const std::string binary = written(codec, r, Form::delimited);
        EXPECT_EQ(json.find('\n'), json.size() - 1);
        const auto of_json = new_record(), of_binary = new_record();
        ASSERT_TRUE(
            google::protobuf::util::JsonStringToMessage(unframed(json, Form::ndjson), of_json.get())
                .ok())
            << json;
        ASSERT_TRUE(of_binary->ParseFromString(unframed(binary, Form::delimited)));
        EXPECT_TRUE(MessageDifferencer::Equals(*of_json, *of_binary)) << json;
        EXPECT_TRUE(of_binary->GetReflection()->GetUnknownFields(*of_binary).empty());
    }
}

TEST(RecordCodec, WhatIsWrittenIsReadAgain) {
    Codec codec;
    Filler filler(2);
    for (int k = 0; k < 3000; ++k) {
        const Record r = filler.record();
        const std::string json = written(codec, r, Form::ndjson);
        for (const Form form : {Form::ndjson, Form::delimited}) {
            Record again = filler.record();  // nothing of what was there may stay
            codec.read(unframed(written(codec, r, form), form), form, again);
            EXPECT_EQ(written(codec, again, Form::ndjson), json);
        }
    }
}

TEST(RecordCodec, ConvertingThereAndBackChangesNothing) {
    Codec codec;
    Filler filler(3);
    for (int k = 0; k < 1000; ++k) {
        const std::string json = written(codec, filler.record(), Form::ndjson);
        std::string binary, again;
        codec.convert(unframed(json, Form::ndjson), Form::ndjson, Form::delimited, binary);
        codec.convert(unframed(binary, Form::delimited), Form::delimited, Form::ndjson, again);
        EXPECT_EQ(again, json);
    }
}

TEST(RecordCodec, AnExample) {
    Record r;
    r.time.ns = 1'714'564'825'250'000'000;
    Ack ack;
    ack.src = 2;
    ack.dest = 1;
    ack.transmission = 7;
    ack.frame = {0, 2};
    r.kind = ack;
    Codec codec;
    EXPECT_EQ(written(codec, r, Form::ndjson),
              "{\"time\":\"2024-05-01T12:00:25.250Z\",\"ack\":"
              "{\"src\":2,\"dest\":1,\"transmission\":7,\"frame\":[0,2]}}\n");
    EXPECT_EQ(kind_name(r), "ack");
}

TEST(RecordCodec, WhatIsNotKnownIsSkipped) {
    Codec codec;
    Record r;
    codec.read(
        R"({"time":"2024-05-01T12:00:25Z","ack":{"src":2,"new":{"a":[1,{"b":null}]}},"z":1})",
        Form::ndjson, r);
    ASSERT_NE(r.as<Ack>(), nullptr);
    EXPECT_EQ(r.as<Ack>()->src, 2U);
    codec.read(R"({"brand_new":{"x":1}})", Form::ndjson, r);
    EXPECT_EQ(r.kind.index(), 0U);
    EXPECT_EQ(kind_name(r), "unknown");
    codec.read(R"({"result":{"outcome":"EATEN_BY_A_WHALE","transmission":3}})", Form::ndjson, r);
    ASSERT_NE(r.as<Result>(), nullptr);
    EXPECT_EQ(r.as<Result>()->transmission, 3U);
    codec.read("\xa2\x06\x01x", Form::delimited, r);  // field 100
    EXPECT_EQ(r.kind.index(), 0U);
}

TEST(RecordCodec, WhatIsNotKnownSurvivesTheOtherForm) {
    Codec codec;
    const std::string line = R"({"ack":{"src":2,"new":[1]},"other":"x"})";
    std::string binary, again;
    codec.convert(line, Form::ndjson, Form::delimited, binary);
    Record r;
    codec.read(unframed(binary, Form::delimited), Form::delimited, r);
    ASSERT_NE(r.as<Ack>(), nullptr);
    EXPECT_EQ(r.as<Ack>()->src, 2U);
    codec.convert(unframed(binary, Form::delimited), Form::delimited, Form::ndjson, again);
    EXPECT_EQ(again, line + "\n");

    const std::string bytes("\x32\x02\x08\x02\xa2\x06\x01x", 8);  // ack { src: 2 }, field 100
    std::string json, back;
    codec.convert(bytes, Form::delimited, Form::ndjson, json);
    codec.read(unframed(json, Form::ndjson), Form::ndjson, r);
    ASSERT_NE(r.as<Ack>(), nullptr);
    codec.convert(unframed(json, Form::ndjson), Form::ndjson, Form::delimited, back);
    EXPECT_EQ(unframed(back, Form::delimited), bytes);
}

std::string fault(const std::string& text, Form form = Form::ndjson) {
    try {
        Codec codec;
        Record r;
        codec.read(text, form, r);
    } catch (const DataError& e) {
        return e.what();
    }
    return "taken";
}

TEST(RecordCodec, APackingOfTheOtherFormIsOfNoMeaningAndPassedOn) {
    Codec codec;
    const std::string bytes("\x32\x02\x08\x02\x9a\x06\x01x", 8);  // ack { src: 2 }, as_binary
    std::string json, back;
    Record r;
    codec.convert(bytes, Form::delimited, Form::ndjson, json);
    codec.read(unframed(json, Form::ndjson), Form::ndjson, r);
    ASSERT_NE(r.as<Ack>(), nullptr);
    EXPECT_EQ(r.as<Ack>()->src, 2U);
    codec.convert(unframed(json, Form::ndjson), Form::ndjson, Form::delimited, back);
    EXPECT_EQ(unframed(back, Form::delimited), bytes);

    const std::string alone("\x9a\x06\x01x", 4);  // of no kind that is known
    json.clear();
    codec.convert(alone, Form::delimited, Form::ndjson, json);
    codec.read(unframed(json, Form::ndjson), Form::ndjson, r);
    EXPECT_EQ(r.kind.index(), 0U);

    const std::string line = R"({"ack":{"src":2},"as_json":"x"})";
    std::string binary, again;
    codec.convert(line, Form::ndjson, Form::delimited, binary);
    codec.read(unframed(binary, Form::delimited), Form::delimited, r);
    EXPECT_NE(r.as<Ack>(), nullptr);
    codec.convert(unframed(binary, Form::delimited), Form::delimited, Form::ndjson, again);
    EXPECT_EQ(again, line + "\n");
}

/// What converting a binary record that holds this line says.
std::string fault_of_packed(const std::string& line) {
    const std::string bytes = "\x92\x06" + std::string(1, static_cast<char>(line.size())) + line;
    try {
        Codec codec;
        std::string out;
        codec.convert(bytes, Form::delimited, Form::ndjson, out);
        return out;
    } catch (const DataError& e) {
        return e.what();
    }
}

TEST(RecordCodec, WhatIsPackedUpIsARecordOfOneLine) {
    EXPECT_EQ(fault_of_packed(R"({"ack":{"src":2},"other":1})"),
              "{\"ack\":{\"src\":2},\"other\":1}\n");
    EXPECT_EQ(fault_of_packed("{\"ack\":\n{\"src\":2}}"), "as_json: more than one line");
    EXPECT_EQ(fault_of_packed(R"({"ack":{},"as_binary":"MgIIAg=="})"),
              "a record is packed in a packed one");
    EXPECT_NE(fault_of_packed("rm -r"), "rm -r\n");
}

TEST(RecordCodec, WhatIsNoRecordIsRefused) {
    EXPECT_EQ(fault("{}"), "the record is of no kind: there is only a time, or nothing");
    EXPECT_EQ(fault(R"({"time":"noon","ack":{}})"),
              "time is no time: time 'noon' is not of the form 2024-05-01T12:00:25Z");
    EXPECT_EQ(fault(R"({"time":"2262-04-12T00:00:00Z","ack":{}})"),
              "a time is outside the years 1970 to 2262");
    EXPECT_EQ(fault(R"({"ack":{},"raw":{}})"), "raw and 'ack' exclude each other (oneof)");
    EXPECT_EQ(fault(R"({"ack":{"src":-1}})"), "ack.src '-1' is outside 0 to 4294967295");
    EXPECT_EQ(fault("[]"), "the record is not a JSON object");
    EXPECT_EQ(fault("\x32\x05\x08", Form::delimited).substr(0, 5), "byte ");
}

TEST(RecordCodec, ARecordFitsIntoAPipe) {
    Codec codec;
    Record r;
    Message m;
    m.data.assign(2048, 'x');
    r.kind = m;
    EXPECT_EQ(written(codec, r, Form::delimited).size(), 2048U + 3 + 6 + 3 + 2 + 2);
    EXPECT_LT(written(codec, r, Form::ndjson).size(), max_bytes);
    Transmission packet;  // the largest of a Micro-Modem
    packet.frame.assign(8, std::string(256, '\xff'));
    packet.deadline = UtcTime{1'714'564'825'123'456'789};
    packet.number = packet.slot_index.emplace(4294967295U);
    r.time.ns = 1'714'564'825'123'456'789;
    r.kind = packet;
    EXPECT_LT(written(codec, r, Form::ndjson).size(), max_bytes);
    m.data.assign(5000, 'x');
    r.kind = m;
    std::string out = "before";
    for (const Form form : {Form::ndjson, Form::delimited})
        EXPECT_THROW(codec.write(r, form, out), DataError);
    EXPECT_EQ(out, "before");
    try {
        codec.write(r, Form::delimited, out);
    } catch (const DataError& e) {
        EXPECT_EQ(std::string(e.what()), "message of 5027 bytes is longer than 4096 bytes");
    }
    EXPECT_NE(fault("{\"raw\":{\"line\":\"" + std::string(4096, 'x') + "\"}}").find("4096"),
              std::string::npos);
}

}  // namespace
}  // namespace seautils::record
