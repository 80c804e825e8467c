// What dccl-encode, dccl-decode and dccl-info ask of the command line in the same words.
#ifndef SEAUTILS_TOOLS_DCCL_OPTIONS_HPP
#define SEAUTILS_TOOLS_DCCL_OPTIONS_HPP

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/dccl/models.hpp"
#include "seautils/dccl/type_set.hpp"
#include "seautils/stream/whole_file.hpp"

#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

struct DcclOptions {
    bool keep_collisions = false;  ///< types that share an identifier do no harm here
    bool frames = false;           ///< what is encrypted concerns this tool
    bool lenient = false;
    bool header_only = false;
    bool full_time_resolution = false;
    std::string passphrase_file;
    int passphrase_fd = -1;
    std::vector<std::int32_t> skip_crypto_ids;
    std::string id_codec = "default";
    std::vector<std::string> arithmetic_models;
    dccl::FieldCodecs field_codecs;  ///< what the tool brings along

    /// What decides on the types: all three tools.
    void add_type_options(CLI::App& app) {
        app.add_option("--id-codec", id_codec, "Identifiers of frames: default, or ccl (WHOI CCL)")
            ->check([](const std::string& name) {
                const bool known = name == "default" || name == "ccl";
                return known ? std::string() : quote(name) + " is none of default, ccl";
            })
            ->option_text("NAME");
        app.add_option("--arithmetic-model", arithmetic_models,
                       "Model of the arithmetic codec, in text format; may repeat")
            ->allow_extra_args(false)
            ->option_text("FILE");
    }
    /// What decides on frames: encoder and decoder.
    void add_frame_options(CLI::App& app) {
        frames = true;
        app.add_flag("--lenient", lenient,
                     "Do as the reference library does where that loses data");
        app.add_flag("--header-only", header_only, "Code the header alone");
        auto* file = app.add_option("--passphrase-file", passphrase_file,
                                    "Encrypt bodies with the passphrase in this file")
                         ->option_text("FILE");
        app.add_option("--passphrase-fd", passphrase_fd, "The same from an open descriptor")
            ->option_text("N")
            ->check([](const std::string& n) {
                return n.starts_with('-') ? quote(n) + " is below 0" : std::string();
            })
            ->excludes(file);
        app.add_option("--skip-crypto-id", skip_crypto_ids,
                       "Do not encrypt messages of this id; may repeat")
            ->allow_extra_args(false)
            ->option_text("ID");
    }

    dccl::TypeSet load(cli::Io& io) const;

private:
    std::optional<std::string> passphrase() const;
    void check_legacy(const dccl::TypeSet& types, const cli::Io& io) const;
};

inline constexpr std::size_t most_option_bytes = 1U << 20;

/// From the file, the descriptor, or the file that SEAUTILS_PASSPHRASE_FILE names; without the line
/// end that editors put at the end of a file.
inline std::optional<std::string> DcclOptions::passphrase() const {
    std::string text;
    const char* named = std::getenv("SEAUTILS_PASSPHRASE_FILE");
    if (!passphrase_file.empty()) {
        text = stream::read_input_file(passphrase_file, most_option_bytes);
    } else if (passphrase_fd >= 0) {
        text = stream::read_input_descriptor(
            passphrase_fd, "passphrase descriptor " + std::to_string(passphrase_fd),
            most_option_bytes);
    } else if (named != nullptr && *named != '\0') {
        text = stream::read_input_file(named, most_option_bytes);
    } else {
        return std::nullopt;
    }
    if (text.ends_with('\n')) text.pop_back();
    if (text.ends_with('\r')) text.pop_back();
    if (text.empty()) throw ConfigError("the passphrase is empty");
    if (text.size() > 65536) throw ConfigError("the passphrase is longer than 65536 bytes");
    return text;
}

/// What messages of DCCL 1 cannot do is refused before anything is read.
/// @throws Error(usage)
inline void DcclOptions::check_legacy(const dccl::TypeSet& types, const cli::Io& io) const {
    if (types.types().empty() || types.types()[0].legacy == nullptr) return;
    const auto usage = [](const std::string& what) { throw Error(ExitCode::usage, what); };
    if (io.input_format == "raw" || io.format == "raw")
        usage("frames of DCCL 1 do not say where they end: raw cannot hold them");
    if (header_only) usage("option --header-only is not for messages of DCCL 1");
    if (id_codec != "default") usage("option --id-codec is not for messages of DCCL 1");
    if (!arithmetic_models.empty())
        usage("option --arithmetic-model is not for messages of DCCL 1");
}

inline dccl::TypeSet DcclOptions::load(cli::Io& io) const {
    if (passphrase_fd == STDIN_FILENO && io.reads_stdin()) {
        throw Error(ExitCode::usage,
                    "the passphrase and the records cannot both be standard input");
    }
    dccl::CodecOptions codec;
    codec.lenient = lenient;
    codec.header_only = header_only;
    codec.full_time_resolution = full_time_resolution;
    if (frames) codec.passphrase = passphrase();
    codec.skip_crypto_ids.insert(skip_crypto_ids.begin(), skip_crypto_ids.end());
    codec.now_s = io.now_us() / 1'000'000;
    dccl::ProgramOptions program;
    program.id_codec = id_codec == "ccl" ? dccl::IdCodec::ccl : dccl::IdCodec::standard;
    program.field_codecs = field_codecs;
    for (const std::string& file : arithmetic_models) {
        const std::string text = stream::read_input_file(file, most_option_bytes);
        try {
            dccl::add_model(text, program.models);
        } catch (const ConfigError& e) {
            throw ConfigError(file + ": " + e.what());
        }
    }
    dccl::TypeSet types(io.schemas, io.messages, program, std::move(codec),
                        keep_collisions ? dccl::Collisions::keep : dccl::Collisions::refuse);
    check_legacy(types, io);
    for (const auto& [name, reason] : types.left_out()) io.warn("left out: " + reason);
    for (const std::string& tag : types.ignored_tags())
        io.inform("tag <" + tag + "> means nothing here");
    return types;
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DCCL_OPTIONS_HPP
