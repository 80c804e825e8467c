// A schema in a few lines, its messages as text, its frames as hexadecimal.
#ifndef SEAUTILS_TESTS_UNIT_DCCL_BENCH_HPP
#define SEAUTILS_TESTS_UNIT_DCCL_BENCH_HPP

#include "seautils/core/error.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/models.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/pool.hpp"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace seautils::dccl {

inline std::string to_hex(const std::string& bytes) {
    std::string out;
    for (const char c : bytes) {
        out += "0123456789abcdef"[static_cast<unsigned char>(c) >> 4];
        out += "0123456789abcdef"[c & 15];
    }
    return out;
}

/// Blanks are skipped.
inline std::string from_hex(const std::string& hex) {
    std::string digits, out;
    for (const char c : hex) {
        if (c != ' ') digits += c;
    }
    for (std::size_t k = 0; k + 1 < digits.size(); k += 2) {
        out += static_cast<char>(std::stoi(digits.substr(k, 2), nullptr, 16));
    }
    return out;
}

class Bench {
public:
    /// @param body  what stands behind the import line; messages in the unnamed package
    explicit Bench(const std::string& body, const ProgramOptions& compiled_with = {},
                   const std::string& syntax = "proto2")
        : program_options(compiled_with) {
        pool_.load_text("t.proto",
                        "syntax = \"" + syntax +
                            "\"; import \"dccl/option_extensions.proto\"; "
                            "import \"dccl/arithmetic/protobuf/arithmetic_extensions.proto\"; "
                            "import \"dccl/ccl/protobuf/ccl_extensions.proto\"; " +
                            body);
    }

    const std::shared_ptr<const Program>& program(const std::string& type = "M") {
        auto& program = programs_[type];
        if (!program)
            program = Program::compile(pool_.layout(pool_.message(type)), program_options);
        return program;
    }

    std::string encode(const std::string& text, const std::string& type = "M") {
        Codec codec(options);
        codec.load(program(type));
        std::string out;
        codec.encode(*program(type), *message(text, type), out);
        return to_hex(out);
    }

    /// Of a frame that must be taken whole.
    std::string decode(const std::string& hex, const std::string& type = "M") {
        Codec codec(options);
        codec.load(program(type));
        auto got = pool_.new_message(pool_.message(type));
        const std::string bytes = from_hex(hex);
        EXPECT_EQ(codec.decode(bytes, *got, *program(type)).bytes, bytes.size()) << hex;
        return got->ShortDebugString();
    }

    /// Why it cannot be encoded; "" if it can.
    std::string refusal(const std::string& text, const std::string& type = "M") {
        try {
            encode(text, type);
        } catch (const DataError& e) {
            return e.what();
        }
        return "";
    }

    /// Why it cannot be decoded; "" if it can.
    std::string unreadable(const std::string& hex, const std::string& type = "M") {
        try {
            decode(hex, type);
        } catch (const DataError& e) {
            return e.what();
        }
        return "";
    }

    std::unique_ptr<google::protobuf::Message> message(const std::string& text,
                                                       const std::string& type = "M") const {
        auto m = pool_.new_message(pool_.message(type));
        google::protobuf::TextFormat::Parser parser;
        parser.AllowPartialMessage(true);
        EXPECT_TRUE(parser.ParseFromString(text, m.get())) << text;
        return m;
    }

    schema::Pool& pool() { return pool_; }

    CodecOptions options;
    ProgramOptions program_options;

private:
    schema::Pool pool_;
    std::map<std::string, std::shared_ptr<const Program>> programs_;
};

/// Why the type M of these lines may not be loaded; "" if it may.
inline std::string load_refusal(const std::string& body, const ProgramOptions& options = {},
                                const std::string& syntax = "proto2") {
    try {
        Bench(body, options, syntax).program();
    } catch (const ConfigError& e) {
        return e.what();
    }
    return "";
}

/// A message M of codec version 4 with these fields.
inline std::string version4(const std::string& fields, const std::string& more = "") {
    return "message M { option (dccl.msg) = { id: 1 max_bytes: 1024 codec_version: 4 " + more +
           " }; " + fields + " }";
}
inline std::string version(int number, const std::string& fields, const std::string& more = "") {
    return "message M { option (dccl.msg) = { id: 1 max_bytes: 1024 codec_version: " +
           std::to_string(number) + " " + more + " }; " + fields + " }";
}

}  // namespace seautils::dccl

#endif  // SEAUTILS_TESTS_UNIT_DCCL_BENCH_HPP
