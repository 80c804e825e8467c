#ifndef SEAUTILS_MODEM_SENTENCES_HPP
#define SEAUTILS_MODEM_SENTENCES_HPP

#include "seautils/stream/nmea.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// The sentences of a WHOI Micro-Modem as structs. Each is read by a function that names what is wrong
/// (`CACYC field 2 'x' is not a whole number 0 to 127`) and gives its body for stream::sentence().
///
/// Addresses are 0 to 127 on the line, 0 everybody; frames count from 1 there, and from 0 here.
/// Source: specs of the host interface as Goby3, pyacomms and DUNE read them.
namespace seautils::modem {

using stream::Sentence;

/// `CCCFG,NAME,value`, `CACFG,NAME,value`: a setting kept in the modem. Names are three letters on the
/// first generation, words with dots (`recv.base64data`) on the second.
struct Setting {
    std::string name, value;
    friend bool operator==(const Setting&, const Setting&) = default;
};
Setting read_setting(const Sentence& s);

/// `CAREV,hhmmss,IDENT,revision`: said at intervals, and with IDENT `INIT` when the modem has started.
struct Revision {
    std::string_view time_of_day, ident, revision;
    bool started() const { return ident == "INIT"; }
    /// First number of the revision where this is the main processor's (`AUV`): 2 and more is the
    /// second generation.
    std::optional<unsigned> major_number() const;
    /// Third number: the build, by which firmware of the second generation is told apart.
    std::optional<unsigned> build_number() const;
};
Revision read_revision(const Sentence& s);

/// `CCCYC`, `CACYC`,0,src,dest,rate,ack,frames: a cycle begins, in which src sends to dest.
struct Cycle {
    std::uint32_t src = 0, dest = 0, rate = 0;
    bool ack_requested = false;
    std::uint32_t frames = 1;
    friend bool operator==(const Cycle&, const Cycle&) = default;
};
Cycle read_cycle(const Sentence& s);

/// `CADRQ,hhmmss,src,dest,ack,bytes,frame`: give me this frame, of at most so many bytes.
struct DataRequest {
    std::uint32_t src = 0, dest = 0;
    bool ack_requested = false;
    std::uint32_t bytes = 0;
    std::uint32_t number = 1;  ///< as on the line: from 1, in some old firmware from 0
};
DataRequest read_data_request(const Sentence& s);

/// `CARXD,src,dest,ack,frame,hex`: a frame that was received; no hex: the sender left it unused.
struct ReceivedFrame {
    std::uint32_t src = 0, dest = 0;
    bool ack_requested = false;
    std::uint32_t frame = 0;  ///< index, from 0
    std::string bytes;
};
ReceivedFrame read_received_frame(const Sentence& s);

/// `CAACK,src,dest,frame,ack`: src says that it received this frame of dest's.
struct Acknowledgement {
    std::uint32_t src = 0, dest = 0;
    std::uint32_t frame = 0;  ///< index, from 0
};
Acknowledgement read_acknowledgement(const Sentence& s);

/// `CAMSG,BAD_CRC,n`, `CAMSG,Bad CRC`, `CAMSG,PACKET_TIMEOUT,n` …: a frame was lost, or something else
/// went wrong.
struct Complaint {
    bool bad_crc = false, timeout = false;
    std::optional<std::uint32_t> number;
    std::string_view text;  ///< all of it
};
Complaint read_complaint(const Sentence& s);

/// `CAERR,hhmmss,MODULE,number,text`, or `CAERR,DATA_TIMEOUT,frame` with or without a time before it.
struct Fault {
    bool unknown_command = false;  ///< MODULE is NMEA: the modem did not understand the last one
    bool data_timeout = false;
    std::string_view module;  ///< `NMEA`, or whose command was refused: `CYC`
    std::string_view text;    ///< all of it
};
Fault read_fault(const Sentence& s);

/// `CAMPC`, `CAMPA`,src,dest, and `CAMPR,src,dest,seconds`: src answers to dest. Modems leave the time
/// out, or say a negative one, when they have none: absent here.
struct Ping {
    std::uint32_t src = 0, dest = 0;
    std::optional<double> one_way_travel_time_s;
};
Ping read_ping(const Sentence& s);
/// `CACMA`: a ping was heard, and `CACMR,PNR,time,src,dest,seconds,…`: it was answered (second
/// generation, where the kind and the time stand in either order). Absent: it is of another kind.
std::optional<Ping> read_extended_ping(const Sentence& s);

/// `CCMUC`, `CAMUC`, `CAMUA`,src,dest,HHHH: 13 bits of a user's.
struct Mini {
    std::uint32_t src = 0, dest = 0;
    std::uint32_t value = 0;  ///< 0 to 8191
};
Mini read_mini(const Sentence& s);

/// `SNTTA,TA,TB,TC,TD,hhmmss.ss`: one-way travel times to the transponders A to D, seconds.
struct TravelTimes {
    std::array<std::optional<double>, 4> one_way_s;
    std::string_view time_of_day;
};
TravelTimes read_travel_times(const Sentence& s);

/// `CARDP,src,dest,rate,ack,reserved,mini,data` and `CARFP,time,0,src,dest,rate,…,mini,data`: a flexible
/// data packet. mini and data are triples `good;bytes;hex`, joined by `;`.
struct FlexiblePacket {
    std::uint32_t src = 0, dest = 0, rate = 0;
    std::string mini, data;
    bool good = true;  ///< no piece was bad; where one was, the packet is not to be used
    /// Whether mini is the modem's own header (`08`, src, dest …), as CARFP has it, or the user's.
    bool mini_is_header = false;
    std::string payload() const { return mini_is_header ? data : mini + data; }
};
FlexiblePacket read_flexible_packet(const Sentence& s);

/// `CATMQ,iso,…` and `CATMS,timed_out,iso`: the modem's clock, nanoseconds since 1970. `CACLK` too.
/// @return  absent: it has none, or could not set it
std::optional<std::int64_t> read_clock_ns(const Sentence& s);

/// Bodies of what is said to a modem.
std::string compose(std::string_view address, const Setting& setting);
std::string compose(std::string_view address, const Cycle& cycle);
std::string compose(std::string_view address, const Mini& mini);
std::string compose_transmit_data(std::uint32_t src, std::uint32_t dest, bool ack_requested,
                                  std::string_view bytes);
/// `CCTDP,dest,rate,0,0,hex`
std::string compose_flexible(std::uint32_t dest, std::uint32_t rate, std::string_view bytes);
/// `CCCLK,yyyy,mm,dd,hh,mm,ss`, and `CCTMS,iso,0` of the second generation.
std::string compose_clock(std::int64_t time_s, bool second_generation);

/// The letters of an address as a number, to switch by: code("CACYC").
constexpr std::uint64_t code(std::string_view address) {
    std::uint64_t value = 0;
    if (address.size() > 8) return 0;
    for (const char c : address) value = value << 8 | static_cast<unsigned char>(c);
    return value;
}

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_SENTENCES_HPP
