#ifndef SEAUTILS_CLI_IO_HPP
#define SEAUTILS_CLI_IO_HPP

#include "seautils/stream/output.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::cli {

/// How records are told apart in a stream of bytes.
enum class Framing {
    lines,      ///< text: a record a line, `\n` or `\r\n`, the last one without if need be
    delimited,  ///< binary: varint length, then the record
    raw,        ///< binary: no framing; the body gets the whole block read so far (see for_each_block)
};

/// What a tool's body sees of the command line and of the world.
class Io {
public:
    stream::Output& out;              ///< standard output
    std::string input_format;         ///< as chosen by -F
    std::string format;               ///< as chosen by -f
    std::vector<std::string> schemas; ///< -s, in order
    std::vector<std::string> messages;///< -m, in order
    std::vector<std::string> files;   ///< FILE...; "-" or none is standard input
    std::size_t max_record = 1U << 20;
    bool strict = false;
    std::optional<std::int64_t> time_us;  ///< --time, else nothing (the tool asks now_us())
    std::uint64_t seed = 0;
    int verbosity = 0;  ///< -1 quiet, 0, 1 …

    /// Calls `record` for each record of each input in turn. A DataError that `record` throws is
    /// reported at its place, `file:LINE:` or `file:record N (byte OFFSET):`, counted, and dropped;
    /// with --strict it ends the run with status 65. A record over max_record is refused likewise,
    /// a cut binary record always ends the run. Output is flushed whenever the next read would
    /// wait. Text from a terminal is read after a line that says so; binary is refused.
    /// An empty line is no record. @p record  gets the bytes without their line end; behind them
    /// lie at least 64 more readable bytes.
    void for_each(Framing framing, const std::function<void(std::string_view record)>& record);
    void for_each_line(const std::function<void(std::string_view line)>& record) {
        for_each(Framing::lines, record);
    }

    /// Unframed input: `block` gets all bytes that are not consumed yet, with whether the input has
    /// ended, and returns how many it consumed; the rest comes again with more behind it. At most
    /// max_record bytes are kept: when `block` consumes nothing of that many, status 65.
    /// `offset` is that of the first byte in the file.
    void for_each_block(const std::function<std::size_t(std::string_view bytes, std::uint64_t offset,
                                                        bool ended)>& block);

    /// Reports a record refused at the current place (and counts it, and obeys --strict).
    void refuse(const std::string& what);
    /// As refuse, for unframed input: at `byte OFFSET`.
    void refuse_at(std::uint64_t offset, const std::string& what);

    /// Messages without a place: a warning (not with -q), an information (only with -v).
    void warn(const std::string& what);
    void inform(const std::string& what);

    /// The --time given, else the system's clock: microseconds since 1970, UTC.
    std::int64_t now_us() const;

    struct Impl;
    explicit Io(Impl& impl, stream::Output& output) : out(output), impl_(&impl) {}

private:
    Impl* impl_;
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_IO_HPP
