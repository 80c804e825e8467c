// A Micro-Modem's sentences as structs: those that were captured from modems, and the form of each in
// the description of the host interface.
#include "seautils/core/error.hpp"
#include "seautils/core/time.hpp"
#include "seautils/modem/sentences.hpp"
#include "seautils/modem/statistics.hpp"

#include <gtest/gtest.h>

namespace seautils::modem {
namespace {

/// A line as a sentence; its checksum, where it has one, must be right.
Sentence parsed(std::string_view line) {
    Sentence s;
    EXPECT_EQ(sentence_fault(parse_sentence(line, s), s), "") << line;
    return s;
}

template <class Read>
std::string refusal(std::string_view line, Read read) {
    try {
        read(parsed(line));
        return "taken";
    } catch (const DataError& e) {
        return e.what();
    }
}

record::UtcTime at(const char* text) { return {parse_utc_ns(text)}; }

}  // namespace

TEST(ModemSentences, Settings) {
    const Setting src = read_setting(parsed("$CACFG,SRC,1*33"));
    EXPECT_EQ(src.name, "SRC");
    EXPECT_EQ(src.value, "1");
    EXPECT_EQ(stream::sentence(compose("CCCFG", src)), "$CCCFG,SRC,1*31\r\n");
    const Setting dotted = read_setting(parsed("$CACFG,script.vD,0*63"));
    EXPECT_EQ(dotted.name, "script.vD");
    EXPECT_EQ(dotted.value, "0");
}

TEST(ModemSentences, Revisions) {
    const Revision second = read_revision(parsed("$CAREV,030303,AUV,2.0.27087*16"));
    EXPECT_EQ(second.major_number(), 2U);
    EXPECT_EQ(second.build_number(), 27087U);
    EXPECT_FALSE(second.started());
    EXPECT_EQ(read_revision(parsed("$CAREV,000052,AUV,0.93.0.09*07")).major_number(), 0U);
    EXPECT_FALSE(read_revision(parsed("$CAREV,030303,COPROC,0.30.0.56*40")).major_number());
    EXPECT_TRUE(read_revision(parsed("$CAREV,000001,INIT,0.93.0.30")).started());
}

TEST(ModemSentences, Cycles) {
    const Cycle c = read_cycle(parsed("$CACYC,0,1,2,0,1,1*58"));
    EXPECT_EQ(c, (Cycle{1, 2, 0, true, 1}));
    EXPECT_EQ(stream::sentence(compose("CCCYC", c)), "$CCCYC,0,1,2,0,1,1*5A\r\n");
    EXPECT_EQ(read_cycle(parsed("$CACYC,0,0,8,0,0,1*52")), (Cycle{0, 8, 0, false, 1}));
    EXPECT_EQ(refusal("$CACYC,0,x,2,0,1,1", read_cycle),
              "CACYC field 2 'x' is not a whole number 0 to 127");
    EXPECT_EQ(refusal("$CACYC,0,1,2,0,1", read_cycle), "CACYC of 5 fields where there should be 6");
    EXPECT_EQ(refusal("$" + std::string(1500, 'E') + ",1", read_cycle),
              "'" + std::string(60, 'E') + "…' of 1 field where there should be 6");
    EXPECT_EQ(refusal("$CACYC,0,,2,0,1,1", read_cycle),
              "CACYC field 2 '' is not a whole number 0 to 127");
}

TEST(ModemSentences, DataOnItsWay) {
    const DataRequest d = read_data_request(parsed("$CADRQ,204511,1,2,1,32,1*44"));
    EXPECT_EQ(d.src, 1U);
    EXPECT_EQ(d.dest, 2U);
    EXPECT_TRUE(d.ack_requested);
    EXPECT_EQ(d.bytes, 32U);
    EXPECT_EQ(d.number, 1U);
    EXPECT_EQ(
        stream::sentence(compose_transmit_data(1, 2, true, std::string(32, '5'))),
        "$CCTXD,1,2,1,3535353535353535353535353535353535353535353535353535353535353535*7A\r\n");
    EXPECT_EQ(compose_transmit_data(1, 2, false, ""), "CCTXD,1,2,0,");
}

TEST(ModemSentences, DataThatArrived) {
    const ReceivedFrame r = read_received_frame(parsed(
        "$CARXD,1,2,1,1,3535353535353535353535353535353535353535353535353535353535353535*63"));
    EXPECT_EQ(r.src, 1U);
    EXPECT_EQ(r.dest, 2U);
    EXPECT_TRUE(r.ack_requested);
    EXPECT_EQ(r.frame, 0U);
    EXPECT_EQ(r.bytes, std::string(32, '5'));
    EXPECT_EQ(read_received_frame(parsed("$CARXD,1,2,1,3,")).bytes, "");
    EXPECT_EQ(refusal("$CARXD,1,2,1,1,3g", read_received_frame),
              "CARXD field 5: 'g' in column 2 is no hexadecimal digit");
    const Acknowledgement a = read_acknowledgement(parsed("$CAACK,2,1,1,1*48"));
    EXPECT_EQ(a.src, 2U);
    EXPECT_EQ(a.dest, 1U);
    EXPECT_EQ(a.frame, 0U);
}

TEST(ModemSentences, Complaints) {
    const Complaint c = read_complaint(parsed("$CAMSG,BAD_CRC,4*25"));
    EXPECT_TRUE(c.bad_crc);
    EXPECT_EQ(c.number, 4U);
    EXPECT_TRUE(read_complaint(parsed("$CAMSG,Bad CRC")).bad_crc);
    EXPECT_FALSE(read_complaint(parsed("$CAMSG,Bad CRC")).number);
    EXPECT_TRUE(read_complaint(parsed("$CAMSG,PACKET_TIMEOUT,1")).timeout);
    EXPECT_TRUE(read_fault(parsed("$CAERR,123456,NMEA,3,bad command")).unknown_command);
    EXPECT_TRUE(read_fault(parsed("$CAERR,123456,DATA_TIMEOUT,1")).data_timeout);
    EXPECT_TRUE(read_fault(parsed("$CAERR,DATA_TIMEOUT,1")).data_timeout);
}

TEST(ModemSentences, TravelTimes) {
    const Ping p = read_ping(parsed("$CAMPR,2,1,0.2501*7A"));
    EXPECT_EQ(p.src, 2U);
    EXPECT_EQ(p.dest, 1U);
    EXPECT_DOUBLE_EQ(p.one_way_travel_time_s.value(), 0.2501);
    EXPECT_FALSE(read_ping(parsed("$CAMPA,1,2*5D")).one_way_travel_time_s);
    for (const char* line : {"$CAMPR,2,1,", "$CAMPR,2,1", "$CAMPR,2,1,-0.0400"})
        EXPECT_FALSE(read_ping(parsed(line)).one_way_travel_time_s) << line;
    EXPECT_EQ(refusal("$CAMPR,2,1,nan", read_ping), "CAMPR field 3 'nan' is not a number");

    const TravelTimes t = read_travel_times(parsed("$SNTTA,0.9216,0.5920,,,204504.00*5B"));
    EXPECT_DOUBLE_EQ(t.one_way_s[0].value(), 0.9216);
    EXPECT_DOUBLE_EQ(t.one_way_s[1].value(), 0.5920);
    EXPECT_FALSE(t.one_way_s[2]);
    EXPECT_FALSE(t.one_way_s[3]);
    EXPECT_EQ(t.time_of_day, "204504.00");
    EXPECT_FALSE(read_travel_times(parsed("$SNTTA,-0.5,,,,")).one_way_s[0]);
}

TEST(ModemSentences, PingsOfTheSecondGeneration) {
    const auto reply = read_extended_ping(
        parsed("$CACMR,PNR,2025-05-29T15:09:05.461473,1,0,0.001997,6.3,7.65,1,0,*41"));
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->src, 1U);
    EXPECT_EQ(reply->dest, 0U);
    EXPECT_DOUBLE_EQ(reply->one_way_travel_time_s.value(), 0.001997);
    for (const char* line : {"$CACMA,2025-03-17T17:16:29.639994,PNG,0,1,56.7,6.62,3,0,0*74",
                             "$CACMA,PNG,2025-07-01T02:39:54.631989,1,3,31.5,9.34,1,0,0*7E"}) {
        const auto heard = read_extended_ping(parsed(line));
        ASSERT_TRUE(heard) << line;
        EXPECT_EQ(heard->dest, heard->src == 0 ? 1U : 3U) << line;
        EXPECT_FALSE(heard->one_way_travel_time_s) << line;
    }
}

TEST(ModemSentences, Minipackets) {
    const Mini m = read_mini(parsed("$CCMUC,1,2,0123*74"));
    EXPECT_EQ(m.value, 0x123U);
    EXPECT_EQ(stream::sentence(compose("CCMUC", m)), "$CCMUC,1,2,0123*74\r\n");
    EXPECT_EQ(read_mini(parsed("$CAMUA,1,2,1fab*20")).value, 0x1fabU);
    EXPECT_EQ(refusal("$CAMUA,1,2,2000", read_mini),
              "CAMUA field 3 '2000' is not hexadecimal 0 to 1FFF");
}

TEST(ModemSentences, FlexiblePackets) {
    const FlexiblePacket p = read_flexible_packet(
        parsed("$CARFP,2025-03-17T17:16:29.672622,0,0,1,1,-1,0,0,1;5;08000106ff,1;3;ac4131,,*23"));
    EXPECT_EQ(p.src, 0U);
    EXPECT_EQ(p.dest, 1U);
    EXPECT_EQ(p.rate, 1U);
    EXPECT_EQ(p.mini, std::string("\x08\x00\x01\x06\xff", 5));
    EXPECT_EQ(p.data,
              "\xac"
              "A1");
    EXPECT_TRUE(p.good);
    const FlexiblePacket empty = read_flexible_packet(
        parsed("$CARFP,2025-05-29T15:26:07.286444,0,1,0,1,-1,0,0,1;6;0801000700ff,,*01"));
    EXPECT_EQ(empty.src, 1U);
    EXPECT_EQ(empty.mini.size(), 6U);
    EXPECT_EQ(empty.data, "");
    const FlexiblePacket two = read_flexible_packet(parsed("$CARDP,1,2,3,0,0,,1;2;0102;1;1;03"));
    EXPECT_EQ(two.data, "\x01\x02\x03");
    EXPECT_FALSE(read_flexible_packet(parsed("$CARDP,1,2,3,0,0,,1;2;0102;0;1;03")).good);
    EXPECT_EQ(refusal("$CARDP,1,2,3,0,0,,1;3;0102", read_flexible_packet),
              "CARDP field 7 '1;3;0102' is not made of pieces good;bytes;hex");
    EXPECT_EQ(compose_flexible(2, 1, "\x01\x02"), "CCTDP,2,1,0,0,0102");
}

TEST(ModemSentences, Clocks) {
    EXPECT_EQ(read_clock_ns(parsed("$CATMQ,2019-12-02T03:02:59Z,RTC,RTC*6E")),
              parse_utc_ns("2019-12-02T03:02:59Z"));
    EXPECT_EQ(read_clock_ns(parsed("$CATMS,0,2019-12-02T03:02:59Z")),
              parse_utc_ns("2019-12-02T03:02:59Z"));
    EXPECT_FALSE(read_clock_ns(parsed("$CATMS,1,2019-12-02T03:02:59Z")));
    EXPECT_EQ(read_clock_ns(parsed("$CACLK,2019,12,02,03,02,59")),
              parse_utc_ns("2019-12-02T03:02:59Z"));
    const std::int64_t time_s = parse_utc_ns("2019-12-02T03:02:59Z") / 1'000'000'000;
    EXPECT_EQ(compose_clock(time_s, false), "CCCLK,2019,12,02,03,02,59");
    EXPECT_EQ(compose_clock(time_s, true), "CCTMS,2019-12-02T03:02:59Z,0");
}

TEST(ModemStatistics, ReceptionWithoutAVersion) {
    const auto s = receive_statistics(
        parsed("$CACST,1,153026.0000,0,4105,30,0318,0193,10,00,00,01,01,2,004,004,3,3,3,1,154,09,"
               "08,10,-6,000,0.0,4125000,5000*5B"),
        at("2010-06-01T15:30:27Z"));
    EXPECT_EQ(s.mode, 1U);
    EXPECT_EQ(s.arrival, at("2010-06-01T15:30:26Z"));
    EXPECT_EQ(s.mfd_peak, 4105);
    EXPECT_EQ(s.mfd_ratio, 318);
    EXPECT_EQ(s.shf_again, 10);
    EXPECT_EQ(s.shf_p2b_db, 1);
    EXPECT_EQ(s.rate, 2U);
    EXPECT_EQ(s.src, 4U);
    EXPECT_EQ(s.psk_error, 3U);
    EXPECT_EQ(s.packet_type, 3U);
    EXPECT_EQ(s.frames, 3U);
    EXPECT_EQ(s.bad_frames, 1U);
    EXPECT_EQ(s.snr_rss_db, 154);
    EXPECT_EQ(s.snr_in_db, 9);
    EXPECT_EQ(s.mse_db, -6);
    EXPECT_EQ(s.dqf, 0);
    EXPECT_EQ(s.noise_db, 41);  // the comma behind it is missing
    EXPECT_EQ(s.carrier_hz, 25000);
    EXPECT_EQ(s.bandwidth_hz, 5000);
}

TEST(ModemStatistics, ReceptionWithAVersion) {
    const auto s = receive_statistics(
        parsed("$CACST,8,0,20250606230123.348554,06,32767,45,0102,0123,07,00,00,00,00,1,001,000,0,"
               "5,1,0,150,26.0,9.48,-100,-6.48,-01,0.01,51,25000,5000,0,-1,-1,00*4A"),
        {});
    EXPECT_EQ(s.mode, 0U);
    EXPECT_EQ(s.arrival, at("2025-06-06T23:01:23.348554Z"));
    EXPECT_EQ(s.clock_mode, 6U);
    EXPECT_EQ(s.spl_db, 123);
    EXPECT_EQ(s.rate, 1U);
    EXPECT_EQ(s.src, 1U);
    EXPECT_EQ(s.dest, 0U);
    EXPECT_EQ(s.packet_type, 5U);
    EXPECT_EQ(s.frames, 1U);
    EXPECT_EQ(s.bad_frames, 0U);
    EXPECT_EQ(s.snr_out_db, 9.48);
    EXPECT_EQ(s.snr_symbols_db, -100);
    EXPECT_EQ(s.mse_db, -6.48);
    EXPECT_EQ(s.dqf, -1);
    EXPECT_EQ(s.doppler_mps, 0.01);
    EXPECT_EQ(s.noise_db, 51);
    EXPECT_EQ(s.carrier_hz, 25000);
    EXPECT_EQ(s.bandwidth_hz, 5000);
    const std::string again = compose(s);
    EXPECT_EQ(receive_statistics(parsed("$" + again), {}).arrival, s.arrival);
    EXPECT_EQ(compose(receive_statistics(parsed("$" + again), {})), again);
}

TEST(ModemStatistics, OlderAndShorterForms) {
    const auto timed_out = receive_statistics(parsed("$CACST,6,2,20250606230123.3485"), {});
    EXPECT_EQ(timed_out.mode, 2U);
    EXPECT_EQ(timed_out.arrival, at("2025-06-06T23:01:23.3485Z"));
    EXPECT_FALSE(timed_out.rate);
    for (const char* const bare : {"$CACST,2", "$CACST,6,2"})
        EXPECT_EQ(receive_statistics(parsed(bare), {}).mode, 2U) << bare;
    EXPECT_EQ(refusal("$CACST,6", [](const Sentence& s) { receive_statistics(s, {}); }),
              "CACST of 1 field where there should be 2");
    const auto old =
        receive_statistics(parsed("$CACST,0,235959.5,0,1,2,3,4,5,6,7,8,9,0,1,2,0,1,1,0,"
                                  "100,9,8,10,-6,0,0.5"),
                           at("2025-06-07T00:00:01Z"));
    EXPECT_EQ(old.arrival, at("2025-06-06T23:59:59.5Z"));  // yesterday's
    EXPECT_EQ(old.doppler_mps, 0.5);
    EXPECT_FALSE(old.noise_db);
    EXPECT_FALSE(receive_statistics(parsed("$CACST,0,235959.5"), {}).arrival);
    EXPECT_EQ(refusal("$CACST,0,235959.5,x", [](const Sentence& s) { receive_statistics(s, {}); }),
              "CACST field 3 'x' is not a whole number 0 to 255");
}

TEST(ModemStatistics, Transmission) {
    const auto s = transmit_statistics(
        parsed("$CAXST,7,20250606,230103.000935,3,0,200,5000,25000,1,0,1,0,0,1,5,2,25000*53"));
    EXPECT_EQ(s.sent, at("2025-06-06T23:01:03.000935Z"));
    EXPECT_EQ(s.clock_mode, 3U);
    EXPECT_EQ(s.mode, 0U);
    EXPECT_EQ(s.probe_length, 200U);
    EXPECT_EQ(s.bandwidth_hz, 5000);
    EXPECT_EQ(s.carrier_hz, 25000);
    EXPECT_EQ(s.rate, 1U);
    EXPECT_EQ(s.src, 0U);
    EXPECT_EQ(s.dest, 1U);
    EXPECT_EQ(s.ack_requested, false);
    EXPECT_EQ(s.frames_expected, 0U);
    EXPECT_EQ(s.frames_sent, 1U);
    EXPECT_EQ(s.packet_type, 5U);
    EXPECT_EQ(s.bytes, 2U);
    EXPECT_EQ(compose(s), "CAXST,7,20250606,230103.000935,3,0,200,5000,25000,1,0,1,0,0,1,5,2");
    const auto old = transmit_statistics(
        parsed("$CAXST,20100606,230103.0009,0,4,200,4000,25000,0,1,2,1,1,1,1,32"));
    EXPECT_EQ(old.mode, 4U);
    EXPECT_EQ(old.ack_requested, true);
    EXPECT_EQ(old.bytes, 32U);
}

}  // namespace seautils::modem
