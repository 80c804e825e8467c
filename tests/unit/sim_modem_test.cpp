// Simulated modems against recorded sentences and the published sequences.
//
// Sentences with a checksum that stand here were captured from modems or published with it (Goby
// issue 126, the Goby Micro-Modem driver's documentation, WHOI's interface guides); they are not our
// own output. Sequences are those of the Goby driver's diagrams (data at rate 0 with
// acknowledgement, two-way ping) and of DUNE's driver for long baselines.
#include "sim_rig.hpp"

namespace seautils::sim {
namespace {

constexpr std::size_t one = 0, two = 1, three = 2;

const std::string third = "[node modem3]\nid = 3\nx_m = 750\ny_m = 0\n";

/// One frame from 1 to 2 at rate 0, the host answering as it is asked.
void send_at_rate_0(Rig& rig, const std::string& hex) {
    rig.raw(one, "$CCCYC,0,1,2,0,1,1*5A");
    rig.run(1.2);
    rig.say(one, "CCTXD,1,2,1," + hex);
    rig.run(10);
}

}  // namespace

TEST(SimModem, SaysWhatItIsAfterBoot) {
    Rig rig(Rig::pair("mm2"));
    rig.run(0.9);
    EXPECT_TRUE(rig.heard(one).empty());
    rig.raw(one, "$CCCFG,SRC,1*31");  // deaf
    rig.run(1);
    EXPECT_EQ(rig.heard(one), (Lines{"CAREV,204501,INIT,2.0.27087", "CAREV,204501,AUV,2.0.27087",
                                     "CAREV,204501,COPROC,0.30.0.56"}));
}

TEST(SimModem, CapturedRevisions) {
    Rig rig("[water]\nepoch = 2019-12-02T03:03:02Z\n" + Rig::pair("mm2").substr(8));
    rig.run(2);
    EXPECT_EQ(rig.said[one].at(1).text, "$CAREV,030303,AUV,2.0.27087*16");
    EXPECT_EQ(rig.said[one].at(2).text, "$CAREV,030303,COPROC,0.30.0.56*40");
}

TEST(SimModem, SettingsAreEchoedAndQueried) {
    Rig rig(Rig::pair("mm1"));
    rig.boot();
    rig.raw(one, "$CCCFG,SRC,1*31");
    rig.run(0.1);
    EXPECT_EQ(rig.said[one].at(0).text, "$CACFG,SRC,1*33");
    rig.clear();
    rig.say(one, "CCCFG,ASD,1");
    rig.say(one, "CCCFQ,ASD");
    rig.say(one, "CCCFG,SRC,200");  // no address: the echo says what holds
    rig.say(one, "CCCFG,script.vD,0");
    rig.run(0.5);
    EXPECT_EQ(rig.heard(one), (Lines{"CACFG,ASD,1", "CACFG,ASD,1", "CACFG,SRC,1",
                                     "CAERR,000002,CFG,3,unknown setting"}));
    rig.clear();
    rig.say(one, "CCCFG,ALL,0");
    rig.say(one, "CCCFQ,ASD");
    rig.run(0.5);
    EXPECT_EQ(rig.heard(one), (Lines{"CACFG,ALL,0", "CACFG,ASD,0"}));
    rig.clear();
    rig.say(one, "CCCFQ,ALL");
    rig.say(one, "CCCFQ,TOP");
    rig.run(3);
    EXPECT_GT(rig.count(one, "$CACFG,"), 20U);
    EXPECT_EQ(rig.count(one, "$CACFG,recv.base64data"), 0U);
    EXPECT_EQ(rig.count(one, "$CACFG,TOP,0"), 1U);  // three capitals: a setting to a Micro-Modem 1
}

TEST(SimModem, DottedSettingsOfTheSecondGeneration) {
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    rig.say(one, "CCCFG,script.vD,0");
    rig.run(0.1);
    EXPECT_EQ(rig.said[one].at(0).text, "$CACFG,script.vD,0*63");
    rig.clear();
    rig.say(one, "CCCFQ,TOP");
    rig.run(0.5);
    const std::size_t early = rig.said[one].size();
    rig.run(10);
    EXPECT_GT(rig.said[one].size(), early + 10) << "it streams for seconds";
    EXPECT_EQ(rig.count(one, "$CACFG,recv.base64data,0"), 1U);
}

TEST(SimModem, ClockOfTheFirstGeneration) {
    Rig rig(Rig::pair("mm1"));
    rig.boot();
    rig.run(0.075);  // after a full second, announcing the next one
    rig.say(one, "CCCLK,2024,5,1,20,45,3");
    rig.run(0.9);
    EXPECT_TRUE(rig.heard(one).empty());
    rig.run(0.1);
    EXPECT_EQ(rig.heard(one), (Lines{"CACLK,2024,5,1,20,45,3"}));
    rig.run(10);
    rig.say(one, "CCCLQ,0");
    rig.say(one, "CCTMQ,0");
    rig.run(0.1);
    EXPECT_EQ(rig.heard(one).at(1), "CACLK,2024,5,1,20,45,13");
    EXPECT_EQ(rig.heard(one).at(2), "CAERR,204513,NMEA,2,unknown command");
    rig.clear();
    for (const char* bad : {"2024,2,30,0,0,0", "2024,13,1,0,0,0", "2024,1,1,24,0,0", "", "x"})
        rig.say(one, std::string("CCCLK,") + bad);
    rig.run(1);
    EXPECT_EQ(rig.count(one, "$CAERR,2045"), 5U);
}

TEST(SimModem, ClockOfTheSecondGeneration) {
    Rig rig("[water]\nepoch = 2019-12-02T03:02:57.5Z\n" + Rig::pair("mm2").substr(8));
    rig.boot();
    rig.raw(one, "$CCTMQ,0*54");
    rig.run(0.45);
    EXPECT_TRUE(rig.heard(one).empty());  // it answers half a second late
    rig.run(0.2);
    EXPECT_EQ(rig.heard(one), (Lines{"CATMQ,2019-12-02T03:03:00Z,RTC,EXT"}));
    rig.clear();
    rig.say(one, "CCTMS,2019-12-02T04:00:00Z,0");
    rig.run(1.1);
    EXPECT_EQ(rig.heard(one), (Lines{"CATMS,0,2019-12-02T04:00:00Z"}));
    rig.say(one, "CCTMS,noon,0");
    rig.run(0.5);
    EXPECT_EQ(rig.heard(one).at(1), "CAERR,040000,TMS,3,field 1 is not a time");
}

TEST(SimModem, CapturedTimeQuery) {
    std::string text = Rig::pair("mm2").substr(8);
    text.replace(text.find("nvram"), 0, "pps = no\n");
    Rig rig("[water]\nepoch = 2019-12-02T03:02:57Z\n" + text);
    rig.boot();
    rig.raw(one, "$CCTMQ,0*54");
    rig.run(1);
    EXPECT_EQ(rig.said[one].at(0).text, "$CATMQ,2019-12-02T03:02:59Z,RTC,RTC*6E");
}

TEST(SimModem, RestartsOnCommand) {
    Rig rig(Rig::pair("mm1"));
    rig.boot();
    rig.raw(one, "$CCMSC,1,1,0*41");
    rig.run(3);
    EXPECT_EQ(rig.heard(one),
              (Lines{"CAMSC,1,1,0", "CAREV,000001,INIT,0.93.0.09", "CAREV,000001,AUV,0.93.0.09",
                     "CAREV,000001,COPROC,0.20.0.56"}));
}

// Sender and receiver of Fig. 2.14 of T. Schneider's thesis: the Goby driver's diagram.
TEST(SimModem, DataAtRate0WithAcknowledgement) {
    for (const std::string generation : {"mm1", "mm2"}) {
        Rig rig(Rig::pair(generation));
        rig.boot();
        send_at_rate_0(rig, digits(32));
        EXPECT_EQ(rig.heard(one), (Lines{"CACYC,0,1,2,0,1,1", "CATXP,0", "CATXF,0", "CAXST",
                                         "CADRQ,hhmmss,1,2,1,32,1", "CATXD,1,2,1,32", "CATXP,32",
                                         "CATXF,32", "CAXST", "CARXP,0", "CAACK,2,1,1,1", "CACST"}))
            << generation;
        EXPECT_EQ(rig.heard(two),
                  (Lines{"CARXP,0", "CACYC,0,1,2,0,1,1", "CACST", "CARXP,0",
                         "CARXD,1,2,1,1," + digits(32), "CACST", "CATXP,0", "CATXF,0", "CAXST"}))
            << generation;
    }
}

TEST(SimModem, PublishedSentencesOfAnExchange) {
    Rig rig("[water]\nepoch = 2024-05-01T20:45:08.1Z\n" + Rig::pair("mm2").substr(8));
    rig.boot();  // 20:45:10.1, so that the request falls into second 11
    send_at_rate_0(rig, digits(35));
    EXPECT_EQ(rig.first(one, "$CACYC"), "$CACYC,0,1,2,0,1,1*58");
    EXPECT_EQ(rig.first(one, "$CADRQ"), "$CADRQ,204511,1,2,1,32,1*44");
    EXPECT_EQ(rig.first(one, "$CAERR"), stream::sentence("CAERR,204511,TXD,3,35 bytes where 32 fit")
                                            .substr(0, rig.first(one, "$CAERR").size()));
    rig.clear();
    rig.raw(one, "$CCTXD,1,2,1," + digits(35) + "*7A");  // published so, three bytes too long
    rig.run(1);
    EXPECT_EQ(rig.count(one, "$CAERR"), 1U);
}

TEST(SimModem, PublishedAcknowledgement) {
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    send_at_rate_0(rig, digits(32));
    EXPECT_EQ(rig.first(one, "$CAACK"), "$CAACK,2,1,1,1*48");
}

TEST(SimModem, AtHigherRatesDataIsFetchedBeforeItSpeaks) {
    Rig rig(Rig::pair("mm2") + third);
    rig.boot();
    rig.say(one, "CCCYC,0,1,2,1,1,3");
    rig.run(0.2);
    rig.say(one, "CCTXD,1,2,1," + digits(64));
    rig.run(0.2);
    rig.say(one, "CCTXD,1,2,1," + digits(10));
    rig.run(0.2);
    rig.say(one, "CCTXD,1,2,1,");  // no more
    rig.run(12);
    EXPECT_EQ(rig.heard(one),
              (Lines{"CACYC,0,1,2,1,1,3", "CADRQ,hhmmss,1,2,1,64,1", "CATXD,1,2,1,64",
                     "CADRQ,hhmmss,1,2,1,64,2", "CATXD,1,2,1,10", "CADRQ,hhmmss,1,2,1,64,3",
                     "CATXD,1,2,1,0", "CATXP,74", "CATXF,74", "CAXST", "CARXP,1", "CAACK,2,1,1,1",
                     "CAACK,2,1,2,1", "CACST"}));
    const Lines packet{"CARXP,1",
                       "CACYC,0,1,2,1,1,3",
                       "CARXD,1,2,1,1," + digits(64),
                       "CARXD,1,2,1,2," + digits(10),
                       "CARXD,1,2,1,3,",
                       "CACST"};
    Lines receiver = packet;
    for (const char* line : {"CATXP,0", "CATXF,0", "CAXST"}) receiver.emplace_back(line);
    EXPECT_EQ(rig.heard(two), receiver);
    Lines other = packet;  // it overhears the packet, and the acknowledgement without telling
    other.insert(other.end(), {"CARXP,1", "CACST"});
    EXPECT_EQ(rig.heard(three), other);
}

TEST(SimModem, TheFirstGenerationTakesOthersAcknowledgementsForItsOwn) {
    Rig rig(Rig::pair("mm1") + third);
    rig.boot();
    send_at_rate_0(rig, "01");
    EXPECT_EQ(rig.count(three, "$CAACK,2,3,1,1"), 1U);
    EXPECT_EQ(rig.count(one, "$CAACK,2,1,1,1"), 1U);
}

TEST(SimModem, AllRatesHoldWhatTheTableSays) {
    constexpr unsigned frames[] = {1, 3, 3, 2, 2, 8, 6};
    constexpr unsigned bytes[] = {32, 64, 64, 256, 256, 256, 32};
    for (unsigned rate = 0; rate < rate_count; ++rate) {
        Rig rig(Rig::pair("mm2"));
        rig.boot();
        rig.say(one,
                "CCCYC,0,1,2," + std::to_string(rate) + ",0," + std::to_string(frames[rate] + 1));
        rig.run(1);
        EXPECT_EQ(rig.count(one, "$CAERR,204502,CYC,3,field 6"), 1U);
        rig.say(one, "CCCYC,0,1,2," + std::to_string(rate) + ",0," + std::to_string(frames[rate]));
        for (unsigned k = 0; k < frames[rate]; ++k) {
            rig.run(1.2);
            rig.say(one, "CCTXD,1,2,0," + digits(bytes[rate]));
        }
        rig.run(10);
        EXPECT_EQ(rig.count(two, "$CARXD,1,2,0,"), frames[rate]);
        ASSERT_FALSE(rig.truths.empty());
        EXPECT_EQ(rig.truths.back().bytes, frames[rate] * bytes[rate]) << rate;
        EXPECT_EQ(rig.count(two, "$CATXP"), 0U) << "no acknowledgement was asked for";
    }
}

TEST(SimModem, TheFirstGenerationHasNoRate6NorFlexibleData) {
    Rig rig(Rig::pair("mm1"));
    rig.boot();
    rig.say(one, "CCCYC,0,1,2,6,0,1");
    rig.say(one, "CCTDP,2,1,0,0,0102");
    rig.say(one, "CCTMS,2024-05-01T00:00:00Z,0");
    rig.run(1);
    EXPECT_EQ(rig.heard(one), (Lines{"CAERR,000002,CYC,3,field 4 is not 0 to 5",
                                     "CAERR,000002,NMEA,2,unknown command",
                                     "CAERR,000002,NMEA,2,unknown command"}));
}

TEST(SimModem, DataMayComeBeforeItIsAskedFor) {  // as DUNE does it
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    rig.say(one, "CCTXD,1,2,0,0a0b");
    rig.run(0.1);
    rig.say(one, "CCCYC,0,1,2,0,0,1");
    rig.run(8);
    EXPECT_EQ(rig.heard(one), (Lines{"CATXD,1,2,0,2", "CACYC,0,1,2,0,0,1", "CATXP,0", "CATXF,0",
                                     "CAXST", "CATXP,2", "CATXF,2", "CAXST"}));
    EXPECT_EQ(rig.count(two, "$CARXD,1,2,0,1,0a0b"), 1U);
}

TEST(SimModem, AHostThatIsLateIsGivenUp) {
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    rig.say(one, "CCCFG,DTO,2");
    rig.say(one, "CCCYC,0,1,2,1,0,3");
    rig.run(0.5);
    rig.say(one, "CCTXD,1,2,0,01");
    rig.run(1.9);
    EXPECT_EQ(rig.count(one, "$CAERR"), 0U);
    rig.run(0.2);
    EXPECT_EQ(rig.first(one, "$CAERR"), "$CAERR,204504,DATA_TIMEOUT,2*4A");
    rig.run(10);
    EXPECT_EQ(rig.count(two, "$CARXD"), 1U) << "what came in time is sent";
    rig.clear();
    rig.say(one, "CCCYC,0,1,2,0,0,1");
    rig.run(30);
    EXPECT_EQ(rig.heard(one).back(), "CAXST") << "mode 4: no data";
    EXPECT_EQ(rig.count(one, "$CATXP"), 1U);
    EXPECT_EQ(rig.heard(two),
              (Lines{"CARXP,0", "CACYC,0,1,2,0,0,1", "CACST", "CAMSG,PACKET_TIMEOUT,1", "CACST"}));
    EXPECT_EQ(rig.said[two].back().text, "$CACST,6,2*42");
    rig.clear();
    rig.say(one, "CCCFG,ASD,1");  // a late host's place is taken by test data
    rig.say(one, "CCCYC,0,1,2,0,0,1");
    rig.run(30);
    EXPECT_EQ(rig.count(two, "$CARXD,1,2,0,1,000102030405060708090a0b0c0d0e0f"), 1U);
}

TEST(SimModem, ThirdPartyPoll) {
    for (const unsigned rate : {0U, 1U}) {
        Rig rig(Rig::pair("mm2") + third);
        rig.boot();
        rig.say(one, rate == 0 ? "CCCYC,0,3,2,0,1,1" : "CCCYC,0,3,2,1,1,1");
        rig.run(2.5);
        EXPECT_EQ(rig.count(two, "$CACYC,0,3,2,"), 1U);
        EXPECT_EQ(rig.count(three, "$CACYC,0,3,2,"), 1U);
        EXPECT_EQ(rig.count(three, "$CADRQ,"), 1U);
        rig.say(three, "CCTXD,3,2,1,0a");
        rig.run(10);
        EXPECT_EQ(rig.count(two, "$CARXD,3,2,1,1,0a"), 1U);
        EXPECT_EQ(rig.count(three, "$CAACK,2,3,1,1"), 1U);
        // From rate 1 on the data carry the announcement too: the master sees its echo and that.
        EXPECT_EQ(rig.count(one, "$CACYC,0,3,2,"), rate == 0 ? 1U : 2U);
        EXPECT_EQ(rig.count(one, "$CAMSG"), 0U);
    }
}

TEST(SimModem, APollThatNobodyAnswersTimesOut) {
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    rig.say(one, "CCCYC,0,9,2,0,1,1");
    rig.run(30);
    EXPECT_EQ(rig.heard(one), (Lines{"CACYC,0,9,2,0,1,1", "CATXP,0", "CATXF,0", "CAXST",
                                     "CAMSG,PACKET_TIMEOUT,1", "CACST"}));
}

// Fig. 2.15: two-way ping.
TEST(SimModem, TwoWayPing) {
    Rig rig(Rig::pair("mm2", 0.2501 * 1500));
    rig.boot();
    rig.raw(one, "$CCMPC,1,2*5D");
    rig.run(5);
    EXPECT_EQ(rig.heard(one), (Lines{"CAMPC,1,2", "CATXP,0", "CATXF,0", "CAXST", "CARXP,0",
                                     "CAMPR,2,1,0.2501", "CACST"}));
    EXPECT_EQ(rig.heard(two),
              (Lines{"CARXP,0", "CAMPA,1,2", "CACST", "CATXP,0", "CATXF,0", "CAXST"}));
    EXPECT_EQ(rig.first(one, "$CAMPR"), "$CAMPR,2,1,0.2501*7A");
    EXPECT_EQ(rig.first(two, "$CAMPA"), "$CAMPA,1,2*5D");
}

TEST(SimModem, PublishedPingAtShortRange) {
    Rig rig(Rig::pair("mm2", 0.0101 * 1500));
    rig.boot();
    rig.raw(one, "$CCMPC,1,2*5D");
    rig.run(5);
    EXPECT_EQ(rig.first(one, "$CAMPR"), "$CAMPR,2,1,0.0101*7C");
}

TEST(SimModem, Minipacket) {
    Rig rig(Rig::pair("mm1") + third);
    rig.boot();
    rig.raw(one, "$CCMUC,1,2,0123*74");
    rig.run(3);
    EXPECT_EQ(rig.heard(one), (Lines{"CAMUC,1,2,0123", "CATXP,0", "CATXF,0", "CAXST"}));
    EXPECT_EQ(rig.heard(two), (Lines{"CARXP,0", "CAMUA,1,2,0123", "CACST"}));
    EXPECT_EQ(rig.heard(three), rig.heard(two));
    rig.clear();
    rig.say(one, "CCMUC,1,2,1fab");
    rig.run(3);
    EXPECT_EQ(rig.first(two, "$CAMUA"), "$CAMUA,1,2,1fab*20");
    for (const char* bad : {"2000", "12", "12345", "zz11", ""})
        rig.say(one, std::string("CCMUC,1,2,") + bad);
    rig.run(3);
    EXPECT_EQ(rig.count(one, "$CAERR,0000"), 5U);
}

TEST(SimModem, FlexibleData) {
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    rig.say(one, "CCTDP,2,1,0,0," + digits(3, "ab"));
    rig.run(4);
    EXPECT_EQ(rig.heard(one), (Lines{"CATDP,2,1,0,0,3", "CATXP,3", "CATXF,3", "CAXST"}));
    EXPECT_EQ(rig.heard(two), (Lines{"CARXP,1", "CARDP,1,2,1,0,0,1;3;ababab,", "CACST"}));
    rig.clear();
    rig.say(one, "CCTDP,2,1,0,0," + digits(64 + 64 + 2, "ab"));
    rig.run(8);
    EXPECT_EQ(rig.first(two, "$CARDP").substr(0, 25), "$CARDP,1,2,1,0,0,1;64;aba");
    EXPECT_NE(rig.first(two, "$CARDP").find(",1;64;" + digits(64, "ab") + ";1;2;abab*"),
              std::string::npos);
    rig.clear();
    rig.say(one, "CCTDP,2,1,0,0," + digits(257, "ab"));
    rig.say(one, "CCTDP,2,2,0,0,ab");
    rig.run(1);
    EXPECT_EQ(rig.count(one, "$CAERR"), 2U);
}

TEST(SimModem, SpoiltFlexibleDataSaysWhich) {
    Rig rig(Rig::pair("mm2", 100, "bad_crc = 1"));
    rig.boot();
    rig.say(one, "CCTDP,2,1,0,0,abcd");
    rig.run(4);
    EXPECT_EQ(rig.heard(two), (Lines{"CARXP,1", "CARDP,1,2,1,0,0,0;2;,", "CACST"}));
}

TEST(SimModem, SpoiltFramesTakeTheirPlace) {
    Rig rig(Rig::pair("mm2", 100, "bad_crc = 1"));
    rig.boot();
    send_at_rate_0(rig, "0102");
    EXPECT_EQ(rig.heard(two), (Lines{"CARXP,0", "CACYC,0,1,2,0,1,1", "CACST", "CARXP,0",
                                     "CAMSG,BAD_CRC,1", "CACST"}))
        << "and is not acknowledged";
    EXPECT_EQ(rig.count(one, "$CAACK"), 0U);
    const std::string statistics = rig.said[two].back().text;
    EXPECT_EQ(statistics.substr(0, 10), "$CACST,6,1");
}

TEST(SimModem, AcknowledgesTheFramesThatCame) {
    // Of many seeds, one that spoils some frames of three.
    for (unsigned seed = 0; seed < 20; ++seed) {
        Rig rig(Rig::pair("mm2", 100, "bad_crc = 0.5\nseed = " + std::to_string(seed)));
        rig.boot();
        rig.say(one, "CCCYC,0,1,2,2,1,3");
        for (int k = 0; k < 3; ++k) {
            rig.run(0.2);
            rig.say(one, "CCTXD,1,2,1,0" + std::to_string(k + 1));
        }
        rig.run(10);
        EXPECT_EQ(rig.count(two, "$CARXD") + rig.count(two, "$CAMSG,BAD_CRC"), 3U);
        for (const char* k : {"1", "2", "3"}) {
            EXPECT_EQ(rig.count(two, std::string("$CARXD,1,2,1,") + k),
                      rig.count(one, std::string("$CAACK,2,1,") + k));
        }
    }
}

TEST(SimModem, RemusTransponders) {
    Rig rig(Rig::pair("mm1") +
            "[transponder a]\nletter = A\nx_m = 0\ny_m = 600\n"
            "[transponder b]\nletter = B\nx_m = 300\ny_m = 400\nturn_around_ms = 50\n"
            "[transponder d]\nletter = D\nx_m = 0\ny_m = 1200\n");
    rig.boot();
    rig.raw(one, "$CCPDT,1,2,0,0,1383,1,1,1,1*66");
    rig.run(1.3);
    EXPECT_EQ(rig.heard(one), (Lines{"SNPDT,1,2,0,0,1383,1,1,1,1"}));
    rig.run(0.2);
    // 600 m and 500 m at 1500 m/s; nothing at C; D answers after the timeout
    EXPECT_EQ(rig.heard(one).at(1).substr(0, 22), "SNTTA,0.4000,0.3333,,,");
    EXPECT_EQ(rig.heard(one).size(), 2U) << "no statistics follow";
    EXPECT_EQ(rig.truths.size(), 6U);
}

TEST(SimModem, PublishedTravelTimes) {
    Rig rig("[water]\nepoch = 2024-05-01T20:44:57Z\n" + Rig::pair("mm2").substr(8) +
            "[transponder a]\nquery_hz = 26000\nreply_hz = 25000\nx_m = 0\ny_m = 1382.4\n"
            "[transponder b]\nquery_hz = 26000\nreply_hz = 26500\nx_m = 888\ny_m = 0\n"
            "[transponder other]\nquery_hz = 27000\nreply_hz = 25000\nx_m = 10\ny_m = 0\n");
    rig.boot();
    rig.say(one, "CCPNT,26000,5,5,5000,25000,26500,0,0,1");
    rig.run(6);
    EXPECT_EQ(rig.first(one, "$SNTTA"), "$SNTTA,0.9216,0.5920,,,204504.00*5B");
}

TEST(SimModem, PublishedNarrowbandCommand) {
    Rig rig(Rig::pair("mm2") +
            "[transponder a]\nquery_hz = 26000\nreply_hz = 25000\nx_m = 0\ny_m = 600\n");
    rig.boot();
    rig.raw(one, "$CCPNT,26000,5,5,1353,25000,0,0,0,1*60");
    rig.run(2);
    EXPECT_EQ(rig.heard(one).at(0), "SNPNT,26000,5,5,1353,25000,0,0,0,1");
    EXPECT_EQ(rig.heard(one).at(1).substr(0, 16), "SNTTA,0.4000,,,,");
}

TEST(SimModem, NoiseOnTheLineIsNoCommand) {
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    rig.raw(one, "$CCCFQ,SRC*00");  // wrong checksum
    rig.raw(one, "$CCXYZ,1");
    rig.raw(one, "garbage");
    rig.raw(one, "");
    rig.raw(one, "$");
    rig.raw(one, "$CACFG,SRC,1*33");  // not a host's
    rig.raw(one, std::string("\xff\x00$CCCFQ,SRC", 12));
    rig.raw(one, "$CCCF$CCCFQ,SRC");  // half a line, then a whole one, without checksum
    rig.raw(one, "$CCCFQ,nobody");
    rig.run(1);
    EXPECT_EQ(rig.heard(one),
              (Lines{"CAERR,204502,NMEA,1,bad checksum", "CAERR,204502,NMEA,2,unknown command",
                     "CACFG,SRC,1", "CACFG,SRC,1", "CAERR,204502,CFQ,3,unknown setting"}));
}

TEST(SimModem, IsBusyWhileItSpeaks) {
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    rig.say(one, "CCMPC,1,2");
    rig.run(0.2);
    for (const char* command : {"CCMPC,1,2", "CCCYC,0,1,2,0,1,1", "CCMUC,1,2,0001",
                                "CCPDT,1,2,0,0,1383,1,1,1,1", "CCTDP,2,1,0,0,01"})
        rig.say(one, command);
    rig.say(one, "CCCFQ,SRC");  // this is answered
    rig.run(0.5);
    EXPECT_EQ(rig.count(one, "$CAERR,204502,MPC,4,busy"), 1U);
    EXPECT_EQ(rig.count(one, "$CAERR"), 5U);
    EXPECT_EQ(rig.count(one, "$CACFG,SRC,1"), 1U);
}

TEST(SimModem, ANewerCycleWinsWhileTheOldOneWaitsForData) {
    Rig rig(Rig::pair("mm2"));
    rig.boot();
    rig.say(one, "CCCYC,0,1,2,1,0,3");
    rig.run(0.5);
    rig.say(one, "CCCYC,0,1,2,2,0,1");
    rig.run(0.5);
    rig.say(one, "CCTXD,1,2,0,07");
    rig.run(20);
    EXPECT_EQ(rig.count(two, "$CARXD,1,2,0,1,07"), 1U);
    EXPECT_EQ(rig.count(one, "$CAERR"), 0U);
}

TEST(SimModem, RestartsInTheMiddleOfAPacket) {
    Rig rig(Rig::pair("mm1", 1500, "") + "reboot_s = 5\n");  // the second node
    rig.boot();
    rig.say(two, "CCCYC,0,2,1,0,1,1");
    rig.run(1.2);
    rig.say(two, "CCTXD,2,1,1,01");
    rig.run(10);
    EXPECT_EQ(rig.count(two, "$CAREV,000001,INIT"), 1U);
    EXPECT_EQ(rig.count(two, "$CATXF,1"), 0U);
    EXPECT_EQ(rig.count(one, "$CARXD"), 0U);
    EXPECT_EQ(rig.truths.back().outcome, Outcome::lost);
    rig.clear();
    rig.say(two, "CCCFQ,CST");
    rig.run(1);
    EXPECT_EQ(rig.heard(two), (Lines{"CACFG,CST,1"})) << "settings outlive a restart";
}

TEST(SimModem, SaysOnlyWhatIsSwitchedOn) {
    std::string text = Rig::pair("mm2");
    text.replace(text.find("CST:1, RXP:1"), 12, "CST:0, XST:0");
    Rig rig(text);
    rig.boot();
    send_at_rate_0(rig, "01");
    EXPECT_EQ(rig.heard(two),
              (Lines{"CACYC,0,1,2,0,1,1", "CARXD,1,2,1,1,01", "CATXP,0", "CATXF,0"}));
    EXPECT_EQ(rig.count(one, "$CAXST") + rig.count(one, "$CACST"), 0U);
}

}  // namespace seautils::sim
