#include "seautils/modem/line_reader.hpp"

#include "seautils/core/text.hpp"

namespace seautils::modem {

std::string LineReader::read(std::string_view line, stream::Sentence& sentence) {
    const stream::SentenceFault fault = stream::parse_sentence(line, sentence);
    if (fault != stream::SentenceFault::none) return stream::sentence_fault(fault, sentence);
    switch (sentence.checksum()) {
        case stream::Checksum::good:
            writes_checksums_ = true;
            return {};
        case stream::Checksum::wrong:
            return stream::sentence_fault(fault, sentence);
        case stream::Checksum::absent:
            break;
    }
    if (writes_checksums_) return "the checksum is missing";
    return sentence.noise().empty() ? "" : "noise before a sentence without checksum";
}

std::string raw_text(std::string_view line) {
    constexpr std::size_t most = 3600;       // a record takes 4096 bytes
    constexpr std::size_t most_noise = 700;  // where each byte becomes five: \\xNN
    line = line.substr(0, line.find_last_not_of("\r\n") + 1);
    std::string text = printable(line, most);
    return text.size() > most + 4 ? printable(line, most_noise) : text;
}

}  // namespace seautils::modem
