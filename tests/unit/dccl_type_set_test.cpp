// Several types at once: their identifiers, their names, their frames back to back.
#include "seautils/dccl/type_set.hpp"

#include "dccl_bench.hpp"
#include "seautils/dccl/raw_stream.hpp"
#include "seautils/schema/json.hpp"
#include "temp_folder.hpp"

namespace seautils::dccl {
namespace {

/// Schemas as files of a folder that lasts as long as the test.
class DcclTypeSet : public testing::Test {
protected:
    std::string file(const std::string& name, const std::string& text) const {
        const bool xml = name.ends_with(".xml");
        return folder_.add(
            name,
            (xml ? "" : "syntax = \"proto2\"; import \"dccl/option_extensions.proto\"; ") + text);
    }

    static std::string type(
        const std::string& name, const std::string& options,
        const std::string& fields = "required uint32 v = 1 [(dccl.field) = { min: 0 max: 255 }];") {
        return "message " + name + " { option (dccl.msg) = { max_bytes: 32 codec_version: 4 " +
               options + " }; " + fields + " }\n";
    }

    TypeSet load(const std::vector<std::string>& files,
                 const std::vector<std::string>& names = {}) const {
        return {files, names, {}, options};
    }

    std::string refusal(const std::vector<std::string>& files,
                        const std::vector<std::string>& names = {}) const {
        try {
            load(files, names);
        } catch (const ConfigError& e) {
            return e.what();
        }
        return "";
    }

    static std::vector<std::string> names(const TypeSet& set) {
        std::vector<std::string> all;
        for (const Type& t : set.types()) all.push_back(t.name);
        return all;
    }

    /// "Type json" of the message that the frame begins with.
    static std::string decoded(TypeSet& set, const std::string& hex) {
        schema::Values values;
        const TypeSet::Decoded d = set.decode(from_hex(hex), values);
        std::string json;
        schema::write_json(values, json);
        return d.type->name + " " + json + " " + std::to_string(d.bytes);
    }

    CodecOptions options;
    const TempFolder folder_;
};

using List = std::vector<std::string>;

TEST_F(DcclTypeSet, TypesAreToldByTheirIdentifiers) {
    TypeSet set =
        load({file("a.proto", "package a; " + type("Short", "id: 5") + type("Long", "id: 300"))});
    EXPECT_EQ(names(set), (List{"a.Short", "a.Long"}));
    EXPECT_EQ(decoded(set, "0a07"), "a.Short {\"v\":7} 2");
    EXPECT_EQ(decoded(set, "590208ffff"), "a.Long {\"v\":8} 3");
    EXPECT_THROW(decoded(set, "0c07"), DataError);
    EXPECT_THROW(decoded(set, "59"), DataError);
    EXPECT_THROW(decoded(set, ""), DataError);
    EXPECT_EQ(set.usual(), nullptr);
    EXPECT_TRUE(set.may_begin('\x0a'));
    EXPECT_TRUE(set.may_begin('\x59'));
    EXPECT_FALSE(set.may_begin('\x0b'));
}

TEST_F(DcclTypeSet, EqualIdentifiersAreRefusedAndLocated) {
    const std::string a = file("a.proto", "package a;\n" + type("M", "id: 5"));
    const std::string b = file("b.proto", "package b;\n\n" + type("M", "id: 5"));
    const std::string why = refusal({a, b});
    EXPECT_NE(why.find("b.proto:3: id 5 is both message a.M and message b.M"), std::string::npos)
        << why;
    EXPECT_EQ(refusal({a, b}, {"a.M"}), "") << "but only among those that are wanted";
    const TypeSet both({a, b}, {}, {}, options, Collisions::keep);
    EXPECT_EQ(both.types().size(), 2U);
}

TEST_F(DcclTypeSet, EqualCodesOfOtherLengthsDoNotCollide) {
    ProgramOptions ccl;
    ccl.id_codec = IdCodec::ccl;
    // A native CCL message of number 0x20 would be the escape of all others: none of ours has it.
    TypeSet set({file("a.proto", type("Own", "id: 213975088") + type("Wrapped", "id: 14"))}, {},
                ccl, options);
    EXPECT_EQ(decoded(set, "3007"), "Own {\"v\":7} 2");
    EXPECT_EQ(decoded(set, "201c08"), "Wrapped {\"v\":8} 3");
}

TEST_F(DcclTypeSet, FilesAndFoldersAndNames) {
    const std::string a = file("a.proto", "package a; " + type("M", "id: 1") + type("N", "id: 2"));
    file("b.proto", "package b; " + type("M", "id: 3"));
    TypeSet set = load({folder_.path()});
    EXPECT_EQ(names(set), (List{"a.M", "a.N", "b.M"}));
    EXPECT_EQ(set.type("a.M").program->id(), 1);
    EXPECT_EQ(set.type("N").name, "a.N");
    EXPECT_THROW(set.type("M"), DataError) << "ambiguous";
    try {
        set.type("a.NN");
        ADD_FAILURE();
    } catch (const DataError& e) {
        EXPECT_STREQ(e.what(), "type 'a.NN' is not loaded (did you mean 'a.N'?)");
    }
    TypeSet chosen = load({folder_.path()}, {"b.M", "a.N", "b.M"});
    EXPECT_EQ(names(chosen), (List{"b.M", "a.N"}));
    EXPECT_EQ(chosen.usual()->name, "b.M") << "the first chosen";
    EXPECT_EQ(load({a}, {"N"}).usual()->name, "a.N");
    EXPECT_THROW(load({a}, {"X"}), ConfigError);
    EXPECT_THROW(load({folder_.file("none.proto")}), Error);
}

TEST_F(DcclTypeSet, TypesThatCannotBeCodedAreLeftOutUnlessChosen) {
    const std::string a =
        file("a.proto", type("Good", "id: 1") + type("Bad", "id: 2", "required uint32 v = 1;") +
                            "message Part {}");
    TypeSet set = load({a});
    EXPECT_EQ(names(set), List{"Good"});
    ASSERT_EQ(set.left_out().size(), 1U);
    EXPECT_EQ(set.left_out()[0].first, "Bad");
    EXPECT_NE(set.left_out()[0].second.find("field v: option min is missing"), std::string::npos);
    EXPECT_NE(refusal({a}, {"Bad"}).find("option min is missing"), std::string::npos);
    EXPECT_NE(refusal({a}, {"Part"}), "");
    EXPECT_NE(refusal({file("b.proto", "message Part {}")}), "");
    EXPECT_NE(refusal({file("c.proto", type("Bad", "id: 2", "required uint32 v = 1;"))})
                  .find("option min is missing"),
              std::string::npos)
        << "nothing is left: why";
}

TEST_F(DcclTypeSet, WithoutAnIdentifierThereMustBeOneType) {
    const std::string none = type("None", "omit_id: true");
    TypeSet alone = load({file("a.proto", none)});
    EXPECT_EQ(decoded(alone, "07"), "None {\"v\":7} 1");
    EXPECT_TRUE(alone.may_begin('\x07'));
    TypeSet two = load({file("b.proto", none + type("M", "id: 1"))});
    EXPECT_EQ(decoded(two, "0207"), "M {\"v\":7} 2");
    EXPECT_THROW(decoded(two, "07"), DataError);
}

TEST_F(DcclTypeSet, AnIdOfTheUsersChangesTheIdentifierAlone) {
    ProgramOptions with;
    with.user_id = 300;
    const std::string a = file("a.proto", type("M", "id: 1") + type("N", ""));
    TypeSet set({a}, {"M"}, with, options);
    EXPECT_EQ(decoded(set, "590207"), "M {\"v\":7} 3");
    TypeSet none({a}, {"N"}, with, options);
    EXPECT_EQ(decoded(none, "590207"), "N {\"v\":7} 3");
    with.user_id = 40000;
    EXPECT_THROW(TypeSet({a}, {"M"}, with, options), ConfigError);
}

TEST_F(DcclTypeSet, TheTwoKindsOfSchemasAreNotMixed) {
    const std::string xml =
        file("m.xml",
             "<message_set><message><name>DIVE</name><id>9</id><size>32</size><layout><bool>"
             "<name>b</name></bool></layout></message></message_set>");
    const std::string a = file("a.proto", type("M", "id: 1"));
    EXPECT_NE(refusal({a, xml}), "");
    TypeSet set = load({xml});
    EXPECT_EQ(set.types()[0].name, "DIVE");
    EXPECT_NE(set.types()[0].legacy, nullptr);
    // 0x20, id 9 in 9 bits, zeros; then the body: true is code 2.
    EXPECT_EQ(decoded(set, "200480000000 02").substr(0, 4), "DIVE");
    EXPECT_NE(refusal({xml}, {"NONE"}), "");
}

TEST_F(DcclTypeSet, ZerosBehindAMessageArePaddingUnlessTheyAreAMessage) {
    const TypeSet five = load({file("a.proto", type("M", "id: 5"))});
    EXPECT_TRUE(five.is_padding(std::string(3, '\0')));
    EXPECT_TRUE(five.is_padding(""));
    EXPECT_FALSE(five.is_padding(std::string("\0\1", 2)));
    const TypeSet zero = load({file("b.proto", type("M", "id: 0"))});
    EXPECT_FALSE(zero.is_padding(std::string(3, '\0')));
}

TEST_F(DcclTypeSet, MessagesBackToBack) {
    TypeSet set = load({file("a.proto", type("A", "id: 5") +
                                            type("B", "id: 300",
                                                 "optional string s = 1 [(dccl.field)"
                                                 ".max_length = 20];") +
                                            type("C", "id: 7", ""))});
    std::string stream, expected;
    schema::JsonReader reader;
    schema::Values values;
    const auto add = [&](const std::string& name, std::string json) {
        expected += name + " " + json + "\n";
        json.append(64, '\0');
        reader.read(std::string_view(json).substr(0, json.size() - 64), *set.type(name).layout,
                    values);
        set.encode(set.type(name), values, stream);
    };
    for (int k = 0; k < 100; ++k) {
        add("A", "{\"v\":" + std::to_string(k) + "}");
        add("B", "{\"s\":\"" + std::string(static_cast<std::size_t>(k % 20), 'x') + "\"}");
        add("C", "{}");
        add("B", "{}");
    }
    std::string got;
    std::string_view rest = stream;
    while (!rest.empty()) {
        const TypeSet::Decoded d = set.decode(rest, values);
        got += d.type->name + " ";
        schema::write_json(values, got);
        got += "\n";
        rest.remove_prefix(d.bytes);
    }
    EXPECT_EQ(got, expected);
}

TEST_F(DcclTypeSet, ColumnsForTheMostElements) {
    TypeSet set = load(
        {file("a.proto",
              type("M", "id: 1",
                   "message S { repeated bool b = 1 [(dccl.field).max_repeat = 2]; }"
                   "repeated S sub = 1 [(dccl.field).max_repeat = 3]; optional bool c = 2;"))});
    const std::map<std::string, std::uint32_t> expected = {{"sub", 3}, {"sub.b", 2}};
    EXPECT_EQ(repeats(set.types()[0]), expected);
}

TEST_F(DcclTypeSet, TheClockGivesTimesTheirDay) {
    TypeSet set = load(
        {file("a.proto",
              type("M", "id: 1", "required double t = 1 [(dccl.field).codec = \"dccl.time\"];"))});
    for (const int day : {19000, 19001}) {
        set.set_now(day * 86400 + 100);
        EXPECT_EQ(decoded(set, "02640000"),
                  "M {\"t\":" + std::to_string(day * 86400 + 100) + "} 4");
    }
}

}  // namespace
}  // namespace seautils::dccl
