// The library against the reference model, over random schemas, random messages and random bits.
// SEAUTILS_RANDOM_SCHEMAS and SEAUTILS_RANDOM_FIRST: how many seeds, from which one on.
#include "dccl_random.hpp"
#include "dccl_reference_decode.hpp"
#include "dccl_reference_text.hpp"

#include "seautils/core/error.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/schema/pool.hpp"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace seautils::dccl {
namespace {

using google::protobuf::TextFormat;

std::string hex(const std::string& bytes) {
    std::string out;
    for (const char c : bytes) out += fmt::format("{:02x}", static_cast<unsigned char>(c));
    return out;
}

struct Tally {
    int schemas = 0, refused = 0, encoded = 0, lossy = 0, decoded = 0, unreadable = 0,
        undefined = 0;
};

/// One random schema in the library and in the model.
class Pair {
public:
    Pair(std::uint64_t seed, int version, bool proto3)
        : seed_(seed), root_(reference::SchemaMaker(seed, version, proto3).root()) {
        text_ = reference::proto_text(root_, proto3);
        pool_.load_text("r.proto", text_);
    }

    /// Whether it compiles, as the model says it must or must not.
    bool compiles() {
        const auto refusal = reference::refusal(root_);
        try {
            program_ = Program::compile(pool_.layout(pool_.message("r." + root_.name)));
        } catch (const ConfigError& e) {
            EXPECT_TRUE(refusal) << e.what() << "\n" << where();
            return false;
        }
        EXPECT_FALSE(refusal) << *refusal << " is no reason to refuse\n" << where();
        if (refusal) return false;
        const auto [head, body] = reference::sizes(root_);
        EXPECT_EQ(program_->head_min_bits() + program_->id_bits(), head.min) << where();
        EXPECT_EQ(program_->head_max_bits() + program_->id_bits(), head.max) << where();
        EXPECT_EQ(program_->body_min_bits(), body.min) << where();
        EXPECT_EQ(program_->body_max_bits(), body.max) << where();
        return true;
    }

    void encode(std::uint64_t seed, bool wild, Tally& tally) {
        const reference::Value value = reference::ValueMaker(seed, wild).message(root_);
        reference::Encoded expected;
        const bool header_only = seed % 7 == 0;
        try {
            expected = reference::encode(root_, value, header_only);
        } catch (const reference::Undefined&) {
            ++tally.undefined;
            return;
        }
        const std::string text = reference::text_of(root_, value);
        const auto message = parsed(text);
        std::string lenient;
        codec(true, header_only).encode(*program_, *message, lenient);
        ASSERT_EQ(hex(lenient), hex(expected.bytes)) << text << "\n" << where();
        std::string strict;
        try {
            codec(false, header_only).encode(*program_, *message, strict);
        } catch (const DataError& e) {
            ASSERT_TRUE(expected.lossy || expected.dropped) << e.what() << "\n"
                                                            << text << "\n"
                                                            << where();
            ++tally.lossy;
        }
        if (!strict.empty()) {
            ASSERT_FALSE(expected.lossy || (expected.dropped && !header_only)) << text << "\n"
                                                                               << where();
            ASSERT_EQ(strict, lenient);
        }
        ++tally.encoded;
        if (!header_only) decode(expected.bytes, tally);
    }

    void decode(const std::string& bytes, Tally& tally) {
        const auto got = pool_.new_message(pool_.message("r." + root_.name));
        std::size_t used = 0, expected_used = 0;
        bool refused = false;
        try {
            used = codec(true, false).decode(bytes, *got, *program_).bytes;
        } catch (const DataError&) {
            refused = true;
        }
        try {
            const auto value = reference::decode(root_, bytes, now_s, expected_used);
            ASSERT_FALSE(refused) << hex(bytes) << "\n" << where();
            const std::string text = reference::text_of(root_, value);
            ASSERT_EQ(got->ShortDebugString(), parsed(text)->ShortDebugString())
                << hex(bytes) << "\n"
                << where();
            ASSERT_EQ(got->SerializePartialAsString(), parsed(text)->SerializePartialAsString())
                << hex(bytes) << " " << text << "\n"
                << where();
            ASSERT_EQ(used, expected_used) << hex(bytes) << "\n" << where();
            ++tally.decoded;
        } catch (const reference::Undefined&) {
            ++tally.undefined;
        } catch (const reference::Refused&) {
            ASSERT_TRUE(refused) << hex(bytes) << "\n" << where();
            ++tally.unreadable;
        }
    }

    /// A frame of random bits behind the identifier.
    std::string noise(std::uint64_t seed) const {
        reference::Dice dice(seed);
        std::string bytes;
        for (unsigned k = 0; k < program_->id_bits(); k += 8) {
            bytes += static_cast<char>(program_->id_code() >> k & 0xff);
        }
        const auto most =
            static_cast<int>(std::min<std::uint64_t>(program_->largest_bytes(), 400)) + 8;
        const int dense = 1 + dice.below(4);
        for (int k = dice.one_in(4) ? dice.below(most) : most; k > 0; --k) {
            bytes += static_cast<char>(dice.one_in(dense) ? dice.below(256) : 0);
        }
        return bytes;
    }

private:
    static constexpr std::int64_t now_s = 1'700'000'000;

    std::string where() const { return fmt::format("seed {}\n{}", seed_, text_); }

    std::unique_ptr<google::protobuf::Message> parsed(const std::string& text) const {
        auto message = pool_.new_message(pool_.message("r." + root_.name));
        TextFormat::Parser parser;
        parser.AllowPartialMessage(true);
        EXPECT_TRUE(parser.ParseFromString(text, message.get())) << text << "\n" << where();
        return message;
    }

    Codec codec(bool lenient, bool header_only) const {
        CodecOptions options;
        options.lenient = lenient;
        options.header_only = header_only;
        options.now_s = now_s;
        Codec codec(options);
        codec.load(program_);
        return codec;
    }

    std::uint64_t seed_;
    reference::Message root_;
    std::string text_;
    schema::Pool pool_;
    std::shared_ptr<const Program> program_;
};

class ByReference : public testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(ByReference, BitsAndValues) {
    const auto [version, proto3] = GetParam();
    const char* many = std::getenv("SEAUTILS_RANDOM_SCHEMAS");
    const std::uint64_t count = many != nullptr ? std::stoull(many) : 400;
    const char* from = std::getenv("SEAUTILS_RANDOM_FIRST");
    const std::uint64_t first = from != nullptr ? std::stoull(from) : 1;
    const google::protobuf::LogSilencer quiet;  // strings of random bits are no UTF-8
    Tally tally;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        Pair pair(seed, version, proto3);
        ++tally.schemas;
        if (!pair.compiles())
            ++tally.refused;
        else
            for (std::uint64_t k = 0; k < 8; ++k) {
                pair.encode(seed * 8 + k, k % 2 == 1, tally);
                if (!HasFatalFailure()) pair.decode(pair.noise(seed * 8 + k), tally);
            }
        if (HasFailure()) return;
    }
    EXPECT_LT(tally.refused, tally.schemas / 2);
    EXPECT_GT(tally.lossy, tally.schemas / 4);
    EXPECT_LT(tally.undefined, tally.schemas);
    EXPECT_GT(tally.encoded, tally.schemas);
    EXPECT_GT(tally.decoded, tally.schemas);
}
INSTANTIATE_TEST_SUITE_P(Dccl, ByReference,
                         testing::Values(std::tuple(2, false), std::tuple(3, false),
                                         std::tuple(4, false), std::tuple(3, true),
                                         std::tuple(4, true)));

// The model of the format, of which the other tests make so much.

TEST(DcclReference, GivesTheWorkedExamples) {
    namespace r = reference;
    const auto bytes = [](r::Field f, double value, int id, int version) {
        r::Message m;
        m.id = id;
        m.version = version;
        r::Value v;
        v.items.resize(1);
        v.items[0].set = true;
        v.items[0].real = value;
        v.items[0].whole = static_cast<r::Int>(value);
        m.fields.push_back(std::move(f));
        return hex(r::encode(m, v).bytes);
    };
    r::Field f;
    f.type = r::Type::int32;
    f.min = -500;
    f.max = 500;
    f.precision = -1;
    EXPECT_EQ(bytes(f, -17, 32, 4), "4032");
    f.type = r::Type::uint32;
    f.min = 0;
    f.max = 254;
    f.precision.reset();
    EXPECT_EQ(bytes(f, 128, 128, 4), "010181");
    f.type = r::Type::float64;
    f.label = r::Label::required;
    f.min = -56;
    f.max = -43.3;
    f.precision = 1;
    EXPECT_EQ(r::number_of(f, {"dccl.default", 4}, true).bits(), 8U);
    EXPECT_EQ(bytes(f, -43.3, 43, 4), "567f");
    r::Field time;
    time.type = r::Type::float64;
    time.label = r::Label::required;
    time.codec = "dccl.time";
    EXPECT_EQ(bytes(time, 1.7e9, 110, 3), "dc803801");
    r::Field text;
    text.type = r::Type::string;
    text.max_length = 3;
    EXPECT_EQ(r::text_size(text, {"dccl.default", 2}, false).max, 8U + 24);
    EXPECT_EQ(r::text_size(text, {"dccl.default", 3}, false).max, 2U + 24);
    EXPECT_EQ(r::text_size(text, {"dccl.default", 4}, false).max, 1U + 2 + 24);
}

}  // namespace
}  // namespace seautils::dccl
