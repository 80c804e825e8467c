#ifndef SEAUTILS_SIM_MODEM_HPP
#define SEAUTILS_SIM_MODEM_HPP

#include "seautils/core/rate_table.hpp"
#include "seautils/sim/clock.hpp"
#include "seautils/sim/nvram.hpp"
#include "seautils/sim/packet.hpp"
#include "seautils/sim/scenario.hpp"

#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::sim {

class Fields;

/// What a modem stands on: time, its serial line and its transducer.
class Board {
public:
    virtual ~Board() = default;
    virtual Time now() const = 0;
    /// A sentence to the host, without `$` and checksum.
    virtual void say(const std::string& body) = 0;
    /// Begins to transmit; calls Modem::on_sent when the last sound has left.
    virtual void transmit(Packet packet) = 0;
    virtual Answers interrogate(const Interrogation& question) = 0;
    /// Calls `then` after a delay. It is called even where the modem has started anew since.
    virtual void after(Time delay, std::function<void()> then) = 0;
    /// The modem fell silent and deaf: what it was sending ends here, what arrives is lost.
    virtual void fell_silent() = 0;
};

/// A simulated WHOI Micro-Modem, of either generation, from its serial line to its transducer.
///
/// Its states, and what leads from one to the other:
///     off           boots for boot_s ─► idle (says CAREV)
///     idle          CCCYC from rate 1 on, or a poll heard ─► asking; CCCYC at rate 0, or with another's
///                   address as source ─► cycling; CCMUC, CCMPC, CCTDP, an answer due ─► speaking;
///                   CCPDT, CCPNT ─► interrogating
///     cycling       its minipacket has left: own data ─► asking, else ─► idle, and waits for the data
///     asking        CADRQ for one frame after the other, DTO seconds each: all are there ─► speaking
///     speaking      CATXP … CATXF ─► idle
///     interrogating until its timeout, SNTTA ─► idle
/// A command that speaks is refused as busy while the modem cycles, speaks or interrogates; while it
/// asks, the newer command wins. What is heard does not change the state, but that it may answer
/// after `answer_delay` (acknowledgement, ping) where it is idle then; a command in between wins.
///
/// Rules where the interface guides leave it open, or differ:
/// - It tells its host all that it hears, whoever it is for (CACYC, CARXD, CAMUA, CARDP); CAMPA and
///   CAMPR are for the one addressed. A frame without bytes is sent, heard as an empty CARXD, and not
///   acknowledged. A packet with no bytes at all is not sent (CAXST mode 4).
/// - A rate 0 data packet is understood only after its CACYC.
/// - Micro-Modem 1 reports acknowledgements between others as its own host's.
/// - `CCMSC,SRC,SRC,0` starts it anew; Micro-Modem 1 loses its clock then, Micro-Modem 2 does not.
/// - With a pulse each second (pps), CCCLK and CCTMS take effect at the next full second.
///
/// Sources: J. Shusta, libumutil (WHOI, 2009) for sentences and codes; the sequences of the Goby
/// Micro-Modem driver; captured lines, see tests/unit/sim_modem_test.cpp.
class Modem {
public:
    enum class State { off, idle, cycling, asking, speaking, interrogating };

    static constexpr Time answer_delay =
        300'000'000;  ///< from the last sound heard to the first sent

    Modem(const NodeSpec& spec, const RateTable& rates, Board& board);

    /// Power on; and what a reboot does. Deaf until boot_s later.
    void boot();
    /// A line of the host's, without line end. Never throws.
    void command(std::string_view line);

    /// The first sound of a packet came while nothing else was being received or sent.
    void on_probe(const Packet& packet);
    /// It has come whole; its frames may be spoilt. False: it was not understood.
    bool on_packet(const Heard& heard);
    /// It came to nothing after its first sound: collision.
    void on_spoilt(const Packet& packet);
    /// The modem's own transmission has ended.
    void on_sent(const Packet& packet);

    State state() const { return state_; }
    unsigned address() const { return static_cast<unsigned>(nvram_.number("SRC")); }
    /// What its clock shows.
    Time clock() const { return clock_.at(board_.now()); }

private:
    /// A data cycle of its own.
    struct Job {
        unsigned src = 0, dest = 0, rate = 0, count = 0;
        bool ack = false;
        std::vector<std::string> frames{};
    };
    using Handler = void (Modem::*)(const Fields&);
    static Handler handler(std::string_view id);

    void cfg(const Fields& f);
    void cfq(const Fields& f);
    void clk(const Fields& f);
    void clq(const Fields& f);
    void tms(const Fields& f);
    void tmq(const Fields& f);
    void msc(const Fields& f);
    void cyc(const Fields& f);
    void txd(const Fields& f);
    void muc(const Fields& f);
    void mpc(const Fields& f);
    void tdp(const Fields& f);
    void pdt(const Fields& f);
    void pnt(const Fields& f);

    bool is_mm2() const { return spec_.generation == Generation::mm2; }
    void need_mm2() const;
    void need_free() const;
    void error(std::string_view module, int number, std::string_view text);
    void say_revisions(bool initial);
    void say_settings(bool dotted);
    void set_clock(Time reading, std::function<void()> then);
    void begin_cycle(Job job);
    void ask_next();
    void data_timeout(unsigned frame);
    void send_data();
    void no_data();
    void transmit(State state, Packet packet);
    void answer(Packet packet);
    void interrogate(const Interrogation& question, Time timeout);
    void say_travel_times(const Answers& answers, Time timeout);
    void expect(unsigned src, unsigned rate);
    void hear_cycle(const Heard& heard);
    bool hear_data(const Heard& heard);
    void hear_frames(const Heard& heard);
    void hear_ack(const Heard& heard);
    void hear_ping(const Heard& heard);
    void hear_reply(const Heard& heard);
    void hear_fdp(const Heard& heard);
    void say_received(const Heard& heard);
    void say_sent(const Packet& packet, unsigned mode);
    unsigned clock_mode() const;
    std::string hhmmss() const;
    void later(Time delay, std::function<void()> then);

    NodeSpec spec_;
    const RateTable& rates_;
    Board& board_;
    Nvram nvram_;
    DriftingClock clock_;
    bool clock_is_set_ = false;
    State state_ = State::off;
    unsigned boots_ = 0;
    Job job_;
    unsigned asked_ = 0;                 ///< counts CADRQs, so that an old one's timeout is known
    std::deque<std::string> preloaded_;  ///< CCTXD that came before they were asked for
    unsigned expected_src_ = 0, expected_rate_ = 0;
    unsigned expected_ = 0;  ///< counts announcements that were heard
    bool expecting_ = false;
    unsigned pinged_ = 0;  ///< who was pinged last; 0: none
    Time pinged_at_ = 0, ping_air_ = 0;
};

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_MODEM_HPP
