// Configuration in layers: what may be said, where it is wrong, and who wins.
#include "seautils/cli/config_file.hpp"
#include "seautils/core/error.hpp"
#include "temp_folder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace seautils::cli {
namespace {

using Values = std::map<std::string, std::vector<std::string>>;

const std::vector<ConfigOption> options{
    {"schema", "Schema", "PATH", true, false},
    {"strict", "Stop at the first bad record", "true", false, true},
    {"max-record", "Refuse a longer record", "BYTES", false, false},
    {"link.rate", "Of a section", "80", false, false}};

Values parse(const std::string& text) { return parse_config("t.conf", text, options); }

std::string fault(const std::string& text) {
    try {
        parse(text);
    } catch (const ConfigError& e) {
        EXPECT_EQ(e.code(), ExitCode::config);
        return e.what();
    }
    return "taken";
}

}  // namespace

TEST(CliConfigFile, KeysSectionsAndComments) {
    EXPECT_EQ(parse(""), Values{});
    EXPECT_EQ(parse("# nothing\n\n   \n"), Values{});
    EXPECT_EQ(parse("max-record = 100\nstrict=true\n"),
              (Values{{"max-record", {"100"}}, {"strict", {"true"}}}));
    EXPECT_EQ(parse("  max-record\t=  100   # bytes\r\n"), (Values{{"max-record", {"100"}}}));
    EXPECT_EQ(parse("[link]\nrate = 5300\n"), (Values{{"link.rate", {"5300"}}}));
    EXPECT_EQ(parse("link.rate = 80"), (Values{{"link.rate", {"80"}}}));
    EXPECT_EQ(parse("schema = a.proto\nschema = b c.proto\n"),
              (Values{{"schema", {"a.proto", "b c.proto"}}}));
    EXPECT_EQ(parse("schema = a=b\n"), (Values{{"schema", {"a=b"}}}));
}

TEST(CliConfigFile, AnyKeyOfAFamilyOfSections) {
    const std::vector<ConfigOption> family{{"id", "", "N"}, {"queue.*", "", ""}};
    const auto values = [&](const std::string& text) {
        return parse_config("t.conf", text, family);
    };
    EXPECT_EQ(values("id = 3\n[queue]\nttl_s = 5\n[queue.12]\nack = true\n[queue.12.3]\nack=false"),
              (Values{{"id", {"3"}},
                      {"queue.ttl_s", {"5"}},
                      {"queue.12.ack", {"true"}},
                      {"queue.12.3.ack", {"false"}}}));
    for (const auto& [text, said] : std::map<std::string, std::string>{
             {"[queue.1]\nack = true\n[queue.1]\nack = true",
              "t.conf:2: key 'queue.1.ack' is set twice"},
             {"[queues]\nack = true", "t.conf:2: unknown key 'queues.ack'"}}) {
        try {
            values(text);
            ADD_FAILURE() << text;
        } catch (const ConfigError& e) {
            EXPECT_EQ(e.what(), said);
        }
    }
}

TEST(CliConfigFile, FaultsArePlaced) {
    EXPECT_EQ(fault("\nmax-recrod = 1\n"),
              "t.conf:2: unknown key 'max-recrod' (did you mean 'max-record'?)");
    EXPECT_EQ(fault("zzz = 1"), "t.conf:1: unknown key 'zzz'");
    EXPECT_EQ(fault("[link]\n# x\nspeed = 1\n"), "t.conf:3: unknown key 'link.speed'");
    EXPECT_EQ(fault("strict = true\nnonsense\n"),
              "t.conf:2: a line that is neither 'key = value' nor '[section]'");
    EXPECT_EQ(fault("strict = true\n\nstrict = false\n"), "t.conf:1: key 'strict' is set twice");
    EXPECT_NE(fault("= 5\n"), "taken");
    EXPECT_NE(fault("[link\nrate = 5\n"), "taken");
    EXPECT_LT(fault(std::string(100'000, 'k') + " = 1").size(), 300U);
    EXPECT_EQ(fault("a\x01\xff = 1"), R"(t.conf:1: unknown key 'a\x01\xff')");
}

TEST(CliConfigFile, KeysAreNotGuessedFromTheirBeginning) {
    EXPECT_NE(fault("max = 1"), "taken");
    EXPECT_NE(fault("MAX-RECORD = 1"), "taken");
    EXPECT_NE(fault("schema* = 1"), "taken");
}

TEST(CliConfigFile, TheFirstFileToSayAThingWins) {
    const TempFolder folder;
    const std::string vehicle = folder.add("vehicle.conf", "max-record = 1\nschema = v.proto\n");
    const std::string fleet =
        folder.add("fleet.conf",
                   "# of all\nmax-record = 2\nstrict = true\nschema = f.proto\nschema = g.proto\n");
    EXPECT_EQ(read_config({vehicle, fleet}, options),
              (Values{{"max-record", {"1"}}, {"schema", {"v.proto"}}, {"strict", {"true"}}}));
    EXPECT_EQ(
        read_config({fleet, vehicle}, options),
        (Values{{"max-record", {"2"}}, {"schema", {"f.proto", "g.proto"}}, {"strict", {"true"}}}));
    EXPECT_EQ(read_config({}, options), Values{});
    EXPECT_EQ(config_place({vehicle, fleet}, "strict"), fleet + ":3: ");
    EXPECT_EQ(config_place({vehicle, fleet}, "schema"), vehicle + ":2: ");
    EXPECT_EQ(config_place({vehicle, fleet}, "link.rate"), "");
}

TEST(CliConfigFile, FilesThatCannotBeRead) {
    const TempFolder folder;
    const auto status = [](const std::string& file) {
        try {
            read_config({file}, options);
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find(file), std::string::npos) << e.what();
            return static_cast<int>(e.code());
        }
        return 0;
    };
    EXPECT_EQ(status("/nowhere/x.conf"), 66);
    EXPECT_EQ(status("/"), 66);
    EXPECT_EQ(status(folder.add("large.conf", "#" + std::string(1U << 20, 'x'))), 78);
    EXPECT_EQ(status(folder.add("full.conf", "#" + std::string((1U << 20) - 1, 'x'))), 0);
    EXPECT_EQ(status(folder.add("empty.conf", "")), 0);
}

/// The example, with its comment signs taken away, is a configuration that is taken.
TEST(CliConfigFile, TheExampleIsOne) {
    const std::string example = example_config("some-tool", options);
    EXPECT_EQ(parse(example), Values{});
    EXPECT_TRUE(example.starts_with("# Configuration of some-tool"));
    std::string said;
    for (std::size_t at = 0; at < example.size();) {
        const std::size_t end = example.find('\n', at);
        const std::string line = example.substr(at, end - at);
        if (line.starts_with("#") && !line.starts_with("# ")) said += line.substr(1) + "\n";
        at = end + 1;
    }
    EXPECT_EQ(parse(said), (Values{{"schema", {"PATH"}},
                                   {"strict", {"true"}},
                                   {"max-record", {"BYTES"}},
                                   {"link.rate", {"80"}}}));
}

TEST(CliConfigFile, WhatIsWrittenIsRead) {
    EXPECT_TRUE(rc::check("key = value", [] {
        const auto value = *rc::gen::container<std::string>(
            rc::gen::elementOf(std::string("abz019-_./,:;\"'=\\ ~%é")));
        const std::size_t first = value.find_first_not_of(' ');
        const std::string trimmed =
            first == value.npos ? "" : value.substr(first, value.find_last_not_of(' ') + 1 - first);
        RC_ASSERT(parse("schema =" + value + "\n") == (Values{{"schema", {trimmed}}}));
    }));
}

}  // namespace seautils::cli
