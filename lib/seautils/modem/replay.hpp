#ifndef SEAUTILS_MODEM_REPLAY_HPP
#define SEAUTILS_MODEM_REPLAY_HPP

#include "seautils/modem/line_reader.hpp"
#include "seautils/modem/listener.hpp"
#include "seautils/modem/moment.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::modem {

/// A line of a log, taken apart: what is before the sentence says when it was, and which way it went.
struct LogLine {
    std::optional<record::UtcTime> time;
    bool outgoing = false;      ///< to the modem: `[tx]`, `>`, or a sentence of the host's (`$CC`)
    std::string_view sentence;  ///< from its `$` or `!` on; empty: there is none
};

/// Takes lines of a log apart. Times are `2024-05-01T12:00:25.5Z`, the same with a blank for the `T` or
/// without the `Z` (logs are in UTC), Goby's `2024-May-01 12:00:25.5`, `@1714564825.5` or
/// `1714564825.5`; brackets may stand around them. Directions are Goby's `[rx]` and `[tx]`, `<` and
/// `>`, in either case, anywhere before the sentence.
class LogLines {
public:
    LogLine read(std::string_view line);
    /// The time that a text begins with.
    std::optional<record::UtcTime> time_of(std::string_view text);

private:
    std::optional<std::int64_t> date(std::string_view text);

    std::string date_;  ///< the last one: most lines are of the same day
    std::int64_t date_ns_ = 0;
};

/// Makes the records of a recorded dialogue with a modem, as the driver gave them out then: receptions,
/// acknowledgements, results with their statistics, ranges, events. Which transmission an
/// acknowledgement or result is of is not in such a log; its number is 0.
class Replay {
public:
    /// @param id   the modem's address; absent: as the log says (SRC), and acknowledgements to anybody
    /// @param raw  a record of each line, too
    Replay(std::optional<unsigned> id, double sound_speed_mps, bool raw)
        : id_(id), raw_(raw), listener_(sound_speed_mps) {}

    /// A line of a log. Empty lines and comments (`#`) are nothing.
    /// @throws DataError  why it is not used
    void line(std::string_view line, std::vector<record::Record>& out);
    /// The same of a line that is known to be one, and when.
    void sentence(std::string_view line, bool outgoing, std::optional<record::UtcTime> time,
                  std::vector<record::Record>& out);
    /// Gives out what was not at its end.
    void end(std::vector<record::Record>& out) { listener_.finish(out); }

private:
    void take(const Sentence& s, bool outgoing, std::vector<record::Record>& out);
    void incoming(const Sentence& s, std::uint64_t address, std::vector<record::Record>& out);
    void cycle(const Cycle& cycle, std::vector<record::Record>& out);
    void acknowledgement(const Sentence& s, std::vector<record::Record>& out);
    void transmitted(const Sentence& s, std::vector<record::Record>& out);
    void learn_time(const Sentence& s, std::uint64_t address);
    record::UtcTime utc() const { return now_.utc; }

    std::optional<unsigned> id_;
    bool raw_;
    Listener listener_;
    LogLines lines_;
    LineReader reader_;
    Sentence sentence_;
    Moment now_;  ///< what is known of it: 1970 where nothing is
    bool stamped_ = false;
    std::vector<record::TransmitStatistics> announced_;  ///< of the minipacket before the packet
    bool announcing_ = false;  ///< a cycle of ours at rate 0 was announced
};

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_REPLAY_HPP
