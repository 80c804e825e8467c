#include "seautils/modem/line_reader.hpp"

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

}  // namespace seautils::modem
