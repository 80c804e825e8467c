// DCCL 1: the conformance vectors, frames computed by hand, and what is refused.
#include "seautils/core/error.hpp"
#include "seautils/dccl/legacy_codec.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/stream/hex.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

namespace seautils::dccl {
namespace {

using nlohmann::json;

/// A message of a schema, its values as JSON, its frames as hexadecimal.
class Legacy {
public:
    explicit Legacy(const std::string& xml) : schema_(parse_legacy("test.xml", xml, layouts_)) {}

    const LegacyMessage& message(const std::string& name = "") const {
        for (const LegacyMessage& m : schema_.messages) {
            if (name.empty() || m.name() == name) return m;
        }
        throw std::runtime_error("no message " + name);
    }

    std::string encode(const LegacyMessage& m, const json& values) {
        std::string record = values.dump() + std::string(64, '\0');
        reader_.read(std::string_view(record).substr(0, record.size() - 64), m.layout(), values_);
        std::string bytes, hex;
        dccl::encode(m, values_, options, bytes);
        stream::append_hex(hex, bytes);
        return hex;
    }

    json decode(const LegacyMessage& m, const std::string& hex) {
        std::string bytes, text;
        stream::from_hex(hex, bytes);
        EXPECT_EQ(dccl::decode(m, bytes, options, values_), bytes.size());
        schema::write_json(values_, text);
        return json::parse(text);
    }

    LegacyOptions options;

private:
    schema::LayoutSet layouts_;
    LegacySchema schema_;
    schema::JsonReader reader_;
    schema::Values values_;
};

std::string with_layout(const std::string& layout, const std::string& more = "") {
    return "<message_set><message><name>M</name><id>5</id><size>32</size>" + more + "<layout>" +
           layout + "</layout></message></message_set>";
}

std::string vectors_folder() {
    const char* shared = std::getenv("SEAUTILS_SHARED");
    const std::string root =
        shared != nullptr ? shared : std::string(SEAUTILS_SOURCE_DIR) + "/../shared";
    return root + "/vectors/dccl-legacy";
}

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Whether what was decoded says what the vector says: null and absent are the same.
bool says(const json& got, const json& expected) {
    if (expected.is_array()) {
        if (!got.is_array()) return false;
        for (std::size_t k = 0; k < expected.size(); ++k) {
            const json other = k < got.size() ? got[k] : json();
            if (!says(other, expected[k])) return false;
        }
        return true;
    }
    if (expected.is_number() && got.is_number()) return got.get<double>() == expected.get<double>();
    return got == expected;
}

class LegacyVectors : public testing::TestWithParam<const char*> {};

TEST_P(LegacyVectors, BytesAndValues) {
    const std::string base = vectors_folder() + "/" + GetParam();
    if (!std::filesystem::exists(base + ".jsonl")) GTEST_SKIP() << "no vectors in " << base;
    Legacy legacy(text_of(base + ".xml"));
    std::ifstream lines(base + ".jsonl");
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        const json v = json::parse(line);
        const LegacyMessage& m = legacy.message(v["message"]);
        const schema::Layout& layout = m.layout();
        std::optional<Cipher> cipher;
        if (v.contains("passphrase")) cipher.emplace(v["passphrase"].get<std::string>());
        legacy.options.cipher = cipher ? &*cipher : nullptr;
        legacy.options.now_s = v["time_s"];
        json values = v["values"];
        values[layout.fields[header_time].name] = v["time_s"];
        values[layout.fields[header_src].name] = v["src"];
        values[layout.fields[header_dest].name] = v["dest"];
        EXPECT_EQ(legacy.encode(m, values), v["hex"].get<std::string>()) << line;
        const json decoded = legacy.decode(m, v["hex"]);
        for (const auto& [key, value] : v["decoded"].items()) {
            EXPECT_TRUE(says(decoded.value(key, json()), value))
                << key << " " << decoded << " " << line;
        }
        EXPECT_EQ(decoded[layout.fields[header_src].name], v["src"]);
        EXPECT_EQ(decoded[layout.fields[header_dest].name], v["dest"]);
        EXPECT_EQ(decoded[layout.fields[header_time].name].get<double>(),
                  std::round(v["time_s"].get<double>()));
    }
    EXPECT_GT(count, 0);
}
INSTANTIATE_TEST_SUITE_P(Dccl, LegacyVectors, testing::Values("status", "ctd"));

TEST(DcclLegacy, ABodyByHand) {
    // 0 to 6 and "not given" are 8 codes: 3 bits. 5 is code 6, 110; true is code 2 of 3, 10.
    Legacy legacy(with_layout(
        "<int><name>n</name><max>6</max><min>0</min></int><bool><name>b</name></bool>"));
    const LegacyMessage& m = legacy.message();
    EXPECT_EQ(m.body_bits(), 5U);
    EXPECT_EQ(m.largest_bytes(), 7U);
    const std::string all = legacy.encode(m, {{"n", 5}, {"b", true}, {"_time", 0}});
    const json back = legacy.decode(m, all);
    EXPECT_EQ(back["n"], 5);
    EXPECT_EQ(back["b"], true);
    // Nothing given is zeros, and zeros at the end are not sent.
    EXPECT_EQ(legacy.encode(m, {{"_time", 0}}).size(), 12U);
    EXPECT_FALSE(legacy.decode(m, legacy.encode(m, {{"_time", 0}})).contains("n"));
}

TEST(DcclLegacy, WhatCannotBeSaidIsRefused) {
    Legacy legacy(with_layout(
        "<float><name>f</name><max>10</max><min>-10</min><precision>1</precision></float>"
        "<enum><name>e</name><value>A</value><value>B</value></enum>"
        "<string><name>s</name><max_length>3</max_length></string>"
        "<hex><name>h</name><num_bytes>2</num_bytes></hex>"));
    const LegacyMessage& m = legacy.message();
    const auto refusal = [&](const json& values) -> std::string {
        try {
            legacy.encode(m, values);
        } catch (const DataError& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(refusal({{"f", 10}, {"e", "A"}, {"s", "abc"}, {"h", "0a0b"}}), "");
    EXPECT_NE(refusal({{"f", 10.1}}).find("f 10.1 is outside -10 to 10"), std::string::npos);
    EXPECT_NE(refusal({{"e", "C"}}).find("'C'"), std::string::npos);
    EXPECT_NE(refusal({{"s", "abcd"}}).find("'abcd'"), std::string::npos);
    EXPECT_NE(refusal({{"h", "0a"}}), "");
    EXPECT_NE(refusal({{"_src_id", 32}}).find("32"), std::string::npos);
    legacy.options.lenient = true;
    EXPECT_EQ(refusal({{"f", 10.1}, {"e", "C"}, {"s", "abcd"}}), "");
}

TEST(DcclLegacy, ShortForeignAndSurplusFramesAreRefused) {
    Legacy legacy(with_layout("<bool><name>b</name></bool>"));
    const LegacyMessage& m = legacy.message();
    const std::string frame = legacy.encode(m, {{"b", true}, {"_time", 0}});
    EXPECT_THROW(legacy.decode(m, frame.substr(0, 10)), DataError);
    EXPECT_THROW(legacy.decode(m, frame + "01"), DataError);
    std::string bytes;
    stream::from_hex("21" + frame.substr(2), bytes);  // not CCL's identifier 32
    EXPECT_THROW(legacy_id(bytes), DataError);
    stream::from_hex(frame, bytes);
    EXPECT_EQ(legacy_id(bytes), 5);
}

std::string number(const std::string& min, const std::string& max, int precision,
                   const std::string& more = "") {
    return with_layout(
        fmt::format("<float><name>x</name><min>{}</min><max>{}</max>"
                    "<precision>{}</precision>{}</float>",
                    min, max, precision, more));
}

TEST(DcclLegacy, StepsAreToldApartAsFarAsBoundsMayGo) {
    std::mt19937_64 dice(20261201);
    for (int precision = -12; precision <= 12; ++precision) {
        const std::int64_t most = std::int64_t{1} << (precision == 0 ? 53 : 51);
        for (int k = 0; k < 100; ++k) {
            // Both are the doubles next to a decimal number, and within the limit.
            const auto low = most - 3 - static_cast<std::int64_t>(dice() % 1'000'000);
            const auto high = low + 1 + static_cast<std::int64_t>(dice() % 3);
            const auto written = [&](std::int64_t steps) {
                return fmt::format("{}e{}", k % 2 == 0 ? steps : -steps, -precision);
            };
            Legacy log(number(written(low), written(high), precision));
            const LegacyMessage& m = log.message();
            for (std::int64_t at = low; at <= high; ++at) {
                const double x = std::strtod(written(at).c_str(), nullptr);
                const json back = log.decode(m, log.encode(m, {{"x", x}}));
                ASSERT_EQ(back.at("x"), x) << written(at) << " of " << written(low);
            }
        }
    }
}

std::string refusal(const std::string& xml) {
    schema::LayoutSet layouts;
    try {
        parse_legacy("log.xml", xml, layouts);
    } catch (const ConfigError& e) {
        return e.what();
    }
    return "";
}

TEST(DcclLegacy, AHalfStepOfDifferenceBringsNoNegativeZero) {
    // Element 0 is 1, and differences go from -1.5 in steps of 1: code 2 is -0.5, so 0.5, so 0;
    // that is -1 from element 0, code 1, again 0. Halves go to the even.
    Legacy log(number("0", "1", 0, "<array_length>2</array_length><max_delta>1.5</max_delta>"));
    const LegacyMessage& m = log.message();
    ASSERT_EQ(m.body_bits(), 2 + 3U);
    for (const char* frame : {"2002800000000a", "20028000000006"}) {
        const json x = log.decode(m, frame).at("x");
        EXPECT_EQ(x.dump(), "[1,0]") << frame;
        EXPECT_EQ(log.decode(m, log.encode(m, {{"x", x}})).at("x").dump(), x.dump());
    }
}

TEST(DcclLegacy, BoundsBeyondTheStepsOfADoubleAreRefused) {
    EXPECT_EQ(refusal(number("9007199254740990", "9007199254740992", 0)), "");
    EXPECT_EQ(refusal(number("9007199254740990", "9007199254740994", 0)),
              "log.xml:1: field 'x' goes beyond 2^53 steps of 10^0");
    EXPECT_EQ(refusal(number("2251799813685247e-3", "2251799813685248e-3", 3)), "");
    EXPECT_EQ(refusal(number("-2251799813685250e-3", "-2251799813685249e-3", 3)),
              "log.xml:1: field 'x' goes beyond 2^51 steps of 10^-3");
    EXPECT_EQ(refusal(number("-1e300", "-1e300", -2)),
              "log.xml:1: field 'x' goes beyond 2^51 steps of 10^2");
    const std::string row = "<array_length>3</array_length><max_delta>1e9</max_delta>";
    EXPECT_EQ(refusal(number("2251799813685000e6", "2251799813685100e6", -6, row)),
              "log.xml:1: field 'x' goes beyond 2^51 steps of 10^6")
        << "an element may lie max_delta beyond";
}

TEST(DcclLegacy, SchemasThatCannotWorkAreLocated) {
    EXPECT_EQ(refusal(with_layout("<bool><name>b</name></bool>")), "");
    EXPECT_TRUE(refusal("<message_set>\n<message>").starts_with("log.xml:2: not well-formed"));
    EXPECT_TRUE(refusal("<other/>").starts_with("log.xml:1: the root"));
    EXPECT_NE(refusal(with_layout("\n<bool/>")).find("log.xml:2: <bool> has no <name>"),
              std::string::npos);
    EXPECT_NE(refusal(with_layout("<int><name>n</name><max>x</max></int>")).find("'x'"),
              std::string::npos);
    EXPECT_NE(refusal(with_layout("<string><name>s</name><max_length>90</max_length></string>")),
              "")
        << "longer than <size>";
    EXPECT_NE(refusal(with_layout("<bool><name>b</name></bool><bool><name>b</name></bool>")), "");
    EXPECT_NE(refusal(with_layout("<bool><name>&#1;</name></bool>")), "");
    const auto sized = [](int bytes, int fields) {
        std::string all;
        for (int k = 0; k < fields; ++k) all += fmt::format("<bool><name>b{}</name></bool>", k);
        return fmt::format(
            "<message_set><message><name>M</name><id>5</id><size>{}</size>"
            "<layout>{}</layout></message></message_set>",
            bytes, all);
    };
    EXPECT_EQ(refusal(sized(65536, 10000)), "");
    EXPECT_NE(refusal(sized(65537, 1)).find("1 to 65536"), std::string::npos);
    EXPECT_NE(refusal(sized(65536, 10001)).find("more than 10000 fields"), std::string::npos);
    EXPECT_NE(refusal(std::string((1U << 20) + 1, ' ')).find("1 MiB"), std::string::npos);
    EXPECT_NE(refusal(with_layout("<bool><name>\xff</name></bool>")), "");
}

}  // namespace
}  // namespace seautils::dccl
