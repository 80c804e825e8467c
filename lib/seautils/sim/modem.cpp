#include "seautils/sim/modem.hpp"

#include "seautils/sim/air.hpp"
#include "seautils/sim/fields.hpp"
#include "seautils/sim/sentences.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::sim {

namespace {

/// What is sent where the host is late and ASD is 1.
std::string test_data(std::size_t bytes) {
    std::string data(bytes, '\0');
    for (std::size_t k = 0; k < bytes; ++k) data[k] = static_cast<char>(k);
    return data;
}

}  // namespace

Modem::Modem(const NodeSpec& spec, const RateTable& rates, Board& board)
    : spec_(spec), rates_(rates), board_(board), nvram_(spec), clock_(spec.clock_drift_ppm) {
    clock_.set(board.now(), board.now() + nanoseconds(spec.clock_offset_s));
}

void Modem::boot() {
    ++boots_;
    state_ = State::off;
    job_ = {};
    preloaded_.clear();
    expecting_ = false;
    pinged_ = 0;
    board_.fell_silent();
    if (!is_mm2()) {
        clock_.set(board_.now(), 0);
        clock_is_set_ = false;
    }
    later(nanoseconds(spec_.boot_s), [this] {
        state_ = State::idle;
        say_revisions(true);
    });
}

void Modem::later(Time delay, std::function<void()> then) {
    board_.after(delay, [this, boot = boots_, then = std::move(then)] {
        if (boot == boots_) then();
    });
}

std::string Modem::hhmmss() const { return sim::hhmmss(clock()); }

/// Micro-Modem 1: 0 before its clock is set, 2 after (no pulse), 3 (with). Micro-Modem 2: bits 0-1
/// the source of time (1 its own clock, 2 the user), bits 2-4 that of the pulse (1 its own, 3 external).
unsigned Modem::clock_mode() const {
    if (is_mm2()) return (clock_is_set_ ? 2U : 1U) | (spec_.pps ? 3U << 2 : 1U << 2);
    return (clock_is_set_ ? 2U : 0U) | (spec_.pps ? 1U : 0U);
}

void Modem::say_revisions(bool initial) {
    const std::string& own = spec_.firmware;
    const std::string main = !own.empty() ? own : is_mm2() ? "2.0.27087" : "0.93.0.09";
    if (initial) board_.say(fmt::format("CAREV,{},INIT,{}", hhmmss(), main));
    board_.say(fmt::format("CAREV,{},AUV,{}", hhmmss(), main));
    board_.say(fmt::format("CAREV,{},COPROC,{}", hhmmss(), is_mm2() ? "0.30.0.56" : "0.20.0.56"));
}

void Modem::error(std::string_view module, int number, std::string_view text) {
    board_.say(fmt::format("CAERR,{},{},{},{}", hhmmss(), module, number, text));
}

void Modem::begin_cycle(Job job) {
    job_ = std::move(job);
    ++asked_;
    if (job_.src == address() && job_.rate > 0) return ask_next();
    Packet packet{.kind = PacketKind::cycle, .src = job_.src, .dest = job_.dest};
    packet.ack = job_.ack;
    packet.frame_count = job_.count;
    packet.value = job_.rate;
    transmit(State::cycling, std::move(packet));
}

void Modem::ask_next() {
    while (job_.frames.size() < job_.count && !preloaded_.empty()) {
        job_.frames.push_back(std::move(preloaded_.front()));
        preloaded_.pop_front();
    }
    if (job_.frames.size() == job_.count) return send_data();
    state_ = State::asking;
    const auto frame = static_cast<unsigned>(job_.frames.size() + 1);
    board_.say(fmt::format("CADRQ,{},{},{},{},{},{}", hhmmss(), job_.src, job_.dest,
                           job_.ack ? 1 : 0, rates_.data(job_.rate).frame_bytes, frame));
    const Time timeout = nanoseconds(std::max(nvram_.number("DTO"), 1));
    later(timeout, [this, frame, asked = ++asked_] {
        if (asked == asked_ && state_ == State::asking) data_timeout(frame);
    });
}

void Modem::data_timeout(unsigned frame) {
    board_.say(fmt::format("CAERR,{},DATA_TIMEOUT,{}", hhmmss(), frame));
    if (nvram_.number("ASD") == 1) {
        job_.frames.push_back(test_data(rates_.data(job_.rate).frame_bytes));
        return ask_next();
    }
    job_.count = static_cast<unsigned>(job_.frames.size());
    send_data();
}

void Modem::send_data() {
    preloaded_.clear();
    Packet packet{.kind = PacketKind::data, .src = job_.src, .dest = job_.dest, .rate = job_.rate};
    packet.ack = job_.ack;
    packet.frame_count = job_.count;
    packet.frames = std::move(job_.frames);
    job_ = {};
    if (packet.bytes() > 0) return transmit(State::speaking, std::move(packet));
    state_ = State::idle;
    say_sent(packet, 4);
}

void Modem::transmit(State state, Packet packet) {
    state_ = state;
    expecting_ = false;
    if (packet.kind != PacketKind::lbl) packet.air = air_time(rates_, packet);
    board_.say(fmt::format("CATXP,{}", packet.bytes()));
    board_.transmit(std::move(packet));
}

void Modem::on_sent(const Packet& packet) {
    board_.say(fmt::format("CATXF,{}", packet.bytes()));
    say_sent(packet, 0);
    const bool cycled = state_ == State::cycling;
    state_ = State::idle;
    if (!cycled) return;
    if (job_.src == address()) return ask_next();
    expect(job_.src, job_.rate);
    job_ = {};
}

void Modem::say_sent(const Packet& packet, unsigned mode) {
    if (nvram_.number("XST") == 0) return;
    const Time began = clock() - (mode == 0 ? packet.air : 0);
    board_.say(caxst(packet, spec_.generation, std::max<Time>(began, 0), clock_mode(), mode));
}

void Modem::answer(Packet packet) {
    later(answer_delay, [this, packet = std::move(packet)] {
        if (state_ == State::idle) transmit(State::speaking, packet);
    });
}

}  // namespace seautils::sim
