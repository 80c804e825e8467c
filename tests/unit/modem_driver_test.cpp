// The dialogue with a Micro-Modem (specs/micromodem.md §5), and what goes wrong in it.
#include "modem_rig.hpp"

#include "seautils/core/error.hpp"

namespace seautils::modem {
namespace {

std::string refusal(const Options& options) {
    try {
        Driver driver(options);
        return "taken";
    } catch (const DataError& e) {
        return e.what();
    }
}

/// Answers what is written with its echo, as far as it is a setting.
void echo(Rig& rig, const Lines& written) {
    for (const std::string& body : written) rig.answer(body, "0.93.0.30");
}

}  // namespace

TEST(ModemDriver, StartOfTheFirstGeneration) {
    Options options;
    options.id = 5;
    options.settings = {{"XST", "1"}, {"DTO", "10"}};
    options.query = true;
    Rig rig(options);
    rig.open();
    for (const char* setting : {"CST,1", "XST,1", "DTO,10", "SRC,5", "REV,1", "RXP,1"}) {
        EXPECT_EQ(rig.written(), (Lines{std::string("CCCFG,") + setting}));
        rig.says(std::string("CACFG,") + setting);
    }
    EXPECT_EQ(rig.written(), (Lines{"CCMSC,5,5,0"}));
    rig.says_all({"CAMSC,5,5,0", "CAREV,120000,INIT,0.93.0.30", "CAREV,120000,AUV,0.93.0.30"});
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(1.9);
    EXPECT_EQ(rig.written(), Lines{});  // it settles for 2 s
    rig.pass(0.3);                      // 12:00:02.5
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(0.54);
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(0.036);
    EXPECT_EQ(rig.written(), (Lines{"CCCLK,2024,05,01,12,00,04"}));
    EXPECT_EQ(rig.now().utc.ns, parse_utc_ns("2024-05-01T12:00:03.076Z"));
    EXPECT_EQ(rig.told(), Lines{});
    rig.says("CACLK,2024,05,01,12,00,04");
    EXPECT_EQ(rig.told(), (Lines{"CLOCK_SET 2024-05-01T12:00:04Z"}));
    EXPECT_EQ(rig.written(), (Lines{"CCCFQ,ALL"}));
    rig.pass(1.5);
    rig.says("CACFG,AGC,1");
    rig.pass(1.5);
    EXPECT_FALSE(rig.driver().ready());
    rig.pass(0.6);  // two seconds without another
    EXPECT_TRUE(rig.driver().ready());
    EXPECT_EQ(rig.told(), (Lines{"READY"}));
}

TEST(ModemDriver, StartOfTheSecondGeneration) {
    Options options;
    options.settings = {{"recv.base64data", "0"}};
    options.query = true;
    Rig rig(options);
    rig.open();
    rig.says("CACFG,CST,1");
    rig.written();
    rig.says("CACFG,recv.base64data,0");
    for (const char* setting : {"SRC,1", "REV,1", "RXP,1"})
        rig.says(std::string("CACFG,") + setting);
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,SRC,1", "CCCFG,REV,1", "CCCFG,RXP,1", "CCMSC,1,1,0"}));
    rig.says_all({"CAREV,030303,INIT,2.0.27087", "CAREV,030303,AUV,2.0.27087",
                  "CAREV,030303,COPROC,0.30.0.56"});
    rig.pass(2.8);
    EXPECT_EQ(rig.written(), (Lines{"CCTMS,2024-05-01T12:00:04Z,0"}));
    rig.says("CATMS,0,2024-05-01T12:00:04Z");
    EXPECT_EQ(rig.written(), (Lines{"CCCFQ,TOP"}));
    rig.pass(2.1);
    EXPECT_EQ(rig.told(), (Lines{"CLOCK_SET 2024-05-01T12:00:04Z", "READY"}));
    rig.pass(7.8);
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(0.2);  // ten seconds of silence
    EXPECT_EQ(rig.written(), (Lines{"CCTMQ,0"}));
}

TEST(ModemDriver, ClockIsSetWithinTheWindowWhateverTheTime) {  // pitfall 19
    for (int ms = 0; ms < 1000; ms += 37) {
        Rig rig;
        rig.pass(ms / 1000.0);
        rig.open();
        for (int k = 0; k < 5000 && !rig.driver().ready(); ++k) {
            for (const std::string& body : rig.written()) {
                if (body.starts_with("CCCLK")) {
                    const std::int64_t into_ms = rig.now().utc.ns / 1'000'000 % 1000;
                    EXPECT_GE(into_ms, 50);
                    EXPECT_LE(into_ms, 101);
                    Sentence s;
                    const std::string echoed = "$CACLK" + body.substr(5);
                    stream::parse_sentence(echoed, s);
                    EXPECT_EQ(read_clock_ns(s),
                              (rig.now().utc.ns / 1'000'000'000 + 1) * 1'000'000'000);
                }
                rig.answer(body, "0.93.0.30");
            }
            rig.pass(0.001);
        }
        EXPECT_TRUE(rig.driver().ready());
    }
}

TEST(ModemDriver, ClockThatStaysOff) {
    Rig rig;
    rig.open();
    int set = 0;
    for (int k = 0; k < 300 && !rig.driver().ready(); ++k) {
        for (const std::string& body : rig.written()) {
            if (body.starts_with("CCCLK")) {
                ++set;
                rig.says("CACLK,2001,01,01,00,00,00");
            } else {
                rig.answer(body, "0.93.0.30");
            }
        }
        rig.pass(0.1);
    }
    EXPECT_EQ(set, 5);
    const Lines told = rig.told();
    ASSERT_EQ(told.size(), 2U);
    EXPECT_TRUE(told[0].starts_with("ERROR the modem's clock is off by -736"));
    EXPECT_EQ(told[1], "READY");
}

TEST(ModemDriver, ClockIsSetAgainWhenItIsOff) {
    Rig rig;
    rig.start("2.0.27087");
    for (int k = 0; k < 8; ++k) {
        rig.pass(9);
        rig.says("CACFG,SRC,1");  // whatever: it lives
    }
    rig.pass(10.1);
    EXPECT_EQ(rig.written(), (Lines{"CCTMQ,0"}));
    rig.says("CATMQ,2024-05-01T12:00:00Z,RTC,RTC");  // minutes behind
    rig.pass(1.1);
    const Lines written = rig.written();
    ASSERT_EQ(written.size(), 1U);
    EXPECT_TRUE(written[0].starts_with("CCTMS,2024-05-01T12:01:")) << written[0];
}

TEST(ModemDriver, ClockOfTheSystemStepped) {
    Rig rig;
    rig.start();
    rig.step_clock(3600);
    rig.driver().clock_stepped(rig.now());
    rig.pass(1.1);
    const Lines written = rig.written();
    ASSERT_EQ(written.size(), 1U);
    EXPECT_TRUE(written[0].starts_with("CCCLK,2024,05,01,13,00,")) << written[0];
}

TEST(ModemDriver, OtherGenerationThanThought) {
    Options options;
    options.reset = false;
    Rig rig(options);
    rig.open();
    for (int k = 0; k < 4; ++k) echo(rig, rig.written());
    rig.pass(0.8);
    EXPECT_EQ(rig.written(), (Lines{"CCCLK,2024,05,01,12,00,02"}));
    rig.says("CAERR,120000,NMEA,5,unknown");
    rig.pass(1);
    EXPECT_EQ(rig.written(), (Lines{"CCTMS,2024-05-01T12:00:02Z,0"}));
}

TEST(ModemDriver, AnswersAreAwaitedFiveSecondsThreeTimes) {
    Rig rig;
    rig.open();
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,CST,1"}));
    rig.pass(4.9);
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(0.2);
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,CST,1"}));
    rig.says("CARXP,1");  // it lives, but does not answer
    rig.pass(5);
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,CST,1"}));
    rig.says("CARXP,1");
    rig.pass(5);
    EXPECT_EQ(rig.told(), (Lines{"CONFIG_REFUSED CCCFG,CST,1 was not echoed"}));
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,SRC,1"}));
}

TEST(ModemDriver, FiveMissingAnswersMeanThatNobodyIsThere) {
    Rig rig;
    rig.open();
    rig.pass(24.9);
    EXPECT_FALSE(rig.driver().output().reopen);
    rig.pass(0.2);
    EXPECT_TRUE(rig.driver().output().reopen);
    EXPECT_EQ(rig.told(), (Lines{"CONFIG_REFUSED CCCFG,CST,1 was not echoed",
                                 "NOT_RESPONDING 5 commands were not answered"}));
    EXPECT_FALSE(rig.driver().wake());
    rig.open();
    EXPECT_EQ(rig.told(), (Lines{"DEVICE_BACK"}));
}

TEST(ModemDriver, SettingsMustBeEchoedWithTheirValue) {  // pitfall 18
    Rig rig;
    rig.open();
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,CST,1"}));
    rig.says("CACFG,SRC,1");  // another setting is no answer
    EXPECT_EQ(rig.written(), Lines{});
    rig.says("CACFG,CST,0");  // nor is another value
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,CST,1"}));
    rig.says("CACFG,CST,10");
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,CST,1"}));
    rig.says("CACFG,CST,0");
    EXPECT_EQ(rig.told(), (Lines{"CONFIG_REFUSED CCCFG,CST,1 was not echoed"}));
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,SRC,1"}));
    rig.says("CACFG,SRC,1");
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,REV,1"}));
}

TEST(ModemDriver, RebootInTheMiddleOfAPacket) {  // pitfall 18
    Rig rig;
    rig.start();
    rig.pass(11);  // the start of its own is long over
    rig.written();
    rig.says("CACFG,SRC,1");
    rig.transmit(data_for(2, 0, true, {"a"}));
    rig.says_all({"CACYC,0,1,2,0,1,1", "CATXP,4", "CAREV,000001,INIT,0.93.0.30"});
    EXPECT_EQ(rig.told(), (Lines{"REBOOT", "result #7 FAILED: the modem started anew"}));
    rig.written();
    rig.transmit(data_for(2, 0, true, {"a"}, 8));
    EXPECT_EQ(rig.told(), (Lines{"result #8 FAILED: the modem is not ready"}));
    rig.pass(1.9);
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(0.2);
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,CST,1"}));  // settings and clock once more
    for (int k = 0; k < 40 && !rig.driver().ready(); ++k) {
        rig.says("CACFG,CST,1");
        echo(rig, rig.written());
        rig.pass(0.1);
    }
    EXPECT_TRUE(rig.driver().ready());
    const Lines told = rig.told();
    ASSERT_EQ(told.size(), 2U);
    EXPECT_TRUE(told[0].starts_with("CLOCK_SET"));
    EXPECT_EQ(told[1], "READY");
}

TEST(ModemDriver, KeepAlive) {
    Rig rig;
    rig.start();
    rig.pass(9.8);
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(0.3);
    EXPECT_EQ(rig.written(), (Lines{"CCCFQ,SRC"}));
    rig.says("CACFG,SRC,1");
    rig.pass(9.8);
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(0.3);
    EXPECT_EQ(rig.written(), (Lines{"CCCFQ,SRC"}));
    EXPECT_EQ(rig.told(), Lines{});
}

TEST(ModemDriver, DeviceLostAndBack) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 0, false, {"a"}));
    rig.driver().lost("Input/output error", rig.now());
    EXPECT_EQ(rig.told(),
              (Lines{"DEVICE_LOST Input/output error", "result #7 FAILED: the device was lost"}));
    EXPECT_FALSE(rig.driver().wake());
    rig.transmit(data_for(2, 0, false, {"a"}, 8));
    EXPECT_EQ(rig.told(), (Lines{"result #8 FAILED: the modem is not ready"}));
    rig.written();
    rig.open();
    EXPECT_EQ(rig.told(), (Lines{"DEVICE_BACK"}));
    EXPECT_EQ(rig.written(), (Lines{"CCCFG,CST,1"}));
}

TEST(ModemDriver, OneTransmissionAtATime) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 0, false, {"a"}));
    rig.transmit(data_for(2, 0, false, {"b"}, 8));
    EXPECT_EQ(rig.told(), (Lines{"result #8 BUSY: another transmission is under way"}));
    EXPECT_EQ(rig.written(), (Lines{"CCCYC,0,1,2,0,0,1"}));
}

TEST(ModemDriver, WhatCannotEndBeforeItsDeadlineIsLate) {  // pitfall 22
    Rig rig;
    rig.start();
    // Rate 0: 0.9 s and 3.2 s; an acknowledgement 0.9 s; 22 bytes of a line at 19200 baud 0.011 s.
    for (const bool ack : {false, true}) {
        auto t = data_for(2, 0, ack, {"a"});
        const double needs = (ack ? 5.0 : 4.1) + 22 * 10 / 19200.0;
        t.deadline =
            record::UtcTime{rig.now().utc.ns + static_cast<std::int64_t>((needs - 0.001) * 1e9)};
        rig.transmit(t);
        EXPECT_EQ(rig.told(), (Lines{"result #7 LATE: it would end behind its deadline"}));
        EXPECT_EQ(rig.written(), Lines{});
    }
    auto t = data_for(2, 0, false, {"a"});
    t.deadline = record::UtcTime{rig.now().utc.ns + 4'120'000'000};
    rig.transmit(t);
    EXPECT_EQ(rig.written(), (Lines{"CCCYC,0,1,2,0,0,1"}));
    rig.pass(5.1);  // not answered: by now it is too late to say it again
    EXPECT_EQ(rig.written(), Lines{});
    EXPECT_EQ(rig.told(), (Lines{"result #7 LATE: it would end behind its deadline"}));
}

TEST(ModemDriver, WhatNoModemCanSendIsRefused) {
    Rig rig;
    rig.start();
    const auto why = [&](const record::Transmission& t) {
        rig.transmit(t);
        const Lines told = rig.told();
        return told.empty() ? std::string("taken") : told[0];
    };
    EXPECT_EQ(why(data_for(2, 0, false, {})), "result #7 REFUSED: no data");
    EXPECT_EQ(why(data_for(2, 1, false, {"", ""})), "result #7 REFUSED: no data");
    EXPECT_EQ(why(data_for(2, 0, false, {"a", "b"})),
              "result #7 REFUSED: 2 frames where a packet of rate 0 has at most 1");
    EXPECT_EQ(why(data_for(2, 0, false, {std::string(33, 'a')})),
              "result #7 REFUSED: frame 0 of 33 bytes where rate 0 has at most 32");
    EXPECT_EQ(why(data_for(2, 7, false, {"a"})),
              "result #7 REFUSED: data rate 7 is none of 0 1 2 3 4 5 6");
    EXPECT_EQ(why(data_for(31, 0, false, {"a"})), "result #7 REFUSED: dest 31 is not 0 to 30");
    auto t = data_for(0, 0, false, {});
    t.kind = record::Kind::ping;
    EXPECT_EQ(why(t), "result #7 REFUSED: dest 0 is not 1 to 30");
    t.kind = record::Kind::mini;
    EXPECT_EQ(why(t), "result #7 REFUSED: a minipacket's value is 0 to 8191, and this has none");
    t.mini = 8192;  // pitfall 21: 13 bits
    EXPECT_EQ(why(t), "result #7 REFUSED: a minipacket's value is 0 to 8191, and this has 8192");
    t.kind = record::Kind::blank;
    EXPECT_EQ(why(t), "result #7 REFUSED: nothing that a modem can send");
    EXPECT_EQ(rig.written(), Lines{});
}

TEST(ModemDriver, AcknowledgementsOfOthersAreNotOurs) {  // pitfall 11
    Rig rig;
    rig.start();
    const auto send = [&](std::uint32_t number) {
        rig.transmit(data_for(2, 1, true, {"a", "b"}, number));
        rig.says_all({"CACYC,0,1,2,1,1,2", "CADRQ,120000,1,2,1,64,1", "CADRQ,120000,1,2,1,64,2",
                      "CATXP,9", "CATXF,9"});
        rig.pass(0.6);
        EXPECT_EQ(rig.told(), (Lines{fmt::format("result #{} SENT", number)}));
    };
    send(7);
    rig.says_all({"CAACK,3,1,1,1", "CAACK,2,4,1,1", "CAACK,2,1,3,1"});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 3>1", "HEARD 2>4", "HEARD 2>1"}));
    rig.says_all({"CAACK,2,1,2,1", "CAACK,2,1,2,1"});
    EXPECT_EQ(rig.told(), (Lines{"ack 2>1 #7 [1]", "HEARD 2>1"}));
    send(8);
    rig.says("CAACK,2,1,1,1");  // the next packet's now
    EXPECT_EQ(rig.told(), (Lines{"ack 2>1 #8 [0]"}));
}

TEST(ModemDriver, AnAcknowledgementThatComesTooLateIsSomebodyElses) {  // pitfall 11
    Rig rig;
    rig.start();
    const auto send = [&](std::uint32_t number) {
        rig.transmit(data_for(2, 1, true, {"a"}, number));
        rig.says_all({"CACYC,0,1,2,1,1,1", "CADRQ,120000,1,2,1,64,1", "CATXP,9", "CATXF,9"});
        rig.pass(0.6);
        EXPECT_EQ(rig.told(), (Lines{fmt::format("result #{} SENT", number)}));
    };
    // Node 2 did not hear us. It acknowledges a frame of node 3's, and a Micro-Modem 1 says "for us".
    send(7);
    rig.says("CACYC,0,3,2,1,1,1");
    rig.told();
    rig.says("CAACK,2,1,1,1");
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1"}));
    send(8);
    rig.pass(12);  // the other's cycle was not heard, either
    rig.told();
    rig.says("CAACK,2,1,1,1");
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1"}));
    send(9);
    rig.pass(8);
    rig.told();
    rig.says("CAACK,2,1,1,1");
    EXPECT_EQ(rig.told(), (Lines{"ack 2>1 #9 [0]"}));
}

TEST(ModemDriver, BroadcastIsNeverAcknowledged) {  // pitfall 12
    Rig rig;
    rig.start();
    rig.transmit(data_for(0, 0, true, {"a"}));
    EXPECT_EQ(rig.written(), (Lines{"CCCYC,0,1,0,0,0,1"}));
}

TEST(ModemDriver, UnacknowledgedDataIsSentOnlyWhenTheSoundHasLeft) {  // pitfall 13
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 0, false, {"a"}));
    rig.says_all({"CACYC,0,1,2,0,0,1", "CATXP,4", "CATXF,4", "CADRQ,120000,1,2,0,32,1"});
    EXPECT_EQ(rig.told(), Lines{});
    rig.says("CAERR,120000,DATA_TIMEOUT,1");
    EXPECT_EQ(rig.told(), (Lines{"ERROR 120000,DATA_TIMEOUT,1",
                                 "result #7 FAILED: the modem did not get its data in time"}));
}

TEST(ModemDriver, LostFramesTakeTheirPlace) {  // pitfall 15
    Rig rig;
    rig.start();
    const std::string stats =
        "CACST,6,1,20240501120010.1234,0,1000,40,200,150,1,2,3,4,5,5,2,1,0,3,3,1,150,20,15,10,-9,"
        "200,0.1,5,25000,5000";
    rig.says_all({"CARXP,2", "CACYC,0,2,1,1,0,3", "CARXD,2,1,0,1,aa", "CAMSG,BAD_CRC,2",
                  "CARXD,2,1,0,3,cc", stats});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1", "reception 2>1 r1 [aa  cc] bad [1] stats 1"}));
    rig.says_all(
        {"CACYC,0,2,1,1,0,3", "CARXD,2,1,0,1,aa", "CAMSG,Bad CRC", "CARXD,2,1,0,3,cc", stats});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1", "reception 2>1 r1 [aa  cc] bad [1] stats 1"}));
    // Not complained of, but counted as bad at the end.
    rig.says_all({"CACYC,0,2,1,1,0,3", "CARXD,2,1,0,3,cc",
                  "CACST,6,1,20240501120010.1234,0,1000,40,200,150,1,2,3,4,5,1,2,1,0,3,3,2,150,20,"
                  "15,10,-9,200,0.1,5,25000,5000"});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1", "reception 2>1 r1 [  cc] bad [0 1] stats 1"}));
    // Nothing came of it at all.
    rig.says_all({"CACYC,0,2,1,1,0,3", "CAMSG,PACKET_TIMEOUT,1", "CACST,6,2,20240501120010.1234"});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1", "reception 2>1 r1 [  ] bad [0 1 2] stats 1"}));
}

TEST(ModemDriver, FramesCountedFromZeroByOldFirmware) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 1, false, {"a", "b"}));
    rig.written();
    rig.says_all({"CACYC,0,1,2,1,0,2", "CADRQ,120000,1,2,0,64,0", "CADRQ,120000,1,2,0,64,1"});
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,1,2,0,61", "CCTXD,1,2,0,62"}));
}

TEST(ModemDriver, DataThatWasGarbledIsSaidAgain) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 1, false, {"a"}));
    rig.says_all({"CACYC,0,1,2,1,0,1", "CADRQ,120000,1,2,0,64,1"});
    rig.written();
    rig.says("CAERR,120000,NMEA,2,checksum");
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,1,2,0,61"}));
    rig.says_all({"CATXD,1,2,0,61", "CAERR,120000,NMEA,2,checksum"});
    EXPECT_EQ(rig.written(), Lines{});
}

TEST(ModemDriver, CommandsThatWereNotUnderstoodAreSaidAgainAtOnce) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 1, false, {"a"}));
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(rig.written(), (Lines{"CCCYC,0,1,2,1,0,1"}));
        rig.says("CAERR,120000,NMEA,2,checksum");
    }
    const Lines told = rig.told();
    EXPECT_EQ(told.back(), "result #7 FAILED: the modem did not take CCCYC");
}

TEST(ModemDriver, CommandsThatTheModemRefusesAreNotSaidAgain) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 6, false, {"a"}));
    rig.written();
    rig.says("CAERR,130357,CYC,3,field 4 is not 0 to 5");
    EXPECT_EQ(rig.written(), Lines{});
    EXPECT_EQ(rig.told().back(),
              "result #7 FAILED: the modem refused it: 130357,CYC,3,field 4 is not 0 to 5");
}

TEST(ModemDriver, FaultsWhileItSettlesAreAboutNothingThatWasSaid) {
    Rig rig;
    rig.open();
    for (const std::string& body : rig.written()) rig.answer(body, "0.93.0.30");
    while (!rig.driver().ready() && rig.now().steady_ns < 60'000'000'000) {
        rig.says("CAERR,120000,CYC,3,field 4 is not 0 to 5");
        rig.says("CAERR,120000,NMEA,5,unknown");
        rig.pass(0.5);
        for (const std::string& body : rig.written()) {
            EXPECT_TRUE(body.starts_with("CC")) << body;
            rig.answer(body, "0.93.0.30");
        }
    }
    EXPECT_TRUE(rig.driver().ready());
}

TEST(ModemDriver, ARequestMeansThatTheCycleWasTaken) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 1, false, {"a"}));
    rig.written();
    rig.says("CADRQ,120000,1,2,0,64,1");  // the echo of CCCYC was lost
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,1,2,0,61"}));
    rig.pass(6);
    EXPECT_EQ(rig.written(), Lines{});
}

TEST(ModemDriver,
     RequestsOfNobodysAreAnsweredWithNothing) {  // pitfall 17: else the modem sends tests
    Rig rig;
    rig.start();
    rig.says("CADRQ,120000,1,2,0,32,1");
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,1,2,0,"}));
    rig.says("CADRQ,120000,4,2,0,32,1");
    EXPECT_EQ(rig.written(), Lines{});
}

TEST(ModemDriver, FramesThatTheModemHasNoRoomFor) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 1, false, {std::string(64, 'a')}));
    rig.written();
    rig.says_all({"CACYC,0,1,2,1,0,1", "CADRQ,120000,1,2,0,32,1"});
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,1,2,0,"}));
    EXPECT_EQ(rig.told(),
              (Lines{"result #7 FAILED: the modem asks for 32 bytes of frame 0, which has 64"}));
}

TEST(ModemDriver, TransmissionsThatDoNotEndAreGivenUp) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 0, false, {"a"}));
    rig.says_all(
        {"CACYC,0,1,2,0,0,1", "CATXP,4", "CATXF,4", "CADRQ,120000,1,2,0,32,1", "CATXP,32"});
    rig.pass(9.5);
    rig.says("CACFG,SRC,1");
    rig.pass(6.5);
    EXPECT_EQ(rig.told(), Lines{});
    rig.pass(0.2);  // 4.1 s of sound, 12 s more
    EXPECT_EQ(rig.told(), (Lines{"result #7 FAILED: the modem did not say that it ended (CATXF)"}));
}

TEST(ModemDriver, WhatTheModemCouldNotSend) {
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 0, false, {"a"}));
    rig.says_all(
        {"CACYC,0,1,2,0,0,1", "CAXST,6,20240501,120001.0000,0,3,200,4000,25000,0,1,2,1,1,0,2,4"});
    EXPECT_EQ(rig.told(), (Lines{"result #7 FAILED: transmitting is inhibited stats 1"}));
}

TEST(ModemDriver, NoiseOnTheLineIsToldAndSkipped) {
    Rig rig;
    rig.start();
    rig.line("\xff\x80 x");
    rig.line("$CAMPA,1,2*5E");
    rig.line("$CARXD,1,2,1,1,3535");  // lost its end: the modem writes checksums
    rig.line("$CACYC,0,x,2,0,1,1*11");
    rig.line("$CAMPC,1");
    EXPECT_EQ(rig.told(),
              (Lines{"< \\xff\\x80 x (no sentence begins in it)",
                     "< $CAMPA,1,2*5E (checksum 5E is not the 5D of its bytes)",
                     "< $CARXD,1,2,1,1,3535 (the checksum is missing)",
                     "< $CACYC,0,x,2,0,1,1*11 (CACYC field 2 'x' is not a whole number 0 to 127)",
                     "< $CAMPC,1 (the checksum is missing)"}));
    EXPECT_EQ(rig.driver().bad_lines(), 5U);
    rig.line("\xff\x01$CAMPA,1,2*5D");
    EXPECT_EQ(rig.told(), (Lines{"HEARD 1>2"}));
    EXPECT_EQ(rig.written(), Lines{});
}

TEST(ModemDriver, RawLines) {
    Options options;
    options.raw = true;
    Rig rig(options);
    rig.open();
    rig.line("$CACFG,CST,1*2A\r\n");
    rig.line("$CACYC,0,x,2,0,1,1*11\r");
    EXPECT_EQ(
        rig.told(),
        (Lines{"> $CCCFG,CST,1*37", "< $CACFG,CST,1*2A (checksum 2A is not the 35 of its bytes)",
               "< $CACYC,0,x,2,0,1,1*11 (CACYC field 2 'x' is not a whole number 0 to 127)"}));
    rig.line("$CACFG,CST,1*35\r\n");
    EXPECT_EQ(rig.told(), (Lines{"< $CACFG,CST,1*35", "> $CCCFG,SRC,1*31"}));
    rig.line(std::string(5000, '\xff'));
    const auto records = rig.records();
    EXPECT_LT(records[0].as<record::Raw>()->line.size(), 3000U);
}

TEST(ModemDriver, GatewayBuoy) {
    Options options;
    options.gateway = 4;
    options.reset_settings = true;  // never, through a buoy
    Rig rig(options);
    rig.open();
    EXPECT_EQ(rig.written(), (Lines{"#M4CCCFG,CST,1"}));
    rig.line("#M4$CACFG,CST,1*35\r\n");
    rig.pass(0.01);
    EXPECT_EQ(rig.written(), (Lines{"#G4", "#M4CCCFG,SRC,1"}));
    for (int k = 0; k < 31; ++k) {
        rig.line("#M4" + stream::sentence("CARXP,1"));
        rig.pass(1);
    }
    const Lines written = rig.written();
    EXPECT_EQ(std::count(written.begin(), written.end(), "#G4"), 1);
}

TEST(ModemDriver, OptionsThatCannotBe) {
    Options options;
    options.id = 31;
    EXPECT_EQ(refusal(options), "id 31 is not 1 to 30");
    options.id = 0;
    EXPECT_EQ(refusal(options), "id 0 is not 1 to 30");
    options.id = 1;
    options.settings = {{"SRC", "2"}};
    EXPECT_EQ(refusal(options), "setting SRC is the modem's id, and said as such");
    options.settings = {{"A,B", "2"}};
    EXPECT_EQ(refusal(options), "setting 'A,B' is no name");
    options.settings = {{"A", "2\r\n"}};
    EXPECT_EQ(refusal(options), "a sentence cannot say '\\x0d'");
    options.settings = {};
    options.sound_speed_mps = 340;
    EXPECT_EQ(refusal(options), "sound speed 340 is not 1300 to 1700");
    options.sound_speed_mps = 1480;
    options.lbl.receive_hz = {};
    EXPECT_EQ(refusal(options), "LBL takes 1 to 4 frequencies to receive");
}

}  // namespace seautils::modem
