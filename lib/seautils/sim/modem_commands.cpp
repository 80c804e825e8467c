// What the host tells a modem, one function a command.
#include "seautils/sim/air.hpp"
#include "seautils/sim/fields.hpp"
#include "seautils/sim/modem.hpp"
#include "seautils/sim/sentences.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/time.hpp"
#include "seautils/stream/nmea.hpp"

#include <fmt/format.h>

#include <chrono>
#include <map>

namespace seautils::sim {

namespace {

constexpr std::size_t most_preloaded = 8;
constexpr unsigned most_address = 127;
constexpr Time query_delay = 500'000'000;  ///< MM2 answers CCTMQ so late
constexpr Time stream_delay = 50'000'000;  ///< between the lines of CCCFQ,TOP

/// What the minipacket of a flexible data packet holds at a rate (WHOI's pyacomms); its frames are
/// the table's.
std::size_t fdp_mini_bytes(unsigned rate) { return rate == 1 ? 64 : rate == 3 ? 60 : 55; }

/// The minipacket first, then as many frames as it takes.
std::vector<std::string> fdp_frames(const std::string& data, const Rate& rate) {
    const std::size_t mini = fdp_mini_bytes(rate.rate);
    if (data.size() > mini + std::size_t{rate.frames} * rate.frame_bytes)
        throw Refusal{3, fmt::format("{} bytes are too many", data.size())};
    std::vector<std::string> frames{data.substr(0, mini)};
    for (std::size_t at = mini; at < data.size(); at += rate.frame_bytes)
        frames.push_back(data.substr(at, rate.frame_bytes));
    return frames;
}

/// One of the table's rates. @throws Refusal  it has no such rate
const Rate& in_table(const RateTable& table, unsigned rate, bool flexible) {
    try {
        return flexible ? table.flexible(rate) : table.data(rate);
    } catch (const DataError&) {
        throw Refusal{3, fmt::format("rate {} is not simulated", rate)};
    }
}

/// Year, month, day, hour, minute, second from field 1 on.
Time calendar_time(const Fields& f) {
    namespace chr = std::chrono;
    const chr::year_month_day date{chr::year{static_cast<int>(f.number(1, 1970, 2199))},
                                   chr::month{f.number(2, 1, 12)}, chr::day{f.number(3, 1, 31)}};
    if (!date.ok()) throw Refusal{3, "there is no such day"};
    const Time days = chr::sys_days{date}.time_since_epoch().count();
    const Time of_day =
        f.number(4, 0, 23) * Time{3600} + f.number(5, 0, 59) * Time{60} + f.number(6, 0, 59);
    return (days * 86400 + of_day) * second_ns;
}

}  // namespace

Modem::Handler Modem::handler(std::string_view id) {
    static const std::map<std::string_view, Handler> handlers{
        {"CFG", &Modem::cfg}, {"CFQ", &Modem::cfq}, {"CLK", &Modem::clk}, {"CLQ", &Modem::clq},
        {"TMS", &Modem::tms}, {"TMQ", &Modem::tmq}, {"MSC", &Modem::msc}, {"CYC", &Modem::cyc},
        {"TXD", &Modem::txd}, {"MUC", &Modem::muc}, {"MPC", &Modem::mpc}, {"TDP", &Modem::tdp},
        {"PDT", &Modem::pdt}, {"PNT", &Modem::pnt}};
    const auto found = handlers.find(id);
    return found == handlers.end() ? nullptr : found->second;
}

void Modem::command(std::string_view line) {
    if (state_ == State::off) return;
    stream::Sentence sentence;
    if (stream::parse_sentence(line, sentence) != stream::SentenceFault::none) return;  // noise
    if (sentence.talker() != "CC") return;
    if (sentence.checksum() == stream::Checksum::wrong) return error("NMEA", 1, "bad checksum");
    const Handler handle = handler(sentence.type());
    if (handle == nullptr) return error("NMEA", 2, "unknown command");
    try {
        (this->*handle)(Fields(sentence));
    } catch (const Refusal& refusal) {
        error(refusal.number == 2 ? "NMEA" : sentence.type(), refusal.number, refusal.text);
    }
}

void Modem::need_mm2() const {
    if (!is_mm2()) throw Refusal{2, "unknown command"};
}

void Modem::need_free() const {
    if (state_ != State::idle && state_ != State::asking) throw Refusal{4, "busy"};
}

void Modem::cfg(const Fields& f) {
    f.need(2);
    if (!nvram_.knows(f.text(1))) throw Refusal{3, "unknown setting"};
    nvram_.set(f.text(1), f.text(2));
    const std::string_view now = f.text(1) == "ALL" ? f.text(2) : nvram_.get(f.text(1));
    board_.say(fmt::format("CACFG,{},{}", f.text(1), now));
}

void Modem::cfq(const Fields& f) {
    const std::string_view name = f.text(1);
    if (name == "ALL") return say_settings(false);
    if (name == "TOP" && is_mm2()) return say_settings(true);
    if (!nvram_.knows(name)) throw Refusal{3, "unknown setting"};
    board_.say(fmt::format("CACFG,{},{}", name, nvram_.get(name)));
}

void Modem::say_settings(bool dotted) {
    Time delay = 0;
    for (const auto& [name, value] : nvram_.all()) {
        if (Nvram::is_dotted(name) && !dotted) continue;
        later(delay, [this, line = fmt::format("CACFG,{},{}", name, value)] { board_.say(line); });
        if (dotted) delay += stream_delay;
    }
}

/// Takes over the time at the next full second where there is a pulse, else at once.
void Modem::set_clock(Time reading, std::function<void()> then) {
    const Time now = board_.now();
    const Time delay = spec_.pps ? second_ns - now % second_ns : 0;
    later(delay, [this, reading, then = std::move(then)] {
        clock_.set(board_.now(), reading);
        clock_is_set_ = true;
        then();
    });
}

void Modem::clk(const Fields& f) {
    set_clock(calendar_time(f), [this] { board_.say("CACLK," + calendar(clock())); });
}

void Modem::clq(const Fields&) { board_.say("CACLK," + calendar(clock())); }

void Modem::tms(const Fields& f) {
    need_mm2();
    std::int64_t time_us = 0;
    try {
        time_us = parse_utc(f.text(1));
    } catch (const DataError&) {
        throw Refusal{3, "field 1 is not a time"};
    }
    if (time_us >= 7'258'118'400'000'000) throw Refusal{3, "field 1 is after 2199"};
    set_clock(time_us * 1000, [this] { board_.say("CATMS,0," + iso8601(clock())); });
}

void Modem::tmq(const Fields&) {
    need_mm2();
    later(query_delay, [this] {
        const std::string_view source = clock_is_set_ ? "USER_CMD" : "RTC";
        board_.say(
            fmt::format("CATMQ,{},{},{}", iso8601(clock()), source, spec_.pps ? "EXT" : "RTC"));
    });
}

void Modem::msc(const Fields& f) {
    f.need(3);
    const unsigned src = f.number(1, 0, most_address), dest = f.number(2, 0, most_address);
    if (src != address() || dest != address() || f.text(3) != "0")
        throw Refusal{3, "only an own restart is simulated"};
    board_.say("CAMSC," + std::string(f.all()));
    boot();
}

void Modem::cyc(const Fields& f) {
    f.need(6);
    Job job;
    job.src = f.number(2, 0, most_address);
    job.dest = f.number(3, 0, most_address);
    job.rate = f.number(4, 0, is_mm2() ? 6 : 5);
    job.ack = f.number(5, 0, 1) == 1;
    job.count = f.number(6, 1, in_table(rates_, job.rate, false).frames);
    need_free();
    board_.say("CACYC," + std::string(f.all()));
    begin_cycle(std::move(job));
}

void Modem::txd(const Fields& f) {
    f.need(3);
    const bool asked = state_ == State::asking;
    const std::size_t most = asked ? rates_.data(job_.rate).frame_bytes : 256;
    std::string bytes = f.bytes(4, most);
    if (!asked && preloaded_.size() == most_preloaded) throw Refusal{4, "busy"};
    board_.say(fmt::format("CATXD,{},{},{},{}", f.text(1), f.text(2), f.text(3), bytes.size()));
    if (!asked) return preloaded_.push_back(std::move(bytes));
    ++asked_;
    job_.frames.push_back(std::move(bytes));
    ask_next();
}

void Modem::muc(const Fields& f) {
    f.need(3);
    Packet packet{.kind = PacketKind::mini,
                  .src = f.number(1, 0, most_address),
                  .dest = f.number(2, 0, most_address)};
    const std::string bytes = f.bytes(3, 2);
    for (const char c : bytes) packet.value = packet.value << 8 | static_cast<unsigned char>(c);
    if (bytes.size() != 2 || packet.value > 0x1fff) throw Refusal{3, "field 3 is not 0000 to 1fff"};
    need_free();
    board_.say("CAMUC," + std::string(f.all()));
    transmit(State::speaking, std::move(packet));
}

void Modem::mpc(const Fields& f) {
    f.need(2);
    Packet packet{.kind = PacketKind::ping,
                  .src = f.number(1, 0, most_address),
                  .dest = f.number(2, 0, most_address)};
    need_free();
    board_.say("CAMPC," + std::string(f.all()));
    pinged_ = packet.dest;
    pinged_at_ = board_.now();
    ping_air_ = air_time(rates_, packet);
    transmit(State::speaking, std::move(packet));
}

void Modem::tdp(const Fields& f) {
    need_mm2();
    f.need(5);
    Packet packet{.kind = PacketKind::fdp,
                  .src = address(),
                  .dest = f.number(1, 0, most_address),
                  .rate = f.number(2, 1, 14)};
    packet.ack = f.number(3, 0, 1) == 1;
    const std::string data = f.bytes(5, 4096);
    packet.frames = fdp_frames(data, in_table(rates_, packet.rate, true));
    packet.frame_count = static_cast<unsigned>(packet.frames.size());
    need_free();
    board_.say(fmt::format("CATDP,{},{},{},{},{}", f.text(1), f.text(2), f.text(3), f.text(4),
                           data.size()));
    transmit(State::speaking, std::move(packet));
}

void Modem::pdt(const Fields& f) {
    f.need(9);
    const unsigned timeout_ms = f.number(5, 1, 60'000);
    Interrogation question;
    f.number(1, 1, 4);
    f.number(2, 1, 4);
    for (std::size_t k = 0; k < 4; ++k) question.letters[k] = f.number(6 + k, 0, 1) == 1;
    question.length = 10'000'000;
    need_free();
    board_.say("SNPDT," + std::string(f.all()));
    interrogate(question, timeout_ms * Time{1'000'000});
}

void Modem::pnt(const Fields& f) {
    f.need(9);
    Interrogation question;
    question.query_hz = f.number(1, 1, 200'000);
    question.length = f.number(2, 1, 1000) * Time{1'000'000};
    f.number(3, 1, 1000);
    const unsigned timeout_ms = f.number(4, 1, 60'000);
    for (std::size_t k = 0; k < 4; ++k) question.reply_hz[k] = f.number(5 + k, 0, 200'000);
    need_free();
    board_.say("SNPNT," + std::string(f.all()));
    interrogate(question, timeout_ms * Time{1'000'000});
}

void Modem::interrogate(const Interrogation& question, Time timeout) {
    state_ = State::interrogating;
    const Answers answers = board_.interrogate(question);
    later(timeout, [this, answers, timeout] {
        state_ = State::idle;
        say_travel_times(answers, timeout);
    });
}

/// One-way times: what the transponders take to answer, as the setting TAT says, taken off.
void Modem::say_travel_times(const Answers& answers, Time timeout) {
    const Time turn_around = nvram_.number("TAT") * Time{1'000'000};
    std::string line = "SNTTA";
    for (const std::optional<Time>& answer : answers) {
        line += ',';
        if (answer && *answer <= timeout)
            line += fmt::format("{:.4f}", seconds(*answer - turn_around) / 2);
    }
    const Time now = clock();
    board_.say(fmt::format("{},{}.{:02}", line, hhmmss(), now / 10'000'000 % 100));
}

}  // namespace seautils::sim
