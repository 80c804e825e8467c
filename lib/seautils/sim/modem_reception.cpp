// What a modem hears, and what it tells its host of it.
#include "seautils/sim/modem.hpp"
#include "seautils/sim/sentences.hpp"

#include "seautils/stream/hex.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::sim {

namespace {

std::string hex(std::string_view bytes) {
    std::string digits;
    stream::append_hex(digits, bytes);
    return digits;
}

/// `crc_ok;nbytes;hex` for the frames from `first` on, before `last`.
std::string triples(const Heard& heard, std::size_t first, std::size_t last) {
    std::string all;
    for (std::size_t k = first; k < last; ++k) {
        const std::string& frame = heard.packet->frames[k];
        if (!all.empty()) all += ';';
        const bool bad = heard.is_bad(k);
        all += fmt::format("{};{};{}", bad ? 0 : 1, frame.size(), bad ? "" : hex(frame));
    }
    return all;
}

}  // namespace

void Modem::on_probe(const Packet& packet) {
    if (nvram_.number("RXP") == 1) board_.say(packet.is_fsk() ? "CARXP,0" : "CARXP,1");
    if (packet.kind == PacketKind::data) ++expected_;  // what was announced has begun
}

void Modem::on_spoilt(const Packet& packet) {
    if (packet.kind == PacketKind::data) {
        board_.say("CAMSG,PACKET_TIMEOUT,1");
        expecting_ = false;
    }
    if (nvram_.number("CST") == 1) board_.say(cacst_timeout(spec_.generation));
}

bool Modem::on_packet(const Heard& heard) {
    switch (heard.packet->kind) {
        case PacketKind::cycle:
            hear_cycle(heard);
            break;
        case PacketKind::data:
            return hear_data(heard);
        case PacketKind::ack:
            hear_ack(heard);
            break;
        case PacketKind::ping:
            hear_ping(heard);
            break;
        case PacketKind::reply:
            hear_reply(heard);
            break;
        case PacketKind::fdp:
            hear_fdp(heard);
            break;
        case PacketKind::mini:
            board_.say(fmt::format("CAMUA,{},{},{:04x}", heard.packet->src, heard.packet->dest,
                                   heard.packet->value));
            say_received(heard);
            break;
        default:
            return false;  // transponders' business
    }
    return true;
}

void Modem::say_received(const Heard& heard) {
    if (nvram_.number("CST") != 1) return;
    const Time arrival = clock_.at(heard.start);
    board_.say(cacst(heard, spec_.generation, arrival, clock_mode()));
}

/// Waits for a packet that was announced, and says so when it does not come.
void Modem::expect(unsigned src, unsigned rate) {
    expecting_ = true;
    expected_src_ = src;
    expected_rate_ = rate;
    later(nanoseconds(std::max(nvram_.number("PTO"), 1)), [this, number = ++expected_] {
        if (!expecting_ || number != expected_) return;
        expecting_ = false;
        board_.say("CAMSG,PACKET_TIMEOUT,1");
        if (nvram_.number("CST") == 1) board_.say(cacst_timeout(spec_.generation));
    });
}

void Modem::hear_cycle(const Heard& heard) {
    const Packet& p = *heard.packet;
    board_.say(fmt::format("CACYC,0,{},{},{},{},{}", p.src, p.dest, p.value, p.ack ? 1 : 0,
                           p.frame_count));
    say_received(heard);
    if (p.src != address()) return expect(p.src, p.value);
    if (state_ != State::idle || (p.value > 5 && !is_mm2())) return;
    job_ = Job{.src = p.src, .dest = p.dest, .rate = p.value, .count = p.frame_count, .ack = p.ack};
    ask_next();
}

bool Modem::hear_data(const Heard& heard) {
    const Packet& p = *heard.packet;
    const bool announced = expecting_ && expected_src_ == p.src && expected_rate_ == p.rate;
    expecting_ = false;
    if (p.is_fsk() && !announced) return false;
    if (p.rate > 5 && !is_mm2()) return false;
    if (!p.is_fsk())
        board_.say(fmt::format("CACYC,0,{},{},{},{},{}", p.src, p.dest, p.rate, p.ack ? 1 : 0,
                               p.frame_count));
    hear_frames(heard);
    say_received(heard);
    return true;
}

void Modem::hear_frames(const Heard& heard) {
    const Packet& p = *heard.packet;
    unsigned good = 0;
    for (std::size_t k = 0; k < p.frames.size(); ++k) {
        if (heard.is_bad(k)) {
            board_.say(fmt::format("CAMSG,BAD_CRC,{}", k + 1));
            continue;
        }
        board_.say(fmt::format("CARXD,{},{},{},{},{}", p.src, p.dest, p.ack ? 1 : 0, k + 1,
                               hex(p.frames[k])));
        if (!p.frames[k].empty()) good |= 1U << k;
    }
    if (!p.ack || good == 0 || p.dest != address()) return;
    Packet ack{.kind = PacketKind::ack, .src = address(), .dest = p.src, .rate = p.rate};
    ack.value = good;
    answer(std::move(ack));
}

void Modem::hear_ack(const Heard& heard) {
    const Packet& p = *heard.packet;
    if (p.dest == address() || !is_mm2()) {
        for (unsigned k = 0; k < 8; ++k)
            if ((p.value >> k & 1) != 0)
                board_.say(fmt::format("CAACK,{},{},{},1", p.src, address(), k + 1));
    }
    say_received(heard);
}

void Modem::hear_ping(const Heard& heard) {
    const Packet& p = *heard.packet;
    const bool ours = p.dest == address();
    if (ours) board_.say(fmt::format("CAMPA,{},{}", p.src, p.dest));
    say_received(heard);
    if (ours) answer({.kind = PacketKind::reply, .src = address(), .dest = p.src});
}

void Modem::hear_reply(const Heard& heard) {
    const Packet& p = *heard.packet;
    if (p.dest == address() && p.src == pinged_) {
        const Time there_and_back = heard.start - pinged_at_ - ping_air_ - answer_delay;
        board_.say(fmt::format("CAMPR,{},{},{:.4f}", p.src, p.dest, seconds(there_and_back) / 2));
        pinged_ = 0;
    }
    say_received(heard);
}

void Modem::hear_fdp(const Heard& heard) {
    const Packet& p = *heard.packet;
    if (is_mm2()) {
        board_.say(fmt::format("CARDP,{},{},{},{},0,{},{}", p.src, p.dest, p.rate, p.ack ? 1 : 0,
                               triples(heard, 0, 1), triples(heard, 1, p.frames.size())));
    }
    say_received(heard);
}

}  // namespace seautils::sim
