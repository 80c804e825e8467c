// What dccl-encode, dccl-decode and dccl-info ask of the command line in the same words.
#ifndef SEAUTILS_TOOLS_DCCL_OPTIONS_HPP
#define SEAUTILS_TOOLS_DCCL_OPTIONS_HPP

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/dccl/models.hpp"
#include "seautils/dccl/type_set.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

struct DcclOptions {
    bool keep_collisions = false;  ///< types that share an identifier do no harm here
    bool lenient = false;
    bool header_only = false;
    bool full_time_resolution = false;
    std::string passphrase_file;
    int passphrase_fd = -1;
    std::vector<std::int32_t> skip_crypto_ids;
    std::string id_codec = "default";
    std::vector<std::string> arithmetic_models;

    /// What decides on the types: all three tools.
    void add_type_options(CLI::App& app) {
        app.add_option("--id-codec", id_codec, "Identifiers of frames: default, or ccl (WHOI CCL)")
            ->check(CLI::IsMember({"default", "ccl"}))
            ->option_text("NAME");
        app.add_option("--arithmetic-model", arithmetic_models,
                       "Model of the arithmetic codec, in text format; may repeat")
            ->allow_extra_args(false)
            ->option_text("FILE");
    }
    /// What decides on frames: encoder and decoder.
    void add_frame_options(CLI::App& app) {
        app.add_flag("--lenient", lenient,
                     "Do as the reference library does where that loses data");
        app.add_flag("--header-only", header_only, "Code the header alone");
        auto* file = app.add_option("--passphrase-file", passphrase_file,
                                    "Encrypt bodies with the passphrase in this file")
                         ->option_text("FILE");
        app.add_option("--passphrase-fd", passphrase_fd, "The same from an open descriptor")
            ->option_text("N")
            ->excludes(file);
        app.add_option("--skip-crypto-id", skip_crypto_ids,
                       "Do not encrypt messages of this id; may repeat")
            ->allow_extra_args(false)
            ->option_text("ID");
    }

    dccl::TypeSet load(cli::Io& io) const;

private:
    std::optional<std::string> passphrase() const;
};

/// The whole of a small file. @throws Error(no_input)
inline std::string file_text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad()) {
        throw Error(ExitCode::no_input, path + ": " + std::strerror(errno != 0 ? errno : EIO));
    }
    return text;
}

/// All that comes from a descriptor, at most 64 KiB.
inline std::string descriptor_text(int fd) {
    std::string text;
    char block[4096];
    for (ssize_t n = 1; n > 0 && text.size() < 65536;) {
        n = ::read(fd, block, sizeof block);
        if (n < 0) {
            throw Error(ExitCode::no_input, "passphrase descriptor " + std::to_string(fd) + ": " +
                                                std::strerror(errno));
        }
        text.append(block, static_cast<std::size_t>(n));
    }
    return text;
}

/// From the file, the descriptor, or the file that SEAUTILS_PASSPHRASE_FILE names; without the line
/// end that editors put at the end of a file.
inline std::optional<std::string> DcclOptions::passphrase() const {
    std::string text;
    const char* named = std::getenv("SEAUTILS_PASSPHRASE_FILE");
    if (!passphrase_file.empty()) {
        text = file_text(passphrase_file);
    } else if (passphrase_fd >= 0) {
        text = descriptor_text(passphrase_fd);
    } else if (named != nullptr && *named != '\0') {
        text = file_text(named);
    } else {
        return std::nullopt;
    }
    if (text.ends_with('\n')) text.pop_back();
    if (text.ends_with('\r')) text.pop_back();
    if (text.empty()) throw ConfigError("the passphrase is empty");
    return text;
}

inline dccl::TypeSet DcclOptions::load(cli::Io& io) const {
    dccl::CodecOptions codec;
    codec.lenient = lenient;
    codec.header_only = header_only;
    codec.full_time_resolution = full_time_resolution;
    codec.passphrase = passphrase();
    codec.skip_crypto_ids.insert(skip_crypto_ids.begin(), skip_crypto_ids.end());
    codec.now_s = io.now_us() / 1'000'000;
    dccl::ProgramOptions program;
    program.id_codec = id_codec == "ccl" ? dccl::IdCodec::ccl : dccl::IdCodec::standard;
    for (const std::string& file : arithmetic_models) {
        try {
            dccl::add_model(file_text(file), program.models);
        } catch (const ConfigError& e) {
            throw ConfigError(file + ": " + e.what());
        }
    }
    dccl::TypeSet types(io.schemas, io.messages, program, std::move(codec),
                        keep_collisions ? dccl::Collisions::keep : dccl::Collisions::refuse);
    for (const auto& [name, reason] : types.left_out()) io.warn("left out: " + reason);
    for (const std::string& tag : types.ignored_tags())
        io.inform("tag <" + tag + "> means nothing here");
    return types;
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DCCL_OPTIONS_HPP
