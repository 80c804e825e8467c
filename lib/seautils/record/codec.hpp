#ifndef SEAUTILS_RECORD_CODEC_HPP
#define SEAUTILS_RECORD_CODEC_HPP

#include "seautils/record/record.hpp"
#include "seautils/schema/layout.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace seautils::record {

/// The two forms of a record. NDJSON: an object a line. Delimited: varint length, then protobuf's
/// binary form.
enum class Form : std::uint8_t { ndjson, delimited };

/// A record may take this many bytes, with its line end or its length: as many as a pipe takes
/// from one write without mixing them with another's (PIPE_BUF of Linux).
constexpr std::size_t max_bytes = 4096;

/// Reads and writes records. Keeps its buffers, so that a stream allocates nothing once it is warm;
/// usable from one thread at a time.
class Codec {
public:
    Codec();
    ~Codec();
    Codec(Codec&&) noexcept;
    Codec& operator=(Codec&&) noexcept;

    /// Reads one record, given without its line end or length. Fields, kinds and enumerators that
    /// are not known are skipped.
    /// @throws DataError  malformed; more than max_bytes; no kind, or two of them
    void read(std::string_view bytes, Form form, Record& record);

    /// Appends the record with its line end or length.
    /// @throws DataError  it takes more than max_bytes (says the kind); `out` is unchanged then
    void write(const Record& record, Form form, std::string& out);

    /// Appends a record that was read in one form in the other (or the same), with all that it
    /// holds, known or not: what the other form cannot say goes along whole (as_json, as_binary).
    /// @param bytes  without its line end or length
    /// @throws DataError  as read and write
    void convert(std::string_view bytes, Form from, Form to, std::string& out);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// `message`, `slot` …: the key of the record's kind in JSON; "unknown" where there is none.
std::string_view kind_name(const Record& record);

/// The layout that records are read and written by: that of record.proto.
const schema::Layout& layout();

}  // namespace seautils::record

#endif  // SEAUTILS_RECORD_CODEC_HPP
