// How the tools of the link read and write records.
#ifndef SEAUTILS_TOOLS_RECORD_IO_HPP
#define SEAUTILS_TOOLS_RECORD_IO_HPP

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/record/codec.hpp"
#include "seautils/stream/fifo.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <deque>
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

    /// For tools that must never wait for the reader of their pipe. False: it has no room, and
    /// nothing was written.
    /// @throws DataError  larger than 4096 bytes
    bool offer(const record::Record& record) {
        packet_.clear();
        codec_.write(record, out_, packet_);
        return offer_packet();
    }
    bool offer_on(std::string_view bytes) {
        packet_.clear();
        codec_.convert(bytes, in_, out_, packet_);
        return offer_packet();
    }
    /// Writes the record as soon as there is room; false: too many wait already, it is lost.
    bool keep(const record::Record& record) {
        if (offer(record)) return true;
        if (kept_.size() >= most_kept) return false;
        kept_.push_back(packet_);
        return true;
    }
    /// Writes what was kept, as far as there is room.
    void write_kept() {
        while (!kept_.empty() && stream::try_write(STDOUT_FILENO, kept_.front())) kept_.pop_front();
    }
    std::size_t kept() const { return kept_.size(); }
    /// At the end: waits for the reader of what was kept, or leaves it.
    /// @return how many records are left
    std::size_t leave(bool may_wait) {
        write_kept();
        if (!may_wait) return kept_.size();
        for (const std::string& packet : kept_) io_.out.write(packet);
        kept_.clear();
        return 0;
    }

    record::Codec& codec() { return codec_; }
    record::Form out_form() const { return out_; }

private:
    /// dccl-encode and dccl-decode have records on one side only.
    static record::Form form(const std::string& name) {
        return name == "delimited" ? record::Form::delimited : record::Form::ndjson;
    }
    void sent() { is_pipe_ ? io_.out.flush() : io_.out.commit(); }

    bool offer_packet() {
        if (!is_pipe_) {
            io_.out.write(packet_);
            return true;
        }
        write_kept();
        return kept_.empty() && stream::try_write(STDOUT_FILENO, packet_);
    }

    static constexpr std::size_t most_kept = 10000;

    cli::Io& io_;
    record::Form in_, out_;
    bool is_pipe_ = false;
    record::Codec codec_;
    record::Record record_;
    std::string packet_;
    std::deque<std::string> kept_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_RECORD_IO_HPP
