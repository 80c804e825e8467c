#include "seautils/modem/replay.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/modem/fields.hpp"
#include "seautils/modem/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace seautils::modem {

namespace {

using record::ModemEvent;
using record::UtcTime;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t last_second = 7'258'118'400;  // 2200-01-01T00:00:00Z
constexpr std::array<std::string_view, 12> months = {"jan", "feb", "mar", "apr", "may", "jun",
                                                     "jul", "aug", "sep", "oct", "nov", "dec"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Two digits, or -1.
int two(std::string_view text, std::size_t at) {
    if (at + 2 > text.size() || !is_digit(text[at]) || !is_digit(text[at + 1])) return -1;
    return (text[at] - '0') * 10 + (text[at + 1] - '0');
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// `.5` in nanoseconds; digits beyond the ninth do not count.
std::int64_t fraction_ns(std::string_view text) {
    if (text.empty() || (text[0] != '.' && text[0] != ',')) return 0;
    std::int64_t ns = 0, unit = second_ns;
    for (std::size_t k = 1; k < text.size() && is_digit(text[k]) && unit > 1; ++k) {
        unit /= 10;
        ns += (text[k] - '0') * unit;
    }
    return ns;
}

/// `12:00:25.5`
std::optional<std::int64_t> clock_ns(std::string_view text) {
    const int hour = two(text, 0), minute = two(text, 3), second = two(text, 6);
    if (hour < 0 || minute < 0 || second < 0 || text[2] != ':' || text[5] != ':') return {};
    if (hour > 23 || minute > 59 || second > 60) return {};
    return (hour * 3600 + minute * 60 + second) * second_ns + fraction_ns(text.substr(8));
}

/// `1714564825.5`, ten digits and a fraction, before the year 2200.
std::optional<UtcTime> epoch(std::string_view text) {
    std::int64_t seconds = 0;
    std::size_t k = 0;
    for (; k < text.size() && is_digit(text[k]); ++k) {
        if (k == 10) return {};
        seconds = seconds * 10 + (text[k] - '0');
    }
    if (k < 9 || seconds >= last_second) return {};
    return UtcTime{seconds * second_ns + fraction_ns(text.substr(k))};
}

/// Whether the text has one of these words, in lower case.
bool has_tag(std::string_view text, std::string_view word) {
    const auto same = [](char a, char b) { return lower(a) == b; };
    return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

}  // namespace

/// `2024-05-01` or `2024-May-01`.
std::optional<std::int64_t> LogLines::date(std::string_view text) {
    if (!date_.empty() && text == date_) return date_ns_;
    std::string month(text.substr(5, 2));
    if (text.size() == 11) {
        std::array<char, 3> name{};
        std::transform(text.begin() + 5, text.begin() + 8, name.begin(), lower);
        const auto found =
            std::find(months.begin(), months.end(), std::string_view(name.data(), 3));
        if (found == months.end()) return {};
        month = fmt::format("{:02}", found - months.begin() + 1);
    }
    const auto ns = modem::date_ns(
        fmt::format("{}{}{}", text.substr(0, 4), month, text.substr(text.size() - 2)));
    if (!ns) return {};
    date_ = text;
    date_ns_ = *ns;
    return ns;
}

std::optional<UtcTime> LogLines::time_of(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t[(@"), text.size()));
    if (text.size() < 9 || !is_digit(text[0])) return {};
    if (text[4] != '-') return epoch(text);
    const std::size_t length = text.size() > 8 && text[8] == '-' ? 11 : 10;
    if (text.size() < length + 9) return {};
    if (text[length] != 'T' && text[length] != ' ') return {};
    const auto day = date(text.substr(0, length));
    const auto time = clock_ns(text.substr(length + 1));
    return day && time ? std::optional(UtcTime{*day + *time}) : std::nullopt;
}

LogLine LogLines::read(std::string_view line) {
    LogLine l;
    if (!line.empty() && line[0] == '$') {  // most logs are nothing but sentences
        l.sentence = line;
    } else {
        const std::size_t start = line.find_first_of("$!");
        const std::string_view before = line.substr(0, start);
        if (start != line.npos) l.sentence = line.substr(start);
        l.time = time_of(before);
        const bool to = has_tag(before, "[tx]") || before.find('>') != before.npos;
        l.outgoing = to && !has_tag(before, "[rx]");
    }
    if (!l.sentence.empty() && l.sentence.substr(1).starts_with("CC")) l.outgoing = true;
    return l;
}

void Replay::line(std::string_view line, std::vector<record::Record>& out) {
    const std::size_t first = line.find_first_not_of(" \t\r\n");
    if (first == line.npos || line[first] == '#') return;
    const LogLine l = lines_.read(line);
    if (l.sentence.empty()) throw DataError("no sentence begins in it");
    sentence(l.sentence, l.outgoing, l.time, out);
}

void Replay::sentence(std::string_view line, bool outgoing, std::optional<UtcTime> time,
                      std::vector<record::Record>& out) {
    if (time) {
        now_ = {*time, time->ns};
        stamped_ = true;
        listener_.tick(now_, out);
    }
    std::string fault = reader_.read(line, sentence_);
    const std::size_t at = out.size();
    if (raw_) {
        record::Raw raw;
        raw.direction = outgoing ? record::Raw::Direction::out : record::Raw::Direction::in;
        raw.line = raw_text(line);
        add(out, utc(), std::move(raw));
    }
    try {
        if (!fault.empty()) throw DataError(fault);
        take(sentence_, outgoing, out);
    } catch (const DataError& e) {
        if (raw_) std::get<record::Raw>(out[at].kind).fault = e.what();
        throw;
    }
}

void Replay::take(const Sentence& s, bool outgoing, std::vector<record::Record>& out) {
    const std::uint64_t address = code(s.address());
    if (!outgoing) return incoming(s, address, out);
    if (address == code("CCCFG") && s[1] == "SRC") id_ = Fields(s).address(2);
}

/// A log without times has those that the modem says.
void Replay::learn_time(const Sentence& s, std::uint64_t address) {
    std::optional<std::int64_t> ns;
    if (address == code("CATMQ") || address == code("CATMS") || address == code("CACLK"))
        ns = read_clock_ns(s);
    if (address == code("CACST")) {
        if (const auto arrival = receive_statistics(s, {}).arrival) ns = arrival->ns;
    }
    if (address == code("CAXST")) {
        if (const auto sent = transmit_statistics(s).sent) ns = sent->ns;
    }
    if (address == code("CARFP") || address == code("CACMA") || address == code("CACMR")) {
        for (const std::size_t k : {1U, 2U}) {
            if (const auto time = lines_.time_of(s[k])) ns = time->ns;
        }
    }
    if (ns) now_ = {{*ns}, *ns};
}

void Replay::incoming(const Sentence& s, std::uint64_t address, std::vector<record::Record>& out) {
    if (!stamped_) learn_time(s, address);
    switch (address) {
        case code("CACFG"):
            if (s[1] == "SRC") id_ = Fields(s).address(2);
            return;
        case code("CACYC"):
            cycle(read_cycle(s), out);
            return;
        case code("CAACK"):
            acknowledgement(s, out);
            return;
        case code("CAXST"):
            transmitted(s, out);
            return;
        case code("CATXP"):
            listener_.finish(out);
            return;
        case code("CAREV"):
            if (!read_revision(s).started()) return;
            listener_.reset(out);
            add_event(out, utc(), ModemEvent::Event::reboot, {});
            return;
        case code("CAERR"):
            add_event(out, utc(), ModemEvent::Event::error, std::string(read_fault(s).text));
            return;
        default:
            break;
    }
    const std::size_t first = out.size();
    listener_.take(s, address, now_, out);
    for (std::size_t k = first; k < out.size(); ++k) {
        auto* range = std::get_if<record::Range>(&out[k].kind);
        if (range != nullptr && range->method != record::Range::Method::two_way_ping)
            range->src = id_.value_or(0);
    }
}

void Replay::cycle(const Cycle& c, std::vector<record::Record>& out) {
    const bool ours = id_ == c.src;
    announcing_ = ours && c.rate == 0;
    announced_.clear();
    if (!ours) listener_.cycle(c, now_, out);
}

void Replay::acknowledgement(const Sentence& s, std::vector<record::Record>& out) {
    const Acknowledgement a = read_acknowledgement(s);
    if (id_ && a.dest != *id_) return add_heard(out, utc(), a.src, a.dest);
    record::Ack ack;
    ack.src = a.src;
    ack.dest = a.dest;
    ack.frame = {a.frame};
    add(out, utc(), std::move(ack));
}

/// One result for a packet, and for the minipacket that announced it.
void Replay::transmitted(const Sentence& s, std::vector<record::Record>& out) {
    const auto stats = transmit_statistics(s);
    const bool failed = stats.mode.value_or(0) != 0;
    const bool mini = stats.packet_type == 2U || (!stats.packet_type && announced_.empty());
    announced_.push_back(stats);
    if (announcing_ && mini && !failed) return;
    announcing_ = false;
    record::Result r;
    r.outcome = failed ? record::Result::Outcome::failed : record::Result::Outcome::sent;
    if (failed) r.why = transmit_fault(*stats.mode);
    r.statistics = std::move(announced_);
    announced_.clear();
    add(out, utc(), std::move(r));
}

}  // namespace seautils::modem
