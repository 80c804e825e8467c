// Loading of .proto files at run time: where imports are found, and what is said of faulty ones.
#include "seautils/core/error.hpp"
#include "seautils/schema/builtin_files.hpp"
#include "seautils/schema/pool.hpp"
#include "temp_folder.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace seautils::schema {
namespace {

namespace fs = std::filesystem;

/// A folder of files that is gone afterwards; the working folder while it lives, so that messages
/// name files as a user would.
class Folder {
public:
    Folder() : before_(fs::current_path()) { fs::current_path(folder_.path()); }
    ~Folder() { fs::current_path(before_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    void add(const std::string& name, const std::string& text) const { folder_.add(name, text); }
    std::string path() const { return folder_.path(); }

private:
    fs::path before_;
    TempFolder folder_;
};

std::string proto2(const std::string& rest) { return "syntax = \"proto2\";\n" + rest; }

/// What a pool says of a file; empty: nothing.
std::string fault(const std::string& path, std::vector<std::string> folders = {}) {
    try {
        Pool pool(std::move(folders));
        pool.load(path);
    } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        return fmt::format("{} {}", static_cast<int>(e.code()), e.what());
    }
    return {};
}

std::string text_fault(const std::string& text) {
    try {
        Pool pool;
        pool.load_text("t.proto", text);
    } catch (const ConfigError& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        EXPECT_LT(std::string(e.what()).size(), 1000U);
        return e.what();
    }
    return {};
}

std::vector<std::string> names(const Pool& pool) {
    std::vector<std::string> all;
    for (const auto* message : pool.messages()) all.push_back(message->full_name());
    return all;
}

std::string unknown(const Pool& pool, const std::string& name) {
    try {
        return "found " + pool.message(name).full_name();
    } catch (const ConfigError& e) {
        return e.what();
    }
}

}  // namespace

/// The five files of the specification (§1), and those of protobuf.
TEST(SchemaPool, ImportFilesOfDcclAreFoundByThemselves) {
    for (const char* path :
         {"dccl/option_extensions.proto", "dccl/protobuf/option_extensions.proto",
          "dccl/arithmetic/protobuf/arithmetic_extensions.proto",
          "dccl/arithmetic/protobuf/arithmetic.proto", "dccl/ccl/protobuf/ccl_extensions.proto",
          "google/protobuf/descriptor.proto", "google/protobuf/timestamp.proto",
          "google/protobuf/any.proto", "google/protobuf/duration.proto",
          "google/protobuf/wrappers.proto", "google/protobuf/struct.proto",
          "google/protobuf/empty.proto", "google/protobuf/field_mask.proto"}) {
        EXPECT_EQ(text_fault(proto2(fmt::format("import \"{}\"; message M {{}}", path))), "")
            << path;
    }
    EXPECT_EQ(builtin_files().size(), 5U);
}

TEST(SchemaPool, OptionsOfDcclAtTheirNumbers) {
    Pool pool;
    pool.load_text("o.proto", proto2(R"(import "dccl/option_extensions.proto";
        import "dccl/arithmetic/protobuf/arithmetic_extensions.proto";
        import "dccl/ccl/protobuf/ccl_extensions.proto";
        message M {
          option (dccl.msg) = { id: 5 max_bytes: 32 codec_version: 4 };
          optional double d = 1 [(dccl.field) = { min: -1.5 max: 2 precision: 1 in_head: true
              dynamic_conditions { omit_if: "x" } units { base_dimensions: "L" }
              [arithmetic] { model: "m" } [ccl] { bit_size: 13 } }];
          optional double e = 2 [(dccl.field).(arithmetic).model = "n"]; })"));
    const auto& m = pool.message("M");
    // 1012 of wire type 2 is a2 3f; id 5, max_bytes 32, codec_version 4 are fields 1, 2 and 5
    EXPECT_NE(m.options().SerializeAsString().find(
                  std::string("\xa2\x3f\x06\x08\x05\x10\x20\x28\x04", 9)),
              std::string::npos);
    const std::string field = m.field(0)->options().SerializeAsString();
    EXPECT_TRUE(field.starts_with("\xa2\x3f"));
    EXPECT_NE(field.find(std::string("\x29\0\0\0\0\0\0\xf8\xbf", 9)),
              std::string::npos);                                                  // 5: -1.5
    EXPECT_NE(field.find(std::string("\x18\x01\x20\x01", 4)), std::string::npos);  // 3, 4
    EXPECT_NE(field.find("\xc2\x3e\x02\x10\x0d"), std::string::npos);              // 1000
    EXPECT_NE(field.find("\xca\x3e\x03\x0a\x01m"), std::string::npos);             // 1001
    EXPECT_NE(m.field(1)->options().SerializeAsString().find("\xca\x3e\x03\x0a\x01n"),
              std::string::npos);
}

TEST(SchemaPool, ImportsAreFoundBesideTheFileAndAbove) {
    const Folder folder;
    folder.add(
        "fleet/a/b/c/leaf.proto",
        proto2(
            "import \"beside.proto\"; import \"b/c/from_a.proto\"; import \"a/b/top.proto\";"
            "message Leaf { optional Beside x = 1; optional FromA y = 2; optional Top z = 3; }"));
    folder.add("fleet/a/b/c/beside.proto", proto2("message Beside {}"));
    folder.add("fleet/a/b/c/from_a.proto", proto2("message FromA {}"));
    folder.add("fleet/a/b/top.proto", proto2("message Top {}"));
    EXPECT_EQ(fault("fleet/a/b/c/leaf.proto"), "");
    EXPECT_EQ(fault(folder.path() + "/fleet/a/b/c/leaf.proto"), "");
    Pool pool;
    pool.load("fleet/a/b/c/leaf.proto");
    EXPECT_EQ(names(pool), std::vector<std::string>{"Leaf"});  // imports are not loaded
    EXPECT_EQ(pool.message("Leaf").field(0)->message_type()->full_name(), "Beside");
}

TEST(SchemaPool, ImportFoldersComeLast) {
    const Folder folder;
    folder.add("here/main.proto",
               proto2("import \"common.proto\"; message M { optional Common c = 1; }"));
    folder.add("lib/common.proto", proto2("message Common { optional int32 of_lib = 1; }"));
    EXPECT_EQ(fault("here/main.proto").substr(0, 23), "78 here/main.proto:2:1:");
    EXPECT_EQ(fault("here/main.proto", {"lib"}), "");
    folder.add("here/common.proto", proto2("message Common { optional int32 of_here = 1; }"));
    Pool pool({"lib"});
    pool.load("here/main.proto");
    EXPECT_EQ(pool.message("M").field(0)->message_type()->field(0)->name(), "of_here");
}

TEST(SchemaPool, AFileIsOneByWhateverNameItIsReached) {
    const Folder folder;
    folder.add("f/x.proto", proto2("package p; message X {}"));
    folder.add("f/y.proto", proto2("package p; import \"x.proto\"; import \"f/x.proto\";"
                                   "message Y { optional X x = 1; }"));
    fs::create_symlink("f", "link");
    Pool pool;
    for (const char* path :
         {"f/x.proto", "./f/../f/x.proto", "link/x.proto", "f/y.proto", "f", "link"})
        pool.load(path);
    EXPECT_EQ(names(pool), (std::vector<std::string>{"p.X", "p.Y"}));
}

TEST(SchemaPool, AFolderIsLoadedInOrderOfName) {
    const Folder folder;
    folder.add("s/b.proto", proto2("message B {}"));
    folder.add("s/a/z.proto", proto2("message Z { message Inner {} map<string, int32> m = 1; }"));
    folder.add("s/c.proto", proto2("message C {}"));
    folder.add("s/.hidden.proto", "nonsense");
    folder.add("s/notes.txt", "nonsense");
    folder.add("s/dccl/option_extensions.proto", "not looked at: it is built in");
    Pool pool;
    pool.load("s");
    EXPECT_EQ(names(pool), (std::vector<std::string>{"Z", "Z.Inner", "B", "C"}));
    folder.add("empty/notes.txt", "");
    EXPECT_EQ(fault("empty"), "66 empty: no .proto file in this folder");
}

TEST(SchemaPool, WhatCannotBeOpenedIsNoInput) {
    const Folder folder;
    EXPECT_EQ(fault("nowhere.proto"), "66 nowhere.proto: No such file or directory");
    EXPECT_EQ(fault("/dev/null/x.proto").substr(0, 3), "66 ");
}

TEST(SchemaPool, FaultsArePlacedInTheFileThatHasThem) {
    const Folder folder;
    folder.add("bad.proto", proto2("message M {\n  optional int32 a = 1\n}\n"));
    EXPECT_EQ(fault("bad.proto"), "78 bad.proto:4:1: expected \";\"");
    folder.add("type.proto", proto2("message M {\n  optional Nothing a = 1;\n}\n"));
    EXPECT_EQ(fault("type.proto"), "78 type.proto:3:12: \"Nothing\" is not defined");
    folder.add("missing.proto", proto2("import \"gone.proto\";\nmessage M {}\n"));
    EXPECT_EQ(fault("missing.proto"),
              "78 missing.proto:2:1: import \"gone.proto\" was not found or had errors "
              "(gone.proto: not found)");
    folder.add("sub/inner.proto", proto2("message {\n"));
    folder.add("outer.proto", proto2("import \"sub/inner.proto\";\nmessage M {}\n"));
    const std::string inner = fault("outer.proto");
    EXPECT_NE(inner.find("sub/inner.proto:2:9: expected message name"), std::string::npos) << inner;
    folder.add("twice.proto", proto2("message M { optional int32 a = 1; }\nmessage M {}\n"));
    EXPECT_EQ(fault("twice.proto"), "78 twice.proto:3:9: \"M\" is already defined");
    folder.add("number.proto",
               proto2("message M {\n optional int32 a = 1;\n optional int32 b = 1; }"));
    EXPECT_TRUE(fault("number.proto")
                    .starts_with("78 number.proto:4:21: field number 1 has already been used"))
        << fault("number.proto");
    folder.add("option.proto", proto2("import \"dccl/option_extensions.proto\";\nmessage M {\n"
                                      " optional int32 a = 1 [(dccl.field).mni = 1]; }"));
    EXPECT_TRUE(fault("option.proto").starts_with("78 option.proto:4:")) << fault("option.proto");
    folder.add("noise.proto", "\x01\xff\xfe{");
    EXPECT_TRUE(fault("noise.proto").starts_with("78 noise.proto:1:")) << fault("noise.proto");
    folder.add("long.proto", proto2("import \"" + std::string(3000, '\x7f') + "\";\n"));
    EXPECT_TRUE(fault("long.proto").starts_with("78 long.proto:2:1: import \"\\x7f\\x7f"));
    EXPECT_LT(fault("long.proto").size(), 1300U);
}

TEST(SchemaPool, CirclesOfImportsAreRefused) {
    const Folder folder;
    folder.add("self.proto", proto2("import \"self.proto\"; message M {}"));
    EXPECT_NE(fault("self.proto").find("78 self.proto"), std::string::npos) << fault("self.proto");
    folder.add("a.proto", proto2("import \"b.proto\"; message A {}"));
    folder.add("b.proto", proto2("import \"a.proto\"; message B {}"));
    EXPECT_TRUE(fault("a.proto").starts_with("78 ")) << fault("a.proto");
}

TEST(SchemaPool, TheSameTypeInTwoFilesIsRefused) {
    const Folder folder;
    folder.add("one.proto", proto2("package p; message Same { optional int32 a = 1; }"));
    folder.add("two.proto", proto2("package p; message Same { optional int32 b = 1; }"));
    Pool pool;
    pool.load("one.proto");
    try {
        pool.load("two.proto");
        FAIL();
    } catch (const ConfigError& e) {
        EXPECT_TRUE(std::string(e.what()).starts_with("two.proto:2:")) << e.what();
        EXPECT_NE(std::string(e.what()).find("already defined"), std::string::npos) << e.what();
    }
    // A file that failed leaves the others usable.
    EXPECT_EQ(pool.message("p.Same").field(0)->name(), "a");
}

TEST(SchemaPool, TypesMayHoldThemselves) {
    Pool pool;
    pool.load_text(
        "r.proto",
        proto2(
            "message A { optional B b = 1; } message B { repeated A a = 1; optional B b = 2; }"));
    const Layout& a = pool.layout(pool.message("A"));
    EXPECT_EQ(a.fields[0].message->fields[0].message, &a);
    EXPECT_EQ(a.fields[0].message->fields[1].message, a.fields[0].message);
    EXPECT_EQ(&pool.layout(pool.message("A")), &a);  // made once
}

TEST(SchemaPool, MessagesByName) {
    Pool pool;
    pool.load_text("n.proto",
                   proto2("package fleet.nav; message Status { message Leg {} } message Stats {}"));
    pool.load_text("m.proto", proto2("package other; message Leg {}"));
    EXPECT_EQ(unknown(pool, "fleet.nav.Status"), "found fleet.nav.Status");
    EXPECT_EQ(unknown(pool, "Status"), "found fleet.nav.Status");
    EXPECT_EQ(unknown(pool, "nav.Status"), "found fleet.nav.Status");
    EXPECT_EQ(unknown(pool, "Status.Leg"), "found fleet.nav.Status.Leg");
    EXPECT_EQ(unknown(pool, "Leg"),
              "message 'Leg' is ambiguous: fleet.nav.Status.Leg or other.Leg");
    EXPECT_EQ(unknown(pool, "tatus"), "message 'tatus' is not in the schema");
    EXPECT_EQ(unknown(pool, "fleet.nav.Sttus"),
              "message 'fleet.nav.Sttus' is not in the schema (did you mean 'fleet.nav.Status'?)");
    EXPECT_EQ(unknown(pool, ""), "message '' is not in the schema");
    EXPECT_TRUE(unknown(pool, std::string(100'000, 'x')).size() < 200);
}

TEST(SchemaPool, PlacesOfFields) {
    const Folder folder;
    folder.add("p.proto", proto2("message Leg {\n  optional int32 seq = 1;\n}\n"
                                 "message M {\n  repeated Leg leg = 1;\n}\n"));
    Pool pool;
    pool.load("p.proto");
    const auto& m = pool.message("M");
    EXPECT_EQ(pool.place(m, ""), "p.proto:5: ");
    EXPECT_EQ(pool.place(m, "leg"), "p.proto:6: ");
    EXPECT_EQ(pool.place(m, "leg[3].seq"), "p.proto:3: ");
    EXPECT_EQ(pool.place(m, "leg[].seq"), "p.proto:3: ");
    EXPECT_EQ(pool.place(m, "leg.zzz"), "p.proto:6: ");
    EXPECT_EQ(pool.place(m, "zzz"), "p.proto:5: ");
    EXPECT_EQ(pool.place(m, "."), "p.proto:5: ");
}

TEST(SchemaPool, LimitsOfFiles) {
    const Folder folder;
    const std::string comment = "//" + std::string((1U << 20) - 60, 'x') + "\n";
    folder.add("large.proto", proto2("message M {}\n" + comment));
    EXPECT_EQ(fault("large.proto"), "");
    folder.add("larger.proto", proto2("message M {}\n" + comment + comment));
    EXPECT_NE(fault("larger.proto").find("1 MiB"), std::string::npos) << fault("larger.proto");
    folder.add("importer.proto", proto2("import \"larger.proto\";"));
    EXPECT_NE(fault("importer.proto").find("1 MiB"), std::string::npos) << fault("importer.proto");
    std::string chain;
    for (int k = 0; k < 1100; ++k)
        folder.add(fmt::format("many/f{}.proto", k), proto2(fmt::format("message M{} {{}}", k)));
    EXPECT_EQ(fault("many"), "78 many: more than 1000 .proto files");
    std::string deep = "deep";
    for (int k = 0; k < 16; ++k) deep += "/d";
    folder.add(deep + "/m.proto", proto2("message M {}"));
    EXPECT_EQ(fault("deep"), "");
    folder.add(deep + "/d/n.proto", proto2("message N {}"));
    EXPECT_EQ(fault("deep"), "78 " + deep + "/d: folders are nested deeper than 16");
    for (int k = 0; k < 1100; ++k) chain += fmt::format("import \"many/f{}.proto\";\n", k);
    folder.add("all.proto", proto2(chain));
    EXPECT_NE(fault("all.proto").find("1000 files"), std::string::npos) << fault("all.proto");
}

namespace {

std::string times(std::size_t n, std::string_view text) {
    std::string all;
    for (std::size_t k = 0; k < n; ++k) all += text;
    return all;
}

/// The same, with the count from 1 for each `#`.
std::string counted(int n, std::string_view text) {
    std::string all;
    for (int k = 1; k <= n; ++k) {
        for (const char c : text) all += c == '#' ? std::to_string(k) : std::string(1, c);
    }
    return all;
}

}  // namespace

/// Protobuf's compiler recurses with brackets, and goes on behind a fault: none may be hidden from the
/// count by what it does not take for a bracket's end.
TEST(SchemaPool, BracketsThatWouldExhaustTheStack) {
    for (const std::string& deep :
         {times(50'000, "message A {"), "option (x) = " + times(50'000, "{ a "),
          times(80'000, "}") + times(80'000, "message A{"), "message A {" + times(400'000, "]{"),
          "message A { optional int32 a = 1 [" + times(400'000, "}["),
          "message A { option a = \"\\\n" + times(80'000, "message A{")}) {
        EXPECT_EQ(text_fault(proto2(deep)), "t.proto: nested deeper than 64 brackets");
    }
    EXPECT_EQ(text_fault(proto2(std::string("//\0", 3) + times(80'000, "message A{"))),
              "t.proto: a NUL byte is in it");
    // Brackets in comments and strings are none.
    const std::string many(1000, '{');
    EXPECT_EQ(text_fault(proto2("// " + many + "\n/* " + many +
                                " */ message M { optional string s = 1 [default = \"" + many +
                                "\\\"" + many + "\"]; }")),
              "");
    EXPECT_NE(text_fault(proto2("/* " + many)), "");
    EXPECT_NE(text_fault(proto2("\"" + many)), "");
    EXPECT_EQ(text_fault(proto2(counted(30, "message M# {") + times(30, "}"))), "");
}

/// Each of these took seconds or gigabytes: protobuf's compiler compares all with all.
TEST(SchemaPool, NumbersThatCostTheirSquare) {
    const std::string items = "t.proto: more than 1000 options and reserved numbers in a block";
    EXPECT_EQ(text_fault(proto2("message M { reserved 1" + times(400'000, ",1") + "; }")), items);
    EXPECT_EQ(text_fault(proto2("enum E { A = 1; reserved 2" + times(400'000, ",2") + "; }")),
              items);
    EXPECT_EQ(text_fault(proto2("message M { " + times(40'000, "extensions 1 to max;") + "}")),
              items);
    EXPECT_EQ(text_fault(proto2("message M { " + times(40'000, "option a = 1;") + "}")), items);
    EXPECT_EQ(text_fault(proto2("message M { optional bool a = 1 [" +
                                times(40'000, "deprecated=true,") + "lazy=true]; }")),
              "t.proto: more than 1000 elements in square brackets");
    EXPECT_EQ(text_fault(proto2("message M { optional " + times(400'000, ".a") + " a = 1; }")),
              "t.proto: a name of more than 100 parts");
    EXPECT_EQ(text_fault(proto2("message " + std::string(500'000, 'p') + "{" +
                                counted(10'000, "optional bool a#=#;") + "}")),
              "t.proto: a name of more than 512 bytes");
    const std::string nested = times(30, "message " + std::string(512, 'p') + "{");
    EXPECT_EQ(text_fault(proto2(nested + counted(18'000, "optional bool a#=#;") + times(30, "}"))),
              "t.proto: names of more than 128 MiB in all");
}

/// What real schemas hold is far below.
TEST(SchemaPool, WhatIsLargeButHonestIsTaken) {
    EXPECT_EQ(text_fault(proto2("message M { " + counted(18'000, "optional bool a#=#;") + "}")),
              "");
    EXPECT_EQ(text_fault(proto2("message M { " + counted(5'000, "map<int32,bool> a#=#;") + "}")),
              "");
    EXPECT_EQ(
        text_fault(proto2("message M { " + counted(900, "reserved #;") + "}" +
                          counted(500, "message N# { reserved 1, 2; option deprecated = true; }"))),
        "");
    EXPECT_EQ(text_fault(proto2("message " + std::string(512, 'p') + "{ optional bool " +
                                std::string(512, 'q') + " = 1; }")),
              "");
}

TEST(SchemaPool, BytesInAll) {
    const Folder folder;
    const std::string comment = "//" + std::string((1U << 20) - 100, 'x') + "\n";
    std::string imports;
    for (int k = 0; k < 18; ++k) {
        folder.add(fmt::format("part{}.proto", k), proto2(comment));
        imports += fmt::format("import \"part{}.proto\";\n", k);
    }
    folder.add("all.proto", proto2(imports));
    EXPECT_NE(fault("all.proto").find("16 MiB"), std::string::npos) << fault("all.proto");
}

TEST(SchemaPool, ATextIsAFileToo) {
    EXPECT_EQ(text_fault(proto2("message M { optional Zzz z = 1; }")),
              "t.proto:2:22: \"Zzz\" is not defined");
    EXPECT_EQ(text_fault(""), "");
    EXPECT_NE(text_fault("syntax = \"proto4\";"), "");
    EXPECT_NE(text_fault(proto2("import \"/etc/passwd\";")).find("not found"), std::string::npos);
    EXPECT_NE(text_fault(proto2("import \"../../../../etc/passwd\";")), "");
}

}  // namespace seautils::schema
