// Any line as a sentence: what is read is in the line, and what is composed is read back the same.
#include "common.hpp"

#include "seautils/modem/sentences.hpp"
#include "seautils/modem/statistics.hpp"
#include "seautils/stream/nmea.hpp"

using namespace seautils;

namespace {

/// Each reader takes any sentence, or refuses it decently.
void read_as_everything(const stream::Sentence& s) {
    using namespace modem;
    fuzz::accepted([&] { read_setting(s); });
    fuzz::accepted([&] { read_revision(s).build_number(); });
    fuzz::accepted([&] { read_cycle(s); });
    fuzz::accepted([&] { read_data_request(s); });
    fuzz::accepted([&] { read_received_frame(s); });
    fuzz::accepted([&] { read_acknowledgement(s); });
    fuzz::accepted([&] { read_complaint(s); });
    fuzz::accepted([&] { read_fault(s); });
    fuzz::accepted([&] { read_ping(s); });
    fuzz::accepted([&] { read_extended_ping(s); });
    fuzz::accepted([&] { read_mini(s); });
    fuzz::accepted([&] { read_travel_times(s); });
    fuzz::accepted([&] { read_flexible_packet(s); });
    fuzz::accepted([&] { read_clock_ns(s); });
    fuzz::accepted([&] { receive_statistics(s, record::UtcTime{}); });
    fuzz::accepted([&] { transmit_statistics(s); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view line = fuzz::view(data, size);
    fuzz::context = printable(line);
    stream::Sentence s;
    const auto fault = stream::parse_sentence(line, s);
    if (fault != stream::SentenceFault::none) {
        fuzz::require(!stream::sentence_fault(fault, s).empty(), "a fault is said");
        return 0;
    }
    fuzz::require(s.body().data() >= line.data() &&
                      s.body().data() + s.body().size() <= line.data() + line.size(),
                  "the sentence lies in the line");
    std::size_t bytes = s.fields();
    for (std::size_t k = 0; k <= s.fields(); ++k) bytes += s[k].size();
    fuzz::require(bytes == s.body().size(), "fields and commas are all of it");
    if (s.body().find('!') == s.body().npos && s.body().size() + 4 <= stream::longest_sentence) {
        const std::string again = stream::sentence(s.body());
        stream::Sentence other;
        fuzz::require(stream::parse_sentence(again, other) == stream::SentenceFault::none &&
                          other.checksum() == stream::Checksum::good && other.body() == s.body(),
                      "what is composed is read back the same");
    }
    read_as_everything(s);
    return 0;
}
