// The conformance vectors made with the reference library: bytes, values, sizes, refusals.
// They lie outside of the tree, where SEAUTILS_SHARED says (default ../shared).
#include "seautils/core/error.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/models.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/pool.hpp"

#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <tuple>

namespace seautils::dccl {
namespace {

using google::protobuf::Message;
using nlohmann::json;

std::string vectors_folder() {
    const char* shared = std::getenv("SEAUTILS_SHARED");
    const std::string root =
        shared != nullptr ? shared : std::string(SEAUTILS_SOURCE_DIR) + "/../shared";
    return root + "/vectors/dccl";
}

std::string from_hex(const std::string& hex) {
    std::string bytes;
    for (std::size_t k = 0; k + 1 < hex.size(); k += 2) {
        bytes += static_cast<char>(std::stoi(hex.substr(k, 2), nullptr, 16));
    }
    return bytes;
}

std::string to_hex(const std::string& bytes) {
    std::string hex;
    for (const char c : bytes) {
        char two[3];
        std::snprintf(two, sizeof two, "%02x", static_cast<unsigned char>(c));
        hex += two;
    }
    return hex;
}

/// One pool for each schema file: that is what a tool has.
schema::Pool& pool_of(const std::string& file) {
    static std::map<std::string, schema::Pool> pools;
    const auto found = pools.find(file);
    if (found != pools.end()) return found->second;
    schema::Pool pool;
    pool.load(vectors_folder() + "/" + file);
    return pools.emplace(file, std::move(pool)).first->second;
}

/// A vector's codec, with the types that it asks for.
struct Bench {
    explicit Bench(const json& v) : pool(pool_of(v.at("schema"))), codec(options(v)) {
        const json config = v.value("config", json::object());
        for (const json& lib : config.value("libs", json::array())) {
            if (lib == "ccl") program_options.id_codec = IdCodec::ccl;
        }
        for (const json& text : config.value("models", json::array())) {
            add_model(text.get<std::string>(), program_options.models);
        }
        for (const json& type : config.value("load_types", json::array())) load(type);
        program = load(v.at("type"));
    }

    static CodecOptions options(const json& v) {
        const json config = v.value("config", json::object());
        CodecOptions o;
        o.lenient = !config.value("strict", false);
        o.header_only = config.value("header_only", false);
        if (config.contains("passphrase")) o.passphrase = config["passphrase"];
        for (const json& id : config.value("skip_ids", json::array()))
            o.skip_crypto_ids.insert(id.get<int>());
        o.now_s = config.value("now", 1700000000);
        return o;
    }

    const Program* load(const std::string& type) {
        auto compiled = Program::compile(pool.layout(pool.message(type)), program_options);
        codec.load(compiled);
        return compiled.get();
    }

    std::unique_ptr<Message> message(const std::string& type, const std::string& text) const {
        auto m = pool.new_message(pool.message(type));
        google::protobuf::TextFormat::Parser parser;
        parser.AllowPartialMessage(true);
        EXPECT_TRUE(parser.ParseFromString(text, m.get())) << text;
        return m;
    }

    std::string encode(const std::string& type, const std::string& text) {
        std::string out;
        codec.encode(*codec.find(type), *message(type, text), out);
        return to_hex(out);
    }

    /// Decoded values as bytes of protobuf, which compare NaN and zeros of either sign bit by bit.
    std::string decode(const std::string& bytes, const std::string& type,
                       std::size_t* used = nullptr) {
        auto m = pool.new_message(pool.message(type));
        const Codec::Decoded d = codec.decode(bytes, *m, *codec.find(type));
        if (used != nullptr) *used = d.bytes;
        return m->SerializePartialAsString();
    }

    std::string expected(const std::string& type, const std::string& text) const {
        return message(type, text)->SerializePartialAsString();
    }

    schema::Pool& pool;
    ProgramOptions program_options;
    Codec codec;
    const Program* program = nullptr;
};

std::string text_of(const std::string& bytes, Bench& bench, const std::string& type) {
    auto m = bench.pool.new_message(bench.pool.message(type));
    m->ParsePartialFromString(bytes);
    return m->ShortDebugString();
}

void check_decoded(Bench& bench, const std::string& bytes, const std::string& type,
                   const std::string& text) {
    const std::string got = bench.decode(bytes, type);
    EXPECT_EQ(got, bench.expected(type, text))
        << "decoded  " << text_of(got, bench, type) << "\nexpected " << text;
}

void roundtrip(const json& v) {
    Bench bench(v);
    const std::string type = v["type"];
    EXPECT_EQ(bench.encode(type, v["input_text"]), v["hex"].get<std::string>());
    check_decoded(bench, from_hex(v["hex"]), type, v["decoded_text"]);
    if (v.contains("max_size")) {
        EXPECT_EQ(bench.program->reported_max_size(), v["max_size"].get<unsigned>());
        EXPECT_EQ(bench.program->reported_min_size(), v["min_size"].get<unsigned>());
    }
    if (v.contains("hash")) {
        const json& hash = v["hash"];
        const std::uint64_t want = hash.is_string()
                                       ? std::stoull(hash.get<std::string>(), nullptr, 0)
                                       : hash.get<std::uint64_t>();
        EXPECT_EQ(bench.program->definition_hash(), want);
    }
}

void decode(const json& v) {
    Bench bench(v);
    const std::string type = v["type"];
    const std::string bytes = from_hex(v["hex"]);
    check_decoded(bench, bytes, type, v["decoded_text"]);
    std::size_t used = 0;
    bench.decode(bytes, type, &used);
    EXPECT_EQ(bytes.size() - used, v.value("bytes_left", 0U));
}

void stream(const json& v) {
    Bench bench(v);
    std::string bytes = from_hex(v["hex"]);
    for (const json& one : v["decoded"]) {
        const std::string type = one["type"];
        EXPECT_EQ(bench.codec.identify(bytes).name(), type);
        std::size_t used = 0;
        EXPECT_EQ(bench.decode(bytes, type, &used), bench.expected(type, one["text"]));
        bytes.erase(0, used);
    }
    EXPECT_TRUE(bytes.empty());
}

void sequence(const json& v) {
    Bench bench(v);
    const std::string type = v["type"];
    for (const json& step : v["steps"]) {
        EXPECT_EQ(bench.encode(type, step["input_text"]), step["hex"].get<std::string>());
        auto expected = bench.pool.new_message(bench.pool.message(type));
        ASSERT_TRUE(
            google::protobuf::util::JsonStringToMessage(step["decoded_json"].dump(), expected.get())
                .ok());
        EXPECT_EQ(bench.decode(from_hex(step["hex"]), type), expected->SerializePartialAsString());
    }
}

void bulk(const json& v) {
    Bench bench(v);
    const std::string type = v["type"];
    const auto open = [&](const char* key) {
        return std::ifstream(vectors_folder() + "/" + v[key].get<std::string>());
    };
    auto text = open("input_text_file"), hex = open("hex_file"),
         decoded = open("decoded_text_file"), input_json = open("input_json_file");
    std::string t, h, d, j;
    int lines = 0;
    schema::JsonReader reader;
    schema::Values values;
    while (std::getline(text, t) && std::getline(hex, h) && std::getline(decoded, d) &&
           std::getline(input_json, j)) {
        ASSERT_EQ(bench.encode(type, t), h) << t;
        ASSERT_EQ(bench.decode(from_hex(h), type), bench.expected(type, d)) << d;
        reader.read(j, bench.program->layout(), values);
        std::string out;
        bench.codec.encode(*bench.program, values, out);
        ASSERT_EQ(to_hex(out), h) << j;
        ++lines;
    }
    EXPECT_EQ(lines, v["count"].get<int>());
}

void layout(const json& v) {
    Bench bench(v);
    const json& l = v["layout"];
    const Program& p = *bench.program;
    EXPECT_EQ(p.reported_max_size(), v["max_size"].get<unsigned>());
    EXPECT_EQ(p.reported_min_size(), v["min_size"].get<unsigned>());
    EXPECT_EQ(p.largest_bytes(), l["max_bytes_actual"].get<unsigned>());
    EXPECT_EQ(p.id_bits(), l["id_bits"].get<unsigned>());
    EXPECT_EQ(p.head_max_bits(), l["head_bits"].get<unsigned>());
    EXPECT_EQ(p.body_max_bits(), l["body_bits"].get<unsigned>());
    // The reference lists a oneof's members below its selector, and leaves out what takes no bits.
    using Row = std::tuple<std::string, std::uint64_t, std::uint64_t, std::string>;
    bool any_oneof = false;
    std::vector<Row> rows, ours;
    for (const char* part : {"head_fields", "body_fields"}) {
        for (const json& row : l[part]) any_oneof |= row["oneof"].get<bool>();
    }
    for (const char* part : {"head_fields", "body_fields"}) {
        for (const json& row : l[part]) {
            if (row["oneof"].get<bool>()) continue;
            rows.emplace_back(row["name"], row["min_bits"], row["max_bits"], row["codec"]);
        }
    }
    for (const FieldReport& r : p.report()) {
        if (r.lost || r.max_bits == 0) continue;
        ours.emplace_back(r.field->name, r.min_bits, r.max_bits, r.codec);
    }
    if (any_oneof) std::sort(rows.begin(), rows.end());
    if (any_oneof) std::sort(ours.begin(), ours.end());
    EXPECT_EQ(ours, rows);
}

void check(const json& v) {
    const std::string kind = v["kind"];
    if (kind == "roundtrip") return roundtrip(v);
    if (kind == "decode") return decode(v);
    if (kind == "stream") return stream(v);
    if (kind == "sequence") return sequence(v);
    if (kind == "bulk") return bulk(v);
    if (kind == "layout") return layout(v);
    if (kind == "load_error") {
        EXPECT_THROW(Bench{v}, ConfigError);
        return;
    }
    Bench bench(v);
    if (kind == "encode_error")
        EXPECT_THROW(bench.encode(v["type"], v["input_text"]), DataError);
    else if (kind == "decode_error")
        EXPECT_THROW(bench.decode(from_hex(v["hex"]), v["type"]), DataError);
    else
        FAIL() << "unknown kind " << kind;
}

class Vectors : public testing::TestWithParam<const char*> {};

/// Layout vectors do not repeat the models and add-ons that their schema needs: those of the other
/// vectors of the schema are meant.
void complete(json& v, const std::vector<json>& all) {
    if (v["kind"] != "layout" || v.contains("config")) return;
    json config = json::object();
    for (const json& other : all) {
        if (other["schema"] != v["schema"] || !other.contains("config")) continue;
        for (const json& lib : other["config"].value("libs", json::array())) {
            if (lib == "ccl") config["libs"] = json::array({"ccl"});
        }
        for (const json& model : other["config"].value("models", json::array())) {
            const auto name = [](const json& m) {
                return m.get<std::string>().substr(0, m.get<std::string>().find(' ', 7));
            };
            const json known = config.value("models", json::array());
            const bool twice = std::any_of(known.begin(), known.end(),
                                           [&](const json& k) { return name(k) == name(model); });
            if (!twice) config["models"].push_back(model);
        }
    }
    v["config"] = config;
}

TEST_P(Vectors, HoldAsTheReferenceHasThem) {
    std::ifstream in(vectors_folder() + "/vectors.jsonl");
    if (!in)
        GTEST_SKIP() << "no conformance vectors at " << vectors_folder() << " (SEAUTILS_SHARED)";
    std::vector<json> all;
    for (std::string line; std::getline(in, line);) all.push_back(json::parse(line));
    int count = 0;
    for (json v : all) {
        if (v["kind"] != GetParam()) continue;
        complete(v, all);
        SCOPED_TRACE(v["id"].get<std::string>() + " " + v["type"].get<std::string>() + " " +
                     v.value("note", ""));
        ++count;
        try {
            check(v);
        } catch (const std::exception& e) {
            ADD_FAILURE() << "threw: " << e.what();
        }
    }
    EXPECT_GT(count, 0);
}

INSTANTIATE_TEST_SUITE_P(Dccl, Vectors,
                         testing::Values("roundtrip", "decode", "stream", "sequence", "bulk",
                                         "layout", "load_error", "encode_error", "decode_error"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace seautils::dccl
