#ifndef SEAUTILS_CLI_IO_HPP
#define SEAUTILS_CLI_IO_HPP

#include "seautils/cli/clock.hpp"
#include "seautils/stream/output.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::cli {

class Messages;

/// How records are told apart in a stream of bytes.
enum class Framing {
    lines,      ///< text: a record a line, `\n` or `\r\n`, the last one without if need be
    delimited,  ///< binary: varint length, then the record
};

/// What the command line says to every tool.
struct Settings {
    std::string input_format;           ///< as chosen by -F
    std::string format;                 ///< as chosen by -f
    std::vector<std::string> schemas;   ///< -s, in order
    std::vector<std::string> messages;  ///< -m, in order
    std::vector<std::string> files;     ///< FILE...; "-" or none is standard input
    std::size_t max_record = 1U << 20;
    bool strict = false;
    bool follow = false;
    std::optional<bool> progress;  ///< --progress, --no-progress
    Clock clock;                   ///< --clock, --time, SEAUTILS_CLOCK
    std::uint64_t seed = 0;
    int verbosity = 0;  ///< -1 quiet, 0, 1 …
};

/// What a tool's body sees of the command line and of the world.
class Io : public Settings {
public:
    Io(Settings settings, stream::Output& output, const Messages& messages);
    ~Io();
    Io(const Io&) = delete;
    Io& operator=(const Io&) = delete;

    stream::Output& out;  ///< standard output

    /// Calls `record` for each record of each input in turn. A DataError that `record` throws is
    /// reported at its place, `file:LINE:` or `file:record N (byte OFFSET):`, counted, and dropped;
    /// with --strict it ends the run with status 65. A record over max_record is refused likewise;
    /// a cut binary record always ends the run. Output is flushed whenever the next read would
    /// wait. Text from a terminal is read after a line that says so; binary is refused.
    /// An empty line is no record.
    /// @param record  gets the bytes without their line end; behind them lie at least 64 more
    ///                readable bytes
    void for_each(Framing framing, const std::function<void(std::string_view record)>& record);

    /// Unframed input: `block` gets all bytes that are not consumed yet, the offset of the first in
    /// the file, and whether the input has ended; it returns how many it consumed, and the rest
    /// comes again with more behind it. Ends with status 65 when `block` consumes nothing of
    /// max_record bytes.
    using Block =
        std::function<std::size_t(std::string_view bytes, std::uint64_t offset, bool ended)>;
    void for_each_block(const Block& block);

    /// Reports what is wrong at a byte of the unframed input, counts it, and obeys --strict.
    void refuse_at(std::uint64_t offset, const std::string& what);
    /// The same, and ends the run with status 65.
    [[noreturn]] void stop_at(std::uint64_t offset, const std::string& what);

    /// Reports a record that cannot be used at a place (`file:LINE: `), counts it, obeys --strict.
    void refuse(const std::string& place, const std::string& what);

    /// Messages without a place: a warning (not with -q), an information (only with -v).
    void warn(const std::string& what) const;
    void inform(const std::string& what) const;

    /// The clock's time in microseconds since 1970, UTC.
    std::int64_t now_us() const;

    /// Whether records come from standard input.
    bool reads_stdin() const;

    /// The line or the record that for_each() is at, from 1 in each file.
    std::uint64_t record_number() const;

    /// Records refused so far.
    std::uint64_t refused() const;

    /// The signal that ended the tool's loop, or 0: App raises it again when all is written.
    int ended_by = 0;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_IO_HPP
