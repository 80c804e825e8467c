// How the tools of the link read and write records.
#ifndef SEAUTILS_TOOLS_RECORD_IO_HPP
#define SEAUTILS_TOOLS_RECORD_IO_HPP

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/record/codec.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <vector>

namespace seautils::tools {

/// The formats that records have, for App::input_formats and output_formats.
inline const std::vector<std::string> record_formats{"ndjson", "delimited"};

/// Where a tool of other formats reads or writes records: ndjson when no format is chosen.
/// @param option  --format or --input-format; what it chose is in `format`
/// @throws Error(usage)  ndjson without records, or records in another format
inline void settle_record_format(bool records, const CLI::App& app, const std::string& option,
                                 std::string& format) {
    const bool chosen = app.get_option(option)->count() > 0;
    if (records && !chosen) format = "ndjson";
    if (!records && format == "ndjson")
        throw Error(ExitCode::usage, "option " + option + ": ndjson is for --records");
    if (records && format != "ndjson" && format != "delimited")
        throw Error(ExitCode::usage, "option " + option + ": records are ndjson or delimited");
}

/// Records in and out, in the formats of -F and -f.
class RecordIo {
public:
    explicit RecordIo(cli::Io& io) : io_(io), in_(form(io.input_format)), out_(form(io.format)) {
        struct stat status {};
        is_pipe_ = ::fstat(STDOUT_FILENO, &status) == 0 && S_ISFIFO(status.st_mode);
    }

    cli::Framing framing() const {
        return in_ == record::Form::ndjson ? cli::Framing::lines : cli::Framing::delimited;
    }

    /// The record, until the next call. @throws DataError
    const record::Record& read(std::string_view bytes) {
        codec_.read(bytes, in_, record_);
        return record_;
    }
    /// A packet of a socket: either form, told by its first byte. @throws DataError
    const record::Record& read_packet(std::string_view bytes) {
        const bool json = bytes.starts_with('{');
        codec_.read(bytes, json ? record::Form::ndjson : record::Form::delimited, record_);
        return record_;
    }

    /// Writes a record to standard output; into a pipe with a write of its own.
    /// @throws DataError  larger than 4096 bytes
    void write(const record::Record& record) {
        codec_.write(record, out_, io_.out.buffer());
        sent();
    }
    /// Passes a record on as it came, with all that this version does not know.
    void pass_on(std::string_view bytes) {
        codec_.convert(bytes, in_, out_, io_.out.buffer());
        sent();
    }

    record::Codec& codec() { return codec_; }
    record::Form out_form() const { return out_; }

private:
    /// dccl-encode and dccl-decode have records on one side only.
    static record::Form form(const std::string& name) {
        return name == "delimited" ? record::Form::delimited : record::Form::ndjson;
    }
    void sent() { is_pipe_ ? io_.out.flush() : io_.out.commit(); }

    cli::Io& io_;
    record::Form in_, out_;
    bool is_pipe_ = false;
    record::Codec codec_;
    record::Record record_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_RECORD_IO_HPP
