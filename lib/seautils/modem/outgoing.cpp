#include "seautils/modem/outgoing.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace seautils::modem {

namespace {

using record::Kind;
using record::Transmission;
using Form = Outgoing::Form;

constexpr unsigned most_address = 30;
constexpr unsigned bits_per_byte = 10;      ///< on the line: start, eight, stop
constexpr std::size_t sentence_bytes = 20;  ///< of CCTXD beside its digits
constexpr double nominal_speed_mps = 1500;

void check_address(const char* what, std::uint32_t address, unsigned least) {
    if (address >= least && address <= most_address) return;
    throw DataError(fmt::format("{} {} is not {} to {}", what, address, least, most_address));
}

/// Rate and frames of data of our own.
void check_frames(const Transmission& t, const Rate& rate) {
    if (t.frame.size() > rate.frames) {
        throw DataError(fmt::format("{} where a packet of rate {} has at most {}",
                                    counted(t.frame.size(), "frame"), t.rate, rate.frames));
    }
    bool any = false;
    for (std::size_t k = 0; k < t.frame.size(); ++k) {
        any = any || !t.frame[k].empty();
        if (t.frame[k].size() <= rate.frame_bytes) continue;
        throw DataError(fmt::format("frame {} of {} where rate {} has at most {}", k,
                                    counted(t.frame[k].size(), "byte"), t.rate, rate.frame_bytes));
    }
    if (!any) throw DataError("no data");
}

std::chrono::nanoseconds writing_time(const Transmission& t, unsigned baud) {
    std::size_t bytes = 0;
    for (const std::string& frame : t.frame) bytes += sentence_bytes + 2 * frame.size();
    return std::chrono::nanoseconds(bytes * bits_per_byte * 1'000'000'000 / baud);
}

Outgoing data_of(const Transmission& t, const Options& options) {
    Outgoing o;
    o.request = t;
    if (t.src != 0 && t.src != options.id) {  // for another to send
        const Rate& rate = options.rates.data(t.rate);
        o.form = Form::poll;
        o.frames = t.frame.empty() ? rate.frames
                                   : std::min(static_cast<unsigned>(t.frame.size()), rate.frames);
        o.ack = t.ack_requested && t.dest != 0;
        o.sound = minipacket_time;
        return o;
    }
    const Rate& rate =
        options.flexible ? options.rates.flexible(t.rate) : options.rates.data(t.rate);
    check_frames(t, rate);
    o.form = options.flexible ? Form::flexible : Form::cycle;
    o.frames = static_cast<unsigned>(t.frame.size());
    o.ack = t.ack_requested && t.dest != 0 && !options.flexible;
    o.has_cycle = rate.cycle.count() > 0;
    o.sound = rate.air_time(o.frames, o.ack);
    o.writing = writing_time(t, options.baud);
    return o;
}

Command command(std::string body, std::string reply) {
    return {Command::Kind::transmission, std::move(body), std::move(reply), {}};
}

Command cycle_command(const Outgoing& o, unsigned src) {
    const Transmission& t = o.request;
    const Cycle cycle{src, t.dest, t.rate, o.ack, o.frames};
    return command(compose("CCCYC", cycle), fmt::format("CACYC,0,{},{},{}", src, t.dest, t.rate));
}

Command flexible_command(const Transmission& t, bool pad_even) {
    std::string bytes;
    for (const std::string& frame : t.frame) bytes += frame;
    if (pad_even && bytes.size() % 2 != 0) bytes += '\0';
    return command(compose_flexible(t.dest, t.rate, bytes), "CATDP");
}

/// Field k of a list, 0 where it is not so long.
unsigned at(const std::vector<unsigned>& list, std::size_t k) {
    return k < list.size() ? list[k] : 0;
}

Command lbl_command(const Lbl& lbl, unsigned src) {
    const unsigned timeout = lbl.timeout_ms();
    switch (lbl.kind) {
        case Lbl::Kind::remus:
            break;
        case Lbl::Kind::narrowband:
            return command(
                fmt::format("CCPNT,{},{},{},{},{},{},{},{},1", lbl.transmit_hz, lbl.transmit_ms,
                            lbl.receive_ms, timeout, at(lbl.receive_hz, 0), at(lbl.receive_hz, 1),
                            at(lbl.receive_hz, 2), at(lbl.receive_hz, 3)),
                "SNPNT");
        case Lbl::Kind::coded:
            return command(
                fmt::format("CCPGT,{},{},{},{},{},{},{},{},{},{},0", lbl.transmit_hz, lbl.code_bits,
                            lbl.transmit_code, timeout, at(lbl.receive_hz, 0),
                            at(lbl.receive_codes, 0), at(lbl.receive_codes, 1),
                            at(lbl.receive_codes, 2), at(lbl.receive_codes, 3), lbl.bandwidth_hz),
                "SNPGT");
    }
    const auto bit = [&](unsigned k) { return lbl.transponders >> k & 1; };
    return command(fmt::format("CCPDT,1,{},0,0,{},{},{},{},{}", src % 4 + 1, timeout, bit(0),
                               bit(1), bit(2), bit(3)),
                   "SNPDT");
}

void check_range(const char* what, double value, double least, double most) {
    if (value >= least && value <= most) return;
    throw DataError(fmt::format("{} {} is not {} to {}", what, value, least, most));
}

}  // namespace

unsigned Lbl::timeout_ms() const {
    return static_cast<unsigned>(max_range_m * 2 / nominal_speed_mps * 1000 + turnaround_ms);
}

void Options::check() const {
    check_address("id", id, 1);
    check_range("sound speed", sound_speed_mps, 1300, 1700);
    check_range("baud", baud, 50, 4'000'000);
    check_range("LBL range", lbl.max_range_m, 1, 20000);
    check_range("LBL turnaround", lbl.turnaround_ms, 0, 10000);
    if (lbl.receive_hz.empty() || lbl.receive_hz.size() > 4)
        throw DataError("LBL takes 1 to 4 frequencies to receive");
    if (lbl.receive_codes.size() > 4) throw DataError("LBL takes at most 4 codes to receive");
    for (const Setting& s : settings) {
        if (s.name == "SRC") throw DataError("setting SRC is the modem's id, and said as such");
        if (s.name.empty() || s.name.find(',') != std::string::npos)
            throw DataError("setting " + quote(s.name) + " is no name");
        stream::sentence(compose("CCCFG", s));  // refuses what a line cannot say
    }
}

Outgoing outgoing_of(const Transmission& t, const Options& options) {
    if (t.src != 0) check_address("src", t.src, 1);
    check_address("dest", t.dest, 0);
    Outgoing o;
    o.request = t;
    switch (t.kind) {
        case Kind::data:
            return data_of(t, options);
        case Kind::ping:
            check_address("dest", t.dest, 1);
            o.form = Form::ping;
            o.sound = minipacket_time;
            return o;
        case Kind::mini:
            if (!t.mini || *t.mini > 0x1fff)
                throw DataError("a minipacket's value is 0 to 8191, and this has " +
                                (t.mini ? std::to_string(*t.mini) : std::string("none")));
            o.form = Form::mini;
            o.sound = minipacket_time;
            return o;
        case Kind::lbl:
            o.form = Form::lbl;
            o.sound = std::chrono::milliseconds(options.lbl.timeout_ms());
            return o;
        case Kind::blank:
            break;
    }
    throw DataError("nothing that a modem can send");
}

Command command_of(const Outgoing& o, const Options& options, bool pad_even) {
    const Transmission& t = o.request;
    switch (o.form) {
        case Form::cycle:
        case Form::answer:
            break;
        case Form::poll:
            return cycle_command(o, t.src);
        case Form::flexible:
            return flexible_command(t, pad_even);
        case Form::ping: {
            const std::string who = fmt::format("{},{}", options.id, t.dest);
            return command("CCMPC," + who, "CAMPC," + who);
        }
        case Form::mini: {
            const Mini mini{options.id, t.dest, *t.mini};
            return command(compose("CCMUC", mini), compose("CAMUC", mini));
        }
        case Form::lbl:
            return lbl_command(options.lbl, options.id);
    }
    return cycle_command(o, options.id);
}

}  // namespace seautils::modem
