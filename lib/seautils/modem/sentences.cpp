#include "seautils/modem/sentences.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"
#include "seautils/modem/fields.hpp"
#include "seautils/stream/hex.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>

namespace seautils::modem {

namespace {

constexpr std::uint32_t most_frame = 255;  ///< the numbers of frames that any firmware uses

/// Number k, from 0, of `2.0.27087`.
std::optional<unsigned> part(std::string_view revision, int k) {
    for (; k > 0; --k) {
        const std::size_t point = revision.find('.');
        if (point == revision.npos) return {};
        revision.remove_prefix(point + 1);
    }
    unsigned value = 0;
    const auto error =
        std::from_chars(revision.data(), revision.data() + revision.size(), value).ec;
    return error == std::errc() ? std::optional(value) : std::nullopt;
}

/// Frames count from 1; a 0 is the first frame's of firmware that counts from 0.
std::uint32_t frame_index(const Fields& f, std::size_t k) {
    const std::uint32_t number = f.whole(k, most_frame);
    return number == 0 ? 0 : number - 1;
}

std::uint32_t hex_value(const Fields& f, std::size_t k, std::uint32_t most) {
    const std::string_view text = f.text(k);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (error != std::errc() || end != text.data() + text.size() || value > most)
        f.refuse(k, fmt::format("hexadecimal 0 to {:X}", most));
    return value;
}

bool negative(const std::optional<double>& value) { return value && !(*value >= 0); }

/// Takes the text up to the next `;` off the front.
std::string_view take(std::string_view& text) {
    const std::size_t end = std::min(text.find(';'), text.size());
    const std::string_view piece = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return piece;
}

/// `good;bytes;hex[;…]`: appends the bytes; false where a piece is marked as bad.
bool read_pieces(const Fields& f, std::size_t k, std::string& to) {
    bool good = true;
    std::string bytes;
    for (std::string_view rest = f.text(k); !rest.empty();) {
        const std::string_view crc = take(rest), count = take(rest), hex = take(rest);
        std::size_t expected = 0;
        std::from_chars(count.data(), count.data() + count.size(), expected);
        stream::from_hex(hex, bytes);
        if (crc != "1") {
            good = false;
        } else if (bytes.size() != expected) {
            f.refuse(k, "made of pieces good;bytes;hex");
        }
        to += bytes;
    }
    return good;
}

}  // namespace

Setting read_setting(const Sentence& s) {
    Fields(s).need(2);
    return {std::string(s[1]), std::string(s.from(2))};
}

std::optional<unsigned> Revision::major_number() const {
    return ident == "AUV" ? part(revision, 0) : std::nullopt;
}

std::optional<unsigned> Revision::build_number() const {
    return ident == "AUV" ? part(revision, 2) : std::nullopt;
}

Revision read_revision(const Sentence& s) {
    Fields(s).need(2);
    return {s[1], s[2], s[3]};
}

Cycle read_cycle(const Sentence& s) {
    const Fields f(s);
    f.need(6);
    return {f.address(2), f.address(3), f.whole(4, 14), f.whole(5, 1) == 1, f.whole(6, most_frame)};
}

DataRequest read_data_request(const Sentence& s) {
    const Fields f(s);
    f.need(6);
    return {f.address(2), f.address(3), f.whole(4, 1) == 1, f.whole(5, 65535),
            f.whole(6, most_frame)};
}

ReceivedFrame read_received_frame(const Sentence& s) {
    const Fields f(s);
    f.need(5);
    return {f.address(1), f.address(2), f.whole(3, 1) == 1, frame_index(f, 4), f.bytes(5)};
}

Acknowledgement read_acknowledgement(const Sentence& s) {
    const Fields f(s);
    f.need(3);
    return {f.address(1), f.address(2), frame_index(f, 3)};
}

Complaint read_complaint(const Sentence& s) {
    const Fields f(s);
    f.need(1);
    Complaint c;
    c.bad_crc = s[1] == "BAD_CRC" || s[1] == "Bad CRC";
    c.timeout = s[1] == "PACKET_TIMEOUT";
    if ((c.bad_crc || c.timeout) && !s[2].empty()) c.number = f.whole(2, most_frame);
    c.text = s.from(1);
    return c;
}

Fault read_fault(const Sentence& s) {
    return {s[2] == "NMEA", s[1] == "DATA_TIMEOUT" || s[2] == "DATA_TIMEOUT", s[2], s.from(1)};
}

Ping read_ping(const Sentence& s) {
    const Fields f(s);
    f.need(2);
    Ping ping{f.address(1), f.address(2), f.maybe_real(3)};
    if (negative(ping.one_way_travel_time_s)) ping.one_way_travel_time_s.reset();
    return ping;
}

std::optional<Ping> read_extended_ping(const Sentence& s) {
    const bool kind_first = s[1] == "PNG" || s[1] == "PNR";
    if (!kind_first && s[2] != "PNG" && s[2] != "PNR") return {};
    const Fields f(s);
    f.need(4);
    Ping ping{f.address(3), f.address(4), {}};
    if (s.type() == "CMR") ping.one_way_travel_time_s = f.maybe_real(5);
    if (negative(ping.one_way_travel_time_s)) ping.one_way_travel_time_s.reset();
    return ping;
}

Mini read_mini(const Sentence& s) {
    const Fields f(s);
    f.need(3);
    return {f.address(1), f.address(2), hex_value(f, 3, 0x1fff)};
}

TravelTimes read_travel_times(const Sentence& s) {
    const Fields f(s);
    TravelTimes t;
    for (std::size_t k = 0; k < t.one_way_s.size(); ++k) {
        t.one_way_s[k] = f.maybe_real(k + 1);
        if (negative(t.one_way_s[k])) t.one_way_s[k].reset();
    }
    t.time_of_day = s[5];
    return t;
}

FlexiblePacket read_flexible_packet(const Sentence& s) {
    const Fields f(s);
    const bool timed = s.type() == "RFP";  // time, one field, then as CARDP
    const std::size_t src = timed ? 3 : 1, mini = timed ? 9 : 6;
    f.need(mini + 1);
    FlexiblePacket p{f.address(src), f.address(src + 1), f.whole(src + 2, 14), {}, {}, true, timed};
    p.good = read_pieces(f, mini, p.mini);
    p.good = read_pieces(f, mini + 1, p.data) && p.good;
    return p;
}

std::optional<std::int64_t> read_clock_ns(const Sentence& s) {
    if (s.type() == "CLK") {
        const Fields f(s);
        f.need(6);
        const auto date = date_ns(
            fmt::format("{:04}{:02}{:02}", f.whole(1, 9999), f.whole(2, 99), f.whole(3, 99)));
        const std::int64_t seconds = f.whole(4, 23) * 3600 + f.whole(5, 59) * 60 + f.whole(6, 60);
        return date ? std::optional(*date + seconds * 1'000'000'000) : std::nullopt;
    }
    const bool set = s.type() == "TMS";
    if (set && s[1] == "1") return {};
    return parse_utc_ns(s[set ? 2 : 1]);
}

std::string compose(std::string_view address, const Setting& setting) {
    return fmt::format("{},{},{}", address, setting.name, setting.value);
}

std::string compose(std::string_view address, const Cycle& c) {
    return fmt::format("{},0,{},{},{},{:d},{}", address, c.src, c.dest, c.rate, c.ack_requested,
                       c.frames);
}

std::string compose(std::string_view address, const Mini& m) {
    return fmt::format("{},{},{},{:04X}", address, m.src, m.dest, m.value);
}

std::string compose_transmit_data(std::uint32_t src, std::uint32_t dest, bool ack_requested,
                                  std::string_view bytes) {
    std::string body = fmt::format("CCTXD,{},{},{:d},", src, dest, ack_requested);
    stream::append_hex(body, bytes);
    return body;
}

std::string compose_flexible(std::uint32_t dest, std::uint32_t rate, std::string_view bytes) {
    std::string body = fmt::format("CCTDP,{},{},0,0,", dest, rate);
    stream::append_hex(body, bytes);
    return body;
}

std::string compose_clock(std::int64_t time_s, bool second_generation) {
    const std::string iso = format_utc(time_s * 1'000'000);
    if (second_generation) return fmt::format("CCTMS,{},0", iso);
    const std::string_view t = iso;
    return fmt::format("CCCLK,{},{},{},{},{},{}", t.substr(0, 4), t.substr(5, 2), t.substr(8, 2),
                       t.substr(11, 2), t.substr(14, 2), t.substr(17, 2));
}

}  // namespace seautils::modem
