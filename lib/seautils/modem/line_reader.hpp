#ifndef SEAUTILS_MODEM_LINE_READER_HPP
#define SEAUTILS_MODEM_LINE_READER_HPP

#include "seautils/stream/nmea.hpp"

#include <string>
#include <string_view>

namespace seautils::modem {

/// Reads a modem's lines as sentences, and trusts none that may have been damaged: beside a wrong
/// checksum, a missing one is refused once the modem has shown that it writes them (else a frame that
/// lost its end would be taken for a shorter one), and so is one behind noise.
class LineReader {
public:
    /// @return why the line cannot be used; empty: `sentence` holds it
    std::string read(std::string_view line, stream::Sentence& sentence);

private:
    bool writes_checksums_ = false;
};

/// A line without its end, printable, cut so that a record has room for it.
std::string raw_text(std::string_view line);

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_LINE_READER_HPP
